"""Random shafts on two to five dry bearings of all families: clearances and interferences, preload by force, closure
and spring, soft supports, a housing that couples all outer rings, loads over five decades.

Every structure holds its shaft along X in both directions and against tilt, so that every scene has an equilibrium:
the potential is convex, and it grows in all directions.
"""

from collections.abc import Callable
from typing import Any

import jax.numpy as jnp
import numpy as np
from campaign.draws import Numbers, Range, even, log
from campaign.structure import Results, Structure, Twin
from shaft_cases import DEEP_GROOVE, RPM, balls, rollers, steel
from tapered_cases import tapered

from jaxbearing.shafts import MatchedSet, MountedBearing, PointLoad, Preload, Section, Shaft, ShaftSystem, Support

LENGTH = 0.3
ANGULAR = balls(13, 53.5e-3, 11.112e-3, 0.515, 0.525, np.radians(40.0))
ROLLERS = rollers(13, 54e-3, 10e-3, 10e-3, 25e-6)
TAPERED = tapered(1e3)
EMPTY = 1.0
"""Largest load on the inner raceway, N, of a bearing that counts as empty. The smallest loads are 0.1 N."""
BALANCE = 1e-8
LOADS: dict[str, Range] = {
    "speed": even(0.0, 20_000.0 * RPM, zero=0.1),
    "axial": log(0.1, 1e4, zero=0.1, negative=0.5),
    "radial": log(0.1, 1e4, negative=0.5),
    "tangential": log(0.1, 1e4, zero=0.1, negative=0.5),
    "place": even(0.0, 1.0),
    "radius": even(0.0, 0.05),
    "diameter": even(20e-3, 45e-3),
    "bore": even(0.0, 0.7),
}
"""`place`: of the load, over the length of the shaft; `bore`: over the diameter."""
CLEARANCE = even(-30e-6, 100e-6)
CLOSURE = even(-30e-6, 30e-6)
STIFFNESS = log(1e6, 1e9)


def shaft_of(
    bearings: tuple[MountedBearing, ...], sets: tuple[MatchedSet, ...] = (), housing: np.ndarray | None = None
) -> ShaftSystem:
    """Two hollow sections of steel with a load on them."""
    sections = [Section(0.5 * LENGTH, 30e-3, 5e-3), Section(0.5 * LENGTH, 30e-3, 5e-3)]
    load = PointLoad("load", 0.1, axial=1.0, radial=1.0, tangential=1.0, radius=0.01)
    return ShaftSystem(Shaft(100.0, sections, steel(206e9)), bearings, sets, [load], housing)


def loads(v: Numbers) -> Numbers:
    """Paths and values of shaft and load."""
    return {
        "shaft.speed": v["speed"],
        "force.load.axial": v["axial"],
        "force.load.radial": v["radial"],
        "force.load.tangential": v["tangential"],
        "force.load.position": LENGTH * v["place"],
        "force.load.radius": v["radius"],
        "shaft.sections.1.outer_diameter": v["diameter"],
        "shaft.sections.1.inner_diameter": v["bore"] * v["diameter"],
        "shaft.sections.2.outer_diameter": 1.2 * v["diameter"],
    }


def _same(names: tuple[str, ...], path: str) -> tuple[dict[str, Range], Callable[[Numbers], Numbers]]:
    """Ranges of a number of several bearings, `path` in each, and from their draws to paths and values."""
    bound = {"geometry.diametral_clearance": CLEARANCE, "closure": CLOSURE}[path]
    ranges = {f"{name}.{path}": bound for name in names}
    return ranges, lambda v: {f"bearing.{name}.{path}": v[f"{name}.{path}"] for name in names}


def clearances(*names: str) -> tuple[dict[str, Range], Callable[[Numbers], Numbers]]:
    return _same(names, "geometry.diametral_clearance")


def closures(*names: str) -> tuple[dict[str, Range], Callable[[Numbers], Numbers]]:
    return _same(names, "closure")


def supports(*paths: str) -> tuple[dict[str, Range], Callable[[Numbers], Numbers]]:
    """Soft supports of the outer rings of bearings and sets; against tilt (20 mm)^2 times as stiff as across."""
    ranges = {f"{path}.{name}": STIFFNESS for path in paths for name in ("axial", "radial")}

    def values(v: Numbers) -> Numbers:
        found = {}
        for path in paths:
            found[f"{path}.support.axial"] = v[f"{path}.axial"]
            found[f"{path}.support.radial"] = v[f"{path}.radial"]
            found[f"{path}.support.tilt"] = 4e-4 * v[f"{path}.radial"]
        return found

    return ranges, values


def preloads(**ranges: Range) -> tuple[dict[str, Range], Callable[[Numbers], Numbers]]:
    """Numbers of the preload of the set `pair`."""
    named = {f"preload.{name}": one for name, one in ranges.items()}
    return named, lambda v: {f"set.pair.{name}": v[name] for name in named}


def housing(count: int) -> tuple[dict[str, Range], Callable[[Numbers], Numbers]]:
    """A housing that couples the outer rings of so many bearings, positive definite."""
    ranges = {"housing": STIFFNESS, "coupling": even(0.0, 5.0)}
    freedoms = np.diag([1.0, 1.0, 1.0, 4e-4, 4e-4])

    def values(v: Numbers) -> Numbers:
        mean = np.full((count, count), 1.0 / count)
        rings = v["housing"][:, None, None] * (np.eye(count) + v["coupling"][:, None, None] * (np.eye(count) - mean))
        together = np.einsum("nij,kl->nikjl", rings, freedoms)
        return {"housing": together.reshape(len(rings), 5 * count, 5 * count)}

    return ranges, values


SUPPORT = Support(axial=1e8, radial=1e8, tilt=4e4)


def two_deep_grooves() -> ShaftSystem:
    return shaft_of((MountedBearing("a", DEEP_GROOVE, 0.03), MountedBearing("b", DEEP_GROOVE, 0.25, "-x")))


def two_tapered() -> ShaftSystem:
    first = MountedBearing("a", TAPERED, 0.05, support=SUPPORT)
    return shaft_of((first, MountedBearing("b", TAPERED, 0.24, "-x", support=SUPPORT)))


def with_spring() -> ShaftSystem:
    pair = MatchedSet("pair", "<>", ANGULAR, 0.05, 20e-3, Preload(spring_force=200.0, spring_stiffness=1e7))
    return shaft_of((MountedBearing("b", ROLLERS, 0.25),), (pair,))


def on_soft_supports() -> ShaftSystem:
    pair = MatchedSet("pair", "><", ANGULAR, 0.06, 20e-3, Preload(force=200.0), support=SUPPORT)
    return shaft_of((MountedBearing("b", DEEP_GROOVE, 0.26, support=SUPPORT),), (pair,))


def three_in_line() -> ShaftSystem:
    ends = MountedBearing("a", DEEP_GROOVE, 0.02), MountedBearing("b", DEEP_GROOVE, 0.28, "-x")
    return shaft_of((*ends, MountedBearing("m", ROLLERS, 0.15)))


def in_a_housing() -> ShaftSystem:
    pair = MatchedSet("pair", "<>", ANGULAR, 0.05, 20e-3, Preload(offset=2e-6))
    return shaft_of((MountedBearing("b", ROLLERS, 0.25),), (pair,), 1e8 * np.eye(15))


def four_of_three_families() -> ShaftSystem:
    pair = MountedBearing("a", TAPERED, 0.04), MountedBearing("b", TAPERED, 0.12, "-x")
    return shaft_of((*pair, MountedBearing("m", ROLLERS, 0.2), MountedBearing("c", DEEP_GROOVE, 0.28)))


def five() -> ShaftSystem:
    three = MatchedSet("pair", "<<>", ANGULAR, 0.06, 20e-3, Preload(offset=2e-6))
    ends = MountedBearing("m", ROLLERS, 0.18), MountedBearing("c", DEEP_GROOVE, 0.27)
    return shaft_of(ends, (three,))


def unbalanced(_: Numbers, results: Results) -> dict[str, tuple[np.ndarray, float]]:
    """Sum of all forces, and of all moments about x = 0, over the sum of their sizes."""
    names = sorted({path.partition("']")[0].removeprefix("bearings['") for path in results if path.startswith("bear")})
    bearings = np.stack([results[f"bearings['{name}'].on_shaft"] for name in names], axis=1)
    at = np.stack([results[f"bearings['{name}'].position"] for name in names], axis=1)
    load = np.concatenate([bearings, results["shaft.load"]], axis=1)
    place = np.concatenate([at, results["shaft.position"]], axis=1)
    size = np.sum(np.abs(load[..., :3]), axis=(1, 2)) + 1.0
    force = np.max(np.abs(np.sum(load[..., :3], axis=1)), axis=1) / size
    about = load[..., 3:] - place[..., None] * load[..., 1:3]
    moment = np.max(np.abs(np.sum(about, axis=1)), axis=1) / (LENGTH * size)
    return {"sum of forces": (force, BALANCE), "sum of moments": (moment, BALANCE)}


def strength(solution: Any) -> Any:
    """Size of the forces of all bearings on the shaft, N."""
    forces = jnp.stack([one.on_shaft[:3] for one in solution.bearings.values()])
    return jnp.sqrt(jnp.sum(jnp.square(forces)) + 1.0)


def mirrored(v: Numbers) -> Numbers:
    """The load on the other side of the plane of azimuth 0."""
    return v | {"force.load.tangential": -v["force.load.tangential"]}


def not_mirrored(_: Numbers, here: Results, __: Numbers, there: Results) -> np.ndarray:
    """The rows have an element at azimuth 0, and dry ones know no sense of rotation."""
    signs = np.array([1.0, 1.0, -1.0, 1.0, -1.0]) / np.array([1.0, 1.0, 1.0, LENGTH, LENGTH])
    worst = []
    for path, values in here.items():
        if path.endswith("on_shaft"):
            apart = values * np.abs(signs) - there[path] * signs
            worst.append(np.max(np.abs(apart), axis=1))
    size = sum(np.sum(np.abs(values[:, :3]), axis=1) for path, values in here.items() if path.endswith("on_shaft"))
    return np.max(worst, axis=0) / (size + 1.0)


MIRROR = Twin("mirrored load, mirrored forces", mirrored, not_mirrored, 1e-6)


def structure(name: str, load: Callable[[], ShaftSystem], *parts: tuple[dict[str, Range], Any]) -> Structure:
    ranges = LOADS | {key: one for own, _ in parts for key, one in own.items()}

    def numbers(v: Numbers) -> Numbers:
        found = loads(v)
        for _, values in parts:
            found |= values(v)
        return found

    return Structure(
        name=f"shaft: {name}",
        kind="shaft",
        load=load,
        ranges=ranges,
        numbers=numbers,
        balances=unbalanced,
        summary=strength,
        twins=(MIRROR,),
    )


STRUCTURES = [
    structure("two deep groove bearings", two_deep_grooves, clearances("a", "b"), closures("a", "b")),
    structure("two tapered bearings, soft", two_tapered, closures("a", "b"), supports("bearing.a", "bearing.b")),
    structure(
        "pair with spring, rollers",
        with_spring,
        clearances("b"),
        preloads(spring_force=log(10.0, 1e3), spring_stiffness=log(3e6, 1e8)),
    ),
    structure(
        "X pair, deep groove, soft",
        on_soft_supports,
        clearances("b"),
        preloads(force=log(10.0, 1e3)),
        supports("bearing.b", "set.pair"),
    ),
    structure("three in line", three_in_line, clearances("a", "b", "m"), closures("a", "b")),
    structure("pair, rollers, one housing", in_a_housing, clearances("b"), preloads(offset=CLOSURE), housing(3)),
    structure("four of three families", four_of_three_families, clearances("m", "c"), closures("a", "b")),
    structure("five", five, clearances("m", "c"), preloads(offset=CLOSURE)),
]
"""Eight programs."""


def share_with_an_empty_bearing(results: Results) -> float:
    """Part of the converged scenes in which a bearing carries nothing."""
    loads_ = [values for path, values in results.items() if path.endswith(".largest_load")]
    smallest = np.min(loads_, axis=0)
    return float(np.mean(smallest[np.isfinite(smallest)] < EMPTY))

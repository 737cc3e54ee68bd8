"""Computes the dimensions of the running bearing from the scene as drawn. One pure function does this for all families.

Seats, temperatures and rotation make the raceways grow (`mounting`); each family computes its dimensions after this
growth (`AbstractBearing.grown`). No equation has to be solved iteratively. The model neglects temperature differences
inside a part, shafts and housings that are longer than the rings, shoulders and ribs of the rings, seats that are not
round, and the loss of interference under load. Shoulders and a longer shaft change the effect of a fit by about 5 %.
"""

import dataclasses
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar
from ..materials import Material
from ..mounting import Annulus, Fit, Fits, FitState, PartTemperatures
from ..mounting.annulus import REFERENCE_TEMPERATURE
from ..mounting.seats import Seat
from ..numerics.checks import demand, numbers_or_none
from ..numerics.refusals import refusals_of, refuse_all
from .facts import Excess
from .growth import FitResult, Growth, Play
from .solution import FailureCause

if TYPE_CHECKING:
    from .bearing import AbstractBearing
else:
    AbstractBearing = Any

Bearing = TypeVar("Bearing", bound="AbstractBearing")
HIGHEST_STRESS = 127e6
"""Hoop stress at the bore of the inner ring above which makers warn of fracture of through-hardened rings, Pa."""


_COLD, _WARM, _RUNNING = (False, False), (True, False), (True, True)
"""States of a mounted bearing: pairs of "has the temperatures of the scene" and "turns"."""


class _Rings(NamedTuple):
    """Growth of rings and rolling elements, hoop stress at the bore of the inner ring, and state of the seats. The
    fields of `seats` are arrays with an entry for each existing seat, that on the shaft first."""

    growth: Growth
    hoop_stress: Float[Array, ""]
    seats: FitState | None

    def last(self, names: tuple[str, ...], name: str) -> FitState | None:
        """Selects a seat in the last of several states of the bearing; `None` if there is no such seat.

        **Arguments:** `names`: names of all existing seats, in the order of the arrays; `name`: name of the seat.
        """
        return None if name not in names else jax.tree.map(lambda leaf: leaf[-1, names.index(name)], self.seats)


def mounting_problems(scene: AbstractBearing) -> Iterator[str | ValueError]:
    """Yields a message or an error for each missing or conflicting input of a scene with seats or temperatures."""
    fits: Fits | None = scene.fits
    temperatures: PartTemperatures | None = scene.temperatures
    if fits is None:
        if temperatures is not None:
            yield "temperatures: they apply to a mounted bearing only; the scene needs a [fits] table"
        return
    # if the fits could not be read, a placeholder without this attribute replaces them, and nothing is checked
    geometry, check_room = scene.geometry, fits.check_room
    for name in ("bore", "outside_diameter"):
        if getattr(geometry, name) is None:
            yield f"geometry.{name}: found nothing, expected a length, which [fits] needs, e.g. '25 mm'"
    yield from refusals_of(check_room, geometry.bore, geometry.outside_diameter)
    yield from refusals_of(check_walls, scene)
    if temperatures is None and scene.thermal is None:
        return
    materials: dict[str, Material | None] = {
        **{f"materials.{name}": material for name, material in scene.materials.named_rings.items()},
        f"materials.{scene.element}s": getattr(scene.materials, f"{scene.element}s"),
        "fits.shaft_material": fits.shaft_material if fits.on_shaft else None,
        "fits.housing_material": fits.housing_material if fits.in_housing else None,
    }
    for name, material in materials.items():
        if material is not None and material.thermal_expansion is None:
            who = "[temperatures]" if scene.thermal is None else "[thermal]"
            needed = f"expected a number, which {who} needs, e.g. '12.5e-6 1/K'"
            yield f"{name}.thermal_expansion: found nothing, {needed}"


def check_walls(scene: AbstractBearing) -> None:
    """Checks that each ring has a wall between its seat and its raceway.

    **Raises:** `ValueError` if it has none."""
    geometry = scene.geometry
    sizes = numbers_or_none(*(leaf for leaf in jax.tree.leaves(geometry)), geometry.bore, geometry.outside_diameter)
    if sizes is None:
        return
    inner, outer = scene.raceway_diameters
    problems: list[ValueError] = []
    for name, word, of, raceway, fine in (
        ("bore", "less", "inner", inner, geometry.bore < inner),
        ("outside_diameter", "more", "outer", outer, geometry.outside_diameter > outer),
    ):
        text = f"geometry.{name} must be {word} than the diameter of the {of} raceway"
        message = lambda name=name, text=text, raceway=raceway: (
            f"{text}, {float(raceway):.6g} m, got {float(getattr(geometry, name)):.6g} m"
        )
        problems += refusals_of(demand, text, fine, message)
    refuse_all(problems)


def running_scene(scene: Bearing) -> tuple[Bearing, FitResult | None, dict[str, FailureCause]]:
    """The bearing that runs: a scene of the same family without seats, whose dimensions are those of the mounted, warm
    and turning bearing.

    **Returns:** the scene, the state of its fits (`None` without them), and possible causes of impossible dimensions.
    """
    if scene.fits is None:
        return scene, None, {}
    states = (_COLD, _RUNNING) if scene.temperatures is None else (_COLD, _WARM, _RUNNING)
    rings = jax.vmap(lambda warm, turning: _rings(scene, warm, turning))(*np.asarray(states).T)
    plays = jax.vmap(scene.play)(jax.tree.map(lambda leaf: jnp.concatenate([jnp.zeros(1), leaf]), rings.growth))
    drawn, fitted, heated, turning = (plays.measure[place] for place in (0, 1, -2, -1))
    last: Play = jax.tree.map(lambda leaf: leaf[-1], plays)
    growth: Growth = jax.tree.map(lambda leaf: leaf[-1], rings.growth)
    on_shaft, in_housing = (rings.last(_seats_of(scene.fits), name) for name in ("shaft", "housing"))
    result = FitResult(
        clearance=last.measure if scene.play_is_clearance else None,
        contact_angle=last.contact_angle,
        axial_shift=last.axial_shift,
        drawn=drawn,
        by_fits=fitted - drawn,
        by_temperatures=heated - fitted,
        by_speed=turning - heated,
        growth_inner=growth.inner,
        growth_outer=growth.outer,
        interference_inner=None if on_shaft is None else on_shaft.interference,
        interference_outer=None if in_housing is None else in_housing.interference,
        pressure_inner=None if on_shaft is None else on_shaft.pressure,
        pressure_outer=None if in_housing is None else in_housing.pressure,
        loose_speed=None if on_shaft is None else on_shaft.loose_speed,
        loose_speed_outer=None if in_housing is None else in_housing.loose_speed,
        hoop_stress=rings.hoop_stress[-1],
    )
    unseated = dataclasses.replace(scene, fits=None, temperatures=None)
    return unseated.grown(growth), result, _impossible(last)


def _impossible(play: Play) -> dict[str, FailureCause]:
    """Causes that leave the running bearing without contacts: message -> `FailureCause`, which says whether it
    applies."""
    return {"fits and temperatures leave the rolling elements no contact": FailureCause(~play.possible, jnp.zeros(0))}


def running_play(scene: AbstractBearing) -> Play:
    """Play of a bearing with fits when it is mounted, warm and turning at its speeds."""
    return scene.play(_rings(scene, *_RUNNING).growth)


def _seats_of(fits: Fits) -> tuple[Seat, ...]:
    """Names of the seats that the scene has."""
    seats: tuple[tuple[Seat, bool], ...] = (("shaft", fits.on_shaft), ("housing", fits.in_housing))
    return tuple(name for name, there in seats if there)


def _rings(scene: AbstractBearing, warm: Array | bool, turning: Array | bool) -> _Rings:
    """Growth and stress of the rings, and the state of the seats.

    Rings and seats are computed as arrays. With scalars, JAX would compile a small program for each of many operations.

    **Arguments:** `warm`: False for the cold bearing; `turning`: False for the bearing at rest.
    """
    fits, operation, geometry = scene.fits, scene.operation, scene.geometry
    assert fits is not None
    raceways, bore, outside = _together(scene.raceway_diameters), geometry.bore, geometry.outside_diameter
    speeds = jnp.where(turning, _together([operation.inner_speed, operation.outer_speed]), 0.0)
    cold = scene.temperatures is None

    def warming(*parts: str) -> Array:
        if cold:
            return jnp.zeros(len(parts))
        temperatures = _together([getattr(scene.temperatures, part) for part in parts])
        return jnp.where(warm, temperatures - REFERENCE_TEMPERATURE, 0.0)

    names, sizes = _seats_of(fits), [(bore, raceways[0]), (raceways[1], outside)]
    bodies = _bodies(list(scene.materials.of_rings), sizes, speeds, warming("inner_ring", "outer_ring"), cold)
    growth, pressures, seats = bodies.free(raceways), jnp.zeros(2), None
    if names:
        sides = slice(0 if "shaft" in names else 1, 2 if "housing" in names else 1)
        materials = [getattr(fits, f"{name}_material") for name in names]
        around = {"shaft": (fits.shaft_bore, bore), "housing": (outside, fits.housing_diameter(outside))}
        their_warming = warming(*(f"of_{name}" for name in names))
        others = _bodies(materials, [around[name] for name in names], speeds[sides], their_warming, cold)
        asked = [fits.interference(name, {"shaft": bore, "housing": outside}[name]) for name in names]
        seats = _seats(fits, bodies, others, _together(asked), sides)
        free = [jnp.zeros(1)] * 2
        free[sides] = jnp.split(seats.pressure, len(names))
        pressures, inside = jnp.concatenate(free), np.asarray([True, False])
        growth = growth + bodies.pressed(raceways, jnp.where(inside, pressures, 0.0), jnp.where(inside, 0.0, pressures))
    element = [getattr(scene.materials, f"{scene.element}s")]
    elements = _bodies(element, [(0.0, 1.0)], speeds[:1], warming("of_elements"), cold)
    strains = [jnp.broadcast_to(body.strain, body.speed.shape) for body in (bodies, elements)]
    return _Rings(Growth(*growth, *strains[0], *strains[1]), bodies.hoop_stress_at_bore(pressures)[0], seats)


def _together(numbers: Iterable[Scalar]) -> Array:
    """Joins numbers to an array. `jnp.stack` is not used, because it fails if only some of the numbers are batched and
    differentiated."""
    return jnp.concatenate([jnp.reshape(jnp.asarray(number), (1,)) for number in numbers])


def _bodies(
    materials: list[Material], sizes: list[tuple[Scalar, Scalar]], speeds: Array, warming: Array, cold: bool
) -> Annulus:
    """Combines several bodies into one `Annulus` whose sizes and material fields are arrays.

    **Arguments:** `sizes`: bore and outside diameter of each body, m; `speeds`: speed of each body, rad/s; `warming`:
    temperature rise of each body, K; `cold`: True if no thermal expansion is needed.
    """
    stacked = _together
    names = ("youngs_modulus", "poisson_ratio", "density", *(() if cold else ("thermal_expansion",)))
    # The fields of this material are arrays, which its constructor refuses: they replace the fields of a built material
    material = jax.tree.map(lambda _: None, materials[0])
    values = [stacked([getattr(single, name) for single in materials]) for name in names]
    fields = lambda tree: [getattr(tree, name) for name in names]
    material = eqx.tree_at(fields, material, values, is_leaf=lambda leaf: leaf is None)
    bores, outsides = zip(*sizes, strict=True)
    return Annulus(material, stacked(bores), stacked(outsides), speeds, warming)


def _seats(fits: Fits, rings: Annulus, others: Annulus, interference: Array, sides: slice) -> FitState:
    """The seats on these sides of the bearing. The shaft lies inside the inner ring, and the housing lies around the
    outer ring.

    **Arguments:** `others`: shaft and housing, if present; `interference`: interference of each seat, m.
    """
    on_shaft, seated = np.arange(2)[sides] == 0, jax.tree.map(lambda leaf: leaf[sides], rings)
    choose = lambda first, second: jax.tree.map(lambda x, y: jnp.where(on_shaft, x, y), first, second)
    inner, outer = choose(others, seated), choose(seated, others)
    return Fit(inner, outer, interference, fits.smoothed(interference)).state()


def fit_excess(scene: AbstractBearing, fit: FitResult) -> Excess:
    """Maps each warning about the seats to a number that is positive where the warning applies."""
    operation, excess = scene.operation, {}
    if fit.interference_inner is not None:
        turning = jnp.abs(jnp.asarray(operation.inner_speed)) > 0.0
        text = "the inner ring is loose on the shaft, where it will creep: a tighter fits.shaft_interference is needed"
        excess[text] = jnp.where(turning, -fit.interference_inner, -1.0)
    if fit.interference_outer is not None:
        turning = jnp.abs(jnp.asarray(operation.outer_speed)) > 0.0
        text = "the outer ring is loose in the rotating housing: a tighter fits.housing_interference is needed"
        excess[text] = jnp.where(turning, -fit.interference_outer, -1.0)
    excess["stress around the bore of the inner ring beyond 127 MPa, where makers warn of bursting rings"] = (
        fit.hoop_stress - HIGHEST_STRESS
    )
    return excess

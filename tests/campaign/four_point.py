"""Random ball bearings with up to four contacts: one ring or both with two groove arcs.

Every dry one has an equilibrium. Of balls that slide, loads as in `balls`.
"""

import functools
from typing import Any, NamedTuple

import numpy as np
from campaign import elastic
from campaign.balls import CAGE, DIMENSIONS, ELASTIC, SLIDING, ball_numbers, largest_of
from campaign.bearings import MIRROR, OIL, OPERATION, STEELS, energy, placing_film, rubbed, summary
from campaign.draws import Numbers, Range, even
from campaign.structure import Results, Structure

import jaxbearing as jb

ARCS: dict[str, Range] = {
    "clearance": even(-0.6e-3, 3.5e-3),
    "shim_inner": even(10.0, 38.0),
    "shim_outer": even(10.0, 38.0),
}
"""Clearance between all contacts over the ball diameter; shim angles, degrees."""
FLOOR = 1.1e-3
"""Granted in balances of forces, N: the floor of the centrifugal force of dry balls."""


class Flank(NamedTuple):
    """One contact of a ball: its race, its side (0 of a ring with one arc) and the end of its results' names."""

    race: str
    side: float
    name: str


def flanks_of(scene: Any) -> list[Flank]:
    found = []
    for race in ("inner", "outer"):
        if getattr(scene.geometry, f"shim_{race}") is None:
            found.append(Flank(race, 0.0, race))
        else:
            found += [Flank(race, 1.0, race), Flank(race, -1.0, f"{race}_second")]
    return found


def arched_numbers(v: Numbers, scene: Any) -> Numbers:
    numbers = ball_numbers(v, scene)
    for race in ("inner", "outer"):
        if getattr(scene.geometry, f"shim_{race}") is not None:
            numbers[f"geometry.shim_{race}"] = np.radians(v[f"shim_{race}"])
    return numbers


class Geometry(NamedTuple):
    """Sizes of the bearings, m: offsets g and distances e of the arcs, A_2 of the ring without displacement, R_i."""

    offset: dict[str, np.ndarray]
    apart: dict[str, np.ndarray]
    across: np.ndarray
    lever: np.ndarray
    cosine: np.ndarray


def geometry_of(n: Numbers) -> Geometry:
    diameter = n["geometry.ball_diameter"]
    offset = {race: (n[f"geometry.conformity_{race}"] - 0.5) * diameter for race in ("inner", "outer")}
    zero = np.zeros_like(diameter)
    apart = {race: g * np.sin(n.get(f"geometry.shim_{race}", zero)) for race, g in offset.items()}
    height = sum(np.sqrt(offset[race] ** 2 - apart[race] ** 2) for race in offset)
    across = height - 0.5 * n["geometry.diametral_clearance"]
    both = offset["inner"] + offset["outer"]
    cosine = np.minimum(across / both, 1.0)
    # with radial preload balls stand at the contact angle 0, and the inner ring is larger
    lever = 0.5 * n["geometry.pitch_diameter"] + offset["inner"] * cosine + np.maximum(across - both, 0.0)
    return Geometry(offset, apart, across, lever, cosine)


def reaches(scene: Any, n: Numbers, r: Results, size: Geometry) -> dict[str, np.ndarray]:
    """Distance of the groove centre from the ball centre that loads and films ask for at each contact, m."""
    diameter, pitch = n["geometry.ball_diameter"], n["geometry.pitch_diameter"]
    modulus = elastic.reduced_modulus(
        (n["materials.rings.youngs_modulus"], float(scene.materials.rings.poisson_ratio)),
        (n["materials.balls.youngs_modulus"], n["materials.balls.poisson_ratio"]),
    )
    found = {}
    for race, side in (("inner", -1.0), ("outer", 1.0)):
        conformity = n[f"geometry.conformity_{race}"]
        rolling = diameter / 2.0 * (1.0 + side * diameter / pitch * size.cosine)
        transverse = conformity * diameter / (2.0 * conformity - 1.0)
        found[race] = elastic.point_stiffness(rolling, transverse, modulus)
    reach = {}
    for flank in flanks_of(scene):
        load = r[f"elements.load_{flank.name}"]
        approach = (np.maximum(load, 0.0) / found[flank.race][:, None]) ** (2.0 / 3.0)
        film = 0.0 if scene.contact is None else placing_film(scene, r, flank.name)
        reach[flank.name] = size.offset[flank.race][:, None] + approach - film
    return reach


class Pushed(NamedTuple):
    """Forces on the inner ring at its arcs, N, and their places from the displaced centre of the ring, m; both (axial,
    along the load line, across it)."""

    force: np.ndarray
    place: np.ndarray


def pushed(scene: Any, n: Numbers, r: Results) -> tuple[list[Pushed], np.ndarray]:
    """Forces on the inner ring at every arc; by how much the distances miss what loads and films ask for, m."""
    size = geometry_of(n)
    reach, outer = reaches(scene, n, r, size), [one for one in flanks_of(scene) if one.race == "outer"]
    loads = np.stack([r[f"elements.load_{one.name}"] for one in outer])
    # the ball, from its most loaded contact on the outer ring
    centres = []
    for one in outer:
        angle = r[f"elements.contact_angle_{one.name}"]
        axial = reach[one.name] * np.sin(angle) - one.side * size.apart["outer"][:, None]
        centres.append(np.stack([axial, reach[one.name] * np.cos(angle)]))
    heaviest = np.argmax(loads, axis=0)
    centre = np.take_along_axis(np.stack(centres), heaviest[None, None], axis=0)[0]
    gaps = [np.where(loads[k] > 1e-3, np.hypot(*(c - centre)), 0.0) for k, c in enumerate(centres)]
    cosine, sine = np.cos(r["elements.azimuth"]), np.sin(r["elements.azimuth"])
    radius = (size.lever - size.across)[:, None] + centre[1]
    ball = np.stack([centre[0], radius * cosine, radius * sine])
    moved = [r[f"ring.{name}"][:, None] + 0.0 * cosine for name in ("axial", "radial", "lateral")]
    tilts = [r[f"ring.{name}"][:, None] + 0.0 * cosine for name in ("tilt", "tilt_lateral")]
    if scene.operation.tilts:
        turn = np.hypot(*tilts)
        share = np.sinc(turn / np.pi)
        normal = np.stack([np.cos(turn), -share * tilts[0], -share * tilts[1]])
        away = ball - np.stack(moved)
        height = np.sum(away * normal, axis=0)
        flat = away - height * normal
        outward = flat / np.linalg.norm(flat, axis=0)
    else:
        # to first order, as the package has it where no ring tilts: each groove centre in the half-plane of its ball
        normal = np.stack([1.0 + 0.0 * cosine, 0.0 * cosine, 0.0 * cosine])
        outward = np.stack([0.0 * cosine, cosine, sine])
        along = moved[2] * cosine - moved[1] * sine
        away = ball - np.stack([moved[0], moved[1] + along * sine, moved[2] - along * cosine])
    found = []
    for one in flanks_of(scene):
        if one.race == "outer":
            continue
        place = one.side * size.apart["inner"][:, None] * normal + size.lever[:, None] * outward
        arm = place - away
        length = np.linalg.norm(arm, axis=0)
        load = r[f"elements.load_{one.name}"]
        gaps.append(np.where(load > 1e-3, np.abs(length - reach[one.name]), 0.0))
        found.append(Pushed(load * arm / length, place))
    return found, np.max(np.stack(gaps), axis=(0, 2))


def arched_balances(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    cosine, sine = np.cos(r["elements.azimuth"]), np.sin(r["elements.azimuth"])
    mass = n["materials.balls.density"] * np.pi / 6.0 * n["geometry.ball_diameter"] ** 3
    outward = 0.5 * mass[:, None] * n["geometry.pitch_diameter"][:, None] * r["elements.orbital_speed"] ** 2
    number = lambda name: n.get(f"operation.{name}", np.zeros(len(cosine)))
    axial, radial, moment = number("axial_load"), number("radial_load"), number("moment")
    speed = np.abs(number("inner_speed")) + np.abs(number("outer_speed"))
    unit = 0.01 * (np.hypot(axial, radial) + np.sum(outward, axis=1)) * speed * n["geometry.pitch_diameter"]
    found = energy(r, unit) | rubbed(scene, n, r)
    on_ring, missed = pushed(scene, n, r)
    found["rings and balls fit"] = (missed / 1e-6, 1e-4)
    force = np.sum([one.force for one in on_ring], axis=0)
    heaviest = np.max([largest_of(r[f"elements.load_{one.name}"]) for one in flanks_of(scene)], axis=0)
    total = np.hypot(axial, radial) + 1e-3 * heaviest
    error = lambda value, scale: (np.maximum(np.abs(value) - FLOOR, 0.0) / scale, 1e-8)
    found["ring carries the axial load"] = error(np.sum(force[0], axis=1) - axial, total)
    outer = [one for one in flanks_of(scene) if one.race == "outer"]
    part = lambda of: sum(r[f"elements.load_{one.name}"] * of(r[f"elements.contact_angle_{one.name}"]) for one in outer)
    inward = force[1] * cosine + force[2] * sine
    across = part(np.cos) - inward - outward
    found["a ball is in axial balance"] = error(largest_of(part(np.sin) - force[0]), total + heaviest)
    caged = scene.slips and scene.cage is not None
    if not caged:
        found["a ball is in radial balance"] = error(largest_of(across), total + heaviest)
    # with a cage that is the friction of its pocket, which goes through cage and land to the ring that guides it
    pocket = across if caged and scene.cage.guidance == "inner_ring" else np.zeros_like(across)
    missing = np.sum(force[1] + pocket * cosine, axis=1) - (0.0 if scene.operation.symmetric else radial)
    found["ring carries the radial load"] = error(missing, total)
    if "operation.moment" in n:
        turned = sum(np.sum(one.force[0] * one.place[1] - one.force[1] * one.place[0], axis=1) for one in on_ring)
        scale = np.abs(moment) + geometry_of(n).lever * heaviest
        found["ring carries the moment"] = (np.abs(turned - moment) / scale, 1e-6)
    return found


def structure(
    name: str, count: int, changes: dict[str, str], ranges: dict[str, Range] | None = None, **kwargs: Any
) -> Structure:
    small = {"geometry.n_balls": str(count), "geometry.ball_diameter": "8 mm", "rating": "none"}
    built = functools.cache(lambda: jb.load_scene("four_point_qj", {**small, **changes}))
    return Structure(
        name=f"four-point: {name}",
        dear="sliding" in name,
        kind="ball",
        load=built,
        ranges={**DIMENSIONS, **ARCS, **OPERATION, **STEELS, **(ranges or {})},
        numbers=lambda v: arched_numbers(v, built()),
        balances=lambda n, r: arched_balances(built(), n, r),
        summary=summary,
        **{"twins": (MIRROR,), **kwargs},
    )


FILMS = {
    "oil.name": "mobil_jet_ii",
    "operation.oil_temperature": "60 degC",
    "operation.oil_flow": "1 l/min",
    "contact.film": "nijenbanning",
    "contact.rolling_resistance": "source_86",
}
TRACTION = {
    **FILMS,
    "contact.thermal": "gupta",
    "contact.traction": "maxwell_eyring",
    "contact.traction_accuracy": "1e-2",
    "kinematics.attitude": "equilibrium",
}
IN_CAGE = {
    "cage.guidance": "inner_ring",
    "cage.guiding_clearance": "400 um",
    "cage.pocket_clearance": "300 um",
    "cage.land_width": "3 mm",
    "cage.n_lands": "2",
    "drag.through_flow_fraction": "1.0",
}
AXIAL = {"operation.radial_load": "none"}
STRUCTURES = [
    structure("dry, axial", 12, AXIAL, twins=ELASTIC, small=True),
    structure("dry, combined", 9, {}, twins=ELASTIC, small=True),
    structure("dry, three contacts", 10, {"geometry.shim_outer": "none"}, twins=ELASTIC),
    structure("dry, moment", 8, {"operation.moment": "0 N*m"}),
    structure("films, combined", 9, FILMS, OIL),
    structure("sliding, axial", 12, TRACTION | AXIAL, {**OIL, **SLIDING}),
    structure("sliding, combined, cage and drag", 8, TRACTION | IN_CAGE, {**OIL, **SLIDING, **CAGE}),
]

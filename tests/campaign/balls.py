"""Random ball bearings.

Every dry ball bearing has an equilibrium: contacts push, each groove is a full circle, and the centre of the inner ring
is drawn to it from any side; no certificate is accepted. Left out:

- balls that slide under a radial load without a cage: the package says that it finds no steady state;
- shares of the gyroscopic couple that an unloaded contact cannot carry (`kinematics.gyroscopic` = shared);
- angular contact bearings under less axial load than the 1.22 F_r tan(alpha) that keeps half of the balls loaded: on
  the far side the inner ring lifts off by more than its groove is deep, and the full circle of the model is no groove;
- balls that slide, below the least load of makers' catalogues, a hundredth of the capacity, or below the
  centrifugal force of the balls, which are then thrown off the inner race and skid: every third of those fails, and
  says so.
"""

import functools
from typing import Any, NamedTuple

import numpy as np
from campaign import elastic
from campaign.bearings import (
    CRAWL,
    FRICTION,
    HEAVIER,
    HOTTER,
    LITRE_PER_HOUR,
    MIRROR,
    OIL,
    OPERATION,
    SPEEDS,
    STEELS,
    energy,
    friction,
    oil,
    places_known,
    placing_film,
    rubbed,
    scaled,
    solids,
    speeds,
    summary,
    supplied,
)
from campaign.draws import Numbers, Range, even, log
from campaign.structure import Results, Structure

import jaxbearing as jb

STATIC = 6e6
"""Largest load over the number of balls and the square of their diameter, N/m^2: half of ISO 76 for radial loads."""
LEAST_LOAD = 0.02
"""Of balls that slide, over the largest, which is half of the capacity."""
FASTEST = {False: 2.5e6, True: 1.5e6}
"""Speed times pitch diameter, rpm mm, of dry and lubricated bearings."""
DIMENSIONS: dict[str, Range] = {
    "diameter": log(3e-3, 40e-3),
    "fill": even(0.55, 0.93),
    "groove_inner": even(0.505, 0.54),
    "groove_outer": even(0.505, 0.54),
    "angle": even(10.0, 42.0),
    "clearance": even(0.0, 2.5e-3),
    "load": even(0.0, 1.0),
    "direction": even(0.0, 1.0),
    "moment": even(-1.0, 1.0, zero=0.1),
    "tilt": even(-1.0, 1.0),
}
"""`fill`: diameter over the distance of neighbours; `clearance` over the ball diameter; `load`: its logarithm, and
`direction` of a combined one, from radial to axial."""
CAGE: dict[str, Range] = {
    "guiding": log(0.5e-3, 6e-3),
    "pocket": even(0.1, 0.6),
    "land": even(0.01, 0.04),
    "flow": even(0.0, 300.0, zero=0.1),
}
SLIDING: dict[str, Range] = {**FRICTION, "start": log(1e-6, 0.1)}
"""Of balls that slide."""


def ball_numbers(v: Numbers, scene: Any) -> Numbers:
    n, operation, diameter = scene.geometry.n_balls, scene.operation, v["diameter"]
    chord = diameter / v["fill"]
    pitch = chord / np.sin(np.pi / n)
    most = np.maximum(STATIC * n * diameter**2, 2.0)
    lubricated = scene.contact is not None
    turning = speeds(v, pitch, 100.0 if lubricated else 1e-2, FASTEST[lubricated], rest=0.0 if lubricated else 0.1)
    # balls that roll without sliding do not skid: any load
    least = np.ones_like(most)
    if scene.slips:
        fastest = np.maximum(*(np.abs(turning[name]) for name in SPEEDS))
        # of the common orbit at a ratio of diameters of the usual 0.2; with both rings turning, of the faster one
        orbit = 0.4 * fastest + 0.6 * np.abs(turning["operation.outer_speed"])
        thrown = v["density"] * np.pi / 12.0 * diameter**3 * pitch * orbit**2
        least = np.maximum(n * thrown, LEAST_LOAD * most)
    total = least * np.maximum(most / least, 1.0) ** v["load"]
    numbers = {
        "geometry.pitch_diameter": pitch,
        "geometry.ball_diameter": diameter,
        "geometry.conformity_inner": v["groove_inner"],
        "geometry.conformity_outer": v["groove_outer"],
        **solids(v, "balls"),
        **turning,
    }
    if scene.geometry.contact_angle is None:
        numbers["geometry.diametral_clearance"] = v["clearance"] * diameter
    else:
        numbers["geometry.contact_angle"] = np.radians(v["angle"])
    lean = 0.5 * np.pi * v["direction"]
    if operation.radial_load is None:
        numbers["operation.axial_load"] = total
    elif operation.axial_load is None:
        numbers["operation.radial_load"] = total
    elif scene.geometry.contact_angle is None:
        numbers["operation.axial_load"] = total * np.sin(lean)
        numbers["operation.radial_load"] = total * np.cos(lean)
    else:
        numbers["operation.axial_load"] = total
        numbers["operation.radial_load"] = (1.0 - v["direction"]) * total / (1.22 * np.tan(np.radians(v["angle"])))
    if operation.moment is not None:
        numbers["operation.moment"] = 0.1 * v["moment"] * total * pitch
    if operation.misalignment is not None:
        numbers["operation.misalignment"] = 2e-3 * v["tilt"]
    if lubricated:
        numbers |= oil(v, scene) | friction(v, scene)
    if scene.cage is not None:
        numbers |= {
            "cage.guiding_clearance": v["guiding"] * pitch,
            "cage.pocket_clearance": np.minimum(v["pocket"] * (chord - diameter), 0.05 * diameter),
            "cage.land_width": v["land"] * pitch,
        }
    if scene.drag is not None:
        numbers["operation.oil_flow"] = v["flow"] * LITRE_PER_HOUR
    return numbers


def ball_balances(
    scene: Any, n: Numbers, r: Results, opening: np.ndarray | float = 0.0
) -> dict[str, tuple[np.ndarray, float]]:
    """Balances of balls and inner ring. **Arguments:** by how much the outer race has moved outwards, m."""
    inner, outer = r["elements.load_inner"], r["elements.load_outer"]
    cosine, sine = np.cos(r["elements.azimuth"]), np.sin(r["elements.azimuth"])
    mass = n["materials.balls.density"] * np.pi / 6.0 * n["geometry.ball_diameter"] ** 3
    outward = 0.5 * mass[:, None] * n["geometry.pitch_diameter"][:, None] * r["elements.orbital_speed"] ** 2
    number = lambda name: n.get(f"operation.{name}", np.zeros(len(inner)))
    axial, radial, moment = number("axial_load"), number("radial_load"), number("moment")
    # residuals of forces are in 1 % of the load and of the centrifugal forces
    speed = np.abs(number("inner_speed")) + np.abs(number("outer_speed"))
    unit = 0.01 * (np.hypot(axial, radial) + np.sum(outward, axis=1)) * speed * n["geometry.pitch_diameter"]
    balanced = scene.kinematics.attitude == "equilibrium" or not scene.slips
    rough = scene.contact is not None and scene.contact.mixed is not None
    found = energy(r, unit, rough) if balanced else {}
    found |= rubbed(scene, n, r)
    if scene.kinematics.gyroscopic is not None or not places_known(scene):
        # its friction stands in all balances of forces; without the places of the balls there are none
        return found
    place, fits = _placed(scene, n, r, opening)
    # a tilted ring is displaced along the orbit too; with films the printed loads are those in the balls' half-planes
    length = np.linalg.norm(place.arm if scene.contact is None else place.arm[:2], axis=0)
    pushed = inner * place.arm / length
    total = np.hypot(axial, radial) + np.max(inner, axis=1) * 1e-3
    # the floor of 1 mN on the centrifugal force, which holds a ball that nothing loads
    floor = 1.1e-3
    error = lambda value, scale: (np.maximum(np.abs(value) - floor, 0.0) / scale, 1e-8)
    found["ring carries the axial load"] = error(np.sum(pushed[0], axis=1) - axial, total)
    across = outer * np.cos(r["elements.contact_angle_outer"]) - pushed[1] - outward
    caged = scene.slips and scene.cage is not None
    if not caged:
        found["a ball is in radial balance"] = error(largest_of(across), total + largest_of(outer))
    # with a cage that is the friction of its pocket, which goes through cage and land to the ring that guides it
    pocket = across if caged and scene.cage.guidance == "inner_ring" else np.zeros_like(across)
    on_line = pushed[1] * cosine - pushed[2] * sine
    radial_error = np.sum(on_line + pocket * cosine, axis=1) - (0.0 if scene.operation.symmetric else radial)
    found["ring carries the radial load"] = error(radial_error, total)
    along = outer * np.sin(r["elements.contact_angle_outer"]) - pushed[0]
    found["a ball is in axial balance"] = error(np.max(np.abs(along), axis=1), total + largest_of(outer))
    if "operation.moment" in n and scene.operation.radial_load is not None:
        turned = np.sum(pushed[0] * place.from_centre[1] - on_line * place.from_centre[0], axis=1)
        scale = np.abs(moment) + place.lever * np.max(inner, axis=1)
        found["ring carries the moment"] = (np.abs(turned - moment) / scale, 1e-8)
    return found | fits


def largest_of(values: np.ndarray) -> np.ndarray:
    return np.max(np.abs(values), axis=1)


class Placed(NamedTuple):
    """`arm`: from the balls to the nearest inner groove centres (axial, outward, along the orbit); `from_centre`: to
    these from the displaced centre of the ring (axial, along the load line); R_i; m."""

    arm: np.ndarray
    from_centre: np.ndarray
    lever: np.ndarray


def _placed(
    scene: Any, n: Numbers, r: Results, opening: np.ndarray | float
) -> tuple[Placed, dict[str, tuple[np.ndarray, float]]]:
    """Where the inner grooves are, seen from the balls; groove centres, balls and elastic approaches close at every
    loaded ball; Hertz's pressures."""
    diameter, pitch = n["geometry.ball_diameter"], n["geometry.pitch_diameter"]
    f_inner, f_outer = n["geometry.conformity_inner"], n["geometry.conformity_outer"]
    distance = (f_inner + f_outer - 1.0) * diameter
    if "geometry.contact_angle" in n:
        free = np.cos(n["geometry.contact_angle"])
        aligned = -distance * np.sin(n["geometry.contact_angle"])
    else:
        free = 1.0 - n["geometry.diametral_clearance"] / (2.0 * distance)
        aligned = np.zeros_like(distance)
    rings = float(scene.materials.rings.poisson_ratio)
    modulus = elastic.reduced_modulus(
        (n["materials.rings.youngs_modulus"], rings),
        (n["materials.balls.youngs_modulus"], n["materials.balls.poisson_ratio"]),
    )
    lever = pitch / 2.0 + (f_inner - 0.5) * diameter * free
    reach = {}
    found: dict[str, tuple[np.ndarray, float]] = {}
    for name, groove, side in (("inner", f_inner, -1.0), ("outer", f_outer, 1.0)):
        rolling = diameter / 2.0 * (1.0 + side * diameter / pitch * free)
        across = groove * diameter / (2.0 * groove - 1.0)
        load = r[f"elements.load_{name}"]
        stiffness = elastic.point_stiffness(rolling, across, modulus)
        approach = (np.maximum(load, 0.0) / stiffness[:, None]) ** (2.0 / 3.0)
        film = 0.0 if scene.contact is None else placing_film(scene, r, name)
        reach[name] = ((groove - 0.5) * diameter)[:, None] + approach - film
        # radii at the free angle for the stiffness, at the contact angle for films and pressures
        rows, heaviest = np.arange(len(load)), np.argmax(load, axis=1)
        at = np.cos(r[f"elements.contact_angle_{name}"][rows, heaviest])
        rolling = diameter / 2.0 * (1.0 + side * diameter / pitch * at)
        pressure = elastic.point_pressure(largest_of(load), rolling, across, modulus)
        error = np.abs(r[f"elements.pressure_{name}"][rows, heaviest] / pressure - 1.0)
        found[f"Hertz, {name}"] = (np.where(largest_of(load) > 1.0, error, 0.0), 1e-6)
    at_outer = r["elements.contact_angle_outer"]
    # the ball: along the axis from the middle plane of the outer groove, and from the axis
    ball = [reach["outer"] * np.sin(at_outer), (lever - distance * free)[:, None] + reach["outer"] * np.cos(at_outer)]
    ball[1] = ball[1] + opening
    axial, radial, tilt = (r[f"ring.{name}"][:, None] for name in ("axial", "radial", "tilt"))
    cosine, sine = np.cos(r["elements.azimuth"]), np.sin(r["elements.azimuth"])
    middle = axial - aligned[:, None]
    if scene.operation.tilts:
        # the nearest point of the tilted circle, in the fixed frame: along the axis, the load line, across it
        centre = np.stack([middle + 0.0 * cosine, radial + 0.0 * cosine, 0.0 * cosine])
        normal = np.stack([np.cos(tilt) + 0.0 * cosine, -np.sin(tilt) + 0.0 * cosine, 0.0 * cosine])
        away = np.stack([ball[0], ball[1] * cosine, ball[1] * sine]) - centre
        flat = away - np.sum(away * normal, axis=0) * normal
        nearest = centre + lever[:, None] * flat / np.linalg.norm(flat, axis=0)
        arm = nearest - np.stack([ball[0], ball[1] * cosine, ball[1] * sine])
        arm = np.stack([arm[0], arm[1] * cosine + arm[2] * sine, arm[2] * cosine - arm[1] * sine])
    else:
        arm = np.stack([middle - ball[0], lever[:, None] + radial * cosine - ball[1], 0.0 * cosine])
    nearest = np.stack([ball[0] + arm[0] - middle, (ball[1] + arm[1]) * cosine - arm[2] * sine - radial])
    # a film thicker than the groove's radius is larger than the ball's puts the ball beyond the groove centre
    arm = arm * np.where(reach["inner"] < 0.0, -1.0, 1.0)
    # the contact angle is that on the tilted race
    turned = np.arctan2(np.sin(tilt) * cosine, np.cos(tilt))
    seen = np.arctan2(arm[0], arm[1]) - turned
    length = np.linalg.norm(arm, axis=0)
    loaded = np.minimum(r["elements.load_inner"], r["elements.load_outer"]) > 1e-3
    gap = np.hypot(length - np.abs(reach["inner"]), length * (seen - r["elements.contact_angle_inner"]))
    found["rings and balls fit"] = (np.max(np.where(loaded, gap, 0.0), axis=1) / 1e-6, 1e-4)
    return Placed(arm, nearest, lever), found


def structure(
    name: str, base: str, count: int, changes: dict[str, str], ranges: dict[str, Range], **kwargs: Any
) -> Structure:
    small = {"geometry.n_balls": str(count), "geometry.ball_diameter": "8 mm", "geometry.pitch_diameter": "153 mm"}
    if base == "turbine_ball" and changes.get("cage") != "none":
        small |= {"cage.inner_diameter": "none", "cage.outer_diameter": "none"}
    if base == "deep_groove_6205":
        small["geometry.shoulder_angle_inner"] = "none"
    built = functools.cache(lambda: jb.load_scene(base, {**small, **changes}))
    return Structure(
        name=f"ball: {name}",
        dear="sliding" in name,
        kind="ball",
        load=built,
        ranges={**DIMENSIONS, **OPERATION, **STEELS, **ranges},
        numbers=lambda v: ball_numbers(v, built()),
        balances=lambda n, r: ball_balances(built(), n, r),
        summary=summary,
        **{"twins": (MIRROR,), **kwargs},
    )


ELASTIC = (MIRROR, HEAVIER, CRAWL, scaled((), floor=0.05))
NO_CAGE = {"cage": "none"}
STRUCTURES = [
    structure("dry, axial", "angular_contact_218", 16, {}, {}, twins=ELASTIC),
    structure("dry, combined, tilt free", "deep_groove_6205", 9, {}, {}, twins=ELASTIC),
    structure(
        "dry, radial, held",
        "deep_groove_6205",
        8,
        {"operation.moment": "none", "operation.axial_load": "none"},
        {},
        twins=ELASTIC,
    ),
    structure(
        "dry, misaligned, inner control",
        "angular_contact_218",
        14,
        {"operation.radial_load": "1 kN", "operation.misalignment": "1 mrad", "kinematics.attitude": "inner"},
        {},
        twins=ELASTIC,
    ),
    structure(
        "dry, capped couple",
        "angular_contact_218",
        12,
        {"operation.radial_load": "1 kN", **{"kinematics.gyroscopic": "capped"}},
        {},
    ),
    structure(
        "dry, common orbit",
        "deep_groove_6205",
        11,
        {"kinematics.orbit": "common"},
        {},
    ),
    structure(
        "films, isothermal, combined",
        "turbine_ball",
        10,
        {
            "contact.traction": "none",
            "contact.traction_accuracy": "none",
            "contact.rolling_resistance": "none",
            "contact.thermal": "none",
            "kinematics.attitude": "outer",
            "operation.radial_load": "1 kN",
            "operation.moment": "0 N*m",
            "drag": "none",
            **NO_CAGE,
        },
        OIL,
        twins=(MIRROR, HOTTER),
    ),
    structure(
        "films, Hamrock-Dowson, tilt free",
        "deep_groove_6205",
        9,
        {"oil.name": "mobil_jet_ii", "operation.oil_temperature": "60 degC", "contact.film": "hamrock_dowson"},
        OIL,
        twins=(MIRROR, HOTTER),
    ),
    structure(
        "films, Hamrock-Dowson, radial, held",
        "deep_groove_6205",
        8,
        {
            "oil.name": "mobil_jet_ii",
            "operation.oil_temperature": "60 degC",
            "operation.moment": "none",
            "operation.axial_load": "none",
            "contact.film": "hamrock_dowson",
            "contact.thermal": "gupta",
        },
        OIL,
        twins=(MIRROR,),
    ),
    structure("sliding, axial", "turbine_ball", 14, {"drag": "none", **NO_CAGE}, OIL),
    structure("sliding, axial, cage and drag", "turbine_ball", 12, {}, {**OIL, **CAGE}),
    structure(
        "sliding, axial, Heathcote, Hamrock-Dowson",
        "turbine_ball",
        15,
        {
            "contact.heathcote": "true",
            "contact.film": "hamrock_dowson",
            "contact.thermal": "none",
            "drag": "none",
            **NO_CAGE,
        },
        OIL,
    ),
    structure(
        "sliding, axial, least power",
        "turbine_ball",
        13,
        {"kinematics.attitude": "min_power", "drag": "none", **NO_CAGE},
        OIL,
    ),
    structure(
        "sliding, axial, couple resolved",
        "turbine_ball",
        16,
        {"kinematics.gyroscopic": "resolved", "drag": "none", **NO_CAGE},
        OIL,
    ),
    structure(
        "sliding, combined, cage",
        "turbine_ball",
        8,
        {"operation.radial_load": "1 kN", "operation.moment": "0 N*m", "contact.traction_accuracy": "1e-2"},
        {**OIL, **CAGE},
    ),
    structure(
        "films, Biboulet-Houpert, layer, hysteresis",
        "deep_groove_6205",
        9,
        {
            "oil.name": "mobil_jet_ii",
            "operation.oil_temperature": "60 degC",
            "contact.film": "nijenbanning",
            "contact.thermal": "gupta",
            "contact.rolling_resistance": "biboulet_houpert",
            "contact.supply.layer": "1 um",
            "contact.hysteresis": "0.005",
        },
        {**OIL, **FRICTION, **supplied("layer")},
    ),
    structure(
        "sliding, axial, rough, Biboulet-Houpert, gap",
        "turbine_ball",
        14,
        {
            "drag": "none",
            **NO_CAGE,
            "contact.rolling_resistance": "biboulet_houpert",
            "contact.supply.gap_over_central": "5",
            "contact.mixed.roughness": "0.3 um",
            "contact.hysteresis": "0.005",
        },
        {**OIL, **SLIDING, **supplied("gap_over_central")},
    ),
    structure(
        "sliding, axial, rough, meniscus, Heathcote",
        "turbine_ball",
        13,
        {
            "drag": "none",
            **NO_CAGE,
            "contact.heathcote": "true",
            "contact.supply.meniscus_gap": "5 um",
            "contact.mixed.roughness": "0.3 um",
            "contact.mixed.share": "greenwood_tripp",
        },
        {**OIL, **SLIDING, **supplied("meniscus_gap")},
    ),
]

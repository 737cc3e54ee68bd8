"""Random cylindrical roller bearings."""

import functools
from typing import Any

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
    STEELS,
    energy,
    first_moment,
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

HIGHEST_PRESSURE = 3e9
"""Of the most loaded roller, Pa, about."""
RING_POISSON = 0.29
"""M50, of the built-in scenes."""
DIMENSIONS: dict[str, Range] = {
    "diameter": log(3e-3, 50e-3),
    "fill": even(0.55, 0.95),
    "slenderness": even(0.8, 2.5),
    "contact": even(0.85, 1.0),
    "clearance": even(-1.5e-3, 6e-3),
    "load": even(0.0, 1.0),
}
"""`fill`: diameter over the distance of neighbours; `clearance` over the roller diameter; `load`: its logarithm."""
CAGE: dict[str, Range] = {
    "guiding": log(0.5e-3, 6e-3),
    "pocket": even(0.1, 0.6),
    "land": even(0.015, 0.05),
    "drag": even(0.0, 1.2, zero=0.1),
    "flow": even(0.0, 300.0, zero=0.1),
}
"""Clearances over pitch diameter and over the gap between neighbours, land width over pitch diameter."""
FLANGE: dict[str, Range] = {"flange": log(1e-3, 1e-2), "flange_angle": even(0.0, 0.02), "rails": log(5e-3, 5e-2)}
"""Clearances over the roller length."""
TILT: dict[str, Range] = {"tilt": even(-1.0, 1.0, zero=0.05), "drop": log(2e-4, 2e-3)}


def roller_numbers(v: Numbers, scene: Any) -> Numbers:
    n = scene.geometry.n_rollers
    diameter = v["diameter"]
    chord = diameter / v["fill"]
    pitch, length = chord / np.sin(np.pi / n), v["slenderness"] * diameter
    contact = v["contact"] * length
    lubricated = scene.contact is not None
    modulus = elastic.reduced_modulus((v["rings_modulus"], RING_POISSON), (v["elements_modulus"], v["poisson"]))
    inner = 1.0 / (2.0 / diameter + 2.0 / (pitch - diameter))
    most = 0.2 * n * elastic.load_at_line_pressure(HIGHEST_PRESSURE, inner, contact, modulus)
    radial = np.maximum(most, 2.0) ** v["load"]
    numbers = {
        "geometry.pitch_diameter": pitch,
        "geometry.roller_diameter": diameter,
        "geometry.roller_length": length,
        "geometry.contact_length": contact,
        "geometry.diametral_clearance": v["clearance"] * diameter,
        "operation.radial_load": radial,
        **solids(v, "rollers"),
        **speeds(v, pitch, 100.0 if lubricated else 1e-2, 2e6, rest=0.0 if lubricated else 0.1),
    }
    if lubricated:
        numbers |= oil(v, scene) | friction(v, scene)
    if scene.cage is not None:
        numbers |= {
            "cage.guiding_clearance": v["guiding"] * pitch,
            "cage.pocket_clearance": np.minimum(v["pocket"] * (chord - diameter), 0.05 * diameter),
            "cage.land_width": v["land"] * pitch,
            "drag.coefficient": v["drag"],
            # what a supply takes is no more nor less than what flows
            "operation.oil_flow": numbers.get("operation.oil_flow", v["flow"] * LITRE_PER_HOUR),
        }
    if scene.flange is not None:
        numbers |= {
            "flange.axial_clearance": v["flange"] * length,
            "flange.angle": v["flange_angle"],
            "cage.pocket_axial_clearance": v["rails"] * length,
        }
    if scene.operation.misalignment is not None:
        numbers["operation.misalignment"] = 5e-3 * v["tilt"]
    if scene.operation.moment is not None:
        numbers["operation.moment"] = 0.3 * v["tilt"] * radial * length
    if scene.profile is not None and scene.profile.shape is not None:
        numbers["profile.shape.drop"] = v["drop"] * diameter
    return numbers


def roller_balances(
    scene: Any, n: Numbers, r: Results, opening: np.ndarray | float = 0.0
) -> dict[str, tuple[np.ndarray, float]]:
    """**Arguments:** `opening`: of the outer raceway at each roller, m, where it is not round."""
    inner, outer = r["elements.load_inner"], r["elements.load_outer"]
    cosine = np.cos(r["elements.azimuth"])
    radial = n["operation.radial_load"]
    diameter, pitch = n["geometry.roller_diameter"], n["geometry.pitch_diameter"]
    length = n["geometry.contact_length"]
    mass = n["materials.rollers.density"] * np.pi / 4.0 * diameter**2 * n["geometry.roller_length"]
    outward = mass[:, None] * pitch[:, None] / 2.0 * r["elements.orbital_speed"] ** 2
    found = energy(r) | rubbed(scene, n, r)
    found |= {
        "ring carries the load": (np.abs(np.sum(inner * cosine, axis=1) - radial) / radial, 1e-9),
        "a roller is in balance": (
            np.max(np.abs(outer - inner - outward), axis=1) / (radial + np.max(outer, axis=1)),
            1e-9,
        ),
    }
    if scene.tilts:
        return found | _moments(scene, n, r)
    poisson = n["materials.rollers.poisson_ratio"]
    rings = (n["materials.rings.youngs_modulus"], RING_POISSON)
    modulus = elastic.reduced_modulus(rings, (n["materials.rollers.youngs_modulus"], poisson))
    races = [1.0 / (2.0 / diameter + 2.0 / (pitch - diameter)), 1.0 / (2.0 / diameter - 2.0 / (pitch + diameter))]
    for name, load, radius in zip(("inner", "outer"), (inner, outer), races, strict=True):
        pressure = elastic.line_pressure(load.T, radius, length, modulus).T
        # an unloaded contact has the pressure of that load
        least = elastic.line_pressure(1e-9, radius, length, modulus)[:, None]
        error = np.maximum(np.abs(pressure - r[f"elements.pressure_{name}"]) - least, 0.0)
        found[f"Hertz, {name}"] = (np.max(error, axis=1) / np.max(pressure, axis=1), 1e-9)
    approach = elastic.palmgren(inner.T, length, modulus).T + elastic.palmgren(outer.T, length, modulus).T
    closing = r["ring.radial"][:, None] * cosine - n["geometry.diametral_clearance"][:, None] / 2.0 - opening
    scale = np.max(np.abs(closing), axis=1) + np.max(approach, axis=1)
    if scene.contact is None:
        gap = np.where(inner > 0, approach - closing, np.maximum(closing - approach, 0.0))
    else:
        films = placing_film(scene, r, "inner") + placing_film(scene, r, "outer")
        gap = approach - closing - films
        scale += np.max(films, axis=1)
    if places_known(scene):
        found["rings and rollers fit"] = (np.max(np.abs(gap), axis=1) / scale, 1e-8)
    return found


def _moments(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    """The laminae add up to the load; by how much the moments of rollers and ring leave what their laminae, within
    which nothing is printed, allow; over load and length. The end s = l lies along the axis; there a moment moves the
    ring at azimuth 0, off that end of the roller."""
    (inner, open_inner), (outer, open_outer) = (first_moment(r[f"laminae.{place}"]) for place in ("inner", "outer"))
    load, outer_load = r["elements.load_inner"], r["elements.load_outer"]
    most = np.max(load, axis=1)
    sums = np.sum(r["laminae.inner"], axis=2) - load, np.sum(r["laminae.outer"], axis=2) - outer_load
    # the centrifugal force acts at mid length
    tipping = np.abs(outer - inner - 0.5 * (outer_load - load)) - open_inner - open_outer
    found = {
        "laminae add up to the load": (np.max(np.abs(sums), axis=(0, 2)) / most, 1e-12),
        "a roller does not tip": (np.maximum(np.max(tipping, axis=1), 0.0) / most, 1e-9),
    }
    if scene.operation.moment is not None:
        cosine = np.cos(r["elements.azimuth"])
        moment = np.sum((inner - 0.5 * load) * cosine, axis=1)
        given = n["operation.moment"] / n["geometry.contact_length"]
        left = np.abs(moment + given) - np.sum(open_inner * np.abs(cosine), axis=1)
        found["ring carries the moment"] = (np.maximum(left, 0.0) / most, 1e-9)
    return found


DRY = ("contact", "oil", "cage", "flange", "drag")
RADIAL = {"operation.moment": "none", "operation.misalignment": "none"}


def load(name: str, count: int, changes: dict[str, str], drop: tuple[str, ...] = ()) -> Any:
    small = {
        "geometry.n_rollers": str(count),
        "geometry.pitch_diameter": "142 mm",
        "geometry.roller_diameter": "8 mm",
    }
    if "cage" not in drop:
        small |= {"cage.inner_diameter": "none", "cage.outer_diameter": "none"}
    if "flange" not in drop and "flange.ring" not in changes:
        drop = (*drop, "flange")
        small["cage.pocket_axial_clearance"] = "none"
    if "cage" in drop:
        small.pop("cage.pocket_axial_clearance", None)
    elif "flange.ring" in changes:
        small["flange.height"] = "none"
    return jb.load_scene(name, {**dict.fromkeys(drop, "none"), **small, **changes})


def structure(name: str, count: int, changes: dict[str, str], ranges: dict[str, Range], **kwargs: Any) -> Structure:
    built = functools.cache(lambda: load("turbine_roller", count, changes, kwargs.get("without", ())))
    rest = {key: value for key, value in kwargs.items() if key != "without"}
    twins = rest.pop("twins", (MIRROR,))
    return Structure(
        name=f"roller: {name}",
        dear="guiding" in ranges or "tilt" in ranges,
        kind="cylindrical roller",
        load=built,
        ranges={**DIMENSIONS, **OPERATION, **STEELS, **ranges},
        numbers=lambda v: roller_numbers(v, built()),
        balances=lambda n, r: roller_balances(built(), n, r),
        summary=summary,
        twins=twins,
        **rest,
    )


MEAN = {"contact.traction_model": "mean_pressure", "contact.traction_accuracy": "none"}
ELASTIC = (MIRROR, HEAVIER, CRAWL, scaled(("profile.shape.drop",)))
LUBRICATED = {**OIL, **CAGE}
ROLLING_ALONE = {"contact.traction": "none", **dict.fromkeys(MEAN, "none")}
FILMS = tuple(
    f"elements.{what}_{race}" for what in ("film", "film_least", "temperature_rise") for race in ("inner", "outer")
)
"""What a tilting roller does not have where it does not touch."""
ROUGH = {"contact.mixed.roughness": "0.3 um"}
LOSSY = {"contact.hysteresis": "0.005"}
STRUCTURES = [
    structure("dry", 9, {}, {}, without=DRY, twins=ELASTIC, small=True),
    structure("dry, many", 40, {}, {}, without=DRY, twins=ELASTIC),
    structure(
        "misaligned, crowned",
        10,
        {"operation.misalignment": "1 mrad", "profile.shape": "crowned", "profile.drop": "8 um"},
        TILT,
        without=DRY,
        twins=ELASTIC,
    ),
    structure("moment, straight", 8, {"operation.moment": "1 N*m"}, TILT, without=DRY, twins=ELASTIC),
    structure(
        "films, isothermal",
        11,
        {"contact.traction": "none", "contact.thermal": "none", **dict.fromkeys(MEAN, "none")},
        OIL,
        without=("cage", "flange", "drag"),
        twins=(MIRROR, HOTTER),
    ),
    structure("skidding, Ree-Eyring, Dowson-Toyoda", 9, {**MEAN, "contact.film": "dowson_toyoda"}, LUBRICATED),
    structure(
        "outer guided, flanges, rails",
        15,
        {**MEAN, "cage.guidance": "outer_ring", "flange.ring": "both", "contact.film": "dowson_higginson"},
        {**LUBRICATED, **FLANGE},
    ),
    structure(
        "rolling resistance, Bair-Winer, Pan-Hamrock",
        12,
        {
            **MEAN,
            "contact.film": "pan_hamrock",
            "contact.rolling_resistance": "ertel_grubin",
            "contact.traction": "bair_winer",
        },
        LUBRICATED,
    ),
    structure(
        "Pennzane, Grubin, Hsu-Lee",
        10,
        {
            **MEAN,
            "oil.name": "pennzane_x2000",
            "contact.film": "grubin",
            "contact.thermal": "hsu_lee",
            "contact.traction": "elsharkawy_hamrock",
            "flange.ring": "inner",
        },
        {**LUBRICATED, **FLANGE},
    ),
    structure(
        "march through the pressure",
        8,
        {"contact.traction_model": "distributed", "contact.traction_accuracy": "1e-2", "cage.turbulence": "pure"},
        LUBRICATED,
    ),
    structure(
        "rolling alone, full range, layer, hysteresis",
        11,
        {**ROLLING_ALONE, "contact.rolling_resistance": "full_range", "contact.supply.layer": "1 um", **LOSSY},
        {**OIL, **FRICTION, **supplied("layer")},
        without=("cage", "flange", "drag"),
    ),
    structure(
        "rolling alone, Biboulet-Houpert, meniscus, isothermal",
        9,
        {
            **ROLLING_ALONE,
            "contact.thermal": "none",
            "contact.rolling_heating": "aihara",
            "contact.rolling_resistance": "biboulet_houpert",
            "contact.supply.meniscus_distance": "5 mm",
            "contact.supply.rolling_law": "biboulet_houpert",
        },
        {**OIL, **FRICTION, **supplied("meniscus_distance")},
        without=("cage", "flange", "drag"),
    ),
    structure(
        "misaligned, full range, flow",
        10,
        {
            **ROLLING_ALONE,
            "contact.rolling_resistance": "full_range",
            "contact.supply.from_flow": "0.1",
            "operation.misalignment": "1 mrad",
            "profile.shape": "crowned",
            "profile.drop": "8 um",
            **LOSSY,
        },
        {**OIL, **TILT, **FRICTION, **supplied("from_flow")},
        without=("cage", "flange", "drag"),
        may_be_nan=FILMS,
    ),
    structure(
        "skidding, rough, full range, gap",
        9,
        {
            **MEAN,
            **ROUGH,
            "contact.rolling_resistance": "full_range",
            "contact.supply.gap_over_central": "5",
            **LOSSY,
        },
        {**LUBRICATED, **FRICTION, **supplied("gap_over_central")},
    ),
    structure(
        "skidding, asperity pressure, rigid, layer",
        12,
        {
            **MEAN,
            **ROUGH,
            "contact.mixed.share": "greenwood_tripp_pressure",
            "contact.mixed.film": "minimum",
            "contact.rolling_resistance": "rigid_isoviscous",
            "contact.supply.layer": "1 um",
        },
        {**LUBRICATED, **FRICTION, **supplied("layer")},
    ),
]

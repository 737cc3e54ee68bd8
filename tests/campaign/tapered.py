"""Random tapered roller bearings. A radial load above what the axial one holds, or a moment beyond the rollers' length,
has no equilibrium; whether the loads are such is told by linear programming (`tapered_campaign`), not by the solver."""

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
    energy,
    first_moment,
    friction,
    oil,
    rubbed,
    scaled,
    solids,
    speeds,
    summary,
    supplied,
)
from campaign.draws import Numbers, Range, even, log
from campaign.structure import Results, Structure
from campaign.tapered_campaign import feasible, runs_away

import jaxbearing as jb

HIGHEST_PRESSURE = 2.5e9
POISSON = 0.3
STEELS: dict[str, Range] = {
    "rings_modulus": even(190e9, 220e9),
    "elements_modulus": even(190e9, 220e9),
    "poisson": even(0.26, 0.32),
    "density": even(7000.0, 8000.0),
}
DIMENSIONS: dict[str, Range] = {
    "diameter": log(4e-3, 40e-3),
    "fill": even(0.6, 0.95),
    "axis": even(9.0, 28.0),
    "slenderness": even(0.9, 2.2),
    "rib_height": even(0.3, 0.8),
    "end": even(0.75, 0.96),
    "load": even(0.0, 1.0),
    "radial": even(0.0, 1.08, zero=0.05),
    "moment": even(-1.0, 1.0),
    "tilt": even(-1.0, 1.0, zero=0.1),
    "drop": log(2e-4, 2e-3),
    "drag": even(0.0, 1.2, zero=0.1),
    "flow": even(0.0, 300.0, zero=0.1),
}
"""`fill`: of the roller over the space between its neighbours; `axis`: of a roller to the bearing's, degrees;
`rib_height`: of the contact with the rib below the roller's axis, over its radius; `end`: radius of the sphere over the
distance of the apex; `load`: logarithm of the axial one; `radial`: over what that holds; `moment`: of what the
rollers' length holds."""


def tapered_numbers(v: Numbers, scene: Any) -> Numbers:
    n, operation = scene.geometry.n_rollers, scene.operation
    diameter, axis = v["diameter"], np.radians(v["axis"])
    half = np.arcsin(v["fill"] * np.sin(axis) * np.sin(np.pi / n))
    cup = axis + half
    length = np.minimum(v["slenderness"] * diameter, 0.35 * diameter / np.sin(half))
    apex = diameter / (2.0 * np.sin(half))
    end = v["end"] * apex
    theta = np.arcsin(v["rib_height"] * diameter / (2.0 * end))
    mean = diameter - length * np.sin(half)
    modulus = elastic.reduced_modulus((v["rings_modulus"], POISSON), (v["elements_modulus"], v["poisson"]))
    cone = (apex - 0.5 * length) * np.tan(cup - 2.0 * half)
    inner = 1.0 / (2.0 / mean + 1.0 / cone)
    most = 0.5 * n * elastic.load_at_line_pressure(HIGHEST_PRESSURE, inner, length, modulus) * np.sin(cup)
    axial = most ** v["load"]
    pitch = 2.0 * (apex * np.sin(axis) - 0.5 * length * np.sin(axis))
    lubricated = scene.contact is not None
    numbers = {
        "geometry.roller_diameter": diameter,
        "geometry.roller_length": length,
        "geometry.contact_angle": cup,
        "geometry.roller_half_angle": half,
        "geometry.flange_angle": axis - theta,
        "geometry.end_radius": end,
        "operation.axial_load": axial,
        **solids(v, "rollers"),
        # the mean speed that centrifugal forces allow at a light load is less than that of other bearings
        **speeds(v, pitch, 100.0 if lubricated else 1e-2, 5e5, rest=0.0 if lubricated else 0.1),
    }
    if operation.radial_load is not None:
        numbers["operation.radial_load"] = v["radial"] * axial / np.tan(cup)
    if operation.moment is not None:
        middle = (apex - 0.5 * length) * numbers["operation.radial_load"] / np.cos(cup)
        numbers["operation.moment"] = middle + 0.6 * v["moment"] * 0.5 * length * axial / np.sin(cup)
    if operation.misalignment is not None:
        numbers["operation.misalignment"] = 2e-3 * v["tilt"]
    if scene.profile is not None and scene.profile.shape is not None:
        numbers["profile.shape.drop"] = v["drop"] * diameter
    if lubricated:
        numbers |= oil(v, scene) | friction(v, scene)
    if scene.drag is not None:
        numbers |= {"drag.coefficient": v["drag"], "operation.oil_flow": v["flow"] * LITRE_PER_HOUR}
    return numbers


def tapered_balances(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    inner, outer, rib = (r[f"elements.load_{place}"] for place in ("inner", "outer", "flange"))
    cup, half, rib_angle = (n[f"geometry.{name}"] for name in ("contact_angle", "roller_half_angle", "flange_angle"))
    cone, axis = cup - 2.0 * half, cup - half
    theta = axis - rib_angle
    column = lambda values: values[:, None]
    cosine = np.cos(r["elements.azimuth"])
    axial = n["operation.axial_load"]
    radial = n.get("operation.radial_load", np.zeros_like(axial))
    scale = np.hypot(axial, radial)
    along = np.sum(inner * np.sin(column(cone)) + rib * np.cos(column(rib_angle)), axis=1)
    across = np.sum((inner * np.cos(column(cone)) - rib * np.sin(column(rib_angle))) * cosine, axis=1)
    if scene.operation.symmetric:
        across = np.zeros_like(across)
    # of the force balances of a roller the combination without its centrifugal force, which is along the radius
    first = (inner + outer) * np.sin(column(half)) - rib * np.cos(column(theta))
    second = (outer - inner) * np.cos(column(half)) - rib * np.sin(column(theta))
    roller = np.abs(first * np.cos(column(axis)) + second * np.sin(column(axis)))
    found = energy(r) | rubbed(scene, n, r)
    if scene.operation.moment is not None:
        # about the apex, from which the end s = 0 is the farther; what rotation adds cancels round the bearing
        length = column(n["geometry.roller_length"])
        place, left_open = first_moment(r["laminae.outer"])
        apex = column(n["geometry.roller_diameter"] / (2.0 * np.sin(half)))
        moment = np.sum((apex * outer - length * place) * cosine, axis=1)
        given = n["operation.moment"] - float(scene.operation.load_position) * radial
        # a contact shorter than a lamina: its load there is not the whole one
        missed = np.abs(np.sum(r["laminae.outer"], axis=-1) - outer)
        left = np.abs(moment - given) - np.sum(length * (left_open + missed) * np.abs(cosine), axis=1)
        size = np.max(outer, axis=1) * n["geometry.roller_length"]
        found["ring carries the moment"] = (np.maximum(left, 0.0) / size, 1e-8)
    return found | {
        "ring carries the axial load": (np.abs(along - axial) / scale, 1e-8),
        "ring carries the radial load": (np.abs(across - radial) / scale, 1e-8),
        "a roller is in balance along the axis": (np.max(roller, axis=1) / (scale + np.max(outer, axis=1)), 1e-8),
        "contacts push": (np.maximum(-np.min(np.minimum(inner, np.minimum(outer, rib)), axis=1), 0.0) / scale, 0.0),
    }


def no_equilibrium(scene: Any) -> bool:
    return not feasible(scene) or runs_away(scene)


def structure(name: str, count: int, changes: dict[str, str], ranges: dict[str, Range], **kwargs: Any) -> Structure:
    # of many thin rollers only: nothing but the count is kept of these numbers
    small = {
        "geometry.n_rollers": str(count),
        "geometry.roller_diameter": "5 mm",
        "geometry.roller_half_angle": "1 deg",
        "geometry.flange_angle": "12 deg",
        "geometry.end_radius": "120 mm",
        "rating": "none",
    }
    built = functools.cache(lambda: jb.load_scene("tapered_example", {**small, **changes}))
    return Structure(
        name=f"tapered: {name}",
        dear=True,
        kind="tapered roller",
        load=built,
        ranges={**DIMENSIONS, **OPERATION, **STEELS, **ranges},
        numbers=lambda v: tapered_numbers(v, built()),
        balances=lambda n, r: tapered_balances(built(), n, r),
        summary=summary,
        certificate=no_equilibrium,
        may_be_nan=tuple(f"elements.{name}" for name in MAY_BE_NAN),
        **{"twins": (MIRROR,), **kwargs},
    )


MAY_BE_NAN = tuple(
    f"{what}_{place}"
    for what in ("film", "temperature_rise", "sliding", "spin", "traction", "film_ratio", "load_share", "flash")
    for place in ("inner", "outer", "flange")
)
"""Where a roller does not touch."""
DRY = {"oil": "none", "contact": "none", "drag": "none"}
ELASTIC = (MIRROR, CRAWL, HEAVIER, scaled(("profile.shape.drop",), floor=1e-6))
ROUGH = {"contact.mixed.roughness": "0.3 um", "contact.mixed.flange_roughness": "0.3 um"}
STRUCTURES = [
    structure("dry, axial", 17, {**DRY, "operation.radial_load": "none"}, {}, twins=ELASTIC),
    structure("dry, radial, held", 12, {**DRY, "operation.misalignment": "0 mrad"}, {}, twins=ELASTIC),
    structure("dry, moment", 10, {**DRY, "operation.moment": "0 N*m"}, {}, twins=ELASTIC),
    structure(
        "dry, moment, logarithmic",
        14,
        {
            **DRY,
            "operation.moment": "0 N*m",
            "profile.shape": "logarithmic",
            "profile.drop": "5 um",
            "profile.end_ratio": "0.9",
        },
        {},
        twins=ELASTIC,
    ),
    structure(
        "lubricated, radial, Dowson-Toyoda",
        11,
        {"contact.film": "dowson_toyoda", "contact.flange_film": "hamrock_dowson"},
        OIL,
    ),
    structure(
        "lubricated, axial, Grubin",
        17,
        {"operation.radial_load": "none", "contact.film": "grubin", "contact.flange_film": "chittenden"},
        OIL,
    ),
    structure(
        "lubricated, misaligned, Dowson-Higginson",
        13,
        {"operation.misalignment": "0.2 mrad", "contact.film": "dowson_higginson"},
        OIL,
    ),
    structure(
        "lubricated, moment, crowned, Pennzane",
        12,
        {
            "operation.moment": "0 N*m",
            "profile.shape": "crowned",
            "profile.drop": "5 um",
            "oil.name": "pennzane_x2000",
            "contact.film": "pan_hamrock",
            "contact.thermal": "none",
            "contact.flange_film": "nijenbanning",
            "contact.traction": "elsharkawy_hamrock",
        },
        OIL,
        twins=(MIRROR, HOTTER),
    ),
    structure(
        "rough, radial, full range, gap",
        11,
        {
            **ROUGH,
            "contact.rolling_resistance": "full_range",
            "contact.supply.gap_over_central": "5",
            "contact.hysteresis": "0.005",
        },
        {**OIL, **FRICTION, **supplied("gap_over_central")},
    ),
    structure(
        "rough, axial, Biboulet-Houpert, layer",
        17,
        {
            **ROUGH,
            "operation.radial_load": "none",
            "contact.mixed.share": "greenwood_tripp",
            "contact.rolling_resistance": "biboulet_houpert",
            "contact.supply.layer": "1 um",
        },
        {**OIL, **FRICTION, **supplied("layer")},
    ),
]

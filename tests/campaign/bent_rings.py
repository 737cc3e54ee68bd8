"""Random bearings whose rings bend or are not round."""

import dataclasses
from typing import Any

import numpy as np
from campaign import balls, tapered
from campaign.bearings import CRAWL, MIRROR, OIL, YIELDING, scaled
from campaign.draws import Numbers, Range, even, log
from campaign.rollers import DRY, LUBRICATED, MEAN, roller_balances, roller_numbers, structure
from campaign.structure import Results, Structure

from jaxbearing.bearings.ball.core import FORCE_FLOOR

RIM: dict[str, Range] = {"rim": log(0.3, 2.0), "wide": even(1.0, 2.0)}
"""Thickness over the diameter of a rolling element, width over the roller length or the ball diameter."""
THINNER = 0.3
"""Thickness of an inner ring over that: it must leave a bore."""
HOUSING: dict[str, Range] = {"housing": log(1e9, 1e13), "glued": log(1e7, 1e12, zero=0.5)}
"""N/m^2, all round and along the circumference."""
SHAFT: dict[str, Range] = {"shaft": log(1e9, 1e13), "shrunk": log(1e7, 1e12, zero=0.5)}
"""N/m^2, under the whole ring and along the circumference."""
OVAL: dict[str, Range] = {"lobe": even(-2e-3, 2e-3, zero=0.1)}
"""Height over the diameter of a rolling element."""
SUPPORTS: dict[str, Range] = {
    "support": log(1e8, 1e10),
    "spread": even(0.25, 1.2),
    "gap": even(0.0, 1e-3, zero=0.3),
}
"""Stiffness, N/m; angle off the load line, rad; gap over the roller diameter."""
LENGTHS = (
    *("outer_ring.thickness", "outer_ring.width", "outer_ring.support_gap", "outer_roundness.lobe_height"),
    *("inner_ring.thickness", "inner_ring.width"),
    # of a support, N/m: as a length, with the modulus held
    "outer_ring.support_stiffness",
)
ELASTIC = (MIRROR, YIELDING, CRAWL, scaled(LENGTHS))
TABLES: dict[str, Any] = {"outer_ring.thickness": "8 mm", "outer_ring.width": "20 mm", "outer_ring.harmonics": "6"}
INNER_TABLES: dict[str, Any] = {
    **{"inner_ring.thickness": "3 mm", "inner_ring.width": "20 mm", "inner_ring.harmonics": "5"},
    "inner_ring.shaft_stiffness": "1e10 N/m^2",
}


def ring_numbers(numbers: Numbers, v: Numbers, scene: Any) -> Numbers:
    """Numbers of the rings and of the lobe, as far as the scene has them, beside those of the rigid bearing."""
    diameter = v["diameter"]
    column = lambda values: np.asarray(values)[:, None]
    width = v["wide"] * numbers.get("geometry.roller_length", diameter)
    if scene.inner_ring is not None:
        numbers |= {
            **{"inner_ring.thickness": THINNER * v["rim"] * diameter, "inner_ring.width": width},
            **{"inner_ring.shaft_stiffness": v["shaft"], "inner_ring.shaft_shear_stiffness": v["shrunk"]},
        }
    if scene.outer_ring is None:
        return numbers
    numbers |= {"outer_ring.thickness": v["rim"] * diameter, "outer_ring.width": width}
    if scene.outer_ring.housing_stiffness is not None:
        numbers |= {"outer_ring.housing_stiffness": v["housing"], "outer_ring.housing_shear_stiffness": v["glued"]}
    if scene.outer_ring.support_angle is not None:
        numbers |= {
            "outer_ring.support_angle": column(v["spread"]) * np.array([-1.0, 1.0]),
            "outer_ring.support_stiffness": column(v["support"]) * np.ones(2),
            "outer_ring.support_gap": column(v["gap"] * diameter) * np.ones(2),
        }
    if scene.outer_roundness is not None:
        numbers["outer_roundness.lobe_height"] = column(v["lobe"] * diameter)
    return numbers


def _shapes(order: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cosines and sines of all orders at the angles of each case."""
    turned = order[:, None] * angle[:, None, :]
    return np.cos(turned), np.sin(turned)


def _deflection(r: Results, angle: np.ndarray, side: str = "outer") -> np.ndarray:
    """Outward deflection of a ring at angles, m."""
    amplitudes = np.stack([r[f"{side}_ring.cosines"], r[f"{side}_ring.sines"]])
    return np.einsum("fcn,fcnj->cj", amplitudes, np.stack(_shapes(r[f"{side}_ring.order"][0], angle)))


def opening_of(scene: Any, n: Numbers, r: Results) -> np.ndarray:
    """By how much the races have moved away from each other at each rolling element, m."""
    azimuth = r["elements.azimuth"]
    opening = np.zeros_like(azimuth)
    if scene.outer_ring is not None:
        opening = opening + _deflection(r, azimuth)
    if scene.inner_ring is not None:
        opening = opening - _deflection(r, azimuth, "inner")
    if scene.outer_roundness is not None:
        opening = opening + n["outer_roundness.lobe_height"] * np.cos(2.0 * azimuth)
    return opening


def ring_balances(
    scene: Any, n: Numbers, r: Results, raceway: np.ndarray, load: np.ndarray, side: str = "outer"
) -> dict[str, tuple[np.ndarray, float]]:
    """The amplitudes balance what bends the ring, written again from the printed loads. **Arguments:** diameter of the
    race, m, and the force by which each rolling element presses the ring away, N."""
    part, sense = f"{side}_ring", 1.0 if side == "outer" else -1.0
    order, azimuth = r[f"{part}.order"][0], r["elements.azimuth"]
    cosines, sines = r[f"{part}.cosines"], r[f"{part}.sines"]
    height, width = n[f"{part}.thickness"], n[f"{part}.width"]
    radius = 0.5 * (raceway + sense * height)
    modulus = n["materials.rings.youngs_modulus"]
    bending, axial = modulus * width * height**3 / 12.0, modulus * width * height
    share = bending / (axial * radius**2)
    each = (bending / radius**4 / (1.0 + share))[:, None] * (order**2 - 1.0) ** 2
    each = np.where(order == 0, (axial / radius**2)[:, None], each)
    bed = f"{part}.{'housing' if side == 'outer' else 'shaft'}"
    if f"{bed}_stiffness" in n:
        along = np.where(order > 0, 1.0 / np.maximum(order, 1.0) ** 2, 0.0)
        each = each + n[f"{bed}_stiffness"][:, None] + n[f"{bed}_shear_stiffness"][:, None] * along
    stiffness = np.pi * radius[:, None] * each * np.where(order == 0, 2.0, 1.0)
    found = {}
    worst = np.zeros(len(load))
    held = [np.zeros_like(cosines), np.zeros_like(sines)]
    if side == "outer" and scene.outer_ring.support_angle is not None:
        angle = n["outer_ring.support_angle"]
        forces = n["outer_ring.support_stiffness"] * np.maximum(
            _deflection(r, angle) - n["outer_ring.support_gap"], 0.0
        )
        off = np.max(np.abs(forces - r["outer_ring.support_forces"]), axis=1)
        found["forces of the supports"] = (off / np.sum(load, axis=1), 1e-6)
        held = [np.einsum("cnm,cm->cn", shape, r["outer_ring.support_forces"]) for shape in _shapes(order, angle)]
    for amplitude, shape, also in zip((cosines, sines), _shapes(order, azimuth), held, strict=True):
        row = stiffness * amplitude + also - sense * np.einsum("cnj,cj->cn", shape, load)
        worst = np.maximum(worst, np.max(np.abs(row), axis=1))
    found[f"the {side} ring is in balance"] = (worst / np.sum(load, axis=1), 1e-8)
    return found


def roller_ring_balances(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    """Rings and rollers fit, and both rings are in balance."""
    pitch, diameter = n["geometry.pitch_diameter"], n["geometry.roller_diameter"]
    found = roller_balances(scene, n, r, opening_of(scene, n, r))
    if scene.inner_ring is not None:
        found |= ring_balances(scene, n, r, pitch - diameter, r["elements.load_inner"], "inner")
    if scene.outer_ring is None:
        return found
    return found | ring_balances(scene, n, r, pitch + diameter, r["elements.load_outer"])


def ball_ring_balances(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    """Rings and balls fit, and both rings are in balance."""
    diameter = n["geometry.ball_diameter"]
    distance = (n["geometry.conformity_inner"] + n["geometry.conformity_outer"] - 1.0) * diameter
    free = 1.0 - n["geometry.diametral_clearance"] / (2.0 * distance)
    found = balls.ball_balances(scene, n, r, opening_of(scene, n, r))
    for side, sense, ring in (("outer", 1.0, scene.outer_ring), ("inner", -1.0, scene.inner_ring)):
        if ring is None:
            continue
        groove = n[f"geometry.conformity_{side}"]
        bottom = n["geometry.pitch_diameter"] + sense * 2.0 * diameter * (groove - (groove - 0.5) * free)
        load = r["elements.load_outer"] * np.cos(r["elements.contact_angle_outer"])
        if side == "inner":
            # less what rotation adds: printed inner angles are those against a tilted ring
            mass = n["materials.balls.density"] * np.pi / 6.0 * diameter**3
            orbit = 0.5 * (mass * n["geometry.pitch_diameter"])[:, None] * r["elements.orbital_speed"] ** 2
            load = load - orbit - FORCE_FLOOR
        found |= ring_balances(scene, n, r, bottom, load, side)
    return found


def cup_balances(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    """The balances of tapered rollers, cone and cup."""
    cup, half, length = (n[f"geometry.{name}"] for name in ("contact_angle", "roller_half_angle", "roller_length"))
    # the cup in the middle of the rollers, from the apex
    apex = n["geometry.roller_diameter"] / (2.0 * np.sin(half))
    found, reach = tapered.tapered_balances(scene, n, r), 2.0 * (apex - 0.5 * length)
    if scene.inner_ring is not None:
        cone, rib = cup - 2.0 * half, n["geometry.flange_angle"]
        load = r["elements.load_inner"] * np.cos(cone)[:, None] - r["elements.load_flange"] * np.sin(rib)[:, None]
        found |= ring_balances(scene, n, r, reach * np.sin(cone), load, "inner")
    if scene.outer_ring is None:
        return found
    load = r["elements.load_outer"] * np.cos(cup)[:, None]
    return found | ring_balances(scene, n, r, reach * np.sin(cup), load)


def bent(name: str, count: int, changes: dict[str, Any], ranges: dict[str, Range], **kwargs: Any) -> Structure:
    base = structure(name, count, changes, {**RIM, **ranges}, **kwargs)
    return dataclasses.replace(
        base,
        numbers=lambda v: ring_numbers(roller_numbers(v, base.scene), v, base.scene),
        balances=lambda n, r: roller_ring_balances(base.scene, n, r),
    )


def bent_cup(name: str, count: int, changes: dict[str, Any], ranges: dict[str, Range], **kwargs: Any) -> Structure:
    base = tapered.structure(name, count, changes, {**RIM, **ranges}, **kwargs)
    return dataclasses.replace(
        base,
        numbers=lambda v: ring_numbers(tapered.tapered_numbers(v, base.scene), v, base.scene),
        balances=lambda n, r: cup_balances(base.scene, n, r),
    )


def bent_balls(name: str, count: int, changes: dict[str, Any], ranges: dict[str, Range], **kwargs: Any) -> Structure:
    base = balls.structure(name, "deep_groove_6205", count, changes, {**RIM, **ranges}, **kwargs)
    return dataclasses.replace(
        base,
        numbers=lambda v: ring_numbers(balls.ball_numbers(v, base.scene), v, base.scene),
        balances=lambda n, r: ball_ring_balances(base.scene, n, r),
    )


BALLS = (MIRROR, CRAWL, scaled(LENGTHS, floor=0.05))
FILMS = {
    "oil.name": "mobil_jet_ii",
    "operation.oil_temperature": "60 degC",
    "operation.moment": "none",
    "contact.film": "hamrock_dowson",
}
LOBE = {
    "outer_roundness.lobe_order": "2",
    "outer_roundness.lobe_height": "1 um",
    "outer_roundness.lobe_angle": "0 deg",
}
STRUCTURES = [
    bent(
        "flexible outer ring, housing, oval race",
        12,
        {**TABLES, "outer_ring.housing_stiffness": "1e10 N/m^2", **LOBE},
        {**HOUSING, **OVAL},
        without=DRY,
        twins=ELASTIC,
        small=True,
    ),
    bent(
        "flexible outer ring, two supports",
        14,
        {
            **TABLES,
            "outer_ring.support_angle": '["-30 deg", "30 deg"]',
            "outer_ring.support_stiffness": '["100 N/um", "100 N/um"]',
            "outer_ring.support_gap": '["0 um", "0 um"]',
        },
        SUPPORTS,
        without=DRY,
        twins=ELASTIC,
    ),
    bent(
        "skidding, flexible outer ring, housing",
        10,
        {**TABLES, **MEAN, "outer_ring.housing_stiffness": "1e10 N/m^2"},
        {**LUBRICATED, **HOUSING},
    ),
    bent_balls(
        "dry, flexible outer ring, housing, oval race, tilt free",
        9,
        {**TABLES, "outer_ring.housing_stiffness": "1e10 N/m^2", **LOBE},
        {**HOUSING, **OVAL},
        twins=BALLS,
    ),
    bent_balls(
        "films, flexible outer ring, housing",
        8,
        {**TABLES, **FILMS, "outer_ring.housing_stiffness": "1e10 N/m^2"},
        {**OIL, **HOUSING},
    ),
    bent_cup(
        "dry, moment, flexible cup, housing, oval race",
        11,
        {**TABLES, **tapered.DRY, "operation.moment": "0 N*m", "outer_ring.housing_stiffness": "1e10 N/m^2", **LOBE},
        {**HOUSING, "lobe": even(-5e-4, 5e-4, zero=0.1)},
        twins=(MIRROR, CRAWL),
    ),
    bent(
        "both rings flexible",
        13,
        {**TABLES, **INNER_TABLES, "outer_ring.housing_stiffness": "1e10 N/m^2"},
        {**HOUSING, **SHAFT},
        without=DRY,
        twins=ELASTIC,
    ),
    bent(
        "skidding, flexible inner ring",
        10,
        {**MEAN, **INNER_TABLES},
        {**LUBRICATED, **SHAFT},
    ),
    bent_balls(
        "dry, flexible inner ring, tilt free",
        9,
        INNER_TABLES,
        SHAFT,
        twins=BALLS,
    ),
    bent_cup(
        "dry, moment, flexible cone",
        11,
        {**tapered.DRY, "operation.moment": "0 N*m", **INNER_TABLES},
        SHAFT,
        twins=(MIRROR, CRAWL),
    ),
]

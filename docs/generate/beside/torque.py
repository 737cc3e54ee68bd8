"""Torque of tapered roller bearings."""

import math
from typing import NamedTuple

import jaxbearing as jb
from jaxbearing.contacts.oil_supply import LEVELS

from .common import MEASURED, Comparison, Found, rows_of, script

KINDS, UNDERSTOOD = (int, float, float, int, int, float), (5, 6)
"""Types of the columns of the 32216's file, and its figures that are compared."""
FAST = 2200
"""Speed, rpm, at which both readings of the 32008's torque agree."""


class Point(NamedTuple):
    """An operating point of the 32216: figure; axial, radial load, kN; speed, rpm; outer ring, degC; torque, N mm."""

    figure: int
    axial: float
    radial: float
    rpm: int
    celsius: int
    torque: float


def points_32216() -> list[Point]:
    """The points of the figures whose set-up is understood."""
    rows = rows_of(MEASURED / "trb_32216_torque.csv")
    points = [Point(*(kind(one) for kind, one in zip(KINDS, row.values(), strict=True))) for row in rows]
    return [one for one in points if one.figure in UNDERSTOOD]


def trb_32216() -> Found:
    """The script of the 32216: flooded, with the supply that the package assumes of a bath, and with the fitted one."""
    example = script("trb_32216")
    supplies = {"flooded": None, "bath": {"gap_over_central": LEVELS["bath"]}, "fitted": example.STARVED}
    rows, deviations = [], {}
    for point in points_32216():
        *place, measured = point[1:]
        cells = [f"{point.figure}", f"{point.axial:g}, {point.radial:g}", *(f"{one:g}" for one in point[3:])]
        solved = {name: example.solved(*place, supply) for name, supply in supplies.items()}
        for solution in solved.values():
            found = example.torque(solution, point.rpm)
            cells.append(f"{found:.0f} ({found / measured:.2f})")
        said = f"{point.axial:g}, {point.radial:g} kN, {point.rpm} rpm, {point.celsius} degC"
        deviations[said] = example.torque(solved["bath"], point.rpm) / measured - 1.0
        makers = jb.compare(example.scene_at(*place, None), solved["flooded"], catalogue=example.CATALOGUE)
        cells += [f"{1e3 * makers[law].total:.0f} ({1e3 * makers[law].total / measured:.2f})" for law in LAWS]
        rows.append(cells)
    headings = ["figure", "Fa, Fr, kN", "rpm", "degC", "measured, N mm", "flooded", "supply of a bath", "fitted supply"]
    return Found([*headings, "SKF", "Palmgren"], rows, deviations)


LAWS = ("skf", "palmgren_ina")


def trb_32008() -> Found:
    """The script of the 32008; the verdict is about the speed at which both readings agree."""
    example = script("trb_32008")
    rows, deviations = [], {}
    for (rpm, celsius), readings in sorted(example.measured().items(), key=lambda one: (one[0][1], one[0][0])):
        found = example.torque(rpm, celsius)
        ratios = [f"{found / readings[name]:.2f}" for name in "AB"]
        rows.append([f"{celsius}", f"{rpm}", *(f"{readings[name]:.0f}" for name in "AB"), f"{found:.0f}", *ratios])
        if rpm == FAST:
            deviations[f"{rpm} rpm, {celsius} degC"] = found / readings["A"] - 1.0
    headings = ["degC", "rpm", "measured, A, N mm", "measured, B", "flooded", "over A", "over B"]
    return Found(headings, rows, deviations)


MISSING = {
    "LM12700": "mean diameter of the rollers, viscosity of the oil, supply",
    "HM801349_pair": "length and diameter of the rollers, viscosity of the oil, supply, share of the axial load",
    "HH926749_pair_grease": "geometry, base oil, supply, temperature",
}
"""Inputs of a solve of each bearing that the data do not have."""


def trb_others() -> Found:
    """Missing inputs of the other tapered bearings, and the growth of their torque with speed or load."""
    rows = []
    for name, missing in MISSING.items():
        points = [row for row in rows_of(MEASURED / "trb_other_torque.csv") if row["bearing"] == name]
        torques = [float(row["torque_Nm"]) for row in points]
        speeds = [float(row["n_rpm"]) for row in points]
        least = torques.index(min(torques))
        shape = "-"
        if name == "LM12700":
            growth = math.log(torques[-1] / torques[least]) / math.log(speeds[-1] / speeds[least])
            shape = f"least at {speeds[least]:.0f} rpm, then with the speed to the power of {growth:.2f}"
        rows.append([name.replace("_", " "), f"{len(points)}", f"{min(torques):g} to {max(torques):g}", shape, missing])
    headings = ["bearing", "points", "torque, N m", "course", "missing for a solve"]
    return Found(headings, rows, {}, "not computed: inputs are missing")


COMPARISONS = (
    Comparison(
        name="trb_32216",
        quantity="torque of a tapered bearing in an oil bath",
        data="32216, 500 to 4000 rpm, 42 and 50 degC, TU Kaiserslautern 2023",
        free="nothing in `supply of a bath`, which the deviation is about; one number, S, in `fitted supply`",
        assumed="rib angle, end radius, profile, shear constants of the oil; contacts as warm as the outer ring",
        believe=75.0,
        data_error=5.0,
        verdict="In an oil bath believe the torque to about {believe} per cent with `contact.supply.level = "
        '"bath"`, on the high side; without a supply it is twice the measured one.',
        compute=trb_32216,
    ),
    Comparison(
        name="trb_32008",
        quantity="torque of a tapered bearing in forced oil",
        data="32008, 200 to 2200 rpm, 55 and 65 degC, Ghent 2023; deviation at 2200 rpm",
        free="nothing",
        assumed="rib angle, end radius, pitch diameter, pressure coefficient and shear constants of the oil",
        believe=35.0,
        data_error=5.0,
        verdict="Where the inlets are surely flooded believe the torque to about {believe} per cent, on the high side; "
        "below 2200 rpm the two readings differ by more than that.",
        compute=trb_32008,
    ),
    Comparison(
        name="trb_others",
        quantity="torque of other tapered bearings",
        data="LM12700, HM801349 pair, HH926749 pair with grease",
        free="nothing",
        assumed="nothing",
        believe=None,
        data_error=100.0,
        verdict="These curves say nothing about the model: their inputs do not suffice for a solve.",
        compute=trb_others,
        dear=False,
    ),
)

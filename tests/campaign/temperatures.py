"""Random mounted bearings of all kinds with a thermal network: each ends in a state that balances, or in an honest
status.

`python -m campaign.temperatures 60` prints what came out of so many cases, as many of each of eight structures.
"""

import sys
from collections import Counter
from typing import NamedTuple

import numpy as np
from campaign.draws import Range, drawn, even, log, single
from warm_cases import warm

import jaxbearing as jb
from jaxbearing.numerics.status import Status

BALANCE = 1e-10
"""Largest balance error of a state, relative to its losses."""
MEDIAN_SOLVES = 15
HONEST = (Status.THERMAL_RUNAWAY, Status.NO_EQUILIBRIUM, Status.INVALID_INPUT)
"""Statuses that say why there is no state: no temperatures below the limit, loads without an equilibrium, seats that
leave no contact."""
COMMON: dict[str, Range] = {
    "operation.oil_temperature": even(293.15, 383.15),
    "thermal.ambient": even(253.15, 333.15),
    "thermal.factor.oil": log(0.5, 3.0),
    "thermal.factor.ambient": log(0.3, 3.0),
    "thermal.rolling_to_oil": even(0.0, 1.0),
    "fits.shaft_interference": even(-10e-6, 40e-6),
    "fits.housing_interference": even(-30e-6, 20e-6),
}
SEATS = {"fits__shaft_interference": "10 um", "fits__housing_interference": "-5 um"}
COMBINED = {"operation__radial_load": "1.5 kN", "operation__axial_load": "200 N"}


class Drawn(NamedTuple):
    """Scenes of one structure, and the ranges of their numbers beside the common ones. `median`: largest median of the
    number of solves of the bearing."""

    name: str
    kind: str
    nodes: int
    changes: dict[str, str]
    ranges: dict[str, Range]
    median: int = MEDIAN_SOLVES


SKIDDING = 20
"""A third of the sliding roller bearings are so light and fast that they skid by up to 15 %. Their losses then change
steeply with the temperatures, and Broyden's iteration takes up to 60 solves."""
STRUCTURES = (
    Drawn(
        "ball, thrust, four nodes",
        "ball",
        4,
        {},
        {
            "operation.inner_speed": log(50.0, 3000.0),
            "operation.axial_load": log(50.0, 4000.0),
            "operation.oil_flow": log(1e-8, 1e-5),
        },
    ),
    Drawn(
        "ball, combined, six nodes",
        "ball",
        6,
        COMBINED,
        {
            "operation.inner_speed": log(50.0, 2000.0),
            "operation.radial_load": log(50.0, 4000.0),
            "operation.oil_flow": log(1e-8, 1e-5),
        },
    ),
    Drawn(
        "roller, one node",
        "roller",
        1,
        {},
        {
            "operation.inner_speed": log(30.0, 2000.0),
            "operation.radial_load": log(500.0, 60e3),
            "operation.oil_flow": log(1e-7, 1e-4),
        },
    ),
    Drawn(
        "roller, six nodes",
        "roller",
        6,
        {},
        {
            "operation.inner_speed": log(30.0, 2000.0),
            "operation.radial_load": log(500.0, 60e3),
            "operation.oil_flow": log(1e-7, 1e-4),
        },
    ),
    Drawn(
        "tapered, four nodes",
        "tapered",
        4,
        {},
        {
            "operation.inner_speed": log(20.0, 600.0),
            "operation.axial_load": log(1e3, 40e3),
            "operation.oil_flow": log(1e-7, 5e-5),
        },
    ),
    Drawn(
        "ball, sliding, four nodes",
        "sliding ball",
        4,
        {},
        {
            "operation.inner_speed": log(100.0, 2000.0),
            "operation.axial_load": log(1e3, 50e3),
            "operation.oil_flow": log(1e-6, 1e-4),
        },
    ),
    Drawn(
        "roller, sliding, four nodes",
        "sliding roller",
        4,
        {},
        {
            "operation.inner_speed": log(100.0, 2000.0),
            "operation.radial_load": log(500.0, 60e3),
            "operation.oil_flow": log(1e-6, 1e-4),
        },
        SKIDDING,
    ),
    Drawn(
        "tapered, sliding rib, six nodes",
        "sliding rib",
        6,
        {"operation__axial_load": "20 kN"},
        {
            "operation.inner_speed": log(20.0, 600.0),
            "operation.radial_load": log(1e3, 30e3),
            "operation.oil_flow": log(1e-7, 5e-5),
        },
    ),
)


class Outcome(NamedTuple):
    """Status, balance error, number of solves and highest temperature of one case."""

    status: Status
    balance: float
    solves: int
    hottest: float


def outcomes(structure: Drawn, cases: int, seed: int = 1) -> list[Outcome]:
    """Solves so many random scenes of a structure."""
    scene = warm(structure.kind, structure.nodes, **SEATS, **structure.changes)
    ranges = COMMON | structure.ranges
    numbers = drawn(ranges, np.random.default_rng(seed).random((cases, len(ranges))))
    solve = jb.jit_solver(scene)
    found = []
    for case in range(cases):
        solution = solve(scene.replace(single(numbers, case)))
        found.append(
            Outcome(
                Status(int(solution.status)),
                float(solution.thermal.balance_error),
                int(solution.thermal.solves),
                float(np.max(np.asarray(solution.thermal.last))),
            )
        )
        drive, total = float(solution.drive_power), float(solution.power_loss.total)
        assert found[-1].status != Status.CONVERGED or abs(drive - total) <= BALANCE * total, (structure.name, case)
    return found


def summary(cases: int) -> str:
    """One line for each structure, and one for all."""
    lines, everything = [], []
    for structure in STRUCTURES:
        found = outcomes(structure, cases // len(STRUCTURES))
        everything += found
        lines.append(f"{structure.name}: {_told(found)}")
    return "\n".join([*lines, f"all: {_told(everything)}"])


def _told(found: list[Outcome]) -> str:
    counts = Counter(one.status.text for one in found)
    states = [one for one in found if one.status == Status.CONVERGED]
    solves = sorted(one.solves for one in states)
    said = ", ".join(f"{count} {name}" for name, count in counts.items())
    worst = max((abs(one.balance) for one in states), default=0.0)
    median = float(np.median(solves)) if solves else 0.0
    return f"{said}; balance error at most {worst:.1e}; solves: median {median:g}, most {max(solves, default=0)}"


if __name__ == "__main__":
    print(summary(int(sys.argv[1]) if len(sys.argv) > 1 else 60))

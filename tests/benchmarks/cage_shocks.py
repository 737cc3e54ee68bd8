"""Shocks between rollers and cage, beside the numbers of the source: its Table 17 and its perturbed shaft.

    python tests/benchmarks/cage_shocks.py [--quick]

The bearing of Table 16 with the reference laws, five turns of the cage from the quasi-static state. Printed: the mean
over the rollers of the largest load on the front and the rear wall of their pockets, in the third and the last turn, N.
Shocks are chaotic: from turn to turn, and from one tolerance to the next, such means differ by tens of per cent, and
between drag coefficients by a factor of ten. The source gives one number and no drag coefficient: agreement in order
of magnitude is all that can be had, and nothing here is tuned for it.
"""

import argparse
import sys
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--quick", action="store_true", help="one point and one perturbation, three turns each")
arguments = parser.parse_args() if __name__ == "__main__" else parser.parse_args(["--quick"])

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import numpy as np  # noqa: E402
from moving_roller import table_16  # noqa: E402
from roller_cases import RPM  # noqa: E402

import jaxbearing as jb  # noqa: E402
from jaxbearing.bearings.motion.settings import Simulation  # noqa: E402
from jaxbearing.report.history_shocks import FACES, shocks, turns  # noqa: E402
from jaxbearing.time_laws import Sinusoidal, Steady  # noqa: E402

TOLERANCE = 1e-5
DRAG = (0.3, 0.6, 1.2)
TABLE_17 = {(15e3, 10e3): 70, (15e3, 14e3): 100, (25e3, 10e3): 80, (25e3, 14e3): 120}
"""Average amplitude of the load between roller and cage, N, at a load, N, and a speed, rpm."""
PERTURBED = {"40 Hz, 10 %": (40.0, 0.1, "up to 600"), "30 Hz, 5 %": (30.0, 0.05, "not given")}
TURNS = 5


def run(load, rpm, drag, law, turns_wanted):
    """A history of so many turns of the cage."""
    scene = table_16(drag).at_operation(radial_load=load, inner_speed=rpm * RPM)
    # of rolling without slip; the cage lags a little
    turn = 60.0 / rpm * 2.0 / (1.0 - 12.0 / 142.0)
    simulation = Simulation(speed=law, tolerance=TOLERANCE)
    return jb.simulate(scene, 1.02 * turns_wanted * turn, simulation=simulation, throw=False)


def figures_of(history, turns_wanted):
    """Whether the run reached its end, whole turns, means and maxima of the peaks turn by turn, energy error."""
    whole = int(turns(history)[-1])
    peaks = shocks(history)
    return {
        "completed": history.completed,
        "turns": whole,
        "steps": int(history.accepted),
        "error": float(history.energy.error),
        "peaks": {face: [(turn["mean"], turn["max"]) for turn in peaks[face][:turns_wanted]] for face in FACES},
    }


def benchmark(quick=False):
    points = list(TABLE_17)[-1:] if quick else list(TABLE_17)
    count = 3 if quick else TURNS
    steady = {
        (load, rpm, drag): figures_of(run(load, rpm, drag, Steady(), count), count)
        for load, rpm in points
        for drag in (DRAG[-1:] if quick else DRAG)
    }
    shaken = {}
    for name, (frequency, amplitude, _) in PERTURBED.items():
        for drag in DRAG[-1:] if quick else DRAG:
            history = run(25e3, 14e3, drag, Sinusoidal(frequency, amplitude), count)
            shaken[name, drag] = figures_of(history, count)
            found = shaken[name, drag]
            cage, shaft = np.asarray(history.instants.cage.speed), np.asarray(history.instants.inner_speed)
            found["swing"] = float(np.ptp(cage) / cage.mean()), float(np.ptp(shaft) / shaft.mean())
        if quick:
            break
    return {"steady": steady, "perturbed": shaken}


def _row(found):
    turn = lambda k: " / ".join(f"{found['peaks'][face][k][0]:.0f}" for face in FACES)
    third = turn(2) if len(found["peaks"]["front"]) > 2 else "-"
    largest = " / ".join(f"{max(peak for _, peak in found['peaks'][face]):.0f}" for face in FACES)
    return f"{third} | {turn(-1)} | {largest}", f"{found['steps']} | {found['error']:.0e}"


def print_table(figures):
    print("Mean peak front / rear, N, in the third turn, in the last, and the largest of the run; Table 17 beside it")
    print("| load, speed | drag | third turn | last turn | largest | Table 17 | turns | steps | energy left open |")
    print("|---|---|---|---|---|---|---|---|---|")
    for (load, rpm, drag), found in figures["steady"].items():
        peaks, rest = _row(found)
        done = found["turns"] if found["completed"] else f"{found['turns']}, NOT COMPLETED"
        print(f"| {load / 1e3:.0f} kN, {rpm:.0f} rpm | {drag} | {peaks} | {TABLE_17[load, rpm]} | {done} | {rest} |")
    print("\nShaft speed perturbed, 25 kN, 14 000 rpm; swing: largest less smallest speed over the mean")
    print("| shaft | drag | third turn | last turn | largest | source | swing of cage, shaft | turns | steps | left |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for (name, drag), found in figures["perturbed"].items():
        peaks, rest = _row(found)
        done = found["turns"] if found["completed"] else f"{found['turns']}, NOT COMPLETED"
        swing = ", ".join(f"{100 * part:.1f} %" for part in found["swing"])
        print(f"| {name} | {drag} | {peaks} | {PERTURBED[name][2]} | {swing} | {done} | {rest} |")


if __name__ == "__main__":
    print_table(benchmark(arguments.quick))

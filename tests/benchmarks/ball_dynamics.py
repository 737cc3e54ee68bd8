"""Speed AND error of transient runs of balls, full against quasi-static meridian, beside scipy on the same vector
field.

    python tests/benchmarks/ball_dynamics.py [--quick] [--meridian dynamic | quasi_static] [--spectra] [--scene]

The ball bearing of Table 15 with cage, isothermal films and the viscous limit of Ree-Eyring traction (12 500 rpm, 20 kN
along the axis, 2 kN of radial load that rise in 2 ms), 6 ms from the steady state. An error is the largest one over all
balls and 64 times, of positions q (um), speeds v (m/s) and surface speeds of the spin (m/s), each model against itself
at a tight tolerance. scipy gets our jitted vector field without the works, and where it asks for one its jitted
Jacobian, with the same tolerances, also of the balance inside. "Times" is the time of scipy's fastest run that is at
least as exact, interpolated between its tolerances where it has two on either side, over ours. Times are wall times of
warm runs.

With `--spectra` instead the spectra of the places of balls and cage of both models at four operating points; with
`--scene` the simulated milliseconds to a second of the scene `turbine_ball_dynamic`.
"""

import argparse
import dataclasses
import itertools
import sys
from pathlib import Path
from typing import Any

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--quick", action="store_true", help="three balls, 0.1 ms, two tolerances, batches of 2")
parser.add_argument("--meridian", choices=("dynamic", "quasi_static"), help="one model alone")
parser.add_argument("--spectra", action="store_true", help="spectra of both models instead")
parser.add_argument("--scene", action="store_true", help="the built-in scene instead")
arguments = parser.parse_args() if __name__ == "__main__" else parser.parse_args(["--quick"])

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import equinox as eqx  # noqa: E402
import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
import numpy as np  # noqa: E402
from benchmark_tools import EXPLICIT, batches_of, best_time, said, scipy_run, times_as_fast  # noqa: E402

import jaxbearing as jb  # noqa: E402
from jaxbearing.bearings.ball.gyroscopic import ResolvedCouple  # noqa: E402
from jaxbearing.bearings.ball.motion.energy import WORKS  # noqa: E402
from jaxbearing.bearings.ball.motion.quasi_static import FINE  # noqa: E402
from jaxbearing.bearings.ball.scene import BallAttitude  # noqa: E402
from jaxbearing.bearings.motion.run import FIELD  # noqa: E402
from jaxbearing.bearings.motion.start import quasi_static_start  # noqa: E402
from jaxbearing.contacts import (  # noqa: E402
    DistributedTraction,
    HamrockDowsonCentral,
    PointLaws,
    ReeEyring,
    Resolution,
)
from jaxbearing.numerics.arrow import ArrowPoint  # noqa: E402
from jaxbearing.numerics.integrate import integrate_segment  # noqa: E402
from jaxbearing.numerics.integrator import IntegratorOptions  # noqa: E402
from jaxbearing.numerics.status import Status  # noqa: E402
from jaxbearing.time_laws import Ramp  # noqa: E402

LAWS = PointLaws(
    film=HamrockDowsonCentral(), traction=DistributedTraction(ReeEyring(), Resolution(12, 6), elastic=False)
)
MODELS = ("dynamic", "quasi_static")
TOLERANCES = (1e-3, 1e-4, 1e-5)
OURS = {"dynamic": ("tsit5", "dopri8"), "quasi_static": ("tsit5", "dopri8", "kvaerno5")}
SCIPY = {"dynamic": ("RK45", "DOP853", "LSODA"), "quasi_static": ("RK45", "DOP853", "LSODA", "Radau", "BDF")}
SLOWEST = 20.0
"""A run that takes longer is the last one of its method, s."""
SAMPLES = 64
REFERENCE = 1e-9
FIRST = 1e-7
DURATION = 6e-3
POINTS = {
    "20 kN axial, 2 kN radial, 12 500 rpm": (20e3, 2e3, 12500.0),
    "20 kN axial, 8 kN radial, 12 500 rpm": (20e3, 8e3, 12500.0),
    "5 kN axial, 1 kN radial, 12 500 rpm": (5e3, 1e3, 12500.0),
    "20 kN axial, 2 kN radial, 5000 rpm": (20e3, 2e3, 5000.0),
}
"""Operating points of the spectra: axial and radial load, N, and speed, rpm."""


def settings(meridian, rise=2e-3):
    """A light, well damped ring, so that the model without inertia of the ring stands for it."""
    mass: Any = {} if meridian == "quasi_static" else {"ring_mass": 0.5, "ring_damping": 1e4}
    return jb.Simulation(meridian=meridian, load=Ramp(0.9, 1.0, rise), **mass)


def bearing(axial=20e3, radial=2e3, rpm=12500.0, balls=20):
    """The ball bearing of Table 15 in motion with the laws of this benchmark."""
    share = balls / 20
    changes = {
        "contact": LAWS,
        "geometry.n_balls": balls,
        "operation.axial_load": axial * share,
        "operation.radial_load": radial * share,
        "operation.inner_speed": rpm * np.pi / 30.0,
    }
    scene = jb.load_scene("turbine_ball_dynamic", {"contact.thermal": "none"}).replace(changes)
    return dataclasses.replace(scene, kinematics=BallAttitude("equilibrium", ResolvedCouple()))


@eqx.filter_jit
def started(scene, simulation):
    return quasi_static_start(scene, simulation)


@eqx.filter_jit
def ours(start, times, options):
    """A run in one go: states at the times, and what it took."""
    idle = len(WORKS)
    return integrate_segment(
        FIELD, start.state, jnp.zeros(()), times, start.dynamics, options, jnp.asarray(FIRST), idle=idle
    )


def full_of(dynamics):
    """The equations of the full model, which the quasi-static ones hold."""
    return getattr(dynamics, "full", dynamics)


def field_of(start):
    """The vector field as scipy wants it, without the works, and its Jacobian, both compiled."""
    dynamics, (own, count) = start.dynamics, start.state.elements.shape

    def field(t, y, tolerance):
        shared = jnp.concatenate([y[own * count :], jnp.zeros(len(WORKS))])
        state = ArrowPoint(y[: own * count].reshape(own, count), shared)
        found, _ = dynamics.nested_rates(t, state, dynamics.first_guess(t, state), tolerance)
        return jnp.concatenate([found.elements.ravel(), found.globals[: -len(WORKS)]])

    return jax.jit(field), jax.jit(jax.jacfwd(field, argnums=1))


def flat(states):
    """States, with times in front, as rows for scipy."""
    count = states.globals.shape[0]
    shared = np.asarray(states.globals)[:, : -len(WORKS)]
    return np.concatenate([np.asarray(states.elements).reshape(count, -1), shared], axis=1)


def errors(rows, exact, balls):
    """Largest errors of q, um, of v, m/s, and of the surface speeds of the spin, m/s."""
    apart = np.abs(rows - exact)
    parts = (0, balls), (balls, 2 * balls), (2 * balls, 5 * balls)
    units = 10.0, 0.1, 1.0
    return tuple(unit * float(np.max(apart[:, a:b])) for unit, (a, b) in zip(units, parts, strict=True))


def loaded_run(start, share, tolerance, times):
    """A run from the start at a share of the loads."""
    where = lambda d: full_of(d).ring.load
    dynamics = eqx.tree_at(where, start.dynamics, share * where(start.dynamics))
    return ours(start._replace(dynamics=dynamics), times, IntegratorOptions(solver="tsit5", tolerance=tolerance))


def benchmark(quick=False, models=MODELS):
    """Rows of the models: model, method, tolerance, steps or calls, errors, seconds, times."""
    scene = bearing(balls=3 if quick else 20)
    times = np.linspace(0.0, 1e-4 if quick else DURATION, SAMPLES + 1)[1:]
    tolerances = TOLERANCES[1:] if quick else TOLERANCES
    table, batches = [], []
    for model in models:
        start = started(scene, settings(model, 2e-3))
        balls = start.state.elements.shape[1]
        exact = ours(start, jnp.asarray(times), IntegratorOptions(solver="dopri8", tolerance=REFERENCE))
        assert int(exact.status) == Status.CONVERGED
        exact = flat(exact.states)
        y0, functions = flat(jax.tree.map(lambda leaf: leaf[None], start.state))[0], field_of(start)
        jax.block_until_ready(functions[0](np.float64(0.0), y0, FINE))
        rivals = {}
        for method in SCIPY[model][1:2] if quick else SCIPY[model]:
            if method not in EXPLICIT:
                jax.block_until_ready(functions[1](np.float64(0.0), y0, FINE))
            for tolerance in tolerances:
                # a guessed first step is so long that no balance is found
                rows, calls, seconds = scipy_run(functions, y0, times, method, tolerance, FIRST)
                if rows is None:
                    table.append(said((model, f"scipy {method}", tolerance, None, *(np.nan,) * 3, seconds, None)))
                    break
                found = errors(rows, exact, balls)
                rivals.setdefault(method, []).append((found[0], seconds))
                table.append(said((model, f"scipy {method}", tolerance, calls, *found, seconds, None)))
                if seconds > SLOWEST:
                    break
        for solver in OURS[model][:1] if quick else OURS[model]:
            for tolerance in tolerances:
                options = IntegratorOptions(solver=solver, tolerance=tolerance)
                run = lambda options=options, start=start: ours(start, jnp.asarray(times), options)
                result = jax.block_until_ready(run())
                if int(result.status) != Status.CONVERGED:
                    table.append(said((model, solver, tolerance, None, *(np.nan,) * 4, None)))
                    continue
                seconds, found = best_time(run, 2), errors(flat(result.states), exact, balls)
                steps = int(result.accepted) + int(result.rejected)
                ratio = times_as_fast(found[0], seconds, rivals)
                table.append(said((model, solver, tolerance, steps, *found, seconds, ratio)))
        shares = jnp.linspace(0.9, 1.1, 2 if quick else 64)
        asked = tolerances[-1:] if quick else tolerances[-2:]
        for tolerance, each, failed in batches_of(loaded_run, start, shares, jnp.asarray(times), asked):
            error = next(row[4] for row in table if row[:3] == (model, "tsit5", tolerance))
            batches.append(said((model, tolerance, each, failed, times_as_fast(error, each, rivals))))
    return {"table": table, "batches": batches}


def spectra(quick=False):
    """At each operating point, of both models: energy of the spectrum of the mean ball's speed v (m/s) and of the
    place of the cage (um) in bands, from runs whose load rises from 90 % in 2 ms and then stays."""
    found = {}
    count = 64 if quick else 512
    times = np.linspace(0.0, 2e-4 if quick else 20e-3, count + 1)[1:]
    for name, point in list(POINTS.items())[: 1 if quick else None]:
        for model in MODELS:
            start = started(bearing(*point, balls=3 if quick else 20), settings(model, 2e-3))
            run = ours(start, jnp.asarray(times), IntegratorOptions(tolerance=1e-5))
            if int(run.status) != Status.CONVERGED:
                found[name, model] = None
                continue
            speed = 0.1 * np.asarray(run.states.elements)[:, 1]
            cage = 10.0 * np.asarray(run.states.globals)[:, 1:3]
            steps = int(run.accepted) + int(run.rejected)
            found[name, model] = steps, bands(times, speed), bands(times, cage)
            said((name, model, steps, *found[name, model][1], *found[name, model][2]))
    return found


EDGES = (0.0, 300.0, 1000.0, 3000.0, np.inf)
"""Edges of the bands, Hz."""


def bands(times, values):
    """Root mean square of each band of frequencies, mean over the columns, after the mean is taken off."""
    power = np.abs(np.fft.rfft(values - values.mean(axis=0), axis=0)) ** 2 * 2.0 / len(times) ** 2
    frequency = np.fft.rfftfreq(len(times), times[1] - times[0])
    inside = [(frequency >= a) & (frequency < b) for a, b in itertools.pairwise(EDGES)]
    return tuple(float(np.sqrt(power[one].sum(axis=0).mean())) for one in inside)


def scene_speed(quick=False):
    """Simulated milliseconds to a second of wall time of the built-in scene, warm, and its steps, by meridian."""
    found = {}
    for model in MODELS[: 1 if quick else None]:
        changes = {"simulation.meridian": model}
        scene: Any = jb.load_scene("turbine_ball_dynamic", changes)
        start = started(scene, scene.simulation)
        times = jnp.linspace(0.0, 2e-5 if quick else 0.5e-3, 3)[1:]
        run = lambda start=start, times=times: ours(start, times, IntegratorOptions())
        result = jax.block_until_ready(run())
        seconds = best_time(run, 1)
        steps = int(result.accepted) + int(result.rejected)
        found[model] = 1e3 * float(times[-1]) / seconds, steps, int(result.status)
        said((model, *found[model]))
    return found


def print_table(figures):
    print(f"{jax.devices()[0].platform}, jax {jax.__version__}")
    print("| meridian | method | tolerance | steps or calls | q, um | v, m/s | spin, m/s | seconds | times |")
    print("|---|---|---|---|---|---|---|---|---|")
    for model, method, tolerance, steps, q, v, spin, seconds, ratio in figures["table"]:
        times = "" if ratio is None else f"{ratio:.1f}"
        print(
            f"| {model} | {method} | {tolerance:.0e} | {steps} | {q:.2g} | {v:.2g} | {spin:.2g} | {seconds:.3f} "
            f"| {times} |"
        )
    for model, tolerance, each, failed, ratio in figures["batches"]:
        times = "" if ratio is None else f", {ratio:.1f} times"
        print(f"batch, {model}, tsit5 {tolerance:.0e}: {each:.4f} s a run{times}, {failed} failed")


def print_spectra(found):
    print("Root mean squares in bands of frequency (below 300 Hz, to 1 kHz, to 3 kHz, above)")
    print("| operating point | meridian | steps | v of a ball, m/s | place of the cage, um |")
    print("|---|---|---|---|---|")
    for (name, model), row in found.items():
        if row is None:
            print(f"| {name} | {model} | FAILED | | |")
            continue
        steps, speed, cage = row
        said = (" / ".join(f"{value:.2g}" for value in values) for values in (speed, cage))
        print(f"| {name} | {model} | {steps} | {' | '.join(said)} |")


if __name__ == "__main__":
    if arguments.spectra:
        print_spectra(spectra(arguments.quick))
    elif arguments.scene:
        for meridian, (rate, steps, status) in scene_speed(arguments.quick).items():
            print(f"{meridian}: {rate:.3g} simulated ms to a second, {steps} steps, status {status}")
    else:
        print_table(benchmark(arguments.quick, [arguments.meridian] if arguments.meridian else MODELS))

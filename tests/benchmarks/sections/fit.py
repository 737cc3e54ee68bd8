"""Rheology from traction curves: our optimisers beside scipy's on the same residuals."""

import time

import equinox as eqx
import jax
import numpy as np
import scipy.optimize
from benchmark_report import HERE, load
from benchmark_tools import best_time
from section_shape import Section, Table

import fitting
from fitting.estimation import column_scales, estimate, jacobian
from fitting.search import Search
from jaxbearing.contacts.resolution import PRESETS, Resolution

MARCHES = {
    **{f"{accuracy:g}": PRESETS[accuracy] for accuracy in (1e-2, 1e-3, 1e-4)},
    "1e-6, extrapolated": Resolution(128, 24, True),
}


def section(quick=False):
    script = load(HERE / "rheology_fit.py")
    recovered = float(np.max(np.abs(script.recovery("mobil_jet_ii", PRESETS[1e-2 if quick else 1e-3]))))
    methods = script.methods("mobil_jet_ii")
    rows = [(f"fitting.fit, {name}", *found[:-1]) for name, found in methods.items()]
    alone = [("Levenberg-Marquardt, ours", *our_fit(script))]
    for name, exact in (("finite differences", False), ("our Jacobian", True)):
        alone.append((f"scipy least_squares, {name}", *scipy_fit(script, exact)))
    alone = [(*row, row[1] / alone[0][1]) for row in alone]
    marches = march_rows(script, dict(list(MARCHES.items())[:2]) if quick else MARCHES)
    best = min(row[3] for row in alone)
    return Section(
        "Rheology from traction curves",
        "60 points of two-disk curves of Mobil Jet II with noise, six parameters, started from a modulus and a stress "
        "that are wrong by a factor of 3. `fitting.fit` includes the choice of the start, intervals and all it says of "
        "the fit; the optimisers alone are compared below.",
        (
            Table(
                "Whole fits (loss: half the sum of squared residuals):",
                ("method", "first, s", "warm, s", "steps", "loss"),
                tuple(rows),
            ),
            Table(
                "The optimisers alone, compiled, on the same residuals from the same start:",
                ("method", "seconds", "steps or calls", "loss", "time over ours"),
                tuple(alone),
            ),
            Table(
                "Curves of the finest march, fitted with coarser ones: what the march costs the parameters:",
                ("accuracy of the march", "largest relative error of a parameter", "warm, s"),
                marches,
            ),
        ),
        {
            "noise-free recovery": recovered,
            "error of a march over its accuracy": float(
                np.max([row[1] / float(row[0].split(",")[0]) for row in marches])
            ),
            "largest loss over the least, ours": float(np.max([row[4] for row in rows])) / best - 1.0,
            "times scipy, finite differences": alone[1][4],
            "times scipy, our Jacobian": alone[2][4],
        },
    )


def noisy(script):
    scene, table = script.experiment("mobil_jet_ii")
    rng = np.random.default_rng(script.SEED)
    values = table.traction_coefficient * (1.0 + script.NOISE * rng.normal(size=len(table.slide_to_roll)))
    return script.three_times_wrong(scene), script.dataclasses.replace(table, traction_coefficient=values)


def posed(script):
    """The problem that the optimisers see."""
    start, table = noisy(script)
    search = Search(fitting.Measurements.of(table, start), start, fitting.FitOptions(errors=script.ERRORS))
    problem = search.problem(search.free_by_rule()[0], {})
    return eqx.tree_at(lambda p: p.scales, problem, column_scales(problem, jax.numpy.zeros(6)))


def our_fit(script):
    """Seconds, warm, steps and loss of our Levenberg-Marquardt."""
    problem, run = posed(script), eqx.filter_jit(lambda p: estimate(p, jax.numpy.zeros(6), "levenberg_marquardt"))
    found = run(problem)
    return best_time(lambda: run(problem), 3), int(found.steps), float(found.loss)


def scipy_fit(script, exact):
    """Seconds, warm, calls and loss of scipy's trust-region method on our residuals."""
    problem = posed(script)
    residual = eqx.filter_jit(lambda u: problem.residual(u))
    slopes = eqx.filter_jit(lambda u: jacobian(problem, u))
    call = lambda u: np.asarray(residual(jax.numpy.asarray(u)))
    more = {"jac": lambda u: np.asarray(slopes(jax.numpy.asarray(u)))} if exact else {}
    first = np.zeros(6)
    call(first), slopes(jax.numpy.zeros(6))  # compile
    options = {"method": "trf", "x_scale": "jac", "xtol": 1e-10, "ftol": 1e-10, **more}
    found = scipy.optimize.least_squares(call, first, **options)
    seconds = best_time(lambda: scipy.optimize.least_squares(call, first, **options).cost, 3)
    return seconds, int(found.nfev), float(found.cost)


def march_rows(script, marches):
    scene, table = script.experiment("mobil_jet_ii", PRESETS[1e-6])
    true = np.array([float(getattr(scene.oil.rheology, name)) for name in script.NAMES])
    rows = []
    for name, resolution in marches.items():
        start = script.three_times_wrong(script.experiment("mobil_jet_ii", resolution)[0])
        measurements, options = fitting.Measurements.of(table, start), fitting.FitOptions(errors=script.ERRORS)
        fitting.fit(measurements, start, options)
        begin = time.perf_counter()
        result = fitting.fit(measurements, start, options)
        seconds = time.perf_counter() - begin
        assert result.converged, name
        found = np.array([result.parameters[name].value for name in script.NAMES])
        rows.append((name, float(np.max(np.abs(found / true - 1.0))), seconds))
    return tuple(rows)

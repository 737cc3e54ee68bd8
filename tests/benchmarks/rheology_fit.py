"""Fits of synthetic traction curves: are the parameters found, are the intervals honest, how long does it take?

    python tests/benchmarks/rheology_fit.py [--repetitions 200]

Two experiments with known rheology: Mobil Jet II, isothermal, Ree-Eyring (3 temperatures, 2 pressures, 10 slides), and
Pennzane SHF X2000, thermal, Elsharkawy-Hamrock. (1) Noise-free curves from a start that is 3 times wrong: relative
error of every parameter. (2) Noise of 2 %, many repetitions: how often the 95 % interval holds the true value,
parameter by parameter (seed 20261122, fixed before the first run). (3) Time of one fit by each method, warm, and its
loss.
"""

import argparse
import dataclasses
import time

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

import fitting
import jaxbearing as jb
from fitting.estimation import column_scales, estimate, linearize
from fitting.parameters import NAMES, natural
from fitting.search import Search
from fitting.uncertainty import spread
from jaxbearing.contacts import PRESETS, Resolution
from jaxbearing.machines import TwoDisk

SEED = 20261122
NOISE = 0.02
ERRORS = fitting.Errors(relative=NOISE, floor=2e-5)
"""What the curves are made with is what the fit is told."""
LEVEL = 0.95


@dataclasses.dataclass
class Table:
    """Columns as `fitting.io.CurveTable` has them."""

    slide_to_roll: np.ndarray
    traction_coefficient: np.ndarray
    pressure: np.ndarray
    entrainment_speed: np.ndarray
    temperature: np.ndarray
    curve: np.ndarray
    curve_names: tuple
    load: None = None


def experiment(name: str, march: Resolution = PRESETS[1e-3]) -> tuple[TwoDisk, Table]:
    """Scene with the true oil, and the points of the curves without noise (made and fitted with the same steps)."""
    scene = jb.load_scene(f"two_disk_{name}")
    traction = dataclasses.replace(scene.contact.traction, resolution=march)
    scene = eqx.tree_at(lambda s: s.contact.traction, scene, traction)
    if name == "mobil_jet_ii":
        temperatures, pressures, speed = (297.0, 340.0, 378.0), (1.05e9, 1.5e9), 21.175
        slides = 2.0 * np.geomspace(5e-4, 0.1, 10)
    else:
        temperatures, pressures, speed = (273.0, 313.0, 353.0), (0.6e9, 1.2e9), 3.0
        slides = np.geomspace(1e-3, 0.2, 10)
    grid = np.meshgrid(temperatures, pressures, slides, indexing="ij")
    temperature, pressure, slide = (axis.ravel() for axis in grid)
    curve = np.repeat(np.arange(len(temperatures) * len(pressures)), len(slides))
    speeds = np.full(slide.shape, speed)
    table = Table(slide, slide, pressure, speeds, temperature, curve, tuple(f"{i}" for i in range(curve[-1] + 1)))
    state = scene.state(slide, speed, temperature, pressure=pressure)
    coefficient = eqx.filter_jit(lambda s, st: s.traction(st).rolling / st.load)(scene, state)
    return scene, dataclasses.replace(table, traction_coefficient=np.asarray(coefficient))


def three_times_wrong(scene: TwoDisk) -> TwoDisk:
    """The scene with modulus and stress wrong by a factor of 3 and the coefficients by 20 to 30 %."""
    rheology = scene.oil.rheology
    factors = (3.0, 0.8, 0.7, 1.0 / 3.0, 1.2, 1.3)
    wrong = {name: getattr(rheology, name) * f for name, f in zip(NAMES, factors, strict=True)}
    return eqx.tree_at(lambda s: s.oil.rheology, scene, dataclasses.replace(rheology, **wrong))


def recovery(name: str, march: Resolution = PRESETS[1e-3]) -> np.ndarray:
    """Relative error of each parameter from noise-free curves."""
    scene, table = experiment(name, march)
    start = three_times_wrong(scene)
    result = fitting.fit(fitting.Measurements.of(table, start), start, fitting.FitOptions(errors=ERRORS))
    assert result.converged, result.failure()
    true = np.array([float(getattr(scene.oil.rheology, n)) for n in NAMES])
    return np.array([result.parameters[n].value for n in NAMES]) / true - 1.0


def coverage(name: str, repetitions: int, march: Resolution = PRESETS[1e-3]) -> tuple[np.ndarray, int]:
    """Part of the repetitions whose interval holds the true value, by parameter; and how many did not converge."""
    scene, table = experiment(name, march)
    rng = np.random.default_rng(SEED)
    noise = rng.normal(size=(repetitions, len(table.slide_to_roll)))
    clean = table.traction_coefficient
    noisy = clean + noise * np.sqrt(np.square(NOISE * clean) + ERRORS.floor**2)
    start = three_times_wrong(scene)
    options = fitting.FitOptions(errors=ERRORS)
    search = Search(fitting.Measurements.of(table, start), start, options)
    free, _ = search.free_by_rule()
    problem = search.problem(free, {})
    filled = lambda rows: jnp.stack([search.fill(row) for row in rows])
    data = filled(noisy), filled([ERRORS.deviation(row, table.curve) for row in noisy])

    def one(data):
        own = eqx.tree_at(lambda p: (p.measured, p.deviation), problem, data)
        u = jnp.zeros(len(NAMES))
        own = eqx.tree_at(lambda p: p.scales, own, column_scales(own, u))
        found = estimate(own, u, "levenberg_marquardt")
        return own.natural(found.u), found.converged, *linearize(own, found.u)[1:]

    run = eqx.filter_jit(lambda data: jax.lax.map(one, data, batch_size=10))
    coordinates, converged, residual, jacobian = (np.asarray(part) for part in run(data))
    true, inside = natural(scene.oil.rheology), []
    for at, left, slopes in zip(coordinates, residual, jacobian, strict=True):
        # the points with which the batch is filled up have no weight
        variance = float(np.sum(np.square(left))) / (search.count - np.sum(free))
        known = spread(slopes[: search.count], free, variance, LEVEL)
        inside.append(np.abs(at - true) <= known.quantile * np.sqrt(np.diag(known.covariance)))
    return np.mean(np.array(inside)[converged], axis=0), int(np.sum(~converged))


def methods(name: str) -> dict:
    """Seconds (warm), steps and loss of one fit of 60 points by each method."""
    scene, table = experiment(name)
    rng = np.random.default_rng(SEED)
    noisy = table.traction_coefficient * (1.0 + NOISE * rng.normal(size=len(table.slide_to_roll)))
    start = three_times_wrong(scene)
    measurements = fitting.Measurements.of(dataclasses.replace(table, traction_coefficient=noisy), start)
    rows = {}
    for method in ("levenberg_marquardt", "bfgs", "gradient_descent"):
        options = fitting.FitOptions(method=method, errors=ERRORS)
        cold = time.perf_counter()
        fitting.fit(measurements, start, options)
        warm = time.perf_counter()
        result = fitting.fit(measurements, start, options)
        rows[method] = (warm - cold, time.perf_counter() - warm, result.steps, result.loss, result.converged)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repetitions", type=int, default=200)
    arguments = parser.parse_args()
    print(f"jax {jax.__version__}, {jax.devices()[0].device_kind}, float64")
    by_name = lambda values: ", ".join(f"{name} {value}" for name, value in zip(NAMES, values, strict=True))
    for name in ("mobil_jet_ii", "pennzane"):
        print(f"\n{name}")
        print("  noise-free, relative error:", by_name(f"{error:.1e}" for error in recovery(name)))
        began = time.perf_counter()
        inside, failed = coverage(name, arguments.repetitions)
        took = time.perf_counter() - began
        print(f"  {arguments.repetitions} repetitions, {100 * NOISE:g} % noise, {took:.0f} s, {failed} not converged;")
        print("  true value in the 95 % interval:", by_name(f"{100 * part:.1f} %" for part in inside))
        for method, (cold, warm, steps, loss, converged) in methods(name).items():
            end = "" if converged else ", not converged"
            print(f"  {method:20s} first {cold:5.1f} s, again {warm:6.2f} s, {steps} steps, loss {loss:.10g}{end}")


if __name__ == "__main__":
    main()

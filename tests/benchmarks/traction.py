"""Speed AND error of the traction law under the Hertz pressure, beside scipy's Radau on the same equations.

    python tests/benchmarks/traction.py [--quick]

Isothermal point contacts, Mobil Jet II, Ree-Eyring: the nine cases of our model sheet (Deborah number 0.09 to 30). An
error is the largest relative error of the friction coefficient over these cases, against a march that is finer by far;
Radau at its tightest tolerance has to agree with it. Times are the best of several warm calls, for one evaluation, on
random contacts. The rival integrates stress and force strip by strip, with the same Gauss points, its own numpy right
hand side and its exact Jacobian, one contact at a time; its fastest setting that meets an error stands beside our
fastest. Full run: also the accuracy of the presets over random contacts, all four viscous functions, line and point.
"""

import argparse
import itertools
import os
import platform
import sys
import time
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--quick", action="store_true", help="batches of 1 and 1000, fewer settings, no random contacts")
arguments = parser.parse_args() if __name__ == "__main__" else parser.parse_args(["--quick"])

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import equinox as eqx  # noqa: E402
import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
import numpy as np  # noqa: E402
from reference_oils import mobil_jet_ii, pennzane_x2000  # noqa: E402
from scipy.integrate import solve_ivp  # noqa: E402

from jaxbearing.contacts import (  # noqa: E402
    PRESETS,
    BairWiner,
    ContactPatch,
    DistributedTraction,
    ElsharkawyHamrock,
    GecimWiner,
    ReeEyring,
    Resolution,
    Sliding,
    deborah_number,
)

MOBIL, PENNZANE = mobil_jet_ii(), pennzane_x2000()
CASES = np.asarray(
    [(1.05e9, 2.92857378e-4, 4.06495709e-7, 21.175, 42.35 * s, 373.0) for s in (0.001, 0.005, 0.02, 0.1)]
    + [(1.5e9, 4.18367682e-4, 3.86886906e-7, 21.175, 42.35 * s, 373.0) for s in (0.001, 0.005, 0.02, 0.1)]
    + [(1.5e9, 4.18367682e-4, 2.42915322e-6, 21.175, 42.35 * 0.002, 297.0)]
)
"""Hertz pressure, half-width (of a circle), film, mean speed, sliding speed, temperature."""
TARGETS = (1e-2, 1e-3, 1e-4, 1e-6)
BATCH = 250
"""Contacts that go through the march together: their fields stay in the cache."""
LAWS = (ReeEyring(), BairWiner(), GecimWiner(), ElsharkawyHamrock(jnp.asarray(2.0)))


def coefficient(resolution, row):
    law = DistributedTraction(ReeEyring(), resolution)
    patch = ContactPatch(row[0], row[1], row[1])
    return law.traction(patch, row[2], row[3], Sliding(row[4]), row[5], MOBIL).rolling / patch.load


def with_slope(resolution, row):
    """Value and derivative with respect to the sliding speed."""
    return jax.jvp(lambda x: coefficient(resolution, row.at[4].set(x)), (row[4],), (jnp.ones_like(row[4]),))


def contacts(n, seed=0):
    rng = np.random.default_rng(seed)
    log = lambda low, high: np.exp(rng.uniform(np.log(low), np.log(high), n))
    columns = (rng.uniform(0.8e9, 2e9, n), log(1e-4, 5e-4), log(1e-7, 1e-6), log(1.0, 50.0), log(1e-3, 3.0))
    return jnp.asarray(np.stack([*columns, rng.uniform(300.0, 400.0, n)], axis=1))


def batched(function, resolution, batch_size=BATCH):
    return jax.jit(lambda rows: jax.lax.map(lambda row: function(resolution, row), rows, batch_size=batch_size))


def best_time(function, budget):
    """Seconds of the fastest of several calls, as many as fit into `budget` seconds, three at least."""
    times = []
    while len(times) < 3 or (sum(times) < budget and len(times) < 50):
        start = time.perf_counter()
        jax.block_until_ready(function())
        times.append(time.perf_counter() - start)
    return min(times)


# -- the rival


def oil_of(pressure, temperature):
    """Viscosity, shear modulus, Eyring stress of Mobil Jet II, line by line from the source's tables 5 and 8."""
    y = (temperature - 165.75 - 171.96 * np.log(1 + 0.4294e-9 * pressure)) * (
        1 - 0.1961 * np.log(1 + 17.434e-9 * pressure)
    )
    inverse = 1 / temperature - 1 / 300
    modulus = 4.82e4 * np.exp(6.11e-9 * pressure + 2450 * inverse)
    return 10 ** (12 - 16.342 * y / (29.406 + y)), modulus, 1.56e5 * np.exp(2.41e-9 * pressure - 786 * inverse)


def radau_strip(pressure, half_width, film, speed, sliding, temperature, tolerance):
    """Integral of the stress over one strip, N/m: unknowns stress/MPa and integral."""

    def slopes(theta, state):
        sine = np.sin(theta)
        viscosity, modulus, stress = oil_of(pressure * sine, temperature)
        rate = sliding / film - stress / viscosity * np.sinh(1e6 * state[0] / stress)
        return np.array([1e-6 * modulus * half_width * sine / speed * rate, state[0] * sine])

    def jacobian(theta, state):
        sine = np.sin(theta)
        viscosity, modulus, stress = oil_of(pressure * sine, temperature)
        relaxation = modulus * half_width * sine / (speed * viscosity) * np.cosh(1e6 * state[0] / stress)
        return np.array([[-relaxation, 0.0], [sine, 0.0]])

    with np.errstate(over="ignore", invalid="ignore"):  # sinh in a trial step, which Radau takes back
        tolerances = {"rtol": tolerance, "atol": 1e-3 * tolerance}
        found = solve_ivp(slopes, (0.0, np.pi), [0.0, 0.0], method="Radau", jac=jacobian, **tolerances)
    assert found.success
    return 1e6 * half_width * found.y[1, -1]


def radau(row, strips, tolerance):
    """Friction coefficient of one contact."""
    pressure, half_width, *rest = row
    nodes, weights = np.polynomial.legendre.leggauss(strips)
    force = 0.0
    for node, weight in zip(nodes[nodes > 0], weights[nodes > 0], strict=True):
        cosine = np.cos(0.5 * np.pi * node)
        strip = radau_strip(pressure * cosine, half_width * cosine, *rest, tolerance)
        force += np.pi * weight * half_width * cosine * strip
    return force / (2 / 3 * np.pi * half_width**2 * pressure)


def radau_rows(settings, exact, repeats):
    """(strips, tolerance) -> error, seconds an evaluation."""
    rows = {}
    for strips, tolerance in settings:
        seconds, found = np.inf, None
        for _ in range(repeats):
            start = time.perf_counter()
            found = np.asarray([radau(row, strips, tolerance) for row in CASES])
            seconds = min(seconds, (time.perf_counter() - start) / len(CASES))
        rows[strips, tolerance] = (float(np.max(np.abs(found / exact - 1))), seconds)
    return rows


# -- ours


def our_rows(resolutions, exact, sizes, budget):
    """Batches that would take longer than three times the budget, seconds, are left out."""
    rows = {}
    for resolution in resolutions:
        one = jax.jit(lambda row, r=resolution: coefficient(r, row))
        start = time.perf_counter()
        one.lower(jnp.asarray(CASES[0])).compile()
        row = {"compile": time.perf_counter() - start, "seconds": {}, "slope": {}}
        found = batched(coefficient, resolution, len(CASES))(jnp.asarray(CASES))
        row["error"] = float(np.max(np.abs(found / exact - 1)))
        for size in sizes:
            inputs = contacts(size)
            if row["seconds"] and size * min(row["seconds"].values()) > 3 * budget:
                continue
            for name, function in (("seconds", coefficient), ("slope", with_slope)):
                run = batched(function, resolution, min(BATCH, size)).lower(inputs).compile()
                row[name][size] = best_time(lambda run=run, inputs=inputs: run(inputs), budget) / size
        rows[resolution] = row
    return rows


def cheapest(rows, target, error, cost):
    met = [key for key in rows if error(rows[key]) <= target]
    return min(met, key=lambda key: cost(rows[key])) if met else None


# -- accuracy of the presets


def random_contacts(oil, line, n, seed):
    """n contacts with Deborah numbers spread evenly over ln D from 1e-2 to 3e2; slide ratio 1e-4 to 1."""
    rng = np.random.default_rng(seed)
    log = lambda low, high: np.exp(rng.uniform(np.log(low), np.log(high), 40_000))
    columns = (rng.uniform(0.7e9, 2.2e9, 40_000), log(5e-5, 5e-4), log(5e-5, 5e-3), log(1e-7, 1.5e-6), log(0.5, 50.0))
    rows = np.stack([*columns, rng.uniform(260.0, 430.0, 40_000), log(1e-4, 1.0)], axis=1)
    patch = ContactPatch(*(jnp.asarray(rows[:, i]) for i in range(3)), line=line)
    deborah = np.asarray(deborah_number(patch, jnp.asarray(rows[:, 4]), jnp.asarray(rows[:, 5]), oil))
    edges = itertools.pairwise(np.geomspace(1e-2, 3e2, 11))
    bins = [np.flatnonzero((deborah >= low) & (deborah < high))[: n // 10] for low, high in edges]
    return jnp.asarray(rows[np.concatenate(bins)])


@eqx.filter_jit
def forces(law, oil, line, rows):
    def one(row):
        patch = ContactPatch(row[0], row[1], row[2], line=line)
        return law.traction(patch, row[3], row[4], Sliding(row[4] * row[6]), row[5], oil).rolling

    return jax.lax.map(one, rows, batch_size=100)


def preset_rows(n):
    """(accuracy, kind of contact, viscous function) -> 95 % quantile and largest relative error of the force."""
    table = {}
    for line in (True, False):
        for seed, viscous in enumerate(LAWS):
            oils = (MOBIL, PENNZANE) if isinstance(viscous, ReeEyring) else (PENNZANE,)
            errors = {accuracy: [] for accuracy in PRESETS}
            for oil in oils:
                rows = random_contacts(oil, line, n // len(oils), seed)
                run = lambda r, v=viscous, o=oil, x=rows, flat=line: forces(DistributedTraction(v, r), o, flat, x)
                exact = run(Resolution(8192, 1, True) if line else Resolution(3072, 256, True))
                for accuracy, resolution in PRESETS.items():
                    errors[accuracy].append(np.abs(np.asarray(run(resolution) / exact) - 1))
            for accuracy, found in errors.items():
                found = np.concatenate(found)
                key = (accuracy, "line" if line else "point", viscous.name)
                table[key] = (float(np.quantile(found, 0.95)), float(np.max(found)))
    return table


def benchmark(quick):
    """Every figure of the tables."""
    steps, strips = ((16, 32, 64), (16,)) if quick else ((16, 32, 64, 128, 256), (8, 16, 24))
    resolutions = [Resolution(n, m, extrapolate) for extrapolate in (False, True) for m in strips for n in steps]
    resolutions += [Resolution(192, 24, True)]
    resolutions += [preset for preset in PRESETS.values() if preset not in resolutions]
    exact = np.asarray(batched(coefficient, Resolution(2048, 64, True), len(CASES))(jnp.asarray(CASES)))
    tight = radau_rows([(32, 1e-9)], exact, 1)[32, 1e-9][0]
    tolerances = (1e-2, 1e-3, 1e-5) if quick else (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
    settings = [(m, tolerance) for m in ((8, 16) if quick else (8, 12, 16, 24)) for tolerance in tolerances]
    return {
        "ours": our_rows(resolutions, exact, *(((1, 1000), 0.2) if quick else ((1, 1000, 100_000), 2.0))),
        "radau": radau_rows(settings, exact, 1 if quick else 3),
        "radau_tight": tight,
        "presets": {} if quick else preset_rows(100),
    }


def print_table(figures):
    machine = f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores"
    print(f"jax {jax.__version__}, {jax.devices()[0].device_kind}, {machine}, float64, {time.strftime('%Y-%m-%d')}")
    print(f"reference against Radau, 32 strips, tolerance 1e-9: {figures['radau_tight']:.1e}")
    sizes = sorted({size for row in figures["ours"].values() for size in row["seconds"]})
    print("\nsteps strips extrapolate | error   | us an evaluation (and with its slope) in a batch of | compile s")
    print("                         |         | " + " ".join(f"{size:>17,d}" for size in sizes))
    for (steps, strips, extrapolate), row in figures["ours"].items():
        of = lambda size, row=row: f"{1e6 * row['seconds'][size]:8.1f} ({1e6 * row['slope'][size]:6.1f})"
        times = " ".join(of(size) if size in row["seconds"] else " " * 17 for size in sizes)
        label = f"{steps:5d} {strips:6d} {'yes' if extrapolate else '':11s}"
        print(f"{label} | {row['error']:.1e} | {times}  | {row['compile']:.2f}")
    print("\nRadau: strips tolerance | error   | us an evaluation")
    for (strips, tolerance), (error, seconds) in figures["radau"].items():
        print(f"{strips:13d} {tolerance:9.0e} | {error:.1e} | {1e6 * seconds:.0f}")
    print(
        "\nat an error of | ours (steps, strips, extrapolate) | us in its largest batch | Radau us | ratio | batch of 1"
    )
    for target in TARGETS:
        fastest = lambda row: row["seconds"][max(row["seconds"])]
        mine = cheapest(figures["ours"], target, lambda row: row["error"], fastest)
        single = cheapest(figures["ours"], target, lambda row: row["error"], lambda row: row["seconds"][1])
        rival = cheapest(figures["radau"], target, lambda row: row[0], lambda row: row[1])
        if mine is None or single is None or rival is None:
            continue
        our, its = fastest(figures["ours"][mine]), figures["radau"][rival][1]
        ratios = f"{its / our:5.0f} | {its / figures['ours'][single]['seconds'][1]:.0f}"
        print(f"{target:14.0e} | {tuple(mine)!s:33s} | {1e6 * our:23.1f} | {1e6 * its:8.0f} | {ratios}")
    if figures["presets"]:
        print("\npreset | resolution          | contact | viscous function   | 95 % of errors below | largest")
    for (accuracy, kind, viscous), (usual, largest) in sorted(figures["presets"].items(), reverse=True):
        preset = str(tuple(PRESETS[accuracy]))
        print(f"{accuracy:6.0e} | {preset:19s} | {kind:7s} | {viscous:18s} | {usual:20.1e} | {largest:.1e}")


if __name__ == "__main__":
    print_table(benchmark(arguments.quick))

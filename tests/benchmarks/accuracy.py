"""Every accuracy setting of the package over its whole range: what it promises and what was measured.

    python tests/benchmarks/accuracy.py [--quick] [--only SECTION ...]

Prints the tables of docs/accuracy.md. The traction without spin is `traction.py`'s table, whole bearings are those of
`march_accuracy.py`, and shocks in time those of `cage_dynamics.py`: what stands there is not measured again.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from line_contacts import by_moes, satellite
from reference_oils import mobil_jet_ii, nye_186a, pennzane_x2000

import jaxbearing as jb
from jaxbearing.contacts import (
    PRESETS,
    SPIN_PRESETS,
    AbstractViscousFunction,
    ContactPatch,
    DistributedTraction,
    ElsharkawyHamrock,
    LogarithmicProfile,
    ReeEyring,
    Resolution,
    SlicedLine,
    Sliding,
)
from jaxbearing.ehl import FilmSimulation
from jaxbearing.ehl.resolution import chosen, cut_error, mesh_error
from jaxbearing.ehl.solution import solve_line_contact
from jaxbearing.lubricants import Lubricant
from jaxbearing.numerics.quadrature import gauss_legendre
from jaxbearing.scenes.line_contact.schema import ACCURACIES
from jaxbearing.time_laws import LinearRamp

Rows = Iterator[tuple[str, ...]]
SPIN_REFERENCE = Resolution(256, 384, extrapolate=True)
SPIN_BATCH = 8
MOES = ((20.0, 10.0), (100.0, 2.5), (100.0, 10.0), (200.0, 10.0), (200.0, 25.0), (500.0, 10.0), (1000.0, 10.0))
"""Moes' M and L of the heavy line contacts."""
LIGHT = ((3.2, 2.5), (3.2, 10.0), (8.0, 2.5), (8.0, 10.0), (25.0, 2.5), (25.0, 10.0))
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5)


def spinning(count: int, seed: int = 3) -> jax.Array:
    """The first of 40 ellipses whose sliding along rolling changes sign inside or near them: Hertz pressure, semi-axes,
    film, speed, temperature, sliding along and across, spin."""
    rng, n = np.random.default_rng(seed), 40
    log = lambda low, high: np.exp(rng.uniform(np.log(low), np.log(high), n))
    pressure, along = rng.uniform(0.7e9, 2.2e9, n), log(1e-4, 5e-4)
    across, film, speed = along * log(1.0, 12.0), log(1e-7, 1e-6), log(1.0, 60.0)
    temperature, slide = rng.uniform(300.0, 400.0, n), log(1e-4, 0.03) * speed
    pole = rng.uniform(0.0, 1.5, n) * across
    spin = slide / np.maximum(pole, 0.2 * across)
    forward = spin * pole * np.where(rng.random(n) < 0.5, 1, -1)
    side = log(1e-2, 1.0) * slide * np.where(rng.random(n) < 0.5, 0, 1)
    return jnp.asarray(
        np.stack([pressure, along, across, film, speed, temperature, forward, side, spin], axis=1)[:count]
    )


@eqx.filter_jit
def _spun(law: DistributedTraction, oil: Lubricant, rows: jax.Array) -> jax.Array:
    def one(row):
        patch, sliding = ContactPatch(row[0], row[1], row[2]), Sliding(row[6], row[7], row[8])
        found = law.traction(patch, row[3], row[4], sliding, row[5], oil)
        return jnp.stack([found.rolling, found.transverse, found.moment, found.power])

    return jax.lax.map(one, rows, batch_size=SPIN_BATCH)


def spin_errors(
    viscous: AbstractViscousFunction, oil: Lubricant, resolutions: Any, n: int, reference: Resolution = SPIN_REFERENCE
) -> dict[Resolution, np.ndarray]:
    """Errors of force (over the larger one of force and moment/sqrt(ac)), moment and power, shape (3, n)."""
    rows = spinning(n)
    values = lambda r: np.asarray(_spun(DistributedTraction(viscous, r), oil, rows)).T
    exact = values(reference)
    size = np.maximum(np.hypot(*exact[:2]), np.abs(exact[2]) / np.sqrt(np.asarray(rows[:, 1] * rows[:, 2])))
    errors = {}
    for resolution in resolutions:
        found = values(resolution)
        force = np.hypot(*(found[:2] - exact[:2])) / size
        errors[resolution] = np.stack([force, *np.abs(found[2:] / exact[2:] - 1.0)])
    return errors


def spin_rows(quick: bool) -> Rows:
    yield ("accuracy", "steps, strips", "function", "force, 95 % and all", "moment", "power")
    presets = {"none with spin": PRESETS[1e-3]} | {f"{key:g}": value for key, value in SPIN_PRESETS.items()}
    if quick:
        presets = {key: presets[key] for key in ("none with spin", "0.01", "0.001")}
    for viscous, oil in ((ReeEyring(), mobil_jet_ii()), (ElsharkawyHamrock(2.0), pennzane_x2000())):
        errors = spin_errors(viscous, oil, presets.values(), 8 if quick else 40)
        for name, resolution in presets.items():
            numbers = [f"{np.quantile(row, 0.95):.1e}, {np.max(row):.1e}" for row in errors[resolution]]
            yield (name, f"{resolution.steps}, {resolution.strips}", viscous.name, *numbers)


@eqx.filter_jit
def _films(scene: Any) -> jax.Array:
    found = solve_line_contact(scene).film
    return jnp.stack([found.central, found.minimum])


def films(m: float, el: float, nodes: int, inlet: float = 4.0) -> np.ndarray:
    """Central and minimum film, m, of a contact with these Moes numbers."""
    return np.asarray(_films(by_moes(m, el, nodes, inlet)[0]))


def extrapolated(m: float, el: float, nodes: int, inlet: float = 4.0) -> np.ndarray:
    """Richardson's of meshes with this number of nodes and about half of it."""
    fine, coarse = films(m, el, nodes, inlet), films(m, el, (nodes + 1) // 2, inlet)
    return fine + (fine - coarse) / 3.0


def line_rows(quick: bool) -> Rows:
    sizes = (101, 201) if quick else (201, 401, 801, 1601)
    asked = " ".join(f"{accuracy:g}" for accuracy in ACCURACIES)
    yield ("M", "L", "x", f"nodes for {asked}", *(f"{n} nodes: worse film, % (estimate)" for n in sizes))
    for m, el in MOES[: 2 if quick else None]:
        scene, _ = by_moes(m, el)
        scales = scene.scales()
        ratio, material = float(scene.film_ratio(scales)), float(scales.moes_material)
        nodes = " ".join(str(chosen(one, n, ratio, material, None)[0]) for one, n in ACCURACIES.items())
        exact = extrapolated(m, el, 401 if quick else 1601)
        error = lambda n, m=m, el=el, exact=exact: 100.0 * np.max(np.abs(films(m, el, n) / exact - 1.0))
        estimate = lambda n, ratio=ratio, material=material: 100.0 * mesh_error(n, ratio, material)
        yield (f"{m:g}", f"{el:g}", f"{ratio:.1f}", nodes, *(f"{error(n):.2f} ({estimate(n):.2f})" for n in sizes))


def inlet_rows(quick: bool) -> Rows:
    inlets, longest = ((4.0,), 16.0) if quick else ((4.0, 6.0, 8.0, 12.0, 16.0), 32.0)
    yield ("M", "L", "x", *(f"inlet {inlet:g}: worse film, % (estimate)" for inlet in inlets))
    for m, el in LIGHT[: 1 if quick else None]:
        scene, _ = by_moes(m, el)
        ratio = float(scene.film_ratio(scene.scales()))
        exact = extrapolated(m, el, 301, longest)
        error = lambda inlet, m=m, el=el, exact=exact: (
            100.0 * np.max(np.abs(extrapolated(m, el, 301, inlet) / exact - 1.0))
        )
        estimate = lambda inlet, ratio=ratio: 100.0 * float(cut_error(inlet, ratio))
        yield (f"{m:g}", f"{el:g}", f"{ratio:.1f}", *(f"{error(one):.2f} ({estimate(one):.2f})" for one in inlets))


def stop_rows(quick: bool) -> Rows:
    """Of `simulation.tolerance` of a line contact: the film after a stop at once and along a ramp of 8 ms."""
    yield ("simulation.tolerance", "steps", "central film, ppm", "minimum film, ppm")
    laws = (LinearRamp(1.0, 0.0, 8e-3),) if quick else (LinearRamp(1.0, 0.0, 8e-3), LinearRamp(1.0, 0.0, 0.0))
    times, scene = np.linspace(0.5e-3, 8e-3, 16), satellite(1, 101)

    def runs(tolerance):
        chosen_ = [FilmSimulation(speed=law, tolerance=tolerance) for law in laws]
        found = [jb.simulate(scene, 8e-3, simulation=one) for one in chosen_]
        read = lambda h, name: np.interp(times, np.asarray(h.time), np.asarray(getattr(h.film, name)))
        steps = sum(int(h.accepted) for h in found)
        return steps, np.stack([[read(h, name) for h in found] for name in ("central", "minimum")])

    _, exact = runs(1e-7)
    for tolerance in TOLERANCES[: 2 if quick else None]:
        steps, values = runs(tolerance)
        error = np.max(np.abs(values / exact - 1.0), axis=(1, 2))
        yield (f"{tolerance:g}", str(steps), *(f"{1e6 * one:.0f}" for one in error))


def lamina_rows(quick: bool) -> Rows:
    """Of `rating.n_laminae`: load of a roller with a logarithmic profile, by the part of its length that touches."""
    length, stiffness = 0.012, 1e9
    profile = LogarithmicProfile(jnp.asarray(5e-6))
    line_load = eqx.filter_jit(lambda line, f, g: line.load_and_moment(f, g)[0])
    load = lambda count, *case: float(line_load(SlicedLine(stiffness, length, profile, count), *map(jnp.asarray, case)))
    cases = ((3e-5, 0.0), (-1.6e-5, 2e-5 / length))
    places = np.linspace(-1.0, 1.0, 20_001)
    approach = lambda f, g: f + g * length * 0.5 * (1.0 + places) - np.asarray(profile.drop_at(jnp.asarray(places)))
    yield ("laminae", *(f"{np.mean(approach(*case) > 0):.0%} touches" for case in cases))
    exact = [load(20_000, *case) for case in cases]
    for count in (10, 30, 100) if quick else (5, 10, 20, 30, 50, 100, 200):
        yield (
            str(count),
            *(f"{abs(load(count, *case) / one - 1):.1e}" for case, one in zip(cases, exact, strict=True)),
        )


def alpha_rows(quick: bool) -> Rows:
    """Of the fixed quadrature of the pressure-viscosity coefficient: against one with eight times the nodes."""
    from jaxbearing.lubricants import pressure_viscosity

    yield ("nodes of alpha*", "-20 to 150 degC, three oils")
    temperature = jnp.linspace(253.0, 423.0, 5 if quick else 35)

    def values(nodes):
        kept, pressure_viscosity.NODES = pressure_viscosity.NODES, nodes
        try:
            laws = [oil.pressure_viscosity for oil in (pennzane_x2000(), nye_186a())]
            laws += [pressure_viscosity.IntegratedPressureViscosity(mobil_jet_ii().viscosity)]
            return np.stack([np.asarray(law.coefficient(temperature)) for law in laws])
        finally:
            pressure_viscosity.NODES = kept

    exact = values(8 * pressure_viscosity.NODES)
    for nodes in (8, 16, pressure_viscosity.NODES):
        assert gauss_legendre(nodes)[0].size == nodes
        yield (str(nodes), f"{np.max(np.abs(values(nodes) / exact - 1)):.1e}")


SECTIONS = {
    "spin": ("contact.traction_accuracy of contacts that spin", spin_rows),
    "line": ("contact.accuracy and contact.nodes of line contacts, heavy loads", line_rows),
    "inlet": ("contact.inlet of line contacts, light loads", inlet_rows),
    "stop": ("simulation.tolerance of line contacts", stop_rows),
    "laminae": ("rating.n_laminae, profile.n_laminae", lamina_rows),
    "alpha": ("quadrature of the pressure-viscosity coefficient (no setting)", alpha_rows),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="fewer and coarser rows")
    parser.add_argument("--only", nargs="+", choices=SECTIONS, default=list(SECTIONS))
    given = parser.parse_args()
    for name in given.only:
        title, rows = SECTIONS[name]
        print(f"\n{title}", flush=True)
        for row in rows(given.quick):
            print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()

"""A shaft on several dry bearings: time and error, growth with the number of bearings, scipy on the same equations."""

import time

import jax
import jax.numpy as jnp
import numpy as np
import scipy.optimize
from benchmark_tools import best_time
from section_shape import Section, Table
from shaft_cases import DEEP_GROOVE, RPM, balls, rollers, steel

import jaxbearing as jb
from jaxbearing.numerics.precision import as_float
from jaxbearing.shafts import MatchedSet, MountedBearing, PointLoad, Preload, Shaft, ShaftSystem
from jaxbearing.shafts import Section as Cylinder
from jaxbearing.shafts.balance import axis_of, build_balance
from jaxbearing.shafts.batches import batches_of
from jaxbearing.shafts.preload import mount
from jaxbearing.shafts.search import Problem, minimise, ports

COUNTS = (2, 3, 4, 5, 6, 7, 8)
POINTS = 6
"""Loads, at factors about the scene's, over which a time is averaged and an error is the largest."""
TIGHT = jb.NewtonOptions(residual_tolerance=1e-12)
SOLVED = 1e-8
"""Scaled residual at which scipy counts as having solved."""


def section(quick=False):
    counts = COUNTS[:2] if quick else COUNTS
    four = [("pair preloaded by force, rollers, deep groove", *timed(of_three_kinds()))]
    growth = [(n, *timed(in_line(n))) for n in counts]
    size, taken = np.log([row[:2] for row in growth]).T
    exponent = float(np.polyfit(size, taken, 1)[0])
    rows = scipy_rows(of_three_kinds(), four[0][1], 2 if quick else POINTS)
    columns = ("ms a solve", "error", "steps, mean: minimum", "Newton", "compile, s", "failed")
    return Section(
        "Shafts on dry bearings",
        "Errors are the largest relative ones of the forces of the bearings, against solves to 1e-12.",
        (
            Table("Four bearings at 6000 rpm:", ("bearings", *columns), tuple(four)),
            Table(
                f"Deep groove bearings in a row, a load in every span; time grows with the power {exponent:.2f}:",
                ("bearings", *columns),
                tuple(growth),
            ),
            Table(
                "scipy `root` (hybr, as `fsolve`) on the same equations, those of the four bearings. Each residual is "
                "one solution of all bearings under held rings, compiled:",
                ("derivatives", "start", "ms an attempt", "solved", "error", "times our solve"),
                rows,
            ),
        ),
        {
            "ms a solve, four bearings": four[0][1],
            "error, four bearings": four[0][2],
            "exponent over bearings": exponent,
            "times scipy, our Jacobian, from our minimum": next(
                row[-1] for row in rows if row[:2] == ("our Jacobian", "our minimum")
            ),
            "failed": float(sum(row[-1] for row in (*four, *growth))),
        },
    )


def loaded(sections, bearings, sets=(), forces=()):
    return ShaftSystem(Shaft(6000.0 * RPM, sections, steel(206e9)), bearings, sets, forces)


def of_three_kinds():
    """A pair of angular contact bearings, a roller bearing and a deep groove bearing with clearance."""
    angular = balls(13, 53.5e-3, 11.112e-3, 0.515, 0.525, np.radians(40.0))
    pair = MatchedSet("pair", "<>", angular, 0.05, 17e-3, Preload(force=200.0))
    middle = MountedBearing("middle", rollers(13, 54e-3, 10e-3, 10e-3, 25e-6), 0.18)
    return loaded(
        [Cylinder(0.15, 0.03), Cylinder(0.2, 0.035)],
        [middle, MountedBearing("end", DEEP_GROOVE, 0.32)],
        [pair],
        [PointLoad("load", 0.1, axial=300.0, radial=2e3, tangential=800.0, radius=0.04)],
    )


def in_line(count):
    """So many deep groove bearings, 100 mm apart."""
    bearings = [MountedBearing(f"b{place}", DEEP_GROOVE, 0.02 + 0.1 * place) for place in range(count)]
    forces = [
        PointLoad(f"f{place}", 0.07 + 0.1 * place, axial=40.0, radial=1000.0, azimuth=0.3 * place)
        for place in range(count - 1)
    ]
    return loaded([Cylinder(0.1 * (count - 1) + 0.04, 0.03)], bearings, (), forces)


def at(system, factor):
    """The scene with other loads."""
    changes = {}
    for force in system.forces:
        changes |= {f"force.{force.name}.{name}": factor * getattr(force, name) for name in ("axial", "radial")}
    return system.replace(changes)


def forces_of(system, solution):
    """Of the bearings in the order of the equations: JAX sorts dictionaries that it returns."""
    return jnp.stack([solution.bearings[place.name].on_shaft for place in system.places])


def error_of(found, exact):
    """Relative to the largest force."""
    return float(np.max(np.abs(np.asarray(found) - np.asarray(exact))) / np.max(np.abs(np.asarray(exact))))


def factors(points=POINTS):
    return jnp.linspace(0.7, 1.4, points)


def timed(system):
    """ms a solve, error, mean steps of both stages, seconds to compile, failed."""
    system = jax.tree.map(as_float, system)

    def solved(options):
        def one(factor):
            found = jb.solve(at(system, factor), throw=False, options=options)
            return forces_of(system, found), found.status, found.start_steps, found.newton_steps

        return jax.jit(one)

    begin = time.perf_counter()
    run = solved(jb.NewtonOptions()).lower(factors()[0]).compile()
    compiled = time.perf_counter() - begin
    exact = solved(TIGHT)
    found = [(run(factor), exact(factor)) for factor in factors()]
    error = max(error_of(ours[0], tight[0]) for ours, tight in found)
    seconds = float(np.mean([best_time(lambda factor=factor: run(factor), 5) for factor in factors()]))
    start, newton = (float(np.mean([ours[place] for ours, _ in found])) for place in (2, 3))
    return 1e3 * seconds, error, start, newton, compiled, int(sum(int(ours[1]) != 0 for ours, _ in found))


def posed(system):
    """The equations of a shaft, as `jb.solve` makes them."""
    places = system.places
    position = jnp.stack([jnp.asarray(place.position, dtype=float) for place in places])
    batches = batches_of(places, jnp.asarray(system.shaft.speed))
    mounted = mount(system, places, batches)
    expansion = jnp.stack([jnp.asarray(place.expansion, dtype=float) for place in places])
    balance = build_balance(system, places, axis_of(system), position, mounted.closure, mounted.springs)
    return Problem(balance, batches, expansion)


def scipy_rows(system, own, points):
    """**Arguments:** `own`: ms of our solve."""
    system = jax.tree.map(as_float, system)
    exact = jax.jit(lambda factor: forces_of(system, jb.solve(at(system, factor), throw=False, options=TIGHT)))

    @jax.jit
    def prepared(factor):
        problem = posed(at(system, factor))
        start = minimise(problem)
        return problem, start.unknowns / problem.balance.column_units(), start.scale

    @jax.jit
    def residual(problem, scale, x):
        """In units of the loads, with the exact derivatives."""
        balance = problem.balance
        rows, columns = balance.row_units() / scale, balance.column_units()
        force, stiffness, _ = ports(problem, balance.displacements(columns * x), jb.NewtonOptions())
        coupled = jnp.einsum("bij,bjz->biz", stiffness, balance.attach.reshape(balance.count, 5, -1))
        slope = balance.linear + balance.left @ coupled.reshape(5 * balance.count, -1)
        value = balance.residual(columns * x, force)
        return rows * value, rows[:, None] * slope * columns[None, :], balance.parts(columns * x).forces

    table = {}
    for factor in factors(points):
        problem, minimum, scale = prepared(factor)
        call = lambda x, which, given=(problem, scale): np.asarray(residual(*given, jnp.asarray(x))[which])
        call(minimum, 0)  # compile
        for start, first in (("zero", np.zeros_like(minimum)), ("our minimum", np.asarray(minimum))):
            for derivatives, more in (
                ("finite differences", {}),
                ("our Jacobian", {"jac": lambda x, call=call: call(x, 1)}),
            ):
                begin = time.perf_counter()
                found = scipy.optimize.root(lambda x, call=call: call(x, 0), first, method="hybr", tol=1e-11, **more)
                seconds = time.perf_counter() - begin
                solved = bool(np.max(np.abs(found.fun)) < SOLVED)
                error = error_of(call(found.x, 2), exact(factor)) if solved else np.nan
                table.setdefault((derivatives, start), []).append((seconds, solved, error))
    rows = []
    for (derivatives, start), attempts in table.items():
        seconds, solved, errors = zip(*attempts, strict=True)
        took = 1e3 * float(np.median(seconds))
        error = float(np.nanmax(errors)) if any(solved) else None
        rows.append((derivatives, start, took, f"{sum(solved)}/{len(solved)}", error, took / own))
    return tuple(rows)

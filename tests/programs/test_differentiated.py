"""Derivatives outside of programs: kept programs give what JAX gives inside of one, in every mode and order."""

import dataclasses
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from springs import flat, springs

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.geometry import RollerGeometry
from jaxbearing.numerics.known_roots import at_known_root, known_roots, recorded_roots
from jaxbearing.numerics.newton import newton_solve
from jaxbearing.programs import KeptProgram, differentiated
from jaxbearing.programs.files import SUFFIX

SCENE = jb.load_scene("reference_roller", {"contact": "none"})
BALLS = "deep_groove_6205"


def shift(load, speed=900.0, scene=SCENE, **options):
    solution = jb.solve(scene.at_operation(radial_load=load, inner_speed=speed), throw=False, **options)
    return solution.ring.radial


@pytest.fixture
def asked(monkeypatch):
    """How often the program of derivatives answered."""
    found = []
    real = differentiated._kept_rows
    monkeypatch.setattr(differentiated, "_kept_rows", lambda *args: (found.append(args), real(*args))[1])
    return found


class Inside(NamedTuple):
    """Of `shift` at 2000 N and 900 rad/s, by one program of JAX; the two slopes: by load and speed."""

    value: jax.Array
    slopes: tuple


inside_at = jax.jit(lambda load, speed: Inside(*jax.value_and_grad(shift, (0, 1))(load, speed)))


@pytest.fixture(scope="module")
def inside():
    found = inside_at(2000.0, 900.0)
    for leaf in jax.tree.leaves(found):
        assert np.all(np.isfinite(leaf))
    return found


def curvatures():
    """By load and speed, and by load twice."""
    return jax.jit(jax.jacfwd(jax.grad(shift, 1)))(2000.0, 900.0), jax.jit(jax.hessian(shift))(2000.0)


def of_function(_):
    first, second = (inside_at(load, 900.0) for load in (1000.0, 2000.0))
    return (2.0 * second.slopes[0] + first.slopes[0]) / (first.value + second.value)


MODES = {
    "grad": (lambda f: jax.grad(f)(2000.0), lambda inside: inside.slopes[0]),
    "two numbers": (lambda f: jax.grad(f, (0, 1))(2000.0, 900.0), lambda inside: inside.slopes),
    "value_and_grad": (lambda f: jax.value_and_grad(f)(2000.0), lambda inside: (inside.value, inside.slopes[0])),
    "jacfwd": (lambda f: jax.jacfwd(f)(2000.0), lambda inside: inside.slopes[0]),
    "jvp": (lambda f: jax.jvp(f, (2000.0,), (3.0,)), lambda inside: (inside.value, 3.0 * inside.slopes[0])),
    "linearize": (lambda f: jax.linearize(f, 2000.0)[1](3.0), lambda inside: 3.0 * inside.slopes[0]),
    "function of the root": (lambda f: jax.grad(lambda load: jnp.log(f(2.0 * load) + f(load)))(1000.0), of_function),
}


@pytest.mark.parametrize("mode", MODES)
def test_first_derivatives_are_those_of_a_program(mode, asked, inside):
    of, expected = MODES[mode]
    found = of(shift)
    assert asked
    jax.tree.map(lambda a, b: np.testing.assert_allclose(a, b, rtol=1e-12), found, expected(inside))


def test_second_derivatives_are_those_of_differences(asked):
    found = jax.jacfwd(jax.jacrev(shift, (0, 1)), (0, 1))(2000.0, 900.0)
    assert not asked
    steps = 1e-4 * np.diag([2000.0, 900.0])
    for i, step in enumerate(steps):
        up, down = (np.array(inside_at(*(way * step + [2000.0, 900.0])).slopes) for way in (1.0, -1.0))
        np.testing.assert_allclose([row[i] for row in found], (up - down) / (2.0 * step[i]), rtol=1e-6)


PAIR = jnp.array([2000.0, 1e200])
failing = lambda value: np.array([value, 0.0])
NESTED = {
    "jacrev(jacfwd)": (lambda f: jax.jacrev(jax.jacfwd(f, 1), 0)(2000.0, 900.0), lambda inside: curvatures()[0]),
    "grad(grad), one number each": (
        lambda f: jax.grad(lambda a: jax.grad(lambda b: f(a, b))(900.0))(2000.0),
        lambda inside: curvatures()[0],
    ),
    "jvp of a direction": (
        lambda f: jax.jvp(lambda t: jax.jvp(f, (2000.0,), (t,))[1], (2.0,), (3.0,)),
        lambda inside: (2.0 * inside.slopes[0], 3.0 * inside.slopes[0]),
    ),
    "vmap(value_and_grad), a lane fails": (
        lambda f: jax.vmap(jax.value_and_grad(f))(PAIR),
        lambda inside: (np.array([inside.value, np.nan]), failing(inside.slopes[0])),
    ),
    "vmap(jacfwd), a lane fails": (
        lambda f: jax.vmap(jax.jacfwd(f))(PAIR),
        lambda inside: failing(inside.slopes[0]),
    ),
    "vmap(hessian), a lane fails": (
        lambda f: jax.vmap(jax.hessian(f))(PAIR),
        lambda inside: failing(curvatures()[1]),
    ),
    "map(grad), a lane fails": (
        lambda f: jax.lax.map(jax.grad(f), PAIR),
        lambda inside: failing(inside.slopes[0]),
    ),
    "grad by what lanes share": (
        lambda f: jax.grad(lambda speed: jnp.nansum(jax.vmap(lambda load: f(load, speed))(PAIR)))(900.0),
        lambda inside: inside.slopes[1],
    ),
    "checkpoint": (lambda f: jax.grad(jax.checkpoint(f))(2000.0), lambda inside: inside.slopes[0]),
}


IN_SHORT = ("jvp of a direction", "vmap(value_and_grad), a lane fails", "grad by what lanes share")


@pytest.mark.parametrize(
    "way", [way if way in IN_SHORT else pytest.param(way, marks=pytest.mark.slow) for way in NESTED]
)
def test_nested_derivatives_and_failed_lanes(way, asked, inside):
    """Outside of a program and inside of one the same. A failed lane,
    whose result is NaN, passes no derivative."""
    of, expected = NESTED[way]
    found = of(shift)
    if way not in ("jvp of a direction", "map(grad), a lane fails", "checkpoint"):
        assert not asked
    jax.tree.map(lambda a, b: np.testing.assert_allclose(a, b, rtol=1e-10, atol=1e-25), found, expected(inside))


def test_threads_do_not_meet(asked, inside):
    """Derivatives, plain solves and programs that are traced, at the same time."""
    expected = [inside.value, inside.slopes[0]]
    tasks = [
        lambda: float(shift(2000.0)),
        lambda: float(jax.grad(shift)(2000.0)),
        lambda: float(jax.jit(lambda load: shift(load))(2000.0)),
        lambda: float(jax.jit(lambda load: jax.grad(shift)(load))(2000.0)),
    ]
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(lambda task: task(), 2 * tasks))
    np.testing.assert_allclose(found, 4 * expected, rtol=1e-12)
    assert len(asked) == 2


def test_no_traced_number_is_left_behind():
    with jax.checking_leaks():
        slope = jax.grad(shift)(2000.0)
        np.testing.assert_allclose(jax.jit(lambda load: jax.grad(shift)(load))(2000.0), slope, rtol=1e-12)


def test_an_optimised_solve_is_differentiated_by_jax(asked, inside):
    slope = jax.grad(lambda load: shift(load, optimised=True))(2000.0)
    assert not asked
    np.testing.assert_allclose(slope, inside.slopes[0], rtol=1e-12)


def test_of_arrays(asked):
    """Numbers and results that are arrays, against differences."""
    angles = jnp.linspace(0.0, 0.09, 10)

    def vector(numbers):
        total = jnp.sum(numbers)
        scene = SCENE.at_operation(radial_load=2000.0 + total)
        scene = scene.replace_geometry(roller_diameter=SCENE.geometry.roller_diameter * (1.0 + 1e-3 * numbers[3]))
        return jb.solve(scene).elements.load_inner

    step = 1e-3 * np.eye(10)
    expected = np.stack([(vector(angles + one) - vector(angles - one)) / 2e-3 for one in step], axis=1)
    found = jax.jacfwd(vector)(angles)
    np.testing.assert_allclose(found, expected, rtol=1e-7, atol=1e-9 * np.max(np.abs(expected)))
    assert len(asked) == 1
    sums = jax.grad(lambda numbers: jnp.sum(vector(numbers) ** 2))(angles)
    np.testing.assert_allclose(sums, 2.0 * vector(angles) @ found, rtol=1e-10)
    assert len(asked) == 2


def test_very_many_numbers_are_left_to_jax(monkeypatch, asked, inside):
    monkeypatch.setattr(differentiated, "_MOST_NUMBERS", 1)
    found = jax.grad(shift, (0, 1))(2000.0, 900.0)
    assert not asked
    np.testing.assert_allclose(found, inside.slopes, rtol=1e-12)
    assert np.isfinite(jax.grad(shift)(2000.0))
    assert asked


def test_a_solve_that_fails():
    expected = inside_at(1e200, 900.0)
    np.testing.assert_array_equal(jax.value_and_grad(shift)(1e200), (expected.value, expected.slopes[0]))
    np.testing.assert_array_equal(jax.jacfwd(shift)(1e200), expected.slopes[0])
    assert np.isnan(expected.value)
    assert expected.slopes[0] == 0.0


@pytest.mark.slow
def test_a_solve_that_fails_raises_while_it_is_differentiated():
    message = "diverged after .* Newton steps: scaled residual 1, worst equation: radial load balance"
    with pytest.raises(jb.SolveError, match=message):
        jax.grad(lambda load: jb.solve(SCENE.at_operation(radial_load=load)).ring.radial)(1e200)
    with pytest.raises(jb.SolveError):
        jax.grad(lambda load: jb.solve(jb.load_scene(BALLS).at_operation(radial_load=load)).ring.radial)(1e200)


def test_what_does_not_depend_on_the_numbers_is_plain():
    def residual(load):
        solution = jb.solve(SCENE.at_operation(radial_load=load))
        assert float(solution.residual_norm) < 1e-8  # no traced number, which has no value
        return solution.ring.radial

    assert np.isfinite(jax.grad(residual)(2000.0))


@pytest.mark.slow
def test_every_number_of_a_scene(asked):
    scene = jb.load_scene(BALLS)
    numbers, structure = jax.tree.flatten(jax.tree.map(jnp.asarray, scene))

    def results(numbers):
        solution = jb.solve(jax.tree.unflatten(structure, numbers))
        return 1e6 * solution.ring.tilt + 1e-9 * solution.stiffness[1, 1] + 1e-3 * solution.elements.load_outer[0]

    found, expected = jax.grad(results)(numbers), jax.jit(jax.grad(results))(numbers)
    assert len(asked) == 1
    assert len(found) > differentiated._FEWEST_ROWS
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-8, atol=1e-10 * max(1.0, float(np.max(np.abs(other)))))


def test_of_the_port(asked):
    place = jnp.array([0.0, 2e-5, 0.0, 0.0, 0.0])
    force = lambda place: jb.reaction(SCENE, place).force
    np.testing.assert_allclose(jax.jacrev(force)(place), jb.reaction(SCENE, place).stiffness, rtol=1e-9, atol=1e-3)
    assert asked


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The files of a cache that is switched on, for programs of a process that begins."""
    monkeypatch.setenv("JAXBEARING_CACHE", str(tmp_path / "cache"))
    for program in (differentiated.solved, differentiated._kept_rows):
        monkeypatch.setattr(program, "_ready", {})
        monkeypatch.setattr(program, "_never", set())
    return lambda: sorted((tmp_path / "cache").rglob(f"*{SUFFIX}"))


def test_both_programs_are_kept(folder, monkeypatch):
    slope = jax.value_and_grad(shift)(2000.0)
    assert len(folder()) == 2
    differentiated.solved._ready.clear()
    differentiated._kept_rows._ready.clear()
    with monkeypatch.context() as patch:
        patch.setattr(KeptProgram, "_made", None)  # none is made again
        assert jax.value_and_grad(shift)(2000.0) == slope
        assert shift(2000.0) == slope[0]
    monkeypatch.setenv("JAXBEARING_CACHE", "off")
    np.testing.assert_allclose(jax.value_and_grad(shift)(2000.0), slope, rtol=1e-12)
    assert len(folder()) == 2


class OwnGeometry(RollerGeometry):
    """Code of the user's own."""


def test_programs_with_code_of_the_user_are_not_kept(folder, inside):
    geometry = OwnGeometry(
        **{field.name: getattr(SCENE.geometry, field.name) for field in dataclasses.fields(OwnGeometry)}
    )
    slope = jax.grad(lambda load: shift(load, scene=dataclasses.replace(SCENE, geometry=geometry)))(2000.0)
    assert folder() == []
    np.testing.assert_allclose(slope, inside.slopes[0], rtol=1e-12)


@pytest.mark.parametrize(
    ("name", "changes", "result"),
    [
        pytest.param(
            "reference_roller",
            {"contact": "none"},
            lambda solution: 1e5 * solution.ring.radial + 1e-9 * solution.stiffness[1, 1],
            id="dry",
        ),
        pytest.param(
            "deep_groove_6205_mounted",
            {},
            lambda solution: solution.fit.clearance * 1e5 + solution.elements.load_inner[0] * 1e-3,
            id="mounted",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            "turbine_roller",
            {"contact": "none", "operation.misalignment": "1 mrad", "rating.grooves": "scene"},
            lambda solution: jnp.log(solution.life.L10r) + 1e4 * solution.ring.radial,
            id="tilting",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            "tapered_example",
            {"contact": "none"},
            lambda solution: 1e5 * solution.ring.axial,
            id="tapered",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            "turbine_ball_mounted",
            {"contact.traction_accuracy": 1e-2},
            lambda solution: jnp.log(solution.power_loss.total) + solution.cage.slip,
            id="films",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            "satellite_contact_1",
            {"contact.accuracy": 1e-2},
            lambda solution: jnp.log(solution.film.central),
            id="line contact",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_every_number_of_a_kind(name, changes, result, asked):
    """Geometry, fits, temperatures, materials, oil, loads: all are traced at once. Against JAX's forward mode inside of
    a program, in three random directions."""
    numbers, structure = jax.tree.flatten(jax.tree.map(jnp.asarray, jb.load_scene(name, changes)))
    # each number's factor, so that all derivatives have the size of the result, about 1
    loss = lambda factors: result(jb.solve(jax.tree.unflatten(structure, list(map(jnp.multiply, factors, numbers)))))
    ones = [jnp.ones_like(number) for number in numbers]
    found = jax.grad(loss)(ones)
    assert len(asked) == 1
    random = np.random.default_rng(5)
    directions = [random.normal(size=(3, *one.shape)) for one in ones]
    along = lambda direction: jax.jvp(loss, (ones,), (direction,))[1]
    expected = jax.jit(lambda directions: jax.lax.map(along, directions))(directions)
    sums = sum(np.sum(one * way, axis=tuple(range(1, way.ndim))) for one, way in zip(found, directions, strict=True))
    assert np.all(np.isfinite(expected))
    np.testing.assert_allclose(sums, expected, rtol=1e-8, atol=1e-8)


# -- roots that are known ---------------------------------------------------------------------------------------------


def springs_times(stiffness):
    plain = springs(m=1, g=1, n=3)
    return type(plain)(stiffness * plain.stiffness, plain.load, m=1)


def root(stiffness):
    """The root, the same times a number of the live system, and a number of the Jacobian."""
    live, result = newton_solve(springs_times(stiffness))
    point = flat(result.point)
    return jnp.concatenate([point, point * jnp.mean(live.stiffness), result.jacobian.local[0, 0, :1]])


def at_known(stiffness):
    with recorded_roots() as roots:
        root(jax.lax.stop_gradient(stiffness))
    with known_roots(roots):
        return root(stiffness)


def orders(function):
    """A program: value, slope in both modes, second derivative."""

    def all_orders(number):
        slope = lambda at: (lambda found: (found, found))(jax.jacrev(function)(at))
        second, reverse = jax.jacfwd(slope, has_aux=True)(number)
        value, forward = jax.jvp(function, (number,), (jnp.ones_like(number),))
        return value, forward, reverse, second

    return jax.jit(all_orders)


@pytest.fixture(scope="module")
def searched():
    return orders(root)(jnp.asarray(1.1))


def test_known_roots_have_the_derivatives_of_those_searched_for(searched):
    (value, *derivatives), (expected, *others) = orders(at_known)(jnp.asarray(1.1)), searched
    np.testing.assert_allclose(value, expected, rtol=1e-14)
    for found, other in zip(derivatives, others, strict=True):
        np.testing.assert_allclose(found, other, rtol=1e-12)
    np.testing.assert_allclose(derivatives[0], derivatives[1], rtol=1e-12)


def test_derivatives_of_a_stiffness_that_are_left_out_are_nan(searched):
    with recorded_roots() as roots:
        size = root(1.1).size // 2

    def point(stiffness):
        with known_roots(roots, stiffness=False):
            result = newton_solve(springs_times(stiffness))[1]
        return flat(result.point), result.jacobian.local

    @jax.jit
    def program(stiffness):
        return jax.jacfwd(point)(stiffness), jax.hessian(lambda s: point(s)[0])(stiffness)

    (slope, local), curved = program(1.1)
    assert np.all(np.isnan(local))
    np.testing.assert_allclose(slope, searched[1][:size], rtol=1e-12)
    np.testing.assert_allclose(curved, searched[3][:size], rtol=1e-11)


def test_known_roots_end_with_their_block():
    """Also where it fails, and inside of another one."""
    search, known = lambda: 0.0, lambda root, _: float(root)

    def fails():
        with known_roots([1.0]):
            raise ZeroDivisionError

    with known_roots([2.0]):
        for _ in range(2):
            with pytest.raises(ZeroDivisionError):
                fails()
        with recorded_roots() as roots, known_roots([3.0]):
            assert at_known_root(search, known) == 3.0
        assert roots == []
        assert at_known_root(search, known) == 2.0
    assert at_known_root(search, known) == 0.0
    with ThreadPoolExecutor(1) as thread, known_roots([4.0]):
        assert thread.submit(at_known_root, search, known).result() == 0.0


def test_a_trace_that_fails_leaves_no_known_roots(monkeypatch, inside):
    solve = sys.modules["jaxbearing.solve"]
    real = solve.with_life

    def fails(scene, solution):
        raise ZeroDivisionError

    monkeypatch.setattr(solve, "with_life", fails)
    new = jb.NewtonOptions(max_steps=77)  # a program that is not there yet
    with pytest.raises(ZeroDivisionError):
        jax.grad(lambda load: shift(load, options=new))(2000.0)
    monkeypatch.setattr(solve, "with_life", real)
    np.testing.assert_allclose(jax.grad(lambda load: shift(load, options=new))(2000.0), inside.slopes[0], rtol=1e-12)


def test_nothing_is_searched_for_at_known_roots():
    with recorded_roots() as roots:
        root(1.1)
    assert len(roots) == 1

    def derivative(stiffness):
        with known_roots(roots):
            return jax.jvp(root, (stiffness,), (1.0,))

    assert "while" not in str(jax.make_jaxpr(derivative)(1.1))
    assert "while" in str(jax.make_jaxpr(root)(1.1))


def test_derivatives_by_other_programs_are_right_too(searched):
    """The root that was noted depends on the number as well; only the search that takes it counts."""

    def both(stiffness):
        with recorded_roots() as roots:
            root(stiffness)
        with known_roots(roots):
            return root(stiffness)

    np.testing.assert_allclose(jax.jit(jax.jacrev(both))(1.1), searched[2], rtol=1e-12)


def test_the_program_of_a_plain_solve_is_asked_for_its_roots_as_well():
    solve = sys.modules["jaxbearing.solve"]
    solution, roots = solve.solve_with_roots(SCENE, jb.NewtonOptions())
    again = eqx.filter_jit(solve.solution_at)(roots, SCENE, jb.NewtonOptions())
    assert len(roots) == 1
    jax.tree.map(
        lambda a, b: np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-9, equal_nan=True),
        (solution.ring, solution.elements, solution.status),
        (again.ring, again.elements, again.status),
    )

"""Every number of every scene has a bound: eager copies beyond it are refused, traced ones end as `invalid_input`."""

import functools
import itertools

import equinox as eqx
import jax
import jax.numpy as jnp
import line_contacts
import numpy as np
import pytest
import tapered_cases
import two_disk_cases
from roller_cases import dry_roller, reference_roller

import jaxbearing as jb
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.bearings.parts import Drag
from jaxbearing.bearings.rating import CLEANLINESS_CLASSES, RELIABILITIES, Rating
from jaxbearing.life.basic import RELIABILITY_FACTORS
from jaxbearing.life.modification import CLEANLINESS
from jaxbearing.numerics.checks import check_inputs
from jaxbearing.numerics.precision import as_float
from jaxbearing.numerics.ranges import RANGES
from jaxbearing.numerics.status import Status
from jaxbearing.scenes.fields import type_at
from jaxbearing.scenes.reader import builtin_names, load_scene
from jaxbearing.sweeps.fields import SceneSource, dimension_of
from jaxbearing.time_laws import Tabulated

SCENES = [*builtin_names(), "rated", "rotating load", "capped couple"]
RATED = {
    "rating.dynamic_capacity": "14 kN",
    "rating.static_capacity": "8 kN",
    "rating.viscosity_ratio": "1.5",
    "rating.fatigue_load_limit": "0.3 kN",
}


@functools.cache
def scene(name):
    if name == "rated":
        return numbers(load_scene("deep_groove_6205", RATED))
    if name == "rotating load":
        more = {"load": "3 kN", "speed": "5000 rpm"}
        return numbers(
            load_scene("turbine_roller_dynamic", {f"simulation.rotating_load.{k}": v for k, v in more.items()})
        )
    if name == "lobes":
        lobes = {"lobe_order": "[2, 3]", "lobe_height": "['2 um', '1 um']", "lobe_angle": "['0 deg', '20 deg']"}
        return numbers(load_scene("reference_roller", {f"outer_roundness.{k}": v for k, v in lobes.items()}))
    if name == "supplied":
        return numbers(load_scene("turbine_ball", {"contact.supply.from_flow": "0.5"}))
    if name == "capped couple":
        return numbers(load_scene("turbine_ball", {"kinematics.gyroscopic": "capped"}))
    return numbers(load_scene(name))


def numbers(given):
    return jax.tree.map(as_float, given)


def paths(given):
    """Dotted path of every number of a scene."""
    leaves, _ = jax.tree_util.tree_flatten_with_path(given)
    return {jax.tree_util.keystr(path, simple=True, separator="."): leaf for path, leaf in leaves}


@functools.cache
def traced_checks(name):
    """The rules of a scene, and a compiled function of its numbers to which of them are broken."""
    leaves, structure = jax.tree.flatten(scene(name))
    rules = []

    @jax.jit
    def broken(values):
        found = check_inputs(jax.tree.unflatten(structure, values))
        rules[:] = found.rules
        return found.broken, found.valid

    jax.eval_shape(broken, leaves)
    return tuple(rules), broken


def bounds(name):
    """(path, bound) of every number with a bound of its own."""
    found = [rule.partition(" must be ") for rule in traced_checks(name)[0]]
    return [(path, bound) for path, _, bound in found if bound in RANGES]


def owner(part, path):
    """Class of the part of a scene that has a number."""
    for name in path.split(".")[:-1]:
        part = part[int(name)] if name.isdigit() else part[name] if isinstance(part, dict) else getattr(part, name)
    return type(part)


def anew(names):
    """(name of a scene, its numbers whose class no scene before it has, as `bounds` gives them)."""
    seen = set()
    for name in names:
        keys = {
            (path, bound): (owner(scene(name), path), path.rpartition(".")[2], bound) for path, bound in bounds(name)
        }
        yield name, [one for one, key in keys.items() if key not in seen]
        seen |= set(keys.values())


def outside(interval):
    """Values that are not allowed: beyond each end, at it where it does not belong, and what is no number."""
    values = [np.nan, np.inf, -np.inf]
    if np.isfinite(interval.low):
        values += [interval.low - 1e-6] if interval.low_allowed else [interval.low - 1e-6, interval.low]
    if np.isfinite(interval.high):
        values += [interval.high + 1e-6] if interval.high_allowed else [interval.high + 1e-6, interval.high]
    return values


@pytest.mark.parametrize("name", SCENES)
def test_every_number_has_a_bound(name):
    rules = traced_checks(name)[0]
    named = {rule.split(" ")[0] for rule in rules}
    # the rule of a table over time is about both of its columns
    together = {"simulation.speed.factors"}
    # reduced moduli and the like are given by the package, not by a user
    assert set(paths(scene(name))) - named - together == set()


WHOLE = dict.fromkeys(("gear_shaft", "deep_groove_6205_mounted", "turbine_roller_dynamic", "tapered_example"), "")
BETWEEN = WHOLE | {"lobes": "outer_roundness.", "supplied": "contact.supply."}
"""Scenes, and the part whose numbers are moved: all, or what no other scene has."""


@pytest.mark.parametrize("name", BETWEEN)
def test_rules_between_numbers_hold_for_traced_numbers_too(name):
    """Each number of a scene is moved far away: what the eager copy refuses is flagged where it is traced, and nothing
    else is."""
    broken, given, refusals = traced_checks(name)[1], scene(name), 0
    for place, (path, old) in enumerate(paths(given).items()):
        if not path.startswith(BETWEEN[name]):
            continue
        for factor, offset in ((-1.0, 0.0), (0.0, 0.0), (0.03, 0.0), (30.0, 0.0), (0.0, 0.37)):
            moved = np.array(old, copy=True)
            moved.flat[-1] = factor * moved.flat[-1] + offset
            in_file = given.path_in_file(path)
            number = moved if moved.ndim else float(moved)
            refused = refuses(ValueError, lambda: given.replace({in_file: number}))  # noqa: B023  (called at once)
            leaves = jax.tree.leaves(given)
            leaves[place] = moved
            assert refused != bool(broken(leaves)[1]), (path, moved)
            refusals += refused
    assert refusals > 2


def test_eager_copies_are_refused_and_traced_ones_are_flagged():
    """Each number of a class in the first scene that has it."""
    for name, numbers_ in anew(SCENES):
        rules, broken = traced_checks(name)
        given, there = scene(name), paths(scene(name))
        where = {path: i for i, path in enumerate(there)}
        for path, bound in numbers_:
            for value in outside(RANGES[bound]):
                # one bad number among good ones is enough
                bad = np.array(there[path], copy=True)
                bad.flat[-1] = value
                in_files = path.rpartition(".")[2].replace("friction_coefficient", "gyroscopic_friction")
                with pytest.raises(ValueError, match=in_files):
                    given.replace({given.path_in_file(path): bad if np.ndim(there[path]) else float(value)})
                leaves = jax.tree.leaves(given)
                leaves[where[path]] = bad
                flags, valid = broken(leaves)
                assert f"{path} must be {bound}" in [rules[i] for i in np.flatnonzero(flags)], (name, path, value)
                assert not bool(valid)
        assert not numbers_ or bool(broken(jax.tree.leaves(given))[1])


def numbers_of_files(name, numbers_):
    """Text of a value and bound of every single number that a scene file may give, by its path."""
    model, found = SceneSource.of(name).model, {}
    for path, bound in numbers_:
        kind = type_at(model, path.split("."))
        if kind is None or np.ndim(paths(scene(name))[path]):
            continue
        dimension = dimension_of(kind)
        unit = "" if dimension is None else f" {dimension.si}"
        found[path] = (lambda value, unit=unit: f"{float(value)!r}{unit}"), bound
    return found


def problems(name, texts):
    """Path and expectation of each problem of a scene file with these texts."""
    try:
        load_scene(name, texts)
    except jb.SceneError as error:
        return [(one.path, one.expected) for one in error.problems]
    return []


def test_files_have_the_bounds_of_the_classes():
    """What a scene file refuses the class refuses (test above), and the other way round. All problems of a file are
    said at once: one file has every number beyond its bound."""
    names = ["turbine_roller_dynamic", "turbine_ball", "tapered_example", "two_disk_etm", "satellite_contact_1"]
    # a viscosity of one's own goes with a law of its pressure: the numbers of the oil's law by themselves
    apart = "oil.pressure_viscosity."
    checked = 0
    for (name, numbers_), of_law in itertools.product(anew(names), (False, True)):
        numbers_ = [one for one in numbers_ if one[0].startswith(apart) == of_law]
        given = numbers_of_files(name, numbers_)
        own = {path: text(paths(scene(name))[path]) for path, (text, _) in given.items()}
        # one property of a material that has a name
        named = dict(problems(name, own))
        given = {path: one for path, one in given.items() if path not in named}
        values = {path: outside(RANGES[bound]) for path, (_, bound) in given.items()}
        for place in range(max(map(len, values.values()), default=0)):
            beyond = {path: given[path][0](some[place]) for path, some in values.items() if place < len(some)}
            found = problems(name, beyond)
            assert sorted(path for path, _ in found) == sorted(beyond), (name, place)
            # each by itself, with its range: not as values that do not fit together
            assert not any("fit together" in expected for _, expected in found), found
            checked += len(found)
        for path, (text, bound) in given.items():
            for value in (-1.0, 0.0):
                if RANGES[bound].holds(value):
                    refused = bool(problems(name, {path: text(value)}))
                    assert refused == refuses(ValueError, lambda: scene(name).replace({path: value})), (path, value)  # noqa: B023
                    checked += 1
    assert checked > 300


def refuses(error, make):
    try:
        make()
    except error:
        return True
    return False


def solved_lanes(given, changes, throw=False):
    """Solutions of lanes with other numbers, each path an array over the lanes, one compiled program."""

    @jax.jit
    def run(changes):
        return jax.lax.map(lambda lane: jb.solve(given.replace(lane), throw=throw), changes)

    return run({path: jnp.asarray(values, dtype=float) for path, values in changes.items()})


HELD = {"operation.moment": "none"}
"""A ring that cannot tilt: a smaller program."""


def rated_ball():
    ball = load_scene("deep_groove_6205", HELD)
    return eqx.tree_at(lambda s: s.rating, ball, Rating(dynamic_capacity=14e3), is_leaf=lambda x: x is None)


LANES = {
    "ball": (
        rated_ball,
        {
            "operation.radial_load": ([1.0e3, np.nan, 1e3, 1e3], "operation.radial_load must be finite"),
            "geometry.ball_diameter": ([7.94e-3, 7.94e-3, 20e-3, 7.94e-3], "geometry.n_balls must be so small"),
            "rating.dynamic_capacity": ([14e3, 14e3, 14e3, -1.0], "rating.dynamic_capacity must be > 0"),
        },
    ),
    "roller": (
        reference_roller,
        {
            "operation.oil_flow": ([4e-5, -4e-5, 4e-5, 4e-5], "operation.oil_flow must be >= 0"),
            "geometry.roller_diameter": ([12e-3, 12e-3, 20e-3, 12e-3], "geometry.n_rollers must be so small"),
            "drag.coefficient": ([1.2, 1.2, 1.2, -1.0], "drag.coefficient must be >= 0"),
        },
    ),
    "tapered": (
        lambda: tapered_cases.tapered(2e3),
        {
            "geometry.flange_angle": (
                [np.radians(10.35), -0.1, np.radians(10.35)],
                "geometry.flange_angle must be above 0 and below 90 degrees",
            ),
            "geometry.end_radius": ([108e-3, 108e-3, 3e-3], "geometry.end_radius must be above half"),
        },
    ),
    "disks": (
        lambda: two_disk_cases.small(),
        {"oil.rheology.stress": ([5e6, -5e6], "oil.rheology.stress must be > 0")},
    ),
    "contact": (
        lambda: line_contacts.satellite(nodes=101),
        {"operation.load_per_length": ([76310.0, -1.0], "operation.load_per_length must be > 0")},
    ),
}


LARGE = [pytest.param(kind, marks=pytest.mark.slow) for kind in ("roller", "tapered")]
"""The claim of the balls again, in larger programs."""


@pytest.mark.parametrize("kind", ["ball", "disks", "contact", *LARGE])
def test_invalid_lanes_say_so_and_leave_the_others_alone(kind):
    make, changes = LANES[kind]
    given = numbers(make())
    found = solved_lanes(given, {path: values for path, (values, _) in changes.items()})
    statuses = np.asarray(found.status).reshape(np.shape(found.status)[0], -1)
    assert np.all(statuses[0] == Status.CONVERGED)
    assert np.all(statuses[1:] == Status.INVALID_INPUT)
    result = {"disks": "traction_coefficient", "contact": "film.central"}.get(kind, "elements.load_inner")
    values = np.asarray(functools.reduce(getattr, result.split("."), found))
    assert np.all(np.isfinite(values[0]))
    assert np.all(np.isnan(values[1:]))
    for path, (numbers_, rule) in changes.items():
        for lane in np.flatnonzero([value != numbers_[0] for value in numbers_]):
            one = jax.tree.map(lambda leaf, lane=lane: leaf[lane], found)
            assert rule in one.failure(), path
            assert "invalid_input" in one.failure()
            assert any(rule in text and bool(flag) for text, flag in one.checks.items())
    # the operation that was asked for is what is shown
    for path in changes:
        if path.startswith("operation."):
            asked = getattr(found.operation, path.removeprefix("operation."))
            np.testing.assert_array_equal(np.ravel(asked), changes[path][0])


def test_invalid_lanes_reach_no_derivative():
    given = numbers(dry_roller())

    def total(load, diameters):
        def lane(diameter):
            changed = given.replace({"geometry.roller_diameter": diameter, "operation.radial_load": load})
            solution = jb.solve(changed, throw=False)
            return jnp.where(solution.converged, solution.ring.radial, 0.0)

        return jnp.sum(jax.lax.map(lane, diameters))

    slope = jax.jit(jax.grad(total))
    alone, beside = slope(25e3, jnp.asarray([12e-3, 12e-3])), slope(25e3, jnp.asarray([12e-3, 20e-3]))
    assert abs(alone) > 0.0
    np.testing.assert_allclose(2.0 * beside, alone, rtol=1e-12)


def test_two_tables_are_judged_apart():
    """One of them alone breaks the rule; both have the same one."""
    good, bad = (Tabulated(np.asarray([0.0, second, 2e-5]), np.ones(3)) for second in (1e-5, 1.5e-5))
    bad = eqx.tree_at(lambda table: table.times, bad, np.asarray([0.0, 3e-5, 2e-5]))
    judged = jax.jit(lambda simulation: check_inputs(simulation).valid)
    for speed, load, valid in ((good, good, True), (bad, good, False), (good, bad, False)):
        run = eqx.tree_at(lambda s: (s.speed, s.load), Simulation(speed=good, load=good), (speed, load))
        assert bool(judged(jax.tree.map(jnp.asarray, run))) is valid


def test_arrays_for_one_number_are_refused_by_name():
    given = numbers(load_scene("deep_groove_6205", HELD))
    with pytest.raises(ValueError, match=r"operation\.inner_speed must be one number, got an array of shape \(2,\)"):
        jax.eval_shape(lambda x: jb.solve(given.replace({"operation.inner_speed": x}), throw=False), jnp.ones(2))


def test_ratings_that_no_standard_has_are_refused():
    for change, words in ({"reliability": 2.0}, "reliability"), ({"cleanliness": "clean"}, "cleanliness"):
        with pytest.raises(ValueError, match=rf"rating\.{words} must be one of"):
            Rating(**change)
    assert set(CLEANLINESS_CLASSES) == set(CLEANLINESS)
    assert set(RELIABILITIES) == set(RELIABILITY_FACTORS)


def test_a_part_is_not_replaced_by_a_word():
    with pytest.raises(TypeError, match=r"materials\.balls must be a part such as Material, got 'Si3N4'"):
        load_scene("deep_groove_6205").replace({"materials.balls": "Si3N4"})


def test_a_scene_that_was_changed_behind_the_checks_is_refused_by_name():
    broken = eqx.tree_at(lambda s: s.geometry.roller_diameter, dry_roller(), np.float64(-1.0))
    with pytest.raises(jb.SolveError, match=r"invalid_input: geometry\.roller_diameter must be > 0"):
        jb.solve(broken)


@pytest.mark.parametrize("value", [1j, "1100", [1.0], np.ones(2), None, object()])
def test_what_is_no_number_is_refused_by_name(value):
    with pytest.raises(ValueError, match=r"operation\.inner_speed must be one number"):
        load_scene("reference_roller").at_operation(inner_speed=value)


def test_compiled_solvers_refuse_what_is_no_scene():
    fast = jb.jit_solver(dry_roller())
    # without the run-time checks of the tests: "expected a scene, or keywords of the operating point"
    with pytest.raises(TypeError, match=r"scene"):
        fast(1100.0)
    with pytest.raises(TypeError, match="expected a real number"):
        fast(inner_speed=np.complex128(1j))


@pytest.mark.slow
def test_the_loss_at_no_flow_has_a_slope_that_foretells_a_step():
    """Parker's law has an infinite slope at no flow; that of the model is the secant to 0.1 l/h."""
    roller = numbers(reference_roller())
    roller = eqx.tree_at(lambda s: s.drag, roller, Drag(coefficient=1.2))

    def loss(flow):
        return jb.solve(roller.at_operation(oil_flow=flow), throw=False).power_loss.drag

    litre = 1e-3 / 3600.0
    at_rest, slope = jax.jit(lambda flow: jax.jvp(loss, (flow,), (1.0,)))(0.0)
    few = 0.01 * litre
    np.testing.assert_allclose(slope * few, jax.jit(loss)(few) - at_rest, rtol=5e-3)
    assert slope * 0.1 * litre > 0.0

"""The bounded part of the campaign: a few structures, scenes drawn and shrunk by hypothesis."""

import equinox as eqx
import hypothesis.strategies as st
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from campaign import judge
from campaign.draws import single
from campaign.structure import results_of
from campaign.structures import STRUCTURES
from hypothesis import HealthCheck, given, settings

import jaxbearing as jb
from jaxbearing.bearings.ball.build import build_core
from jaxbearing.bearings.cylindrical.steady import build_system
from jaxbearing.bearings.tapered.build import build_tapered
from jaxbearing.numerics.newton import newton_solve

pytestmark = pytest.mark.slow

SMALL = [structure for structure in STRUCTURES if structure.small]
EXAMPLES = 40
AGREEMENT = 1e-9
by_name = pytest.mark.parametrize("structure", SMALL, ids=lambda structure: structure.name)


def points(structure):
    """Of the unit cube, as rows of one case."""
    coordinates = st.tuples(*[st.floats(0.0, 1.0)] * structure.size)
    return coordinates.map(lambda unit: np.asarray(unit)[None, :])


@by_name
def test_random_scenes(structure):
    """Every scene converges, or there provably is no equilibrium; what converges keeps the invariants, and so does its
    twin. A failure is shrunk towards the lower ends of the ranges."""

    @given(points(structure))
    @settings(max_examples=EXAMPLES, derandomize=True, deadline=None, suppress_health_check=list(HealthCheck))
    def check(unit):
        numbers = structure.at(unit)
        _, results = judge.solve_batch(structure, numbers, 1)
        found = judge.refused_scenes(structure, numbers) + judge.judge_numbers(structure, numbers, results)
        found += judge.judge_balances(structure, numbers, results)[0]
        found += judge.judge_status(structure, numbers, results)[0]
        for twin in structure.twins:
            found += judge.judge_twin(structure, twin, numbers, results, 1)[0]
        assert not found, found

    check()


@by_name
def test_gradients(structure):
    """Finite and equal to finite differences, by every number of a few scenes."""
    numbers = structure.at(np.random.default_rng(1).random((8, structure.size)))
    _, results = judge.solve_batch(structure, numbers, 1)
    found, worst, _ = judge.judge_gradient(structure, numbers, results, 1, seed=1)
    assert not found, found
    assert 0.0 < worst <= judge.GRADIENT_LIMIT  # something was compared


@pytest.mark.parametrize("name", ["roller: moment, straight", "tapered: dry, moment"])
def test_moments_are_judged(name):
    """Given moments are carried, and none that is a tenth larger; rollers turned end for end tip."""
    structure = next(structure for structure in STRUCTURES if structure.name == name)
    numbers = structure.at(np.random.default_rng(4).random((8, structure.size)))
    _, results = judge.solve_batch(structure, numbers, 8)
    converged = int(np.sum(judge.converged_cases(results)))
    assert converged >= 5
    breached = lambda n, r: [breach.rule for breach in judge.judge_balances(structure, n, r)[0]]
    assert not breached(numbers, results)
    larger = numbers | {"operation.moment": 1.1 * numbers["operation.moment"]}
    assert breached(larger, results) == ["ring carries the moment"] * converged
    turned = results | {"laminae.outer": results["laminae.outer"][..., ::-1]}
    rule = "a roller does not tip" if structure.kind == "cylindrical roller" else "ring carries the moment"
    assert breached(numbers, turned) == [rule] * converged


AGREEING = [
    structure for structure in STRUCTURES if structure.name in ("roller: dry", "ball: dry, combined, tilt free")
]


@pytest.mark.parametrize("structure", AGREEING, ids=lambda structure: structure.name)
def test_one_at_a_time_mapped_and_side_by_side(structure):
    """`jb.solve` of one scene, `lax.map` and `vmap` agree; a lane that fails says so and leaves the others alone."""
    numbers = structure.at(np.random.default_rng(2).random((6, structure.size)))
    broken = {name: values.copy() for name, values in numbers.items()}
    broken["operation.radial_load"][3] = np.nan
    batch = {name: jnp.asarray(values) for name, values in broken.items()}
    mapped = results_of(structure.solver(batch))
    beside = results_of(jax.jit(jax.vmap(structure.solve_one))(batch))
    assert list(np.flatnonzero(mapped["status"])) == list(np.flatnonzero(beside["status"])) == [3]
    for case in (0, 5):
        alone = results_of(jb.solve(structure.single_scene(single(numbers, case)), throw=False))
        for path in ("elements.load_inner", "elements.load_outer", "ring.radial", "elements.orbital_speed"):
            scale = np.max(np.abs(alone[path]))
            for other in (mapped, beside):
                np.testing.assert_allclose(other[path][case], alone[path], rtol=0, atol=AGREEMENT * scale)
    assert np.all(np.isnan(beside["elements.load_inner"][3]))


def _roller_system(scene):
    return build_system(scene), ("azimuth", "directions")


def _ball_system(scene):
    return build_core(scene), ("directions", "azimuth", "held_shift", "ring_motion")


def _tapered_system(scene):
    return build_tapered(scene), ("columns", "held")


ROTATED = {
    "roller: dry": _roller_system,
    "roller: skidding, Ree-Eyring, Dowson-Toyoda": _roller_system,
    "ball: dry, combined, tilt free": _ball_system,
    "tapered: dry, radial, held": _tapered_system,
}


@pytest.mark.parametrize("name", ROTATED)
def test_rotation_by_one_pitch(name):
    """Rolling elements that have all moved on by one pitch carry the loads of those before them."""
    structure = next(structure for structure in STRUCTURES if structure.name == name)
    numbers = structure.at(np.random.default_rng(3).random((12, structure.size)))

    def loads(one, shift):
        system, fields = ROTATED[name](structure.scene.replace(one))
        where = lambda s: [getattr(s, field) for field in fields]
        moved_on = jax.tree.map(lambda values: jnp.roll(values, shift, axis=-1), where(system))
        system = eqx.tree_at(where, system, moved_on)
        if hasattr(system, "started"):
            hopeless = () if "ball" in name else (jnp.asarray(False),)
            system = system.started(*hopeless)[0]
        solved, result = newton_solve(system)
        if name == "roller: dry":
            load = solved.loads(solved.inward_shift(result.point))[0]
        else:
            load = solved.at(result.point).load
        return load, result.point.globals, result.converged

    solve = jax.jit(lambda batch, shift: jax.lax.map(lambda one: loads(one, shift), batch), static_argnums=1)
    batch = {key: jnp.asarray(values) for key, values in numbers.items()}
    here, ring, converged = (np.asarray(values) for values in solve(batch, 0))
    there, other_ring, also = (np.asarray(values) for values in solve(batch, 1))
    assert np.all(converged == also)
    assert np.sum(converged) >= 9
    scale = np.max(np.abs(here), axis=(1, 2), keepdims=True)
    good = converged[:, None, None]
    np.testing.assert_allclose(
        np.where(good, np.roll(there, -1, axis=-1) / scale, 0), np.where(good, here / scale, 0), atol=1e-9
    )
    np.testing.assert_allclose(other_ring[converged], ring[converged], rtol=1e-7, atol=1e-8)


def test_without_compilation():
    """Every operation of its own, eagerly: the same numbers as compiled."""
    structure = SMALL[0]
    numbers = structure.at(np.full((1, structure.size), 0.4))
    compiled = judge.solve_batch(structure, numbers, 1)[1]
    with jax.disable_jit():
        eager = results_of(jb.solve(structure.single_scene(single(numbers, 0))))
    for path, values in eager.items():
        if np.issubdtype(values.dtype, np.floating) and path != "residual_norm":
            scale = np.max(np.abs(values), initial=1e-300)
            np.testing.assert_allclose(compiled[path][0], values, rtol=0, atol=AGREEMENT * scale, err_msg=path)

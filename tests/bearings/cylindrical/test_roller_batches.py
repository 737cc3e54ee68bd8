"""Batches: eager = jit = vmap, failed lanes harm nobody, numbers never recompile, random operating points converge."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from roller_cases import LITRE_PER_HOUR, RPM, dry_roller, reference_roller, turbine_roller

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.steady import build_system
from jaxbearing.numerics.arrow import ArrowPoint, evaluate
from jaxbearing.numerics.precision import as_float
from jaxbearing.numerics.status import Status

SCENES = {"reference": reference_roller, "turbine": turbine_roller}
N_RESIDUALS = 20_000
N_SOLVES = 2_000


def random_operations(rng, n):
    """Table 14 of the source, logarithmic in speed and load; one in ten without oil flow."""
    speed = np.exp(rng.uniform(np.log(100.0), np.log(20_000.0), n)) * RPM
    load = np.exp(rng.uniform(np.log(200.0), np.log(50_000.0), n))
    flow = np.where(rng.uniform(size=n) < 0.1, 0.0, rng.uniform(0.0, 300.0, n)) * LITRE_PER_HOUR
    temperature = rng.uniform(60.0, 200.0, n) + 273.15
    return {
        "inner_speed": jnp.asarray(speed),
        "radial_load": jnp.asarray(load),
        "oil_flow": jnp.asarray(flow),
        "oil_temperature": jnp.asarray(temperature),
    }


@pytest.mark.slow
@pytest.mark.usefixtures("optimized")
@pytest.mark.parametrize("scene", [reference_roller, dry_roller], ids=["reference", "dry"])
def test_residual_eager_equals_jit_of_vmap_on_20000_points(scene):
    """The wrong rows of jax 0.10.2 began at index 16 384 of such a batch."""
    system = build_system(scene())
    start = system.initial()
    rng = np.random.default_rng(7)
    points = ArrowPoint(
        start.elements[None] + 0.1 * jnp.asarray(rng.normal(size=(N_RESIDUALS, *start.elements.shape))),
        start.globals[None] + 0.05 * jnp.asarray(rng.normal(size=(N_RESIDUALS, *start.globals.shape))),
    )
    at = lambda point: evaluate(system, point).residual
    eager = jax.vmap(at)(points)
    compiled = jax.jit(jax.vmap(at))(points)
    # equations are sums of terms far larger than what is left of them: rounding scales with the row
    row = lambda a: jnp.max(jnp.abs(a), axis=tuple(range(1, a.ndim)), initial=1.0, keepdims=True)
    for a, b in zip(eager, compiled, strict=True):
        assert jnp.all(jnp.abs(a - b) <= 1e-12 * jnp.abs(a) + 1e-12 * row(a))
    # a few rows, also beyond 16 384, one by one and without a batch
    for i in (0, 16_384, 19_999):
        single = at(ArrowPoint(points.elements[i], points.globals[i]))
        for a, b in zip(single, compiled, strict=True):
            scale = max(1.0, float(jnp.max(jnp.abs(a), initial=0.0)))
            np.testing.assert_allclose(a, b[i], rtol=1e-12, atol=1e-12 * scale)


@pytest.fixture(scope="module")
def operations():
    operations = random_operations(np.random.default_rng(3), N_SOLVES)
    return operations | {"radial_load": operations["radial_load"].at[5].set(-1000.0).at[11].set(jnp.nan)}


@pytest.mark.slow
@pytest.mark.parametrize("mapped", ["map", "vmap"])
def test_2000_solves_with_lanes_that_fail(operations, mapped):
    """Values and gradients of the good lanes equal single solves; a shared parameter keeps a finite gradient."""
    scene = reference_roller()
    bad = np.isin(np.arange(N_SOLVES), (5, 11))

    def total(operation, coefficient):
        solution = jb.solve(scene.at_operation(**operation).replace({"drag.coefficient": coefficient}))
        return solution.power_loss.total, solution.status

    differentiate = jax.value_and_grad(total, argnums=(0, 1), has_aux=True)
    if mapped == "vmap":
        batch = jax.vmap(differentiate, in_axes=(0, None))
    else:
        batch = lambda o, c: jax.lax.map(lambda each: differentiate(each, c), o)
    (values, status), (by_operation, by_coefficient) = jax.jit(batch)(operations, 1.2)
    assert np.all(np.asarray(status[~bad]) == Status.CONVERGED)
    assert np.all(np.asarray(status[bad]) != Status.CONVERGED)
    assert np.all(np.isnan(values[bad]))
    single = jax.jit(differentiate)
    for i in (0, 4, 6, 10, 12, 999, 1999):
        (value, _), (gradient, slope) = single({k: v[i] for k, v in operations.items()}, 1.2)
        np.testing.assert_allclose(values[i], value, rtol=1e-10)
        np.testing.assert_allclose(by_coefficient[i], slope, rtol=1e-10, atol=1e-10 * abs(value))
        for name, g in gradient.items():
            scale = abs(value / operations[name][i]) if operations[name][i] else abs(g)
            np.testing.assert_allclose(by_operation[name][i], g, rtol=1e-10, atol=1e-10 * scale)
    # `coefficient` is shared: what a failed lane sends back to it is exactly nothing
    np.testing.assert_array_equal(by_coefficient[bad], 0.0)
    for gradient in (*by_operation.values(), by_coefficient):
        assert np.all(np.isfinite(np.asarray(gradient)))


@pytest.mark.slow
def test_numbers_never_recompile():
    traces = []
    counted = jax.jit(lambda s: (traces.append(1), jb.solve(s, throw=False).power_loss.total)[1])
    scene = turbine_roller()
    scene = jax.tree.map(as_float, scene)
    for change in (
        {},
        {"operation.inner_speed": 900.0},
        {"geometry.diametral_clearance": -5e-6},
        {"drag.coefficient": 1.0, "oil.rheology.stress": 2e5, "materials.rings.youngs_modulus": 2.1e11},
    ):
        counted(jax.tree.map(as_float, scene.replace(change)))
    assert len(traces) == 1

    compiled = []
    listen = lambda event, _, fun_name="", **kwargs: compiled.append((event.rsplit("/", 1)[-1], fun_name))
    jax.monitoring.register_event_duration_secs_listener(listen)
    for speed in (700.0, 800.0, 900, np.float64(905.0), np.int64(906), jnp.asarray(907.0), jnp.asarray([908.0])[0]):
        jb.solve(turbine_roller().at_operation(inner_speed=speed))
    assert sum(entry == ("jaxpr_trace_duration", "with_roots") for entry in compiled) <= 1
    jb.solve(dry_roller().replace({"geometry.n_rollers": 37}))  # 37: in no other test, so not compiled yet
    assert sum(entry == ("jaxpr_trace_duration", "with_roots") for entry in compiled) >= 1  # the listener hears

    base = dry_roller().replace({"geometry.n_rollers": 35})
    fast = jb.jit_solver(base)
    ask = (lambda: fast(), lambda: fast(inner_speed=900.0), lambda: fast(radial_load=5e3), lambda: fast(base))
    deepest = [float(jnp.max(call().elements.load_outer)) for call in ask]
    assert sum(entry == ("jaxpr_trace_duration", "compiled") for entry in compiled) == 1
    assert deepest[0] == deepest[3]
    assert len(set(deepest)) == 3


@pytest.mark.parametrize(
    "scene",
    [SCENES["reference"], pytest.param(SCENES["turbine"], marks=pytest.mark.slow)],
    ids=SCENES.keys(),
)
def test_random_operating_points(scene):
    """60 points over Table 14 times clearance: converged, finite, closed."""
    n = 60
    rng = np.random.default_rng(11)
    operations = random_operations(rng, n)
    clearance = jnp.asarray(rng.uniform(-20e-6, 100e-6, n))

    def one(case):
        operation, gap = case
        changed = scene().at_operation(**operation).replace_geometry(diametral_clearance=gap)
        return jb.solve(changed, throw=False)

    solutions = jax.jit(lambda cases: jax.lax.map(one, cases))((operations, clearance))
    assert np.all(np.asarray(solutions.status) == Status.CONVERGED)
    assert np.max(solutions.residual_norm) <= 1e-10
    assert np.max(solutions.iterations) <= 40
    np.testing.assert_allclose(solutions.drive_power, solutions.power_loss.total, rtol=1e-8)
    for leaf in jax.tree.leaves((solutions.elements, solutions.cage, solutions.ring, solutions.stiffness)):
        assert np.all(np.isfinite(np.asarray(leaf)))


def test_failed_solve_raises_with_its_status():
    scene = reference_roller()
    object.__setattr__(scene.operation, "radial_load", np.asarray(np.nan))
    with pytest.raises(jb.SolveError, match=r"invalid_input: operation.radial_load must be > 0"):
        jb.solve(scene)
    solution = jb.solve(scene, throw=False)
    assert np.isnan(solution.power_loss.total)
    assert not solution.converged


def test_32_bit_numbers_are_refused():
    scene = reference_roller()
    with pytest.raises(TypeError, match="64-bit"):
        scene.at_operation(inner_speed=jnp.float32(1000.0))
    narrow = jax.tree.map(lambda leaf: np.float32(leaf), scene)
    with pytest.raises(TypeError, match="64-bit"):
        jb.solve(narrow)
    jax.config.update("jax_enable_x64", False)
    try:
        with pytest.raises(RuntimeError, match="64-bit"):
            jb.solve(scene)
    finally:
        jax.config.update("jax_enable_x64", True)

"""Steady temperatures of networks: check values, balances, folds, derivatives, batches, failures."""

import functools

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import brentq
from thermal_cases import (
    AMBIENT,
    CAPACITY,
    FEEDBACK,
    INLET,
    INNER,
    OUTER,
    four_nodes,
    losses_of,
    one_node,
    ring_losses,
    rings,
    six_nodes,
    viscosity,
)

from jaxbearing.numerics.status import Status
from jaxbearing.thermal.network import (
    NodeHeat,
    OilFlow,
    conductances_between,
    network_of,
    slopes_at,
    thermal_margin,
    thermal_rate,
)
from jaxbearing.thermal.point import ThermalOptions
from jaxbearing.thermal.solve import LIMIT, solve_network

DIGITS = 1e-9
"""Of printed temperatures: nine to ten digits."""

# number of nodes, mixing of the oil, feedback; temperatures; total, to the oil, to the ambient
CASES = {
    "one": (1, 1.0, 0.0, [322.0698674], (236.2370825, 178.3973478, 57.83973478)),
    "half mixed": (1, 0.5, 0.0, [318.328619], (257.501997, 207.1447591, 50.35723795)),
    "four": (
        4,
        1.0,
        0.0,
        [325.2701232, 321.9338786, 327.8017671, 320.9425938],
        (218.2997684, 155.8518766, 62.44789178),
    ),
    "six": (
        6,
        1.0,
        0.0,
        [324.2444677, 319.8919743, 326.9865224, 320.0799351, 320.586295, 314.174977],
        (223.6226694, 138.5987023, 85.02396707),
    ),
    "feedback": (
        6,
        1.0,
        0.02,
        [324.4099277, 320.0226413, 327.1720056, 320.1764493, 320.7322892, 314.2752045],
        (225.970431, None, None),
    ),
}


@jax.jit
def one_at(conductance, mixing):
    return solve_network(one_node(conductance, mixing), losses_of(1))


@jax.jit
def four_at():
    state = solve_network(four_nodes(), losses_of(4), capacity=CAPACITY[:4], options=ThermalOptions(stability=True))
    return state, slopes_at(four_nodes(), losses_of(4), state.temperatures)


@functools.partial(jax.jit, static_argnames="jacobian")
def six_at(numbers, start, factor, above, jacobian):
    def losses(temperatures):
        failed = jnp.max(temperatures) > above
        heat = jnp.where(failed, jnp.nan, losses_of(6, **numbers)(temperatures).heat)
        return NodeHeat(heat, jnp.where(failed, int(Status.NO_EQUILIBRIUM), int(Status.CONVERGED)))

    options = ThermalOptions(jacobian=jacobian)
    return solve_network(six_nodes(factor), losses, start=start, capacity=CAPACITY, options=options)


def six(
    speed=6000.0,
    f1=3e-4,
    preload=2000.0,
    feedback=0.0,
    start=INLET,
    factor=1.0,
    above=np.inf,
    jacobian="when_needed",
):
    """Six nodes. **Arguments:** `above`: temperature, K, above which the losses cannot be computed."""
    numbers = {"speed": speed, "f1": f1, "preload": preload, "feedback": feedback}
    return six_at(numbers, jnp.full(6, start), factor, above, jacobian)


def solved(speed, stability=False):
    """The six nodes with preload that grows with temperature."""
    options = ThermalOptions(stability=stability)
    return solve_network(six_nodes(), losses_of(6, speed=speed, **FEEDBACK), capacity=CAPACITY, options=options)


with_stability = jax.jit(lambda speed: solved(speed, stability=True))


def slopes_of(speed, temperatures):
    return slopes_at(six_nodes(), losses_of(6, speed=speed, **FEEDBACK), temperatures)


@jax.jit
def stability_at(speed, temperatures):
    """Jacobian, margin and rate."""
    slopes = slopes_of(speed, temperatures)
    return slopes.jacobian, thermal_margin(slopes), thermal_rate(slopes, CAPACITY)


@jax.jit
def rings_at(size, start, limit, cooling):
    """The least model of a fold. **Arguments:** `cooling`: conductance of the inner ring to the ambient, W/K."""
    network = network_of((INNER, OUTER), {(INNER, OUTER): 5.0}, {OUTER: 10.0, INNER: cooling}, AMBIENT)
    return solve_network(network, ring_losses(size), start=start, limit=limit, options=ThermalOptions(stability=True))


def two_rings(size, start=None, limit=LIMIT, cooling=0.0):
    return rings_at(size, jnp.full(2, AMBIENT) if start is None else start, limit, cooling)


def test_viscosity_of_the_check_values():
    found = [viscosity(temperature) for temperature in (343.15, 393.15)]
    np.testing.assert_allclose(found, [20.12322036, 5.687853156], rtol=DIGITS)


@pytest.mark.parametrize("name", CASES)
def test_check_values(name):
    nodes, mixing, feedback, temperatures, heats = CASES[name]
    state = {1: lambda: one_at(2.0, mixing), 4: lambda: four_at()[0], 6: lambda: six(feedback=feedback)}[nodes]()
    assert Status(int(state.status)) == Status.CONVERGED
    np.testing.assert_allclose(state.temperatures, temperatures, rtol=DIGITS)
    for found, expected in zip((state.total, state.heat_to_oil, state.heat_to_ambient), heats, strict=True):
        if expected is not None:
            np.testing.assert_allclose(found, expected, rtol=DIGITS)
    # energy closes to the tolerance of the search
    assert abs(float(state.balance_error)) < 1e-10
    np.testing.assert_allclose(state.total, state.heat_to_oil + state.heat_to_ambient, rtol=1e-10)


def test_outlet_of_a_linear_rise():
    np.testing.assert_allclose(one_at(2.0, 0.5).oil_out, 323.507238, rtol=DIGITS)


def test_large_conductances_make_one_node():
    """The flows inside, some 1e2 W, leave differences of 1e-8 K at 1e10 W/K, and round-off that hides the balances."""
    alone = one_at(3.8, 1.0)
    np.testing.assert_allclose(alone.temperatures, 320.2896349, rtol=DIGITS)
    state = six(factor=1e9)
    assert int(state.status) == Status.CONVERGED
    np.testing.assert_allclose(state.temperatures, jnp.full(6, alone.temperatures[0]), rtol=DIGITS)
    assert abs(float(state.balance_error)) < 1e-10
    # the sheet's factor, to the digits that its differences inside leave
    state = six(factor=1e7)
    np.testing.assert_allclose(state.temperatures, jnp.full(6, 320.2896349), rtol=5e-9)


@pytest.mark.parametrize(
    ("speed", "inner", "margin", "total"),
    [(4000.0, 330.7810270, 0.8278199, 315.397464), (7000.0, 359.8254256, 0.5162061, 728.091650)],
)
def test_feedback(speed, inner, margin, total):
    state = with_stability(speed)
    np.testing.assert_allclose(state.temperature(INNER), inner, rtol=DIGITS)
    np.testing.assert_allclose(state.margin, margin, rtol=1e-7)
    np.testing.assert_allclose(state.total, total, rtol=2e-9)
    assert float(state.rate) < 0
    # those that are differentiable are the same
    _, margin_there, rate_there = stability_at(speed, state.temperatures)
    np.testing.assert_allclose(margin_there, state.margin, rtol=1e-10)
    np.testing.assert_allclose(rate_there, state.rate, rtol=1e-10)


def test_rates_of_four_nodes():
    state, slopes = four_at()
    expected = [-1.302180186, -0.2190733351, -0.07961110114, -0.04403188218]
    found = np.sort(np.linalg.eigvals(np.asarray(slopes.jacobian / CAPACITY[:4, None])).real)
    np.testing.assert_allclose(found, expected, rtol=DIGITS)
    np.testing.assert_allclose(state.rate, expected[-1], rtol=DIGITS)


def test_oscillation_begins_before_the_fold():
    speed = brentq(lambda one: float(with_stability(one).rate), 8600.0, 8620.0, xtol=1e-8)
    np.testing.assert_allclose(speed, 8612.310901, rtol=DIGITS)
    state = with_stability(speed)
    np.testing.assert_allclose(state.temperature(INNER), 397.437122, rtol=2e-9)
    np.testing.assert_allclose(state.margin, 0.2414622, rtol=2e-7)
    jacobian = stability_at(speed, state.temperatures)[0]
    rates = np.linalg.eigvals(np.asarray(jacobian / CAPACITY[:, None]))
    np.testing.assert_allclose(abs(rates[np.argmax(rates.real)].imag), 1.810718e-3, rtol=5e-7)
    beyond = with_stability(9000.0)
    assert float(beyond.rate) > 0
    assert float(beyond.margin) > 0
    assert bool(beyond.unstable)
    assert beyond.sentence().endswith("unstable: a bearing would leave this state")
    assert not bool(with_stability(8600.0).unstable)
    assert "unstable" not in with_stability(8600.0).sentence()


def test_fold():
    """Bordered system: R = 0, J v = 0, v v = 1. The search finds the cool branch below, and nothing beyond."""

    def bordered(unknowns):
        temperatures, direction, speed = unknowns[:6], unknowns[6:12], unknowns[12]
        balance = lambda at: six_nodes().residual(at, losses_of(6, speed=speed, **FEEDBACK)(at))
        residual, along = jax.jvp(balance, (temperatures,), (direction,))
        return jnp.concatenate([residual, along, jnp.atleast_1d(direction @ direction - 1.0)])

    near = with_stability(9236.0)
    _, _, direction = np.linalg.svd(np.asarray(stability_at(9236.0, near.temperatures)[0]))
    unknowns = jnp.concatenate([near.temperatures, jnp.asarray(direction[-1]), jnp.asarray([9236.0])])
    step = jax.jit(lambda at: at - jnp.linalg.solve(jax.jacfwd(bordered)(at), bordered(at)))
    for _ in range(12):
        unknowns = step(unknowns)
    np.testing.assert_allclose(unknowns[12], 9237.123042, rtol=1e-10)
    expected = [473.734037, 437.669343, 494.363485, 407.175620, 452.488857, 404.522788]
    # printed to 5e-7 K; here the residual of the bordered system is 1e-12, and the housing 1.2e-6 K off
    np.testing.assert_allclose(unknowns[:6], expected, rtol=4e-9)
    total = jax.jit(lambda at: jnp.sum(losses_of(6, speed=at[12], **FEEDBACK)(at[:6]).heat))(unknowns)
    np.testing.assert_allclose(total, 2342.101847, rtol=DIGITS)
    assert abs(float(stability_at(float(unknowns[12]), unknowns[:6])[1])) < 1e-9
    # towards the fold the margin falls to 0 as the root of the distance
    below = [float(with_stability(float(unknowns[12]) - away).margin) for away in (1e-1, 1e-3)]
    np.testing.assert_allclose(below[0] / below[1], 10.0, rtol=0.01)
    for beyond in (9237.2, 9250.0, 10160.0):
        state = with_stability(beyond)
        assert Status(int(state.status)) == Status.THERMAL_RUNAWAY
        assert np.all(np.isnan(np.asarray(state.temperatures)))
        assert np.isnan(float(state.margin))
        assert float(jnp.max(state.last)) > 523.15
        assert "thermal_runaway" in state.sentence()
        assert "elements" in state.sentence()


@pytest.mark.parametrize("jacobian", ["when_needed", "never"])
def test_runaway_is_found_with_and_without_the_jacobian(jacobian):
    for speed, expected in ((9250.0, Status.THERMAL_RUNAWAY), (9000.0, Status.CONVERGED)):
        state = six(speed, **FEEDBACK, jacobian=jacobian)
        assert Status(int(state.status)) == expected
        assert int(state.derivatives) == 0 or jacobian == "when_needed"


@pytest.mark.parametrize("size", [31.25, 56.25, 61.875])
def test_least_model_of_a_fold(size):
    r"""P = {1 - 2bc -+ sqrt(1 - 4bc)}/(2 b^2 c) with b = 0.02/5, fold at c = 62.5."""
    b = 0.02 / 5.0
    root = np.sqrt(1.0 - 4.0 * b * size)
    cool, hot = ((1.0 - 2.0 * b * size + sign * root) / (2.0 * b * b * size) for sign in (-1.0, 1.0))
    state = two_rings(size)
    np.testing.assert_allclose(state.total, cool, rtol=DIGITS)
    np.testing.assert_allclose(state.margin, root, rtol=1e-8)
    start = AMBIENT + hot * jnp.asarray([1 / 5.0 + 1 / 10.0, 1 / 10.0]) + 1.0
    above = two_rings(size, start, jnp.inf)
    np.testing.assert_allclose(above.total, hot, rtol=DIGITS)
    if size == 31.25:
        np.testing.assert_allclose((state.total, above.total), (42.89321881, 1457.106781), rtol=DIGITS)
        capacity = jnp.asarray([100.0, 200.0])
        rate_at = jax.jit(lambda there: thermal_rate(slopes_at(rings(), ring_losses(size), there), capacity))
        for there, rate in ((state, -0.01944521563), (above, 0.02666091101)):
            np.testing.assert_allclose(rate_at(there.temperatures), rate, rtol=DIGITS)
        # the hot state is no state below the limit
        limited = two_rings(size, start)
        assert Status(int(limited.status)) == Status.THERMAL_RUNAWAY


def test_fold_of_the_least_model():
    state = two_rings(62.5 * (1.0 - 1e-8))
    np.testing.assert_allclose(state.total, 250.0, rtol=3e-4)
    np.testing.assert_allclose(state.temperature(INNER) - state.temperature(OUTER), 50.0, rtol=3e-4)
    np.testing.assert_allclose(state.margin, 1e-4, rtol=1e-2)
    beyond = two_rings(63.0)
    assert Status(int(beyond.status)) == Status.THERMAL_RUNAWAY


@pytest.mark.parametrize("speed", [4000.0, 7000.0, 8000.0, 9000.0, 9230.0])
def test_evaluations_from_four_starts(speed):
    states = [six(speed, **FEEDBACK, start=start) for start in (293.15, 313.15, 350.0, 400.0)]
    counts = [int(state.solves) for state in states]
    assert min(counts) >= 8
    assert max(counts) <= 15
    assert all(int(state.derivatives) == 0 for state in states)
    # near the fold a balance of 1e-11 of the loss leaves the temperatures open by its part of the margin
    spread = np.ptp([np.asarray(state.temperatures) for state in states], axis=0)
    assert np.max(spread) < (1e-9 if speed <= 8000.0 else 1e-6)


def test_losses_are_traced_once():
    """A bearing solve may stand there, which takes longer to trace and compile than to run."""
    traces = []

    def losses(temperatures):
        traces.append(1)
        return losses_of(6)(temperatures)

    jax.eval_shape(lambda: solve_network(six_nodes(), losses, options=ThermalOptions(stability=True)))
    assert len(traces) == 1


PARAMETERS = jnp.asarray([6000.0, 2000.0, 20.0, 6.0, 1.0, 313.15, 0.02])
NAMES = ("speed", "load", "flow", "conductance", "viscosity", "inlet", "feedback")


def of_parameters(parameters):
    speed, load, flow, seat, thickness, inlet, feedback = parameters
    losses = losses_of(6, speed=speed, preload=load, thickness=thickness, feedback=feedback)
    return solve_network(six_nodes(capacity_rate=flow, inlet=inlet, seat=seat), losses)


def shown(parameters):
    """Temperatures, the total loss and the heat of one node."""
    state = of_parameters(parameters)
    return jnp.concatenate([state.temperatures, jnp.stack([state.total, state.heat_to_oil, state.losses.heat[2]])])


@pytest.mark.slow
def test_derivatives_in_both_modes():
    forward, reverse = (np.asarray(mode(shown)(PARAMETERS)) for mode in (jax.jacfwd, jax.jacrev))
    np.testing.assert_allclose(reverse, forward, rtol=1e-10, atol=1e-13)
    evaluate = jax.jit(shown)
    for column, name in enumerate(NAMES):
        width = 1e-4 * float(PARAMETERS[column])
        moved = [evaluate(PARAMETERS.at[column].add(sign * width)) for sign in (1.0, -1.0)]
        difference = np.asarray(moved[0] - moved[1]) / (2.0 * width)
        size = np.max(np.abs(difference))
        np.testing.assert_allclose(forward[:, column], difference, rtol=1e-6, atol=1e-6 * size, err_msg=name)


@pytest.mark.slow
def test_second_derivatives_and_batches_of_derivatives():
    total = lambda speed: of_parameters(PARAMETERS.at[0].set(speed)).total
    second = jax.jit(jax.grad(jax.grad(total)))(6000.0)
    slope = jax.jit(jax.grad(total))
    np.testing.assert_allclose(second, (slope(6000.5) - slope(5999.5)), rtol=1e-5)
    speeds = jnp.asarray([4000.0, 6000.0])
    np.testing.assert_allclose(jax.vmap(slope)(speeds), [slope(speed) for speed in speeds], rtol=1e-12)
    together = jax.grad(lambda shift: jnp.sum(jax.vmap(lambda speed: total(speed + shift))(speeds)))(0.0)
    np.testing.assert_allclose(together, sum(slope(speed) for speed in speeds), rtol=1e-12)


@pytest.mark.slow
def test_margin_has_a_derivative_at_the_temperatures_found():
    margin = lambda speed: thermal_margin(slopes_of(speed, solved(speed).temperatures))
    slope = jax.grad(margin)(7000.0)
    width = 0.5
    difference = (margin(7000.0 + width) - margin(7000.0 - width)) / (2.0 * width)
    np.testing.assert_allclose(slope, difference, rtol=1e-5)


@pytest.mark.slow
def test_a_lane_that_runs_away_changes_no_other():
    batch = jax.jit(jax.vmap(lambda speed: solved(speed, stability=True)))
    good, mixed = batch(jnp.asarray([4000.0, 5000.0, 8000.0])), batch(jnp.asarray([4000.0, 9500.0, 8000.0]))
    assert [Status(int(one)) for one in mixed.status] == [
        Status.CONVERGED,
        Status.THERMAL_RUNAWAY,
        Status.CONVERGED,
    ]
    for before, after in zip(jax.tree.leaves(good), jax.tree.leaves(mixed), strict=True):
        np.testing.assert_array_equal(before[jnp.asarray([0, 2])], after[jnp.asarray([0, 2])])
    assert np.all(np.isnan(np.asarray(mixed.temperatures[1])))

    def sum_of_good(shift):
        state = jax.vmap(lambda speed: solved(speed + shift))(jnp.asarray([4000.0, 9500.0, 8000.0]))
        return jnp.sum(jnp.where(state.status == 0, state.total, 0.0))

    alone = sum(jax.grad(lambda speed: solved(speed).total)(speed) for speed in (4000.0, 8000.0))
    np.testing.assert_allclose(jax.grad(sum_of_good)(0.0), alone, rtol=1e-12)
    np.testing.assert_allclose(jax.jacfwd(sum_of_good)(0.0), alone, rtol=1e-12)


@pytest.mark.parametrize("jacobian", ["when_needed", "never"])
def test_failure_of_the_losses_is_that_of_the_whole(jacobian):
    """Losses that cannot be computed above 320 K, where the root is; and nowhere."""
    for above in (320.0, 300.0):
        state = six(above=above, jacobian=jacobian)
        assert Status(int(state.status)) == Status.NO_EQUILIBRIUM
        assert np.all(np.isnan(np.asarray(state.temperatures)))
        assert np.all(np.isfinite(np.asarray(state.last)))
    # a trial that fails is shortened, where the root is below
    state = six(above=330.0, jacobian=jacobian)
    assert Status(int(state.status)) == Status.CONVERGED
    np.testing.assert_allclose(state.temperatures, CASES["six"][3], rtol=DIGITS)


def test_conductances_that_come_with_the_losses():
    """A conductance that the losses add is one that the network has; its derivative is in K."""
    size, cooling = 30.0, 0.1

    def adding(temperatures):
        more = conductances_between((INNER, OUTER), {(INNER, OUTER): 2.0}) * temperatures[0] / 320.0
        heat = ring_losses(size)(temperatures).heat
        return NodeHeat(heat, between=more, to_ambient=jnp.full(2, cooling))

    @jax.jit
    def found():
        state = solve_network(rings(), adding, options=ThermalOptions(jacobian="never"))
        return state, slopes_at(rings(), adding, state.temperatures).conduction

    state, conduction = found()
    inner, outer = map(float, state.temperatures)
    between = 5.0 + 2.0 * inner / 320.0
    np.testing.assert_allclose(state.total, size * (1.0 + 0.02 * (inner - outer)) ** 2, rtol=1e-12)
    np.testing.assert_allclose(state.total, between * (inner - outer) + cooling * (inner - AMBIENT), rtol=1e-10)
    np.testing.assert_allclose(
        state.total, cooling * (inner - AMBIENT) + (10.0 + cooling) * (outer - AMBIENT), rtol=1e-10
    )
    assert abs(float(state.balance_error)) < 1e-10
    # the conductance that grows with the inner ring's temperature
    grown = 2.0 / 320.0 * (inner - outer)
    expected = [[between + cooling + grown, -between], [-between - grown, between + 10.0 + cooling]]
    np.testing.assert_allclose(conduction, expected, rtol=1e-12)


def test_a_conductance_may_be_a_function_of_the_temperature():
    inside = lambda temperature: 0.1 * jnp.ones_like(temperature)
    network = network_of((INNER, OUTER), {(INNER, OUTER): 5.0}, {OUTER: 10.0, INNER: inside}, AMBIENT)
    never = ThermalOptions(jacobian="never")
    state = jax.jit(lambda: solve_network(network, ring_losses(30.0), options=never))()
    np.testing.assert_allclose(state.temperatures, two_rings(30.0, cooling=0.1).temperatures, rtol=1e-12)


@pytest.mark.slow
def test_functions_of_a_network_may_close_over_traced_numbers():
    def total(slope):
        law = lambda temperature: 5.0 + slope * (temperature - AMBIENT)
        return solve_network(network_of(1, {}, {"bearing": law}, AMBIENT), losses_of(1)).total

    width = 1e-4
    np.testing.assert_allclose(
        jax.grad(total)(0.05), (total(0.05 + width) - total(0.05 - width)) / (2 * width), rtol=1e-6
    )


@pytest.mark.parametrize("jacobian", ["when_needed", "never"])
def test_no_loss_at_all(jacobian):
    """Heat only flows from the oil to the ambient; without a flow there is none, at rest and on the way there."""

    @jax.jit
    def state_of(rate, start):
        network = network_of(1, {}, {"bearing": 2.0}, AMBIENT, OilFlow(rate, INLET))
        nothing = lambda _: NodeHeat(jnp.zeros(1))
        return solve_network(network, nothing, start=start[None], options=ThermalOptions(jacobian=jacobian))

    with_oil = (20.0 * INLET + 2.0 * AMBIENT) / 22.0
    for rate, start, expected, rtol in (
        (20.0, INLET, with_oil, 1e-12),
        (0.0, AMBIENT, AMBIENT, 1e-14),
        (0.0, INLET, AMBIENT, 1e-12),
    ):
        state = state_of(jnp.asarray(rate), jnp.asarray(start))
        assert Status(int(state.status)) == Status.CONVERGED
        np.testing.assert_allclose(state.temperatures, expected, rtol=rtol)


def test_wrong_networks_are_refused():
    with pytest.raises(ValueError, match="no pair of nodes"):
        network_of(4, {("inner_ring", "housing"): 1.0}, {INNER: 1.0}, AMBIENT)
    with pytest.raises(ValueError, match="given twice"):
        network_of(4, {(INNER, OUTER): 1.0, (OUTER, INNER): 1.0}, {INNER: 1.0}, AMBIENT)
    with pytest.raises(ValueError, match="is not a node"):
        network_of(4, {}, {"housing": 1.0}, AMBIENT)
    with pytest.raises(ValueError, match="must be one of 1, 4, 6"):
        network_of(5, {}, {}, AMBIENT)
    with pytest.raises(ValueError, match="needs an oil flow or a conductance"):
        network_of(4, {(INNER, OUTER): 1.0}, {}, AMBIENT)
    with pytest.raises(ValueError, match="symmetric"):
        network_of(4, {(INNER, OUTER): -1.0}, {INNER: 1.0}, AMBIENT)
    with pytest.raises(ValueError, match="node named 'oil'"):
        network_of(("a", "b"), {("a", "b"): 1.0}, {}, AMBIENT, OilFlow(20.0, 300.0))
    with pytest.raises(ValueError, match="must be above 0 and at most 1"):
        OilFlow(20.0, 300.0, 0.0)
    with pytest.raises(ValueError, match="stability"):
        ThermalOptions(jacobian="never", stability=True)
    with pytest.raises(ValueError, match="a temperature for each of 6 nodes"):
        solve_network(six_nodes(), losses_of(6), start=jnp.full(4, 300.0))

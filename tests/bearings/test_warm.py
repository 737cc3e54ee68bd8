"""Bearings with a thermal network: balance, limits, derivatives, batches, and what is refused."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from warm_cases import CHANGES, NAMES, SEATS, warm

import jaxbearing as jb
from jaxbearing.bearings.bearing_life import with_life
from jaxbearing.bearings.heat import bearing_network
from jaxbearing.bearings.warm import at_temperatures
from jaxbearing.numerics.status import Status
from jaxbearing.thermal.shares import OilTemperatures
from jaxbearing.thermal.solve import UNSTABLE

SLOW = pytest.mark.slow
DISSIPATED = 1e-10
"""Largest relative difference of drive power, losses and heat that leaves."""


def balanced(solution):
    total, thermal = float(solution.power_loss.total), solution.thermal
    parts = [float(value) for name, value in vars(solution.power_loss).items() if name != "total" and value is not None]
    np.testing.assert_allclose(sum(parts), total, rtol=1e-14)
    np.testing.assert_allclose(float(solution.drive_power), total, rtol=DISSIPATED)
    np.testing.assert_allclose(float(thermal.heat_to_oil + thermal.heat_to_ambient), total, rtol=DISSIPATED)
    assert abs(float(thermal.balance_error)) <= DISSIPATED
    # heat to the ambient is what leaves along the paths that lead there
    ways = [float(value) for name, value in vars(thermal.flows).items() if value is not None and "ambient" in name]
    np.testing.assert_allclose(sum(ways), float(thermal.heat_to_ambient), rtol=1e-12)
    # what heats the nodes is the whole loss
    np.testing.assert_allclose(sum(map(float, thermal.losses().values())), total, rtol=DISSIPATED)


GIVEN = {"conductance__bearing_ambient": "20 W/K"}
"""One node with a conductance that is given; those of more nodes are computed."""


@pytest.mark.parametrize(
    ("kind", "nodes"),
    [
        ("roller", 1),
        ("roller", 4),
        ("roller", 6),
        pytest.param("ball", 4, marks=SLOW),
        pytest.param("ball", 1, marks=SLOW),
        pytest.param("ball", 6, marks=SLOW),
        *(pytest.param("tapered", nodes, marks=SLOW) for nodes in (1, 4, 6)),
    ],
)
def test_energy_closes(kind, nodes):
    scene = warm(kind, nodes, **(GIVEN if nodes == 1 else {}))
    solution = jb.solve(scene)
    balanced(solution)
    if nodes == 1:
        rise = float(solution.thermal.temperatures.bearing) - float(scene.thermal.ambient)
        np.testing.assert_allclose(solution.thermal.heat_to_ambient, 20.0 * rise, rtol=1e-12)
    assert int(solution.thermal.solves) <= 20
    assert solution.thermal.nodes == scene.thermal.node_names
    by_race = solution.rolling_by_race
    np.testing.assert_allclose(by_race.inner + by_race.outer, solution.power_loss.rolling_resistance, rtol=1e-14)
    assert float(solution.thermal.ambient) == float(scene.thermal.ambient)
    assert float(solution.thermal.oil_in) == float(scene.operation.oil_temperature)
    if nodes > 1:
        # rolling resistance is the only loss, and half of it stays in the oil
        np.testing.assert_allclose(solution.thermal.losses()["oil"], 0.5 * solution.power_loss.total, rtol=1e-9)


@SLOW
@pytest.mark.parametrize(
    ("name", "changes"),
    [
        (
            "reference_roller",
            {
                "geometry.bore": "118 mm",
                "geometry.outside_diameter": "166 mm",
                "materials.rings": "steel",
                "materials.rollers": "steel",
            },
        ),
        ("turbine_ball", {"geometry.bore": "120 mm", "geometry.outside_diameter": "190 mm"}),
        (
            "tapered_example",
            {
                "geometry.bore": "30 mm",
                "geometry.outside_diameter": "62 mm",
                "materials.rings": "52100",
                "materials.rollers": "52100",
            },
        ),
    ],
)
def test_energy_of_all_losses_closes(name, changes):
    """Elements that slide, cage, flanges and drag, each at the temperature of its own oil."""
    more = {"geometry.width": "30 mm", "oil.heat_capacity": "2150 J/(kg*K)", "thermal.nodes": "4"}
    solution = jb.solve(jb.load_scene(name, changes | more))
    balanced(solution)
    oil = solution.thermal.oil
    assert float(oil.drag) == float(solution.thermal.temperatures.oil)
    if solution.cage is not None:
        parts = [float(getattr(oil, place)) for place in ("inner_raceway", "pocket", "cage_pilot", "drag")]
        assert len(set(parts)) == len(parts)


def test_oil_temperatures_of_their_own():
    """Without a network: those of the inlet change nothing, hotter oil of one race thins the film there."""
    plain = dataclasses.replace(warm("roller", 4), thermal=None)
    inlet = float(plain.operation.oil_temperature)
    places = [field.name for field in dataclasses.fields(OilTemperatures)]
    at = lambda **own: OilTemperatures(**{name: own.get(name, inlet) for name in places})
    cold = jb.solve(plain)
    same, hot = (
        jb.solve(dataclasses.replace(plain, oil_temperatures=own)) for own in (at(), at(inner_raceway=inlet + 30.0))
    )
    for name in ("load_inner", "film_inner", "film_outer"):
        np.testing.assert_allclose(getattr(same.elements, name), getattr(cold.elements, name), rtol=1e-12)
    np.testing.assert_allclose(same.power_loss.total, cold.power_loss.total, rtol=1e-12)
    np.testing.assert_allclose(
        same.rolling_by_race.inner + same.rolling_by_race.outer, same.power_loss.rolling_resistance, rtol=1e-14
    )
    # others hang in their films
    loaded = np.asarray(cold.elements.load_inner) > 1e3
    assert np.all(np.asarray(hot.elements.film_inner)[loaded] < 0.7 * np.asarray(cold.elements.film_inner)[loaded])
    np.testing.assert_allclose(hot.elements.film_outer[loaded], cold.elements.film_outer[loaded], rtol=0.05)
    assert float(hot.rolling_by_race.inner) < 0.8 * float(same.rolling_by_race.inner)


@pytest.mark.parametrize(
    "kind", ["roller", pytest.param("sliding roller", marks=SLOW), pytest.param("sliding ball", marks=SLOW)]
)
def test_strong_cooling_is_the_isothermal_bearing(kind):
    """Conductances and an oil that takes all heat: the bearing at the temperature of the oil inlet."""
    strong = {"factor__oil": "1e11", "oil__heat_capacity": "1e15 J/(kg*K)"}
    strong |= {"factor__ambient": "0"}
    if kind == "sliding ball":
        strong |= {"fits": "none"}
    scene = warm(kind, 4, **strong)
    found, cold = jb.solve(scene), jb.solve(dataclasses.replace(scene, thermal=None))
    np.testing.assert_allclose(found.thermal.node_temperatures(), 333.15, rtol=1e-9)
    for name in ("load_inner", "film_inner", "film_outer"):
        np.testing.assert_allclose(getattr(found.elements, name), getattr(cold.elements, name), rtol=1e-9)
    np.testing.assert_allclose(found.power_loss.total, cold.power_loss.total, rtol=1e-9)
    np.testing.assert_allclose(found.stiffness, cold.stiffness, rtol=1e-9, atol=1e-9 * np.max(np.abs(cold.stiffness)))


@pytest.mark.slow
def test_six_nodes_of_one_temperature_are_one_node():
    inside = {f"factor__{name}": "1e8" for name in ("contacts", "oil", "seats")}
    six = warm("roller", 6, **inside, conductance__shaft_ambient="2 W/K", conductance__housing_ambient="3 W/K")
    six, one = jb.solve(six), warm("roller", 1, conductance__bearing_ambient="5 W/K")
    single = jb.solve(one)
    np.testing.assert_allclose(six.thermal.node_temperatures(), float(single.thermal.temperatures.bearing), rtol=1e-6)
    np.testing.assert_allclose(six.power_loss.total, single.power_loss.total, rtol=1e-6)
    np.testing.assert_allclose(six.thermal.heat_to_oil, single.thermal.heat_to_oil, rtol=1e-6)


NUMBERS = (
    "operation.inner_speed",
    "operation.axial_load",
    "operation.oil_flow",
    "operation.oil_temperature",
    "fits.shaft_interference",
    "thermal.ambient",
    "thermal.factor.oil",
    "thermal.rolling_to_oil",
)


def at_path(scene, path):
    for name in path.split("."):
        scene = getattr(scene, name)
    return float(scene)


@SLOW
def test_derivatives_through_the_temperatures():
    """Both modes against central differences, with the seats in the loop."""
    scene = warm("ball", 4, **{name.replace(".", "__"): value for name, value in SEATS.items()})
    numbers = jnp.asarray([at_path(scene, path) for path in NUMBERS])

    def outputs(scales):
        solution = jb.solve(scene.replace(dict(zip(NUMBERS, scales * numbers, strict=True))), throw=False)
        thermal = solution.thermal
        return jnp.stack(
            [thermal.temperatures.inner_ring, thermal.heat_to_oil, solution.fit.clearance / 1e-6, solution.drive_power]
        )

    solved, unit = jax.jit(outputs), np.ones(len(NUMBERS))
    forward, backward = (jax.jit(mode(outputs))(unit) for mode in (jax.jacfwd, jax.jacrev))
    np.testing.assert_allclose(forward, backward, rtol=1e-9, atol=1e-9)
    step = 1e-4
    # fourth order: the error of the second one is as large as what is asked for
    weights = {-2: 1.0 / 12.0, -1: -2.0 / 3.0, 1: 2.0 / 3.0, 2: -1.0 / 12.0}
    for i in range(len(NUMBERS)):
        found = sum(weight * solved(unit + k * step * np.eye(len(NUMBERS))[i]) for k, weight in weights.items()) / step
        np.testing.assert_allclose(forward[:, i], found, rtol=1e-6, atol=1e-6 * np.max(np.abs(found)))


@SLOW
@pytest.mark.parametrize("kind", ["sliding roller", "sliding ball"])
def test_derivatives_with_sliding(kind):
    """Both modes against central differences where traction depends on the temperatures too; the balls are on their
    seats."""
    scene = warm(kind, 4)
    names = ("operation.inner_speed", "operation.oil_flow", "operation.oil_temperature", "thermal.factor.ambient")
    names += ("fits.shaft_interference",) if scene.fits is not None else ()
    numbers = jnp.asarray([at_path(scene, path) for path in names])

    def outputs(scales):
        solution = jb.solve(scene.replace(dict(zip(names, scales * numbers, strict=True))), throw=False)
        return jnp.stack([solution.thermal.temperatures.inner_ring, solution.thermal.heat_to_oil])

    solved, unit = jax.jit(outputs), np.ones(len(names))
    slopes = jax.jit(jax.jacrev(outputs))(unit)
    direction = np.linspace(0.5, 1.0, len(names))
    along = jax.jit(lambda scales: jax.jvp(outputs, (scales,), (jnp.asarray(direction),))[1])(unit)
    np.testing.assert_allclose(along, slopes @ direction, rtol=1e-9, atol=1e-9 * np.max(np.abs(slopes)))
    step = 1e-3
    weights = {-2: 1.0 / 12.0, -1: -2.0 / 3.0, 1: 2.0 / 3.0, 2: -1.0 / 12.0}
    for i in range(len(names)):
        found = sum(weight * solved(unit + k * step * np.eye(len(names))[i]) for k, weight in weights.items()) / step
        np.testing.assert_allclose(slopes[:, i], found, rtol=1e-6, atol=1e-6 * np.max(np.abs(found)))


@pytest.mark.slow
def test_derivative_of_the_temperatures_of_rollers():
    scene = warm("roller", 1)

    def temperature(speed):
        return jb.solve(scene.at_operation(inner_speed=speed), throw=False).thermal.temperatures.bearing

    speed, step = float(scene.operation.inner_speed), 0.05
    value, slope = jax.jit(jax.value_and_grad(temperature))(speed)
    assert 300.0 < float(value) < 523.0
    solved = jax.jit(temperature)
    found = (solved(speed + step) - solved(speed - step)) / (2.0 * step)
    np.testing.assert_allclose(slope, found, rtol=1e-6)


@SLOW
def test_lanes_are_independent():
    """A lane that runs away is NaN with its own status, and changes no bit of the others."""
    scene = warm("roller", 1)
    limits = jnp.asarray([523.15, 400.0, 523.15])
    speeds = jnp.asarray([1000.0, 1100.0, 1050.0])

    def lane(limit, speed):
        changed = scene.replace({"thermal.limit": limit, "operation.inner_speed": speed})
        solution = jb.solve(changed, throw=False)
        return solution.status, solution.thermal.temperatures.bearing, solution.power_loss.total, solution.force

    batch = jax.jit(jax.vmap(lane))
    status, temperature, total, force = batch(limits, speeds)
    assert list(status) == [Status.CONVERGED, Status.THERMAL_RUNAWAY, Status.CONVERGED]
    assert np.isnan(temperature[1])
    assert np.isnan(total[1])
    assert np.all(np.isnan(force[1]))
    alone = batch(limits.at[1].set(523.15), speeds)
    for found, expected in zip((temperature, total, force), alone[1:], strict=True):
        np.testing.assert_array_equal(found[::2], expected[::2])

    def hottest(speeds):
        found = jax.vmap(lane)(limits, speeds)[1]
        return jnp.sum(jnp.where(jnp.isnan(found), 0.0, found))

    slopes = jax.jit(jax.grad(hottest))(speeds)
    assert np.all(np.isfinite(slopes))
    assert float(slopes[1]) == 0.0


def test_a_runaway_is_told():
    solution = jb.solve(warm("roller", 1, limit="100 degC", factor__ambient="0.1", **GIVEN), throw=False)
    assert int(solution.status) == Status.THERMAL_RUNAWAY
    for word in ("thermal_runaway", "the bearing, at 1", "degC", "10500 rpm", "thermal.limit"):
        assert word in solution.failure()
    assert all(np.all(np.isnan(leaf)) for leaf in jax.tree.leaves((solution.elements, solution.power_loss)))
    with pytest.raises(jb.SolveError, match="no steady state below the limit"):
        solution.raise_if_failed()


@SLOW
def test_life_takes_the_oil_of_the_races():
    """kappa is that of the hotter raceway, and the solution of the settled scene is the same."""
    scene = warm("roller", 4, rating__roughness_rings="0.2 um", rating__roughness_elements="0.2 um")
    solution = jb.solve(scene)
    settled = scene.settled(solution)
    oil, density = scene.oil.viscosity, scene.oil.density
    kinematic = lambda temperature: oil.viscosity(0.0, temperature) / density.density(temperature)
    races = (solution.thermal.oil.inner_raceway, solution.thermal.oil.outer_raceway)
    inlet = jb.solve(dataclasses.replace(scene, thermal=None))
    ratio = kinematic(max(map(float, races))) / kinematic(float(scene.operation.oil_temperature))
    np.testing.assert_allclose(solution.life.viscosity_ratio, inlet.life.viscosity_ratio * ratio, rtol=1e-12)
    again = jb.solve(settled)
    np.testing.assert_allclose(again.elements.film_inner, solution.elements.film_inner, rtol=1e-12)
    np.testing.assert_allclose(again.life.L10r, solution.life.L10r, rtol=1e-12)
    np.testing.assert_allclose(
        with_life(settled, again).life.film_ratio_inner, solution.life.film_ratio_inner, rtol=1e-12
    )


@SLOW
def test_reaction_and_stiffness_at_its_own_temperatures():
    """The stiffness is that of the bearing whose temperatures do not change."""
    scene = warm("ball", 4)
    solution = jb.solve(scene)
    held = jb.reaction(scene, solution.ring, at="ring")
    np.testing.assert_allclose(held.thermal.node_temperatures(), solution.thermal.node_temperatures(), rtol=1e-9)
    np.testing.assert_allclose(held.force[0], solution.force[0], rtol=1e-8)
    frozen = jb.solve(at_temperatures(scene, solution.thermal.node_temperatures()))
    np.testing.assert_allclose(solution.stiffness, frozen.stiffness, rtol=1e-9)


@SLOW
def test_stability():
    """Margin and rate where they are asked for. Thinner oil gives a margin above 1 with one node, and of 1 where no
    loss depends on the temperature of the oil."""
    assert float(jb.solve(warm("roller", 1, stability="true")).thermal.margin) > 1.0
    solution = jb.solve(warm("roller", 4, stability="true"))
    np.testing.assert_allclose(solution.thermal.margin, 1.0, rtol=1e-12)
    assert float(solution.thermal.rate) < 0.0
    assert not bool(solution.checks[UNSTABLE])
    plain = jb.solve(warm("roller", 4))
    assert plain.thermal.margin is None
    np.testing.assert_allclose(plain.thermal.node_temperatures(), solution.thermal.node_temperatures(), rtol=1e-10)


@SLOW
def test_given_conductances_and_factors():
    """What is given takes the place of what is computed, a factor multiplies either."""
    given = jb.solve(warm("roller", 4, conductance__outer_ring_ambient="7 W/K", factor__ambient="2"))
    flows, temperatures = given.thermal.flows, given.thermal.temperatures
    rise = float(temperatures.outer_ring) - 293.15
    np.testing.assert_allclose(flows.outer_ring_ambient, 14.0 * rise, rtol=1e-10)
    still = jb.solve(warm("roller", 4, share__drag="0.3", housing_diameter="0.25 m", housing_area="0.1 m^2"))
    balanced(still)
    assert float(still.thermal.flows.outer_ring_ambient) > 0.0


def test_oil_without_a_flow():
    """Grease: no heat leaves with it."""
    solution = jb.solve(warm("roller", 1, operation__oil_flow="0 l/h", **GIVEN))
    assert float(solution.thermal.heat_to_oil) == 0.0
    balanced(solution)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"thermal.nodes": "3"}, ("thermal.nodes: found the number 3; expected one of 1, 4, 6",)),
        ({"oil.heat_capacity": "none"}, ("oil.heat_capacity: found nothing", "[thermal] needs")),
        ({"geometry.width": "none"}, ("geometry.width: found nothing", "[thermal]")),
        ({"contact.rolling_resistance": "none"}, ("the scene has no losses; expected an oil and a [contact]",)),
        ({"thermal.stability": "true", "thermal.jacobian": "never"}, ("thermal.stability", "when_needed")),
        ({"thermal.housing_area": "0.1 m^2"}, ("thermal.housing_diameter: found nothing",)),
        ({"temperatures.inner_ring": "80 degC", "temperatures.outer_ring": "80 degC"}, ("beside [thermal]",)),
        ({"thermal.share.drag": "1.5"}, ("thermal.share.drag", "between 0 and 1")),
        (
            {"materials.rings": "{youngs_modulus = '210 GPa', poisson_ratio = 0.3, density = '7850 kg/m^3'}"},
            ("materials.rings.conductivity: found nothing", "materials.rings.heat_capacity: found nothing"),
        ),
    ],
)
def test_what_is_refused(changes, words):
    with pytest.raises(jb.SceneError) as caught:
        jb.load_scene(NAMES["roller"], CHANGES["roller"] | {"thermal.nodes": "4"} | changes)
    assert all(word in str(caught.value) for word in words), caught.value


def test_a_run_of_rollers_and_cage_has_no_network():
    """A network makes a run one of temperatures, whose solvers are those of stiff equations."""
    network = {
        "oil.heat_capacity": "2150 J/(kg*K)",
        "thermal.nodes": "1",
        "thermal.conductance.bearing_ambient": "5 W/K",
    }
    with pytest.raises(ValueError, match=r"simulation\.solver: found 'tsit5'; expected one of .* beside \[thermal\]"):
        jb.load_scene("turbine_roller_dynamic", network)


def test_network_of_a_scene():
    scene = warm("ball", 6, mixing="0.5", oil_inlet="50 degC")
    network = bearing_network(scene)
    flow = float(scene.operation.oil_flow) * float(scene.oil.density.density(323.15)) * 2150.0
    np.testing.assert_allclose(network.oil.capacity_rate, flow, rtol=1e-12)
    assert float(network.oil.inlet) == 323.15
    assert float(network.oil.mixing) == 0.5


@SLOW
def test_loads_without_an_equilibrium_are_told():
    """The bearing itself has none, whatever its temperatures; the numbers of the reason are there."""
    scene = warm("tapered", 4, operation__radial_load="5 kN", operation__axial_load="100 N")
    solution = jb.solve(scene, throw=False)
    assert int(solution.status) == Status.NO_EQUILIBRIUM
    assert "the axial load of 100 N must be at least" in solution.failure()
    assert "nan" not in solution.failure()
    assert all(np.all(np.isnan(leaf)) for leaf in jax.tree.leaves(solution.elements))

"""The drag coefficient that nobody knows: its assumed distribution in tolerances and sensitivities."""

import dataclasses

import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import solution_of

import jaxbearing as jb
from jaxbearing.bearings.priors import DRAG, SUPPLY_FIELD, drag_prior
from jaxbearing.sensitivity import power_interval
from jaxbearing.tolerance.delta import spreads_of
from jaxbearing.tolerance.derivatives import Slopes
from jaxbearing.tolerance.scatter import scatter_of, scatter_of_source

PATH = "drag.coefficient"


def test_priors_are_those_of_the_sheet():
    """Rollers 0.3, 0.9, at most 1.2: 90 % from 0.07 to 1.3 before it is cut off; balls 0.2, 0.9, 0.66."""
    roller, ball = DRAG["roller"], DRAG["ball"]
    assert (roller.median, roller.log_deviation, roller.high) == (0.3, 0.9, 1.2)
    assert (ball.median, ball.log_deviation, ball.high) == (0.2, 0.9, 0.66)
    uncut = jb.Distribution.lognormal(0.3, 0.9).quantiles(np.array([0.05, 0.95]))
    np.testing.assert_allclose(uncut, [0.068, 1.318], rtol=5e-3)


@pytest.mark.parametrize("name", ["turbine_roller", "tapered_example"])
def test_rollers_scatter_by_default(name):
    scatter = scatter_of(jb.load_scene(name))
    assert scatter.fields == {PATH: DRAG["roller"]}
    assert "assumed: lognormal, median 0.3" in scatter.origins[PATH]
    # the scene has the median: nothing changes at the nominal values
    assert scatter.means == {PATH: 0.3}
    assert not scatter.notes


def test_another_coefficient_gives_way_and_this_is_said():
    scatter = scatter_of(jb.load_scene("reference_roller"))
    assert scatter.means[PATH] == 0.3
    assert "the scene's 1.2 gives way" in scatter.notes[0]
    assert "--no-drag-prior" in scatter.notes[0]


def test_an_assumed_level_of_the_supply_scatters():
    """By a factor of 3, beside the drag; a number of the user's does not."""
    bath = {"contact.supply.level": "bath", "contact.rolling_resistance": "full_range"}
    scene = jb.load_scene("tapered_example", bath)
    scatter = scatter_of(scene)
    assert scatter.fields[SUPPLY_FIELD] == jb.Distribution.lognormal(10.0, np.log(3.0))
    assert scatter.origins[SUPPLY_FIELD] == "assumed: lognormal, median 10, log deviation 1.1"
    assert set(scatter.fields) == {PATH, SUPPLY_FIELD}
    assert scatter.scene.contact.supply.level is None
    assert float(scatter.scene.contact.supply.gap_over_central) == 10.0
    np.testing.assert_allclose(scatter.fields[SUPPLY_FIELD].quantiles(np.array([0.5])), 10.0, rtol=1e-12)
    assert scatter_of_source("tapered_example", bath)[1].fields == scatter.fields
    own = jb.Distribution.lognormal(5.0, 0.5)
    assert scatter_of(scene, {SUPPLY_FIELD: own}).fields[SUPPLY_FIELD] == own
    given = jb.load_scene("tapered_example", {"contact.supply.gap_over_central": "10"})
    assert SUPPLY_FIELD not in scatter_of(given).fields


def test_it_can_be_switched_off_and_replaced():
    scene = jb.load_scene("tapered_example")
    with pytest.raises(ValueError, match="no field that scatters"):
        scatter_of(scene, drag_prior=False)
    with pytest.raises(ValueError, match="no field that scatters"):
        scatter_of_source("tapered_example", drag_prior=False)
    own = jb.Distribution(0.4, 0.1)
    scatter = scatter_of(scene, {PATH: own})
    assert scatter.fields == {PATH: own}
    assert PATH not in scatter.origins


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("deep_groove_6205", {}),
        ("turbine_roller", {"drag": "none"}),
        ("turbine_roller", {"drag.coefficient": "0"}),
        ("turbine_ball", {}),
        ("two_disk_etm", {}),
    ],
)
def test_scenes_without_a_coefficient_have_none(name, changes):
    assert drag_prior(jb.load_scene(name, changes)) is None


def test_balls_that_leave_it_to_the_law_say_so():
    over = {"operation.radial_load": {"mean": 1e3, "deviation": 10.0}}
    scene = jb.load_scene("turbine_ball", {"operation.radial_load": "1 kN", "operation.moment": "0 N*m"})
    assert any("isolated ball" in note for note in scatter_of(scene, over).notes)
    with_number = jb.load_scene("turbine_ball", {PATH: "0.4"})
    assert scatter_of(with_number).fields == {PATH: DRAG["ball"]}


# the interval of a loss that is linear in the coefficient is that of the distribution


def linear(scene, base=700.0, slope=2260.0):
    """Results of a made up solve whose loss is 700 W + 2260 W per unit of the coefficient, with 1 W per N of load."""
    solution = solution_of(scene)

    def evaluated(numbers):
        load = numbers.get("operation.radial_load", 25e3) - 25e3
        value = jnp.asarray(base + slope * numbers[PATH] + load)
        slopes = {PATH: jnp.asarray(slope), "operation.radial_load": jnp.asarray(1.0)}
        return Slopes(solution, {"power_loss.total": value}, {"power_loss.total": slopes})

    return evaluated


def test_likely_limits_are_exact_quantiles_of_a_linear_loss():
    scene = jb.load_scene("reference_roller")
    scatter, evaluated = scatter_of(scene), linear(scene)
    spread = spreads_of(scatter, ("power_loss.total",), evaluated(scatter.means), evaluated)[0]["power_loss.total"]
    low, high = 700.0 + 2260.0 * DRAG["roller"].quantiles(np.array([0.05, 0.95]))
    np.testing.assert_allclose(spread.likely, (low, high), rtol=1e-4)
    np.testing.assert_allclose(spread.value, 700.0 + 2260.0 * 0.3, rtol=1e-12)
    np.testing.assert_allclose(spread.mean, 700.0 + 2260.0 * DRAG["roller"].mean, rtol=1e-12)
    np.testing.assert_allclose(spread.deviation, 2260.0 * DRAG["roller"].deviation, rtol=1e-12)
    assert spread.contributions == {PATH: 1.0}
    assert spread.worst_high == pytest.approx(700.0 + 2260.0 * 1.2)


def test_likely_limits_of_a_sum():
    scene = jb.load_scene("reference_roller")
    load = jb.Distribution(25e3, 500.0)
    scatter, evaluated = scatter_of(scene, {"operation.radial_load": load}), linear(scene)
    spread = spreads_of(scatter, ("power_loss.total",), evaluated(scatter.means), evaluated)[0]["power_loss.total"]
    random = np.random.default_rng(3)
    drag = DRAG["roller"].samples(random.standard_normal(400_000), random.random(400_000))
    sampled = 700.0 + 2260.0 * drag + 500.0 * random.standard_normal(400_000)
    np.testing.assert_allclose(spread.likely, np.quantile(sampled, (0.05, 0.95)), rtol=1e-2)
    np.testing.assert_allclose(sum(spread.contributions.values()), 1.0, rtol=1e-12)


def test_normal_fields_have_normal_limits():
    scene = jb.load_scene("reference_roller")
    scatter = scatter_of(scene, {"operation.radial_load": jb.Distribution(25e3, 500.0)}, drag_prior=False)
    evaluated = linear(scene, slope=0.0)
    found = lambda numbers: evaluated({PATH: 0.3} | dict(numbers))
    spread = spreads_of(scatter, ("power_loss.total",), found(scatter.means), found)[0]["power_loss.total"]
    np.testing.assert_allclose(spread.likely, 700.0 + 500.0 * 1.6448536 * np.array([-1.0, 1.0]), rtol=1e-4)


def test_interval_is_that_of_two_more_solves():
    scene = jb.load_scene("reference_roller")
    made = solution_of(scene)

    def solver(one):
        total = jnp.asarray(700.0 + 2260.0 * float(one.drag.coefficient))
        return dataclasses.replace(made, power_loss=dataclasses.replace(made.power_loss, total=total))

    found = power_interval(scene, solver(scene), solver)
    expected = 700.0 + 2260.0 * DRAG["roller"].quantiles(np.array([0.05, 0.95]))
    np.testing.assert_allclose((found.low, found.high), expected, rtol=1e-12)
    np.testing.assert_allclose(found.value, 700.0 + 2260.0 * 1.2, rtol=1e-12)
    assert found.by == PATH
    dry = jb.load_scene("reference_roller", {"drag": "none"})
    assert power_interval(dry, made, solver) is None
    failed = lambda one: dataclasses.replace(made, status=jnp.asarray(2))
    assert power_interval(scene, made, failed) is None

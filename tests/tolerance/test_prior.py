"""The drag coefficient that nobody knows: its assumed distribution in tolerances and sensitivities."""

import dataclasses

import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import solution_of
from rich.console import Console

import jaxbearing as jb
from jaxbearing.bearings.priors import DRAG, SUPPLY_FIELD, drag_prior
from jaxbearing.loss_interval import power_interval
from jaxbearing.report.sensitivity_table import print_sensitivities
from jaxbearing.sensitivity import Sensitivities
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


def made_up(scene, loss):
    """A solver whose loss is a function of the scene, W."""
    made = solution_of(scene)
    total = lambda one: dataclasses.replace(made.power_loss, total=jnp.asarray(loss(one)))
    return lambda one: dataclasses.replace(made, power_loss=total(one))


def test_interval_by_the_drag_alone():
    scene = jb.load_scene("reference_roller")
    solver = made_up(scene, lambda one: 700.0 + 2260.0 * float(one.drag.coefficient))
    found = power_interval(scene, solver(scene), solver)
    expected = 700.0 + 2260.0 * DRAG["roller"].quantiles(np.array([0.05, 0.95]))
    np.testing.assert_allclose((found.low, found.high), expected, rtol=1e-12)
    np.testing.assert_allclose(found.value, 700.0 + 2260.0 * 1.2, rtol=1e-12)
    assert found.by == PATH
    assert [part.path for part in found.parts] == [PATH]
    assert power_interval(scene, solver(scene), solver, drag_prior=False) is None
    dry = jb.load_scene("reference_roller", {"drag": "none"})
    assert power_interval(dry, solver(scene), solver) is None
    failed = lambda one: dataclasses.replace(solver(one), status=jnp.asarray(2))
    assert power_interval(scene, solver(scene), failed) is None
    own = {PATH: jb.Distribution(0.4, 0.1)}
    replaced = power_interval(scene, solver(scene), solver, own)
    np.testing.assert_allclose((replaced.low, replaced.high), 1604.0 + 226.0 * 1.6448536 * np.array([-1.0, 1.0]))


LUBRICATED = {
    "oil": "none",
    "oil.grade": "ISO VG 68",
    "contact.traction": "elsharkawy_hamrock",
    "contact.rolling_resistance": "full_range",
    "contact.supply.level": "bath",
}
OF_OIL = ("oil.viscosity.pressure_coefficient", "oil.rheology.stress_ratio", "oil.rheology.shear_modulus_ratio")


def lubricated():
    """A scene with all priors: drag, supply level, and those of its oil."""
    return jb.load_scene("tapered_example", LUBRICATED), jb.load_distributions("tapered_example", LUBRICATED)


def test_interval_by_drag_supply_and_oil_together():
    """A loss that is a sum of parts, each with one input, against samples."""
    scene, given = lubricated()
    assert set(given) == set(OF_OIL)

    def loss(one):
        supply = one.contact.supply
        gap = 10.0 if supply.gap_over_central is None else float(supply.gap_over_central)
        alpha, stress = float(one.oil.viscosity.pressure_coefficient), float(one.oil.rheology.stress_ratio)
        ratio = float(one.oil.rheology.shear_modulus_ratio)
        drag = float(one.drag.coefficient)
        return parts(drag, gap, 1e9 * alpha, stress, ratio).sum(axis=0)

    def parts(drag, gap, alpha, stress, ratio):
        return np.array([300.0 * drag, 200.0 * gap / (gap + 10.0), 20.0 * alpha, 2000.0 * stress, 100.0 * ratio])

    solver = made_up(scene, loss)
    found = power_interval(scene, solver(scene), solver, given)
    assert {part.path for part in found.parts} == {PATH, SUPPLY_FIELD, *OF_OIL}
    random, size = np.random.default_rng(5), 400_000
    inputs = (DRAG["roller"], jb.Distribution.lognormal(10.0, np.log(3.0)), *(given[path] for path in OF_OIL))
    drawn = [one.samples(random.standard_normal(size), random.random(size)) for one in inputs]
    drawn[2] = 1e9 * drawn[2]
    sampled = parts(*drawn).sum(axis=0)
    np.testing.assert_allclose((found.low, found.high), np.quantile(sampled, (0.05, 0.95)), rtol=4e-3)
    assert found.by == PATH
    alone = [found.value + 200.0 * (gap / (gap + 10.0) - 0.5) for gap in inputs[1].quantiles(np.array([0.05, 0.95]))]
    supply = next(part for part in found.parts if part.path == SUPPLY_FIELD)
    np.testing.assert_allclose((supply.low, supply.high), alone, rtol=1e-12)
    assert supply.assumed == "assumed: lognormal, median 10, log deviation 1.1"
    stress = next(part for part in found.parts if part.path == "oil.rheology.stress_ratio")
    assert stress.assumed == "uniform, 0.04 to 0.1"
    without = power_interval(scene, solver(scene), solver, given, drag_prior=False)
    assert PATH not in {part.path for part in without.parts}
    assert without.high - without.low < found.high - found.low
    assert [part["path"] for part in found.as_dict()["parts"]] == [part.path for part in found.parts]


def test_a_loss_that_no_input_moves():
    scene, given = lubricated()
    solver = made_up(scene, lambda one: 700.0)
    found = power_interval(scene, solver(scene), solver, given)
    np.testing.assert_allclose((found.low, found.high), 700.0, rtol=1e-12)


def test_the_screen_names_the_largest_and_each_alone(capsys):
    scene, given = lubricated()
    solver = made_up(scene, lambda one: 700.0 + 300.0 * float(one.drag.coefficient))
    screen = Console(width=100)
    print_sensitivities(Sensitivities(), screen, power_interval(scene, solver(scene), solver, given))
    said = " ".join(capsys.readouterr().out.split())
    assert "90 % between" in said
    assert f"mostly by {PATH}. By each input alone:" in said
    assert "not counted: geometry, operation, errors of the laws)" in said
    assert f"{PATH}: between" in said
    assert f"{SUPPLY_FIELD}, {OF_OIL[0]}" in said
    assert "less than 1" in said

"""Fields that scatter together: a posterior in the delta method, in samples and in files."""

import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import solution_of

import jaxbearing as jb
from jaxbearing.distribution import SIGMAS
from jaxbearing.joint import JointDistribution
from jaxbearing.report.joint_file import read_joint, write_joint
from jaxbearing.tolerance.delta import spreads_of
from jaxbearing.tolerance.derivatives import Slopes
from jaxbearing.tolerance.monte_carlo import cases_of
from jaxbearing.tolerance.outcome import Tolerances
from jaxbearing.tolerance.scatter import scatter_of, scatter_of_source
from jaxbearing.tolerance.verb import posterior_of

DRAG, LOAD, FLOW = "drag.coefficient", "operation.radial_load", "operation.oil_flow"
POWER = "power_loss.total"
SEVERAL = np.array([0.3, 25e3, 4e-5]), np.array([True, False, True])
ROOT = np.array([[0.4, 0.0, 0.0], [150.0, 400.0, 0.0], [-0.3, 0.05, 0.1]])
COVARIANCE = ROOT @ ROOT.T


def joint(fields=(DRAG, LOAD, FLOW), covariance=COVARIANCE, samples=None):
    return JointDistribution(tuple(fields), *SEVERAL, covariance, samples)


def drawn(count=400_000):
    """Independent of the package: SI values by the root of the covariance."""
    offsets = np.random.default_rng(3).standard_normal((count, 3)) @ ROOT.T
    centre, positive = SEVERAL
    return np.where(positive, centre * np.exp(np.where(positive, offsets, 0.0)), centre + offsets)


def test_moments_of_values_are_those_of_samples():
    values = drawn()
    np.testing.assert_allclose(np.diag(joint().of_values), np.var(values, axis=0), rtol=2e-2)
    expected = np.corrcoef(values.T)
    size = np.sqrt(np.diag(joint().of_values))
    np.testing.assert_allclose(joint().of_values / np.outer(size, size), expected, atol=5e-3)
    for path, one in joint().marginals.items():
        place = joint().fields.index(path)
        np.testing.assert_allclose(one.deviation**2, joint().of_values[place, place], rtol=1e-9)


def test_axes_make_the_covariance_and_do_not_depend_on_units():
    axes = joint().axes
    np.testing.assert_allclose(axes.T @ axes, COVARIANCE, rtol=1e-9, atol=1e-12)
    assert len(axes) == 3
    units = np.array([1.0, 1e-3, 1.0])
    other = JointDistribution(joint().fields, SEVERAL[0] * units, SEVERAL[1], COVARIANCE * np.outer(units, units))
    np.testing.assert_allclose(np.abs(other.axes), np.abs(axes * units), rtol=1e-9, atol=1e-15)
    # two fields of which only the product is told
    bound = np.array([[0.81, -0.81, 0.0], [-0.81, 0.81, 0.0], [0.0, 0.0, 0.01]])
    assert len(JointDistribution(joint().fields, np.ones(3), np.ones(3, bool), bound).axes) == 2


def test_random_values_have_the_covariance_and_a_longer_run_begins_the_same():
    values = joint().draws(np.random.default_rng(0), 200_000)
    np.testing.assert_allclose(np.cov(np.log(values[:, [0, 2]]).T), COVARIANCE[np.ix_([0, 2], [0, 2])], rtol=2e-2)
    np.testing.assert_allclose(np.corrcoef(values.T), np.corrcoef(drawn().T), atol=1e-2)
    assert np.array_equal(joint().draws(np.random.default_rng(0), 50), values[:50])
    rows = drawn(20)
    sampled = JointDistribution.of_samples(joint().fields, rows, SEVERAL[1])
    chosen = sampled.draws(np.random.default_rng(0), 300)
    assert {tuple(row) for row in chosen} <= {tuple(row) for row in rows}
    assert np.array_equal(sampled.draws(np.random.default_rng(0), 7), chosen[:7])


def test_samples_have_their_covariance():
    found = JointDistribution.of_samples(joint().fields, drawn(), SEVERAL[1])
    np.testing.assert_allclose(found.centre, SEVERAL[0], rtol=5e-3)
    np.testing.assert_allclose(found.covariance, COVARIANCE, rtol=2e-2, atol=1e-4 * 400.0)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"fields": (DRAG, DRAG, FLOW)}, "different paths"),
        ({"covariance": np.eye(2)}, "covariance: found the shape"),
        ({"covariance": COVARIANCE * np.nan}, "not finite"),
        ({"covariance": np.array([[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]])}, "no covariance|not symmetric"),
        ({"samples": np.ones((5, 2))}, "samples: found the shape"),
        ({"samples": -np.ones((5, 3))}, "<= 0"),
    ],
)
def test_what_is_no_distribution_is_refused(change, said):
    with pytest.raises(ValueError, match=said):
        joint(**change)


def evaluated(scene, law, slopes):
    """Results of a made up solve whose loss is a function of the numbers."""
    solution = solution_of(scene)

    def at(numbers):
        value = jnp.asarray(law(*(numbers[path] for path in joint().fields)))
        return Slopes(solution, {POWER: value}, {POWER: {path: jnp.asarray(slopes[path]) for path in joint().fields}})

    return at


def spread_of(law, slopes, **more):
    scene = jb.load_scene("reference_roller")
    scatter = scatter_of(scene, posterior=joint(**more))
    at = evaluated(scene, law, slopes)
    return scatter, spreads_of(scatter, (POWER,), at(scatter.means), at)[0][POWER]


def test_linear_loss_has_the_variance_of_the_covariance():
    slopes = {DRAG: 2260.0, LOAD: 0.4, FLOW: 1e7}
    law = lambda drag, load, flow: 700.0 + 2260.0 * drag + 0.4 * load + 1e7 * flow
    scatter, spread = spread_of(law, slopes)
    assert set(scatter.fields) == {DRAG, LOAD, FLOW}
    assert scatter.origins[DRAG] == "posterior"
    along = np.array([slopes[path] for path in joint().fields])
    np.testing.assert_allclose(spread.deviation**2, along @ joint().of_values @ along, rtol=1e-10)
    np.testing.assert_allclose(sum(spread.contributions.values()), 1.0, rtol=1e-12)
    means = drawn() @ along + 700.0
    np.testing.assert_allclose(spread.mean, means.mean(), rtol=2e-3)
    # the drag and the flow move the loss against each other
    alone = sum((slopes[path] * one.deviation) ** 2 for path, one in scatter.fields.items())
    assert spread.deviation**2 < alone
    np.testing.assert_allclose(spread.likely, np.quantile(means, (0.05, 0.95)), rtol=3e-2)


def test_a_loss_of_the_product_alone_is_as_sure_as_the_product():
    """Two factors known to 0.9, their product to 0.1: a wide posterior with a narrow loss."""
    wide, narrow = 0.9, 0.1
    covariance = np.diag([wide**2, 1.0, wide**2])
    covariance[0, 2] = covariance[2, 0] = 0.5 * narrow**2 - wide**2
    law = lambda drag, load, flow: 700.0 * drag * flow / (0.3 * 4e-5) + 0.0 * load
    slopes = {DRAG: 700.0 / 0.3, LOAD: 0.0, FLOW: 700.0 / 4e-5}
    _, spread = spread_of(law, slopes, covariance=covariance)
    expected = 700.0 * np.exp(narrow * 1.6448536 * np.array([-1.0, 1.0]))
    np.testing.assert_allclose(spread.likely, expected, rtol=1e-2)
    # worst cases are three deviations along the direction that moves the loss, not both limits at once
    assert spread.worst_high < 700.0 * np.exp(1.1 * SIGMAS * narrow)


def test_samples_of_a_scene_are_those_of_the_posterior():
    scene = jb.load_scene("reference_roller")
    rows = drawn(40)
    posterior = JointDistribution.of_samples(joint().fields, rows, SEVERAL[1])
    cases = cases_of(scatter_of(scene, posterior=posterior), 30, seed=1)
    columns = dict(zip(cases.paths, cases.values, strict=True))
    found = {tuple(row) for row in np.stack([columns[path] for path in posterior.fields], axis=1)}
    assert found <= {tuple(row) for row in rows}
    # independent fields keep the samples that they had
    over = {"geometry.pitch_diameter": jb.Distribution(142e-3, 1e-5)}
    with_it, without = (cases_of(scatter_of(scene, over, **more), 30, 1) for more in ({"posterior": posterior}, {}))
    assert "geometry.pitch_diameter" in with_it.paths
    assert len(without.values[0]) == 30


def test_fields_that_a_scene_lacks_are_left_out_and_named():
    wider = JointDistribution((DRAG, "geometry.contact_angle"), np.array([0.3, 0.5]), np.ones(2, bool), np.eye(2))
    scatter = scatter_of(jb.load_scene("reference_roller"), posterior=wider)
    assert scatter.together == (DRAG,)
    assert any("does not have geometry.contact_angle" in note for note in scatter.notes)
    with pytest.raises(ValueError, match=r"none of its fields geometry\.contact_angle"):
        scatter_of(jb.load_scene("reference_roller"), posterior=wider.only(["geometry.contact_angle"]))
    with pytest.raises(ValueError, match="a distribution and a posterior"):
        scatter_of(jb.load_scene("reference_roller"), {DRAG: jb.Distribution(0.3, 0.1)}, posterior=joint())


def test_posterior_prevails_over_the_file():
    given = {DRAG: '{mean = 0.5, deviation = 0.01, shape = "normal"}'}
    _, scatter = scatter_of_source("reference_roller", given, posterior=joint())
    assert scatter.fields[DRAG] == joint().marginals[DRAG]
    assert scatter.means[DRAG] == 0.3


def test_file_keeps_all(tmp_path):
    units = {DRAG: "1", LOAD: "N", FLOW: "m^3/s"}
    for samples in (None, drawn(12)):
        write_joint(joint(samples=samples), units, tmp_path / "a.nc", "Calibration of x")
        again = posterior_of(tmp_path / "a.nc")
        assert again.fields == joint().fields
        np.testing.assert_array_equal(again.covariance, COVARIANCE)
        np.testing.assert_array_equal(again.centre, SEVERAL[0])
        np.testing.assert_array_equal(again.positive, SEVERAL[1])
        assert (again.samples is None) == (samples is None)
    np.testing.assert_array_equal(again.samples, drawn(12))


def test_other_files_are_refused(tmp_path):
    with pytest.raises(ValueError, match=r"no.nc: cannot be read"):
        read_joint(tmp_path / "no.nc")
    (tmp_path / "text.nc").write_text("no file of NetCDF", encoding="utf-8")
    with pytest.raises(ValueError, match=r"text.nc: "):
        read_joint(tmp_path / "text.nc")


def test_picture_of_negative_shares(tmp_path):
    """Two factors whose product alone is told: one of them takes more than all of the variance."""
    covariance = np.diag([0.81, 1.0, 0.01])
    covariance[0, 2] = covariance[2, 0] = -0.085
    law = lambda drag, load, flow: 700.0 * drag * flow / (0.3 * 4e-5) + 0.0 * load
    slopes = {DRAG: 700.0 / 0.3, LOAD: 0.0, FLOW: 700.0 / 4e-5}
    scatter, spread = spread_of(law, slopes, covariance=covariance)
    assert min(spread.contributions.values()) < 0.0
    np.testing.assert_allclose(sum(spread.contributions.values()), 1.0, rtol=1e-12)
    solution = solution_of(jb.load_scene("reference_roller"))
    units = {DRAG: "1", LOAD: "N", FLOW: "m^3/s"}
    found = Tolerances(scatter.fields, units, scatter.origins, {POWER: spread}, None, (), solution)
    jb.plots.tolerances(found).savefig(tmp_path / "a.png")

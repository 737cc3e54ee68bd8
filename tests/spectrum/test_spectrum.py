"""Load spectra of solved scenes: against plain solves, failed states, gradients, refusals."""

import jax
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.rating import Rating
from jaxbearing.spectrum.tables import spectrum_facts

LOADS = {"cruise": 15e3, "start": 40e3}
RATING = Rating(viscosity_ratio=1.5, contamination_factor=0.5)


@pytest.fixture(scope="module")
def scene():
    dry = dict.fromkeys(("contact", "cage", "flange", "drag"))
    return jb.load_scene("reference_roller").replace(dry | {"rating": RATING})


def state(name, share, load, speed=628.0):
    return jb.State(name, share, {"operation.radial_load": load, "operation.inner_speed": speed})


@pytest.fixture(scope="module")
def plain(scene):
    return {
        name: jb.solve(scene.at_operation(radial_load=load, inner_speed=628.0)).life for name, load in LOADS.items()
    }


def test_one_state_is_the_plain_life(scene, plain):
    found = jb.solve_spectrum(scene, [state("cruise", 1.0, LOADS["cruise"])])
    for name in ("L10r", "L10r_hours", "Lnmr", "Lnmr_hours", "L10", "L10h", "L10m", "L10mh", "equivalent_load"):
        np.testing.assert_allclose(getattr(found.life, name), getattr(plain["cruise"], name), rtol=1e-12)
    assert found.governing == "cruise"
    np.testing.assert_array_equal(found.life.damage, [1.0])


def test_two_states(scene, plain):
    """Two equal states are one; two others are Palmgren's and Miner's sum of plain solves."""
    equal = jb.solve_spectrum(scene, [state(name, 0.5, LOADS["cruise"]) for name in ("a", "b")])
    np.testing.assert_allclose(equal.life.Lnmr_hours, plain["cruise"].Lnmr_hours, rtol=1e-10)
    np.testing.assert_allclose(equal.life.damage, [0.5, 0.5], rtol=1e-10)
    found = jb.solve_spectrum(scene, [state("cruise", 0.9, 15e3), state("start", 0.1, 40e3)])
    for name in ("Lnmr_hours", "L10r_hours", "L10h", "L10mh"):
        lives = [float(getattr(plain[one], name)) for one in LOADS]
        np.testing.assert_allclose(getattr(found.life, name), 1.0 / (0.9 / lives[0] + 0.1 / lives[1]), rtol=1e-10)
    damage = 0.1 / float(plain["start"].Lnmr_hours) * float(found.life.Lnmr_hours)
    np.testing.assert_allclose(found.life.damage, [1.0 - damage, damage], rtol=1e-9)
    assert found.governing == ("start" if damage > 0.5 else "cruise")
    np.testing.assert_allclose(found["start"].life.L10r, plain["start"].L10r, rtol=1e-10)
    with pytest.raises(KeyError, match="no state 'stop'"):
        found["stop"]


def test_a_state_that_yields_is_named_before_the_life(scene):
    """4 GPa is the limit of line contacts; the raw life stays what the formulas give."""
    found = jb.solve_spectrum(scene, [state("cruise", 0.9, 15e3), state("start", 0.1, 1e6)])
    (name, said), *others = spectrum_facts(found)
    assert (name, said.count("cruise:"), said.count("start:")) == ("Overload", 0, 1)
    assert all(text.startswith("none, because it yields") for title, text in others if title == "Life")
    assert float(found.life.L10r) > 0.0
    fine = dict(spectrum_facts(jb.solve_spectrum(scene, [state("cruise", 1.0, 15e3)])))
    assert "Overload" not in fine
    assert "none" not in fine["Life"]


def test_a_state_that_fails_is_named_and_there_is_no_life():
    """Too little axial load to hold the cone in the cup."""
    dry = dict.fromkeys(("contact", "rib", "drag", "oil"))
    scene = jb.load_scene("tapered_example").replace(dry | {"rating": RATING})
    states = [jb.State("cruise", 0.9, {}), jb.State("loose", 0.1, {"operation.axial_load": 10.0})]
    found = jb.solve_spectrum(scene, states, throw=False)
    assert list(found.failures) == ["loose"]
    assert "must be at least 2505" in found.failures["loose"]
    assert not found.converged
    assert found.governing is None
    assert np.isnan(found.life.L10r_hours)
    assert np.isfinite(found["cruise"].life.L10r)
    with pytest.raises(jb.SolveError, match="state 'loose': no_equilibrium"):
        found.raise_if_failed()


@pytest.mark.slow
def test_gradient(scene):
    def hours(load):
        states = [state("cruise", 0.9, 15e3), state("start", 0.1, load)]
        return jb.solve_spectrum(scene, states, throw=False).life.L10r_hours

    slope = jax.grad(hours)(40e3)
    difference = (hours(40e3 + 5.0) - hours(40e3 - 5.0)) / 10.0
    np.testing.assert_allclose(slope, difference, rtol=1e-5)
    np.testing.assert_allclose(jax.jit(jax.grad(hours))(40e3), slope, rtol=1e-8)


def test_refusals(scene):
    with pytest.raises(ValueError, match=r"share must add up to 1 over the states, got 0\.9"):
        jb.solve_spectrum(scene, [state("a", 0.5, 1e3), state("b", 0.4, 1e3)])
    with pytest.raises(ValueError, match="a name of their own each, got 'a' 2 times"):
        jb.solve_spectrum(scene, [state("a", 0.5, 1e3), state("a", 0.5, 1e3)])
    with pytest.raises(ValueError, match="share of state 'a' must be above 0 and at most 1"):
        jb.solve_spectrum(scene, [state("a", 0.0, 1e3), state("b", 1.0, 1e3)])
    with pytest.raises(AttributeError, match=r"the scene has no 'operation\.radal_load'"):
        jb.solve_spectrum(scene, [jb.State("a", 1.0, {"operation.radal_load": 1.0})])
    with pytest.raises(ValueError, match="rating: found nothing in state 'a'"):
        jb.solve_spectrum(scene.replace({"rating": None}), [state("a", 1.0, 1e3)])
    others = [state("a", 0.5, 1e3), jb.State("b", 0.5, {"rating": Rating(reliability=0.99)})]
    with pytest.raises(ValueError, match=r"rating\.reliability: expected the same in all states"):
        jb.solve_spectrum(scene, others)
    with pytest.raises(ValueError, match="states must be given beside a scene"):
        jb.solve_spectrum(scene)
    with pytest.raises(TypeError, match="a load spectrum is one of a bearing, got a TwoDisk"):
        jb.solve_spectrum(jb.load_scene("two_disk_etm"), [jb.State("a", 1.0, {})])

"""Programs of sweeps: kept between processes, and compiled quickly where the cases are few."""

import dataclasses

import numpy as np
import pytest
from roller_cases import dry_roller

import jaxbearing as jb
from jaxbearing import lanes
from jaxbearing.sweeps import chunks
from jaxbearing.sweeps.plan import QUICK_CASES
from jaxbearing.sweeps.verb import calls_at_once, plan_in_scene

LOADS = {"operation.radial_load": np.linspace(2e3, 40e3, 3)}


@pytest.fixture
def forgotten(monkeypatch):
    """Makes this process forget its programs, as one that begins."""

    def forget():
        monkeypatch.setattr(chunks, "_compiled", {})

    forget()
    return forget


def test_second_process_traces_nothing(tmp_path, monkeypatch, forgotten):
    """Neither for the numbers nor for the labels of the file."""
    monkeypatch.setenv("JAXBEARING_CACHE", str(tmp_path))
    first = jb.sweep(dry_roller(), LOADS)
    assert len(list(tmp_path.rglob("*.program"))) == 1
    forgotten()
    monkeypatch.setattr(lanes, "solve", lambda *_, **__: pytest.fail("traced"))
    again = jb.sweep(dry_roller(), LOADS)
    assert first.equals(again)


def test_other_solver_options_are_another_program(tmp_path, monkeypatch, forgotten):
    monkeypatch.setenv("JAXBEARING_CACHE", str(tmp_path))
    jb.sweep(dry_roller(), LOADS)
    jb.sweep(dry_roller(), LOADS, options=jb.NewtonOptions(residual_tolerance=1e-9))
    assert len(list(tmp_path.rglob("*.program"))) == 2


def test_few_cases_are_compiled_quickly_with_the_same_numbers():
    scene = dry_roller()
    few = plan_in_scene(scene, LOADS)
    many = plan_in_scene(scene, {"operation.radial_load": np.linspace(2e3, 40e3, QUICK_CASES + 1)})
    assert few.quick
    assert not many.quick
    assert few.key != dataclasses.replace(few, quick=False).key
    inputs, active = few.recipe.inputs(few.cases.part(0, 3))[0], np.ones(3, dtype=bool)
    quick, thorough = (dataclasses.replace(few, quick=quick).program()(inputs, active) for quick in (True, False))
    np.testing.assert_array_equal(quick.status, 0)
    np.testing.assert_allclose(quick.ring.radial, thorough.ring.radial, rtol=1e-12)
    np.testing.assert_allclose(quick.elements.load_inner, thorough.elements.load_inner, rtol=1e-9, atol=1e-9)


def test_scenes_that_run_long_are_compiled_thoroughly():
    contact = jb.load_scene("satellite_contact_1")
    plan = plan_in_scene(contact, {"materials.body_1.density": [7e3, 8e3]})
    assert not plan.quick


@pytest.mark.parametrize(
    ("cases", "chunk", "calls"), [(3, None, 1), (126, None, 2), (5000, None, 8), (5000, 125, 1), (5000, 300, 3)]
)
def test_no_more_devices_than_calls(cases, chunk, calls):
    plan = plan_in_scene(dry_roller(), {"operation.radial_load": np.linspace(2e3, 4e3, cases)}, chunk=chunk)
    assert calls_at_once(plan.recipe, plan.cases, chunk) == calls

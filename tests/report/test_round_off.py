"""The one rule about round-off: 0 for people, and the solver's numbers in Python, JSON and data sets."""

import dataclasses
import io

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import history_of, solution_of
from rich.console import Console

import jaxbearing as jb
from jaxbearing.numerics.checks import Checked
from jaxbearing.report.dataset import solution_to_dataset
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.report.labels import labelled
from jaxbearing.report.round_off import RESOLUTIONS, without_round_off
from jaxbearing.report.summary import print_summary

SCENES = ("turbine_ball", "spindle_pair")


def noisy(part, share):
    """The part with numbers of that size in the place of its own ones of the units of the rule."""
    changes = {}
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if isinstance(value, Checked) or field.metadata.get("static"):
            continue
        if dataclasses.is_dataclass(value):
            changes[field.name] = noisy(value, share)
        elif isinstance(value, dict) and all(dataclasses.is_dataclass(one) for one in value.values()):
            changes[field.name] = {name: noisy(one, share) for name, one in value.items()}
        elif (
            value is not None
            and field.metadata.get("unit") in RESOLUTIONS
            and jnp.issubdtype(jnp.asarray(value).dtype, jnp.floating)
        ):
            changes[field.name] = jnp.full_like(value, share)
    return dataclasses.replace(part, **changes)


@pytest.mark.parametrize("name", SCENES)
def test_every_result_that_is_round_off_is_0_for_people(name):
    solution = solution_of(jb.load_scene(name))
    assert without_round_off(solution) is not None
    cleaned = without_round_off(noisy(solution, -2.6e-52))
    for path, value, metadata in labelled(cleaned):
        left = ("operation.", "residual_norm", "inner_residual")
        counted = not np.issubdtype(np.asarray(value).dtype, np.floating)
        if path.endswith("reliability"):
            continue
        if metadata["unit"] in RESOLUTIONS and not (metadata["derived"] or counted or path.startswith(left)):
            assert not np.any(np.asarray(value) != 0.0), path


def test_what_is_resolved_stays():
    solution = solution_of(jb.load_scene("turbine_ball"))
    assert without_round_off(solution) is solution
    run = history_of(jb.load_scene("turbine_ball_dynamic"))
    assert without_round_off(run) is run


def test_round_off_of_a_run_is_0_at_the_instants_that_have_it():
    """Parts of a run have the shapes of many instants, which their classes do not accept."""
    flow = lambda run: run.instants.flows.inner_ring_oil
    run = history_of(jb.load_scene("deep_groove_6205_mounted"))
    cleaned = without_round_off(eqx.tree_at(flow, run, flow(run).at[-1].set(1e-40)))
    assert type(cleaned.instants.flows) is type(run.instants.flows)
    assert np.array_equal(flow(cleaned), flow(run).at[-1].set(0.0))


def test_displacements_of_a_shaft_are_rounded_to_a_picometre():
    solution = solution_of(jb.load_scene("spindle_pair"))
    moved = lambda solution: solution.shaft.displacement
    numbers = moved(solution).at[0].set(jnp.asarray([2e-6, -3e-21, 5e-13, 1e-19, 2e-5]))
    cleaned = without_round_off(eqx.tree_at(moved, solution, numbers))
    assert moved(cleaned)[0].tolist() == [2e-6, 0.0, 0.0, 0.0, 2e-5]


def test_an_axially_loaded_bearing_has_no_motion_across():
    """Ball bearings under axial load only: round-off of 1e-16 stood as an eccentricity, a tilt and a displacement."""
    scene = jb.load_scene("deep_groove_6205", {"operation.radial_load": "0 N"})
    solution = jb.solve(scene)
    raw = float(solution.ring.tilt)
    assert 0.0 < abs(raw) < 1e-15
    out = io.StringIO()
    print_summary(solution, "a bearing", Console(file=out, width=200), full=True)
    assert "e-" not in "".join(line for line in out.getvalue().splitlines() if "residual" not in line)
    assert "tilt that moves azimuth 0 axially 0 deg" in out.getvalue()
    assert solution_to_dict(solution)["ring"]["tilt"] == 0.0
    assert float(solution_to_dataset(solution)["ring_tilt"]) == raw

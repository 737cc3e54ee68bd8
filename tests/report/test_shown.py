"""`print` and notebooks show scenes and solutions as the command does."""

import io

import jax
import jax.numpy as jnp
import pytest
from rich.console import Console

import jaxbearing as jb
from jaxbearing.report.display import span, with_unit
from jaxbearing.report.summary import print_summary
from jaxbearing.scenes.quantity_texts import quantity_text
from jaxbearing.scenes.units import LENGTH, parse


@pytest.fixture(scope="module")
def solved():
    scene = jb.load_scene("deep_groove_6205")
    return scene, jb.solve(scene)


def test_a_solution_prints_as_the_command_does(solved):
    _, solution = solved
    file = io.StringIO()
    print_summary(solution, "Solution", Console(file=file, width=100, highlight=False, color_system=None))
    assert str(solution) == file.getvalue().rstrip()
    assert "Highest pressure" in str(solution)
    assert repr(solution).startswith("Solution(\n  status=")


def test_a_scene_prints_its_fields_with_units(solved):
    scene, _ = solved
    lines = [" ".join(line.split()) for line in str(scene).splitlines()]
    for line in ("kind ball_bearing", "pitch_diameter 38.5 mm", "diametral_clearance 12 um", "inner_speed 6000 rpm"):
        assert line in lines
    assert "oil_temperature 100 degC" in lines
    assert not any(line.startswith(("misalignment", "contact")) for line in lines)  # not given
    held = scene.at_operation(axial_load=None, displacement={"axial": 6e-5})
    assert "displacement.axial 60 um" in [" ".join(line.split()) for line in str(held).splitlines()]


@pytest.mark.parametrize("name", jb.builtin_names())
def test_every_kind_of_scene_is_shown(name):
    scene = jb.load_scene(name)
    first = "shaft" if scene.kind == "shaft" else "geometry" if "satellite" not in name else "contact"
    assert f"\n{first} ─" in f"\n{scene}"
    assert scene._repr_html_().startswith("<pre")


def test_a_notebook_gets_the_same_with_colours(solved):
    scene, solution = solved
    for shown in (scene, solution):
        assert shown._repr_html_().startswith("<pre")
    assert "CONVERGED" in solution._repr_html_()
    assert "<span style=" in solution._repr_html_()


def test_what_is_not_one_set_of_numbers_shows_its_structure(solved):
    scene, solution = solved
    batch = jax.tree.map(lambda leaf: jnp.stack([leaf, leaf]), solution)
    scenes = jax.tree.map(lambda leaf: jnp.stack([leaf, leaf]), scene)
    for several in (batch, scenes):
        assert str(several) == repr(several)
        assert several._repr_html_() is None
    said = []
    jax.eval_shape(lambda load: said.append(str(scene.at_operation(axial_load=load))), 1.0)
    assert said[0].startswith("BallBearing(")


def test_a_failed_solve_shows_no_result(solved):
    scene, _ = solved
    failed = jb.solve(scene.at_operation(axial_load=1e9), throw=False)
    assert "NOT CONVERGED" in str(failed)
    assert "Highest pressure" not in str(failed)


def test_lengths_from_a_millimetre_on_are_in_millimetres():
    """On the screen and in files: 150 mm is no 150000 um, and no 0.15000000000000002 m."""
    for value, text in {
        0.15: "150.0 mm",
        -0.0133: "-13.30 mm",
        1e-3: "1.000 mm",
        12e-6: "12.00 um",
        0.0: "0 um",
    }.items():
        assert with_unit(value, "m") == text
    assert span(0.15, 0.35, "m") == "150.0 to 350.0 mm"
    assert span(5e-6, 2e-5, "m") == "5.000 to 20.00 um"
    for value, text in {0.205: "0.205 m", 205 * 0.001: "205 mm", 0.2051: "205.1 mm", 1.2e-5: "12 um"}.items():
        assert quantity_text(value, LENGTH) == text
        assert parse(text, LENGTH) == value

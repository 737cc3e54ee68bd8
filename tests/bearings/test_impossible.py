"""Inputs that cannot exist are refused, and bearings that yield have no life on the screen."""

import io

import jax
import pytest
from rich.console import Console

import jaxbearing as jb
from jaxbearing.bearings.rating import Rating
from jaxbearing.numerics.status import Status
from jaxbearing.report.summary import print_summary
from jaxbearing.scenes.errors import SceneError


def screen(solution):
    out = io.StringIO()
    print_summary(solution, "a bearing", Console(file=out, width=200))
    return out.getvalue()


def test_an_interference_that_no_steel_bears_is_refused():
    """Millimetres in the place of micrometres: from files, in Python and traced, in every place that says one."""
    for scene, field in (
        ("deep_groove_6205", "geometry.diametral_clearance"),
        ("reference_roller", "geometry.diametral_clearance"),
        ("deep_groove_6205_mounted", "fits.shaft_interference"),
        ("deep_groove_6205_mounted", "fits.housing_interference"),
    ):
        sign = -1.0 if field.endswith("clearance") else 1.0
        path = field.replace("_interference", "_tolerance")
        left_out = {path: "none"} if path != field else {}
        with pytest.raises(SceneError, match=f"{field}: found an interference of 5 mm"):
            jb.load_scene(scene, {field: f"{sign * 5:g} mm", **left_out})
        fine = jb.load_scene(scene, {field: f"{sign * 5:g} um", **left_out})
        with pytest.raises(ValueError, match=f"{field}: found an interference of 5 mm"):
            fine.replace({field: sign * 5e-3})
    with pytest.raises(SceneError, match=r"found 37\.5 mm on a pitch diameter of .* mm. expected at most a tenth"):
        jb.load_scene("reference_roller", {"geometry.diametral_clearance": "37.5 mm"})
    scene = jb.load_scene("reference_roller", {"contact": "none", "cage": "none"})
    lanes = jax.vmap(lambda value: jb.solve(scene.replace({"geometry.diametral_clearance": value}), throw=False))
    found = lanes(jax.numpy.asarray([-5e-3, 30e-6]))
    assert found.status.tolist() == [Status.INVALID_INPUT, Status.CONVERGED]


def test_a_bearing_that_yields_has_no_life_on_the_screen():
    """15 kN and 40 kN on a 6205, whose static rating is 7.8 kN: 4.2 GPa are passed on both raceways at 40 kN."""
    scene = jb.load_scene("deep_groove_6205", {"operation.moment": "none"}).replace({"rating": Rating()})
    direct = jb.NewtonOptions(continuation=False)
    fine = jb.solve(scene, options=direct)
    assert "Overload" not in screen(fine)
    assert "none, because" not in screen(fine)
    yields = jb.solve(scene.replace({"operation.radial_load": 40e3}), options=direct)
    lines = screen(yields).splitlines()
    results = next(i for i, line in enumerate(lines) if line.startswith("Results"))
    assert lines[results + 1].split()[0] == "Overload"
    pressure = 1e-9 * float(jax.numpy.max(yields.elements.pressure_inner))
    assert pressure > 4.2
    assert f"{pressure:.4g} GPa on the inner raceway" in lines[results + 1]
    assert "beyond C0" in lines[results + 1]
    assert next(line for line in lines if line.split()[:1] == ["Life"]).split()[1:3] == ["none,", "because"]
    # raw results stay what the formulas give
    assert 0.0 < float(yields.life.L10r) < float(fine.life.L10r)

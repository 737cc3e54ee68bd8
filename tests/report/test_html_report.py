"""The report page: its numbers are those of the solution, it loads nothing, and no name breaks it."""

import dataclasses
import re
from datetime import UTC, datetime

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import solution_of
from html_pages import Page
from roller_cases import dry_roller, turbine_roller

import jaxbearing as jb
from jaxbearing.numerics.status import Status
from jaxbearing.report.backends.plotly import library
from jaxbearing.report.backends.svg import Drawing
from jaxbearing.report.bearing.panels import power_losses
from jaxbearing.report.html_report import html_report
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.scenes.inputs import SceneInput, described_field, scene_inputs

WHEN = datetime(2026, 1, 2, 3, 4, tzinfo=UTC)
CHANGES = {
    "turbine_roller": {"contact.traction_model": "mean_pressure"},
    # what compiles fast: no friction
    "turbine_ball": {"contact": "none", "cage": "none", "drag": "none", "kinematics": "none"},
    "deep_groove_6205": {"contact": "none", "operation.radial_load": "3 kN"},
    "tapered_example": {"contact": "none", "drag": "none"},
}
EVIL = "</script><script>alert(1)</script>\"'><img src=x onerror=alert(2)>{{ 7*7 }}"


MADE_UP = ("turbine_roller", "tapered_example")
"""Those that are large to solve."""


class Solved(dict):
    """Scenes and their solutions by name, each when it is asked for."""

    def __missing__(self, name):
        scene = jb.load_scene(name, CHANGES[name])
        self[name] = scene, rollers(scene) if name in MADE_UP else jb.solve(scene)
        return self[name]


def rollers(scene):
    """A solution with made up numbers, some of the size that they have, and with unloaded rollers."""
    found = solution_of(scene)
    load = 8e3 * np.maximum(np.cos(np.asarray(found.elements.azimuth)), 0.0)
    parts = lambda s: (s.elements.load_inner, s.elements.load_outer, s.ring.radial)
    return eqx.tree_at(parts, found, (load, load + 300.0, 40e-6))


@pytest.fixture(scope="module")
def solved():
    return Solved()


def made(solved, name):
    scene, solution = solved[name]
    return html_report(scene, solution, name, scene_inputs(name, CHANGES[name], scene), WHEN)


@pytest.mark.parametrize("name", CHANGES)
def test_all_kinds(name, solved):
    page = Page(made(solved, name))
    results = solution_to_dict(solved[name][1])
    assert page.data("solution") == results
    for word in ("converged", "Convergence and validity", "Inputs", "2026-01-02 03:04 UTC", jb.__version__, "Python"):
        assert word in page.text
    assert ("Not modelled:" in page.text) == bool(results["not_modelled"])
    charts = [attributes["id"].removeprefix("chart-") for attributes in page.attributes("div") if "id" in attributes]
    if name == "turbine_ball":
        # an axial load alone: numbers in the place of flat curves, and no library of charts
        assert (charts, set(page.scripts)) == ([], {"solution"})
        pressure = 1e-9 * results["elements"]["pressure_inner"][0]
        assert "The same at every ball outer race inner race Load on each ball" in page.text
        assert f"{pressure:.3f} GPa" in page.text
        return
    assert {"load", "pressure"} <= set(charts)
    assert set(page.scripts) == {"solution", "code", *(f"data-{chart}" for chart in charts)}
    loads = {trace["name"]: trace for trace in page.data("data-load")["data"]}
    largest = max(results["elements"]["load_inner"] + results["elements"]["load_outer"])
    factor = 1e-3 if largest >= 1e3 else 1.0
    expected = factor * np.asarray(results["elements"]["load_inner"])
    np.testing.assert_allclose(loads["inner race"]["r"][:-1], expected, rtol=1e-14)


@pytest.mark.parametrize(
    ("name", "changes", "charts"),
    [
        ("two_disk_etm", {"contact.traction_accuracy": "1e-2"}, {"data-traction-0"}),
        ("satellite_contact_1", {"contact.nodes": "51"}, {"data-pressure", "data-film"}),
    ],
)
def test_machines_and_line_contacts(name, changes, charts):
    scene = jb.load_scene(name, changes)
    solution = solution_of(scene) if name == "two_disk_etm" else jb.solve(scene)
    page = Page(html_report(scene, solution, name, scene_inputs(name, changes, scene), WHEN))
    assert page.data("solution") == solution_to_dict(solution)
    assert set(page.scripts) == {"solution", "code", *charts}
    assert not page.attributes("svg")
    assert "Drawing" not in page.text
    curve = page.data(min(charts))["data"][0]
    if name == "two_disk_etm":
        np.testing.assert_allclose(curve["y"], page.data("solution")["curves"][0]["traction_coefficient"], rtol=1e-14)
    else:
        film = np.asarray(page.data("solution")["profile"]["film"])
        np.testing.assert_allclose(curve["y"], 1e6 * film, rtol=1e-14)


@pytest.mark.parametrize("name", CHANGES)
def test_arrows_are_proportional_to_the_loads(name, solved):
    page = Page(made(solved, name))
    elements = solved[name][1].elements
    arrows = [line for line in page.attributes("line") if "data-load" in line]
    # all of the front view, those of one element in the section; unloaded ones have none
    loads = np.concatenate([np.asarray(elements.load_inner), np.asarray(elements.load_outer)])
    assert len(arrows) <= loads.size + 3
    assert len(arrows) >= np.sum(loads > 0.05 * loads.max()) + 2
    tips = {}
    for polygon, arrow in zip(_heads(page), arrows, strict=True):
        start = np.array([float(arrow["x1"]), float(arrow["y1"])])
        load, length = float(arrow["data-load"]), float(np.hypot(*(polygon - start)))
        tips.setdefault(arrow["stroke-width"], []).append((load, length))
    for pairs in tips.values():
        load, length = np.transpose([pair for pair in pairs if pair[1] > 5.0])
        # coordinates have two decimals
        np.testing.assert_allclose(length / length.max(), load / load.max(), atol=2e-3)


def _heads(page):
    """Tip of each arrow that has a load."""
    found, before = [], {}
    for tag, attributes in page.elements:
        if tag == "polygon" and "data-load" in before:
            found.append(np.array([float(v) for v in attributes["points"].split()[0].split(",")]))
        before = attributes
    return found


def test_numbers_in_the_tables(solved):
    page = Page(made(solved, "turbine_roller"))
    solution = solved["turbine_roller"][1]
    for name in ("drag", "cage_pilot", "pocket"):
        assert f"{name.replace('_', ' ')} {float(getattr(solution.power_loss, name)):.1f}" in page.text
    assert f"{1e6 * float(solution.ring.radial):.2f} µm" in page.text
    # bars as long as the losses, the largest over the whole width
    widths = [
        float(a["style"].split("width:")[1].split("%")[0]) for a in page.attributes("i") if "width:" in a["style"]
    ]
    losses = np.array(list(power_losses(solution).values()))
    np.testing.assert_allclose(widths, 100.0 * losses / losses.max(), atol=5.1e-3)
    for index, load in enumerate(np.asarray(solution.elements.load_inner)[:3]):
        assert f"{float(load):.0f}" in page.text, index
    # inputs as given, with what they are
    for text in ("geometry.pitch_diameter 142 mm pitch diameter", "2500 daN radial load", "mobil_jet_ii"):
        assert text in page.text
    assert "in the element with the id solution" in page.text


UNIT = r"(?:µm|mm|m|N|kN|W|kW|GPa|MPa|rpm|deg|°C|K|h|Hz|N/µm|N m|kN/mrad|N m/mrad|N m/µm)"


@pytest.mark.parametrize("name", CHANGES)
def test_one_way_to_write_units_and_numbers(name, solved):
    """No ASCII unit beside its sign, and no number with an exponent beside a unit."""
    text = Page(made(solved, name)).text
    assert re.findall(r"[^ ]* (?:um|degC|N(?: m)?/um|[a-z]+\^[23])\b", text) == []
    assert re.findall(rf"\d+(?:\.\d+)?e[+-]?\d+ {UNIT}\b", text) == []


def test_checks_are_ticks(solved):
    page = Page(made(solved, "turbine_roller")).text
    kept = [not bool(left) for left in solved["turbine_roller"][1].range_checks.values()]
    assert page.count("✓ no") == sum(kept)
    assert page.count("! yes") == len(kept) - sum(kept)
    assert "not the case" not in page


def test_what_is_not_modelled_is_not_on_the_page():
    scene = dry_roller()
    page = Page(html_report(scene, jb.solve(scene), "dry", {}, WHEN))
    assert "Power loss" not in page.text
    assert "data-film" not in page.scripts
    assert "Life" not in page.text


@pytest.mark.parametrize("name", CHANGES)
def test_loads_nothing(name, solved):
    text = made(solved, name)
    page = Page(text)
    for _, attributes in page.elements:
        for key in ("src", "srcset", "href", "xlink:href", "action", "data", "poster"):
            assert attributes.get(key, "data:").startswith("data:")
    styles = " ".join([*page.styles, *(a["style"] for _, a in page.elements if "style" in a)])
    assert not re.search(r"@import|url\(", styles)
    own = text.replace(library(), "")
    assert len(own) < 0.1 * len(library())
    assert not re.search(r"https?://", own)
    # the browser itself refuses to load anything
    policy = next(a["content"] for a in page.attributes("meta") if "http-equiv" in a)
    assert policy.startswith("default-src 'none'")
    assert "http" not in policy


def test_no_name_breaks_the_page(solved):
    scene, solution = solved["turbine_roller"]
    evil = dataclasses.replace(solution, notes=(EVIL,))
    inputs = {EVIL: [SceneInput(EVIL, EVIL, EVIL)]}
    page, plain = (Page(html_report(scene, s, t, i, WHEN)) for s, t, i in ((evil, EVIL, inputs), (solution, "x", {})))
    assert not page.attributes("img")
    assert len(page.attributes("script")) == len(plain.attributes("script"))
    assert page.text.count(EVIL) >= 5
    assert EVIL in page.data("solution")["warnings"]
    drawing = Drawing(EVIL, 1.0)
    drawing.text((0.0, 0.0), EVIL)
    assert "<script" not in drawing.markup()
    assert "<img" not in drawing.markup()


def test_warnings_come_first(solved):
    scene, solution = solved["turbine_roller"]
    text = next(iter(solution.range_checks))
    warned = dataclasses.replace(solution, checks={**solution.range_checks, text: jnp.asarray(True)})
    page = Page(html_report(scene, warned, "x", {}, WHEN)).text
    assert page.index("Warnings") < page.index(text) < page.index("Drawing")
    assert "1 of" in page


def test_no_page_without_results(solved):
    scene, solution = solved["turbine_roller"]
    failed = dataclasses.replace(solution, status=jnp.asarray(int(Status.DIVERGED)))
    with pytest.raises(ValueError, match="no results"):
        html_report(scene, failed, "x", {}, WHEN)
    with pytest.raises(TypeError, match="no report"):
        html_report(scene, _Other(), "x", {}, WHEN)


class _Other:
    converged = True


def test_inputs():
    changes = {"operation.inner_speed": "12000 rpm", "flange": "none", "cage.n_lands": "3"}
    scene = jb.load_scene("turbine_roller", changes)
    inputs = scene_inputs("turbine_roller", changes, scene)
    assert "flange" not in inputs
    rows = {row.path: row for table in inputs.values() for row in table}
    assert rows["operation.inner_speed"] == SceneInput("operation.inner_speed", "12000 rpm", "inner ring speed")
    assert (rows["cage.n_lands"].text, rows["cage.n_lands"].given) == ("3", True)
    assert (rows["operation.outer_speed"].text, rows["operation.outer_speed"].given) == ("0", False)
    assert "drag coefficient Cd" in rows["drag.coefficient"].description
    assert rows["contact.film"].description.startswith("Central film")
    assert rows["kind"].description != "kind"
    assert rows["materials.rings"].description == "material of the rings"
    # a description does not repeat the name beside it, nor another field's
    named = [
        row for row in rows.values() if row.description.startswith(f"{row.path.split('.')[-1].replace('_', ' ')}: ")
    ]
    assert named == []
    assert described_field(turbine_roller(), ("no", "such_thing")) == "such thing"

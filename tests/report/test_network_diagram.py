"""The diagram of a thermal network: its numbers and widths are those of the solution, on paper and on the page."""

import dataclasses
from datetime import UTC, datetime

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import solution_of
from html_pages import Page
from matplotlib.text import Text
from warm_cases import warm

from jaxbearing.report.bearing.network import PLACES, THICKEST, THINNEST, network_diagram
from jaxbearing.report.diagrams import LETTER, TEXT, Arrow
from jaxbearing.report.html_report import html_report
from jaxbearing.report.plots import plot_solution, save_plot

WHEN = datetime(2026, 1, 2, 3, 4, tzinfo=UTC)
SCENES = {
    1: lambda: warm("roller", 1),
    4: lambda: warm("roller", 4),
    6: lambda: warm("roller", 6, fits__shaft_interference="30 um"),
}
PATHS = {1: 1, 4: 7, 6: 10}
"""Paths of the heat between nodes and to the ambient, by the number of nodes."""


def flows_of(thermal, watts):
    """The heat of each path replaced by these numbers."""
    named = dict(zip(map("_".join, thermal.paths()), watts, strict=True))
    return dataclasses.replace(thermal.flows, **named)


def with_numbers(solution):
    """The solution with temperatures and heat flows of the size that bearings have."""
    thermal = solution.thermal
    degrees = {name: jnp.asarray(313.15 + 3.0 * place) for place, name in enumerate(thermal.nodes)}
    watts = [jnp.asarray((-1.0) ** place * (5.0 + 1.25 * place)) for place in range(len(thermal.paths()))]
    thermal = dataclasses.replace(
        thermal, temperatures=dataclasses.replace(thermal.temperatures, **degrees), flows=flows_of(thermal, watts)
    )
    oil = lambda t: (t.ambient, t.oil_in, t.oil_out, t.heat_to_oil, t.heat_to_ambient)
    thermal = eqx.tree_at(oil, thermal, tuple(map(jnp.asarray, (293.15, 310.15, 321.65, 33.25, 8.5))))
    return eqx.tree_at(lambda s: s.thermal, solution, thermal)


@pytest.fixture(scope="module", params=SCENES, ids=lambda count: f"{count} nodes")
def warmed(request):
    scene = SCENES[request.param]()
    return request.param, scene, with_numbers(solution_of(scene))


def texts_of(diagram):
    return [box.text for box in diagram.boxes] + [arrow.text for arrow in diagram.arrows if arrow.text]


def test_temperatures_and_heat_of_every_path(warmed):
    count, _, solution = warmed
    thermal, diagram = solution.thermal, network_diagram(solution.thermal)
    assert len(thermal.paths()) == PATHS[count]
    boxes = {box.centre: box.text for box in diagram.boxes}
    for place, name in enumerate(thermal.nodes):
        assert boxes[PLACES[name]] == f"{name.replace('_', ' ')}\n{40.0 + 3.0 * place:.1f} °C"
    assert {"ambient 20.0 °C", "oil in\n37.0 °C", "oil out\n48.5 °C"} <= set(boxes.values())
    said = [arrow.text for arrow in diagram.arrows]
    heat = [float(flow) for flow in thermal.paths().values()]
    decimals = [1 if abs(watts) >= 10.0 else 2 for watts in heat]
    assert said[: len(heat)] == [f"{abs(watts):.{places}f} W" for watts, places in zip(heat, decimals, strict=True)]
    assert sum(text.startswith("loss") for text in said) == min(count, 4)
    assert "takes 33.2 W" in said


def test_arrows_point_along_the_heat_with_widths_in_proportion(warmed):
    _, _, solution = warmed
    diagram = network_diagram(solution.thermal)
    widths = []
    for arrow, (pair, flow) in zip(diagram.arrows, solution.thermal.paths().items(), strict=False):
        x, y = PLACES[pair[0]]
        # the first node is nearer to the start of a positive flow
        away = [np.hypot(end[0] - x, end[1] - y) for end in (arrow.start, arrow.end)]
        assert (away[0] < away[1]) == (float(flow) > 0.0)
        widths.append(arrow.width / abs(float(flow)))
    np.testing.assert_allclose(widths, widths[0], rtol=1e-12)
    assert max(arrow.width for arrow in diagram.arrows) == pytest.approx(THICKEST)
    assert min(arrow.width for arrow in diagram.arrows) == THINNEST


def test_nothing_lies_on_a_box_or_outside(warmed):
    _, _, solution = warmed
    diagram = network_diagram(solution.thermal)
    inside = lambda place, box: all(
        abs(place[i] - box.centre[i]) < (box.width, box.height)[i] / 2 - 1e-9 for i in range(2)
    )
    shown = [*(arrow.at for arrow in diagram.arrows if arrow.text), *(box.centre for box in diagram.boxes)]
    for place in [*shown, *(end for arrow in diagram.arrows for end in (arrow.start, arrow.end))]:
        assert all(diagram.low[i] < place[i] < diagram.high[i] for i in range(2))
    for arrow in diagram.arrows:
        for box in diagram.boxes:
            assert not any(inside(place, box) for place in (arrow.start, arrow.end, *([arrow.at] * bool(arrow.text))))


def corners_of(place, text):
    """Rectangle that a text covers, at least."""
    lines = text.split("\n")
    x, y = 0.5 * LETTER * TEXT * max(map(len, lines)), 0.5 * TEXT * len(lines)
    return np.array([[-x, -y], [x, -y], [x, y], [-x, y]]) + np.array(place)


def apart(first, second):
    """Whether a straight line between two convex outlines exists (along an edge of one of them)."""
    for outline in (first, second):
        edges = np.roll(outline, -1, axis=0) - outline
        for normal in np.stack([-edges[:, 1], edges[:, 0]], axis=-1):
            one, other = first @ normal, second @ normal
            if one.max() <= other.min() or other.max() <= one.min():
                return True
    return False


def test_texts_are_free_of_arrows_and_each_other(warmed):
    diagram = network_diagram(warmed[2].thermal)
    texts = [corners_of(arrow.at, arrow.text) for arrow in diagram.arrows if arrow.text]
    texts += [corners_of(box.centre, box.text) for box in diagram.boxes]
    for i, text in enumerate(texts):
        assert all(apart(text, other) for other in texts[i + 1 :])
        for arrow in diagram.arrows:
            shape = np.array(arrow.outline())
            # shaft and head of an arrow are convex
            assert apart(text, shape[[0, 1, -2, -1]])
            assert apart(text, shape[2:5])


def test_no_heat_at_all_and_no_oil_flow(warmed):
    _, _, solution = warmed
    thermal = solution.thermal
    still = flows_of(thermal, [jnp.asarray(0.0)] * len(thermal.paths()))
    thermal = dataclasses.replace(thermal, flows=still, oil_in=None, oil_out=None)
    diagram = network_diagram(thermal)
    assert {arrow.width for arrow in diagram.arrows} == {THINNEST}
    assert not any("oil in" in text or "oil out" in text for text in texts_of(diagram))
    assert "oil" not in diagram.caption
    assert not any(text.startswith("loss") for text in texts_of(diagram))


def test_on_paper(warmed, tmp_path):
    _, scene, solution = warmed
    figure = plot_solution(solution, "a scene")
    words = [text.get_text() for text in figure.findobj(Text) if isinstance(text, Text)]
    assert set(texts_of(network_diagram(solution.thermal))) <= set(words)
    save_plot(figure, tmp_path / "page.svg")
    without = eqx.tree_at(lambda s: s.thermal, solution, None)
    assert len(plot_solution(without, "a scene").axes) == len(figure.axes) - 1
    assert scene.thermal is not None


def test_on_the_page(warmed):
    _, scene, solution = warmed
    page = Page(html_report(scene, solution, "a scene", {}, WHEN))
    assert "Temperatures and heat flows" in page.text
    for text in texts_of(network_diagram(solution.thermal)):
        assert all(line in page.text for line in text.split("\n"))
    without = eqx.tree_at(lambda s: s.thermal, solution, None)
    assert "Temperatures and heat flows" not in Page(html_report(scene, without, "a scene", {}, WHEN)).text


def test_outline_of_an_arrow():
    corners = np.array(Arrow((0.0, 0.0), (30.0, 40.0), "", (0.0, 0.0), 4.0).outline())
    assert corners.shape == (7, 2)
    np.testing.assert_allclose(corners[3], (30.0, 40.0))
    np.testing.assert_allclose(np.linalg.norm(corners[0] - corners[-1]), 4.0)
    along = corners @ np.array([0.6, 0.8])
    assert along.max() == pytest.approx(50.0)
    assert along.min() == pytest.approx(0.0, abs=1e-12)
    assert np.isfinite(corners).all()


def test_heat_to_the_neighbours_on_a_shaft():
    thermal = with_numbers(solution_of(SCENES[6]())).thermal
    joined = dataclasses.replace(thermal.flows, shaft_neighbours=jnp.asarray(3.0), housing_neighbours=jnp.asarray(-2.0))
    more = network_diagram(dataclasses.replace(thermal, flows=joined))
    arrows = {arrow.text: arrow for arrow in more.arrows}
    out, back = arrows["3.00 W, neighbours"], arrows["2.00 W, neighbours"]
    assert (out.start[0], back.end[0]) == (PLACES["shaft"][0], PLACES["housing"][0])
    assert out.end[1] > out.start[1]
    assert back.end[1] < back.start[1]

"""The interval of a power loss on the report page."""

from datetime import UTC, datetime

from html_pages import Page

import jaxbearing as jb
from jaxbearing.loss_interval import PowerInterval, PowerPart, numbers_among
from jaxbearing.report.html_report import html_report
from jaxbearing.report.interval_listing import TITLE, interval_lines, interval_listing

WHEN = datetime(2026, 1, 1, tzinfo=UTC)
DRAG = PowerPart("drag.coefficient", 733.0, 3011.0, "assumed: lognormal")
ALPHA = PowerPart("oil.viscosity.pressure_coefficient", 1380.0, 1400.0, "uniform")
BOTH = PowerInterval(1389.0, 730.0, 3015.0, DRAG.path, DRAG.assumed, (DRAG, ALPHA))
ONE = PowerInterval(1389.0, DRAG.low, DRAG.high, DRAG.path, DRAG.assumed, (DRAG,))


def test_rows_of_the_table():
    together, drag, alpha = interval_listing(BOTH).rows
    assert together == ("all of these", "730.0 W", "3015 W", "")
    assert drag == ("drag.coefficient", "733.0 W", "3011 W", "assumed: lognormal")
    assert alpha[0] == ALPHA.path
    # one input alone: no second row that says the same
    assert interval_listing(ONE).rows == [drag]


def test_sentence():
    (line,) = interval_lines(BOTH)
    counted = (
        "drag.coefficient, oil.viscosity.pressure_coefficient; not counted: geometry, operation, errors of the laws"
    )
    limits = "power loss, 90 % between 730.0 W and 3015 W, mostly by drag.coefficient (assumed: lognormal)"
    assert line == f"{limits}; counted: only {counted}"
    (line,) = interval_lines(ONE)
    assert ", by drag.coefficient (" in line
    assert line.endswith("not counted: geometry, operation, oil, errors of the laws")
    assert BOTH.as_dict()["not_counted"] == "not counted: geometry, operation, errors of the laws"


def test_page_shows_the_interval():
    scene = jb.load_scene("reference_roller", {"contact": "none"})
    solution = jb.solve(scene)
    text = html_report(scene, solution, "x", {}, WHEN, interval=BOTH)
    # numbers stand at the right of their columns; words, which may take several lines, at the left
    assert '<td class="n">733.0 W</td>' in text
    assert f"<td>{DRAG.assumed}</td>" in text
    page = Page(text).text
    assert TITLE in page
    assert "power loss, 90 % between" in page
    for row in interval_listing(BOTH).rows:
        assert all(cell in page for cell in row)
    assert TITLE not in Page(html_report(scene, solution, "x", {}, WHEN)).text


def test_numbers_among_the_fields():
    scene = jb.load_scene("reference_roller")
    one = jb.Distribution(1.0, 0.1)
    given = dict.fromkeys(("drag.coefficient", "drag", "oil.nothing", "cage.guidance", "geometry.n_rollers"), one)
    assert "drag.coefficient" in numbers_among(scene, given)
    assert not {"drag", "oil.nothing", "cage.guidance"} & set(numbers_among(scene, given))

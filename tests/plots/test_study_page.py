"""The page of the power-loss study: no cell is empty, no text lies on another, curves have points enough."""

import numpy as np
import pytest
import xarray as xr
from pictures import empty_cells, outside, overlapping

import jaxbearing as jb
from jaxbearing.studies.panels import GAPS, panels_of, refined
from jaxbearing.studies.pictures import study_page
from jaxbearing.studies.power_loss import PowerLossStudy

LOCATIONS = ("inner_raceway", "outer_raceway", "pocket", "element_ends", "flange", "cage_pilot", "drag")
UNITS = {"speed": "rad s-1", "flow": "m3 s-1", "load": "N", "temperature": "K", "clearance": "m", "angle": "rad"}


def words(name):
    return name.removeprefix("operation_").replace("_", " ")


def made_up(scene, kept):
    """A study of the panels that a scene has, whose losses nobody solved for."""
    panels = {}
    for panel in panels_of(scene)[0][:kept]:
        names = [path.replace(".", "_") for path in panel.values]
        shape = tuple(values.size for values in panel.values.values())
        rising = np.linspace(50.0, 900.0, shape[0]).reshape(-1, *([1] * (len(shape) - 1))) * np.ones(shape)
        watts = {f"power_loss_{name}": (names, rising * (1 + i), {"units": "W"}) for i, name in enumerate(LOCATIONS)}
        watts["power_loss_total"] = (names, sum(one[1] for one in watts.values()), {"units": "W"})
        axes = {
            name: (name, values, {"units": UNITS[name.split("_")[-1]], "long_name": words(name)})
            for name, values in zip(names, panel.values.values(), strict=True)
        }
        attributes = {"sweep_fields": " ".join(panel.values), "title": f"Power loss {panel.title}"}
        panels[panel.name] = xr.Dataset(watts, axes, attributes)
    return PowerLossStudy(scene, panels, [], 200, 0, {}, {}, ())


@pytest.mark.parametrize("kept", [10, 9, 8, 5, 3])
def test_page(kept):
    study = made_up(jb.load_scene("reference_roller"), kept)
    page = study_page(study, "reference_roller")
    assert len(page.axes) == kept
    assert empty_cells(page) == 0
    assert overlapping(page) == []
    assert outside(page) == []
    titles = [axes.get_title() for axes in page.axes]
    assert not any(name in title for name in study.panels for title in titles)
    assert any("39" in text.get_text() for text in page.subfigs[-1].texts) == (kept > 3)


@pytest.mark.parametrize(("kept", "left"), [(10, 1), (9, 0), (8, 1), (6, 1)])
def test_cells_of_the_page_are_all_used(kept, left):
    """Panels and the legend fill the grid; where no cell is left for it the legend stands below."""
    page = study_page(made_up(jb.load_scene("reference_roller"), kept), "x")
    stacks = [axes for axes in page.axes if len(axes.collections) >= len(LOCATIONS)]
    rows = {round(axes.get_position().y0, 3) for axes in stacks}
    columns = {round(axes.get_position().x0, 3) for axes in stacks}
    assert len(rows) * len(columns) - len(stacks) == (left if len(rows) > 1 else 0)
    (legend,) = page.subfigs[-2].legends
    assert [text.get_text() for text in legend.get_texts()][-1] == "inner raceway"


@pytest.mark.parametrize("values", [[0.0, 50.0, 300.0], [-20.0, 100.0], [1e-3, 0.25, 8.0, 40.0]])
def test_refined(values):
    """The source's values stay, and no gap is wider than a part of the axis."""
    found = refined(np.array(values))
    assert set(values) <= set(found.tolist())
    assert np.all(np.diff(found) > 0.0)
    assert np.max(np.diff(found)) <= (values[-1] - values[0]) / GAPS * (1.0 + 1e-9)

"""A result that follows from others, one labelled property, is in every output: nothing else names it."""

import io
import json
from datetime import UTC, datetime

import numpy as np
import pytest
import xarray as xr
from filled_results import SCENES, solution_of, structure_of
from html_pages import Page
from jaxtyping import Array, Float
from rich.console import Console

import jaxbearing as jb
from jaxbearing._derived import derived
from jaxbearing.bearings.cylindrical.solution import RollerResults
from jaxbearing.bearings.solution import Solution
from jaxbearing.ehl import LineContactSolution
from jaxbearing.machines import TwoDiskSolution
from jaxbearing.report.dataset import solution_to_dataset, write_netcdf
from jaxbearing.report.html_report import html_report
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.report.summary import print_summary


@derived("N", "largest normal load of all")
def largest_load(self) -> Float[Array, "*batch"]:
    return self.elements.load_inner.max(axis=-1)


@derived("1", "normal load over the largest one")
def load_share(self) -> Float[Array, "*batch element"]:
    return self.load_inner / self.load_inner.max(axis=-1, keepdims=True)


@derived("1", "largest traction coefficient of all")
def largest_traction(self) -> Float[Array, "*batch"]:
    return self.traction_coefficient.max(axis=(-4, -3, -2, -1))


@derived("1", "smallest film over the central one")
def film_ratio(self) -> Float[Array, "*batch"]:
    return self.film.minimum / self.film.central


KINDS = {
    "dry roller": [(Solution, "", largest_load), (RollerResults, "elements", load_share)],
    "dry ball": [(Solution, "", largest_load)],
    "two-disk": [(TwoDiskSolution, "", largest_traction)],
    "line contact": [(LineContactSolution, "", film_ratio)],
}
kinds = pytest.mark.parametrize("kind", KINDS)


@pytest.fixture
def added(kind, monkeypatch):
    """Paths of the results that the classes have got."""
    found = {}
    for owner, above, one in KINDS[kind]:
        name = one.fget.__name__
        monkeypatch.setattr(owner, name, one, raising=False)
        found[f"{above}.{name}".removeprefix(".")] = one
    return found


def value_of(result, path):
    for name in path.split("."):
        result = result[name] if isinstance(result, dict) else getattr(result, name)
    return np.asarray(result)


@kinds
def test_one_solve(kind, added, tmp_path):
    scene = SCENES[kind]()
    result = solution_of(scene)
    told = json.loads(json.dumps(solution_to_dict(result), allow_nan=False))
    write_netcdf(solution_to_dataset(result), tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc") as opened:
        variables = {variable.attrs.get("path"): variable for variable in opened.load().variables.values()}
    page = html_report(scene, result, "a scene", {"a": []}, datetime(2026, 1, 1, tzinfo=UTC))
    stream = io.StringIO()
    print_summary(result, "a scene", Console(file=stream, width=100))
    for path, one in added.items():
        value = value_of(result, path)
        np.testing.assert_array_equal(value_of(told, path), value)
        np.testing.assert_array_equal(variables[path].values, value)
        assert variables[path].attrs["long_name"] == one.metadata["description"]
        assert one.metadata["description"] in page
        assert f"{path} " in stream.getvalue()
        assert one.metadata["description"] in " ".join(stream.getvalue().split())
    assert Page(page).data("solution") == told


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "dry ball"])  # of the class of the rollers
def test_sweep(kind, added, monkeypatch):
    scene = SCENES[kind]()

    class Program:
        def __init__(self, *_, **__):
            self.structure = structure_of(scene)

        def __call__(self, inputs, active, progress):
            return solution_of(scene, (len(active),))

    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", Program)
    bearing = kind == "dry roller"
    axis = "operation.inner_speed" if bearing else "materials.body_1.density"
    found = jb.sweep(scene, {axis: [500.0, 600.0] if bearing else [7e3, 8e3]})
    there = {variable.attrs.get("path"): variable for variable in found.variables.values()}
    batch = solution_of(scene, (2,))
    for path in added:
        np.testing.assert_array_equal(there[path].values, value_of(batch, path))


def test_what_is_not_modelled_is_left_out(monkeypatch):
    @derived("W", "half of the total loss")
    def half_loss(self) -> Float[Array, "*batch"] | None:
        return None if self.power_loss.total is None else 0.5 * self.power_loss.total

    monkeypatch.setattr(Solution, "half_loss", half_loss, raising=False)
    assert "half_loss" not in solution_to_dataset(solution_of(SCENES["dry roller"]()))
    assert "half_loss" in solution_to_dataset(solution_of(SCENES["misaligned roller"]()))
    assert half_loss.__doc__ == "half of the total loss, W."

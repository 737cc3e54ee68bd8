"""Whatever a result holds can be written, swept, drawn, printed and reported: all fields, all outputs.

The results are those of every kind of scene with all of its parts, without a solve (`filled_results`).
"""

import dataclasses
import functools
import io
import json
from datetime import UTC, datetime

import numpy as np
import pytest
import xarray as xr
from filled_results import SCENES, history_of, solution_of, structure_of
from html_pages import Page
from rich.console import Console

import jaxbearing as jb
from jaxbearing import plots
from jaxbearing.bearings import frequencies, ring_deflection, solution, supplied
from jaxbearing.bearings.ball import solution as ball_solution
from jaxbearing.bearings.cylindrical import solution as cylindrical_solution
from jaxbearing.bearings.solution import RING_FREEDOMS, Solution
from jaxbearing.bearings.tapered import solution as tapered_solution
from jaxbearing.bearings.warming.history import WarmEnergy, WarmInstant, WarmPeaks, WarmUpHistory
from jaxbearing.ehl import LineContactSolution
from jaxbearing.ehl import solution as film
from jaxbearing.life.result import Life
from jaxbearing.machines import TwoDiskSolution
from jaxbearing.report import histories
from jaxbearing.report.dataset import solution_to_dataset, write_netcdf
from jaxbearing.report.html_report import html_report
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.report.labels import labelled, udunits
from jaxbearing.report.plots import plot_solution, save_plot
from jaxbearing.report.summary import print_summary
from jaxbearing.report.sweep_summary import print_sweep
from jaxbearing.sweeps import labels
from jaxbearing.thermal.result import HeatPaths, NodeTemperatures, ThermalResult
from jaxbearing.thermal.shares import OilTemperatures

WHEN = datetime(2026, 1, 1, tzinfo=UTC)
OTHERS = ("two-disk", "warm two-disk", "line contact")
"""Scenes that are no bearings."""
IN_OTHER_WORDS = ("status", "worst_equation", "force", "stiffness", "deborah_number", "inner_residual")
"""Fields of the JSON that are texts, of a part of the numbers, or of the largest."""
DRAWN = {"power_loss_total", "life_L10h", "film_central", "ring_radial", "cage_slip"}
"""Results with one number a case of which some are drawn."""
HISTORIES = ("roller", "ball", "line contact", "four temperatures", "six temperatures")
PARTS = (
    Solution,
    solution.RingDisplacement,
    solution.CageState,
    cylindrical_solution.RollerResults,
    cylindrical_solution.PowerLoss,
    ball_solution.BallResults,
    ball_solution.BallPowerLoss,
    solution.RacewayPower,
    solution.BoundaryPower,
    solution.RollingByRace,
    supplied.SupplyResult,
    ring_deflection.RingDeflection,
    frequencies.KinematicFrequencies,
    tapered_solution.TaperedResults,
    tapered_solution.TaperedPowerLoss,
    Life,
    ThermalResult,
    NodeTemperatures,
    OilTemperatures,
    HeatPaths,
    LineContactSolution,
    film.FilmResult,
    film.HertzResult,
    film.Profile,
    film.FormulaResult,
    TwoDiskSolution,
)


@functools.cache
def made(kind):
    return solution_of(SCENES[kind]())


kinds = pytest.mark.parametrize("kind", SCENES)


def paths_of(result):
    return {path: (np.asarray(value), found) for path, value, found in labelled(result)}


def used(result):
    """Results by path; of the operating point a scene may use a part only, or a result is said there."""
    said = {path.rpartition(".")[2] for path, *_ in labelled(result) if path.startswith("operation.")}
    return {path: one for path, one in paths_of(result).items() if path.partition(".")[0] not in {"operation", *said}}


def parts_of(tree):
    """All parts of a result."""
    yield tree
    for field in dataclasses.fields(tree):
        value = getattr(tree, field.name)
        if dataclasses.is_dataclass(value):
            yield from parts_of(value)


def test_every_labelled_field_is_in_some_result():
    """A field that no scene here fills would not be tested below."""
    held = {}
    for kind in SCENES:
        for part in parts_of(made(kind)):
            names = {field.name for field in dataclasses.fields(part) if getattr(part, field.name) is not None}
            held[type(part)] = held.get(type(part), set()) | names
    for part in PARTS:
        there = {field.name for field in dataclasses.fields(part) if "unit" in field.metadata}
        # a bearing has neighbours on a shaft only: tests/shafts/test_warm.py
        there -= {"shaft_neighbours", "housing_neighbours"} if part is HeatPaths else set()
        assert there <= held[part], f"{part.__name__}: {there - held[part]}"


@kinds
def test_netcdf(kind, tmp_path):
    result = made(kind)
    write_netcdf(solution_to_dataset(result), tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc") as opened:
        back = opened.load()
    written = {variable.attrs.get("path"): variable for variable in back.variables.values()}
    for path, (value, found) in used(result).items():
        variable = written[path]
        assert variable.attrs["units"] == udunits(found["unit"])
        assert variable.attrs["long_name"] == found["description"]
        np.testing.assert_array_equal(variable.values, value)
        # two results along one dimension are results of the same things
        assert all(back.sizes[name] == size for name, size in zip(variable.dims, value.shape, strict=True))
    for name, variable in back.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name


MODELLED = {
    "ball": RING_FREEDOMS,
    "dry ball": RING_FREEDOMS,
    "roller": ("radial",),
    "dry roller": ("radial",),
    "misaligned roller": RING_FREEDOMS[1:],
    "tapered": RING_FREEDOMS,
}
LOADS, DISPLACEMENTS = ("N", "N", "N", "N m", "N m"), ("m-1", "m-1", "m-1", "rad-1", "rad-1")


@pytest.mark.parametrize("kind", MODELLED)
def test_stiffness_has_one_layout(kind, tmp_path):
    """Five rows and columns in each kind of bearing, each entry with its unit; what is not modelled is 0 in the data
    set, which says so, and null in the JSON."""
    result = made(kind)
    dataset = solution_to_dataset(result)
    stiffness = dataset["stiffness"]
    assert stiffness.dims == ("freedom", "freedom_displaced")
    assert tuple(stiffness["freedom"].values) == tuple(stiffness["freedom_displaced"].values) == RING_FREEDOMS
    units = [[f"{load} {length}" for length in DISPLACEMENTS] for load in LOADS]
    assert stiffness["stiffness_units"].values.tolist() == units
    assert stiffness["freedom_modelled"].values.astype(bool).tolist() == [f in MODELLED[kind] for f in RING_FREEDOMS]
    assert "0" in stiffness.attrs["long_name"]
    told = solution_to_dict(result)["stiffness"]
    for i, row in enumerate(RING_FREEDOMS):
        for j, column in enumerate(RING_FREEDOMS):
            there = row in MODELLED[kind] and column in MODELLED[kind]
            assert told[i][j] == (float(result.stiffness[i, j]) if there else None)


def test_what_is_not_modelled_is_zero():
    stiffness = np.asarray(jb.solve(SCENES["dry roller"]()).stiffness)
    assert stiffness[1, 1] > 0.0
    assert np.count_nonzero(stiffness) == 1


@kinds
def test_json(kind):
    told = json.loads(json.dumps(solution_to_dict(made(kind)), allow_nan=False))
    text = json.dumps(told)
    for path, (value, _) in used(made(kind)).items():
        if path in IN_OTHER_WORDS:
            continue
        at = functools.reduce(
            lambda part, name: part.get(name) if isinstance(part, dict) else None, path.split("."), told
        )
        if at is None:
            # of a family of curves they stand in each curve
            for number in np.unique(value[np.isfinite(value)])[:3]:
                assert repr(float(number)) in text, path
            continue
        expected = np.where(np.isfinite(value), value, np.nan) if value.dtype.kind == "f" else value
        np.testing.assert_array_equal(np.asarray(at, dtype=value.dtype), expected)


@kinds
def test_sweep(kind, tmp_path, monkeypatch):
    """Sweeps with made up results have all that a single solve has."""
    scene = SCENES[kind]()

    class Program:
        def __init__(self, *_, **__):
            self.structure = structure_of(scene)

        def __call__(self, inputs, active, progress):
            return solution_of(scene, (len(active),))

    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", Program)
    values = {"materials.body_1.density": [7e3, 8e3]} if kind in OTHERS else {"operation.inner_speed": [500.0, 600.0]}
    (axis,) = values
    # Zarr, slower, of one kind of each structure
    suffixes = ("nc", "zarr") if kind in ("misaligned roller", "two-disk", "line contact") else ("nc",)
    for suffix in suffixes:
        found = jb.sweep(scene, values, out=tmp_path / f"a.{suffix}").load()
        there = {variable.attrs.get("path"): variable for variable in found.variables.values()}
        for path, (value, _) in used(made(kind)).items():
            dims = there[path].dims
            assert len(dims) in (value.ndim, value.ndim + 1)
            assert dims[: len(dims) - value.ndim] in ((), (axis.replace(".", "_"),)), path
        print_sweep(tmp_path / f"a.{suffix}", "a sweep", 0, 1.0, Console(file=io.StringIO(), width=80))
    for name in DRAWN & set(found):
        plots.result_against(found, name)


@kinds
def test_sweep_without_elements(kind):
    dataset = labels.template(structure_of(SCENES[kind]()), elements=False)
    there = {variable.attrs.get("path") for variable in dataset.variables.values()}
    for path, (_, label) in used(made(kind)).items():
        assert (path in there) == (not {"element", "node"} & set(label["dims"])), path


@kinds
def test_page(kind):
    scene, result = SCENES[kind](), made(kind)
    page = Page(html_report(scene, result, "a scene", {"a": []}, WHEN))
    assert page.data("solution") == solution_to_dict(result)
    if isinstance(result, Solution):
        shown = {one["title"] for one in page.attributes("th") if "title" in one}
        wanted = {found["description"] for _, found in paths_of(result).values() if found["dims"] == ("element",)}
        assert wanted <= shown


@kinds
def test_plots(kind, tmp_path):
    result = made(kind)
    save_plot(plot_solution(result, "a scene"), tmp_path / "a.svg")
    if not isinstance(result, Solution):
        return
    plots.load_distribution(result)
    plots.pressures(result)
    for name, draw in (("film", plots.films), ("sliding", plots.sliding)):
        if any(getattr(result.elements, f"{name}_{side}", None) is not None for side in ("inner", "flange")):
            draw(result)


@kinds
def test_screen(kind):
    for width in (40, 100):
        stream = io.StringIO()
        print_summary(made(kind), "a scene", Console(file=stream, width=width))
        assert "CONVERGED" in stream.getvalue()


@functools.cache
def run_of(kind):
    return history_of(SCENES[kind]())


def test_every_labelled_field_of_a_run_of_temperatures_is_in_some_run():
    runs = [run_of(kind) for kind in HISTORIES if "temperatures" in kind]
    held = {
        (type(part), name)
        for run in runs
        for part in parts_of(run)
        for name, value in vars(part).items()
        if value is not None
    }
    for part in (WarmUpHistory, WarmInstant, WarmEnergy, WarmPeaks, NodeTemperatures):
        there = {field.name for field in dataclasses.fields(part) if "unit" in field.metadata}
        there -= {"bearing"} if part is NodeTemperatures else set()  # of one node
        assert {(part, name) for name in there} <= held, part


@pytest.mark.parametrize("kind", HISTORIES)
def test_histories(kind, tmp_path):
    run = run_of(kind)
    dataset = histories.history_to_dataset(run)
    write_netcdf(dataset, tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc", decode_times=False) as opened:
        back = opened.load()
    there = {variable.attrs.get("path") for variable in back.variables.values()}
    for path in paths_of(run):
        assert path.removeprefix("instants.") in there
    assert json.dumps(histories.history_to_dict(run), allow_nan=False)
    stream = io.StringIO()
    histories.print_history(run, "a scene", Console(file=stream, width=100))
    save_plot(histories.plot_history(run, "a scene"), tmp_path / "a.png")

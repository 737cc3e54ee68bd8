"""Outputs of shafts: screen, JSON, data set, page, pictures, stiffness over speed, rotors for ROSS."""

import dataclasses
import io
import json
import tomllib
from datetime import UTC, datetime

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr
from filled_results import solution_of
from rich.console import Console

import jaxbearing as jb
from jaxbearing.bearings.ring import shift_matrix
from jaxbearing.life.duty import SpectrumLife
from jaxbearing.report.dataset import solution_to_dataset, write_netcdf
from jaxbearing.report.display import digits
from jaxbearing.report.html_report import html_report
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.report.plots import plot_solution, save_plot
from jaxbearing.report.ross import TESTED
from jaxbearing.report.shaft.bending import BendingLine, bending_line, cut_loads
from jaxbearing.report.shaft.drawn import svg
from jaxbearing.report.shaft.facts import life_columns, shaft_facts, shaft_notes, shaft_warnings, with_states
from jaxbearing.report.shaft.modes import natural_frequencies
from jaxbearing.report.shaft.page_content import page_content
from jaxbearing.report.shaft.picture import Area, Pointer, pictures
from jaxbearing.report.shaft.ross import ross_rotor, write_ross_rotor
from jaxbearing.report.shaft.stiffness import (
    ShaftStiffness,
    print_shaft_stiffness,
    shaft_stiffness_over_speed,
    shaft_stiffness_to_dict,
)
from jaxbearing.report.summary import print_summary
from jaxbearing.scenes.inputs import scene_inputs
from jaxbearing.shafts import DutyResult, MountedBearing, SystemLifeResult
from jaxbearing.solve import solve_once
from jaxbearing.tolerance.results import labels_of

RPM = np.pi / 30.0
FREEDOMS = ("axial", "radial", "lateral", "tilt", "tilt_lateral")


@pytest.fixture(scope="module")
def scene():
    return jb.load_scene("spindle_pair", {"shaft.sections": "[{length='60 mm', outer_diameter='50 mm'}]", **MOVED})


MOVED = {"set.pair.position": "30 mm", "force.cutting.position": "55 mm", "force.cutting.radial": "80 N"}


@pytest.fixture(scope="module")
def filled(scene):
    """A solution with made up numbers."""
    return solution_of(scene)


def screen(print_it, *given):
    out = io.StringIO()
    print_it(*given, Console(file=out, width=100))
    return out.getvalue()


def test_screen(filled):
    text = screen(print_summary, filled, "a shaft")
    assert "CONVERGED" in text
    assert [line.split()[0] for line in text.splitlines() if line.strip().startswith("pair.")][:2] == [
        "pair.1",
        "pair.2",
    ]
    for name in ("axial", "radial", "moment", "Q max", "L10 ", "L10r", "System life", "Deflection", "Torques"):
        assert name in text


def test_lives_safety_and_lubrication(scene, filled):
    """A row for each bearing, with the reliability of every life; what no bearing has is no column. The page has what a
    narrow screen has no room for, and both the life of the system of each kind."""
    lives = [one.life for one in filled.bearings.values()]
    one, two = (
        dataclasses.replace(life, viscosity_ratio=kappa, Lnmr_hours=hours, reliability=0.98)
        for life, kappa, hours in zip(lives, (jnp.asarray(0.4321), None), (jnp.asarray(2e4), None), strict=True)
    )
    bearings = dict(zip(filled.bearings, map(_with_life, filled.bearings.values(), (one, two)), strict=True))
    rated = dataclasses.replace(filled, bearings=bearings)
    columns = life_columns(rated)
    assert columns["kappa"] == ["0.432", "-"]
    assert columns["Lnmr\nh, 98 %"] == ["20000", "-"]
    assert columns["Ln\nh, 98 %"] == [digits(0.37 * float(life.L10h)) for life in (one, two)]
    assert columns["L10\nh, 90 %"] == [digits(float(life.L10h)) for life in (one, two)]
    assert columns["safety\nC0/P0"] == [
        digits(float(life.static_capacity / life.static_load), 3) for life in (one, two)
    ]
    assert "clearance\num" not in columns
    assert set(life_columns(rated, wide=False)) < set(columns)
    assert {"L10r\nh, 90 %", "L10\nh, 90 %"} <= set(life_columns(filled))
    system = f"at 90 % reliability: basic reference life L10r {digits(float(filled.life.L10r_hours))} h"
    assert system in " ".join(screen(print_summary, rated, "a shaft").split())
    assert f"ISO 281 L10 {digits(float(filled.life.L10h))} h" in " ".join(screen(print_summary, rated, "x").split())
    mixed = bearings | {"pair.2": _with_life(bearings["pair.2"], dataclasses.replace(two, reliability=0.90))}
    mixed = dataclasses.replace(filled, bearings=mixed)
    assert "Lnmr\nh, n" in life_columns(mixed)
    assert "Reliability n pair.1 98 %, pair.2 90 %" in " ".join(screen(print_summary, mixed, "x").split())
    page = html_report(scene, rated, "x", scene_inputs("spindle_pair", {}, scene), datetime(2026, 1, 1, tzinfo=UTC))
    for words in ("Lnmr, h, 98 %", "safety, contact", "system life L10, 90 %", "system life L10r, 90 %"):
        assert words in page


def test_a_duty_cycle_with_a_state_that_yields_has_no_life_of_the_system(filled):
    """A state that is not the first one: the bearing is named first of all, and the other one keeps its life."""

    def under(pressure, bearing):
        found = bearing.solution
        elements = dataclasses.replace(
            found.elements, pressure_inner=jnp.full_like(found.elements.pressure_inner, pressure)
        )
        return dataclasses.replace(bearing, solution=dataclasses.replace(found, elements=elements))

    fine = dataclasses.replace(filled, bearings={name: under(1e9, one) for name, one in filled.bearings.items()})
    one = fine.bearings["pair.1"]
    heavy = dataclasses.replace(fine, bearings=fine.bearings | {"pair.1": under(5e9, one)})
    hours = {name: jnp.asarray(100.0) for name in ("L10r_hours", "L10r", "mean_speed", "equivalent_load")}
    each = {name: jnp.ones(2) for name in ("revolutions", "damage", "reference_damage")}
    lives = dict.fromkeys(fine.bearings, SpectrumLife(**hours, **each))
    system = SystemLifeResult(L10r=hours["L10r"], L10r_hours=hours["L10r_hours"])
    for states, yields in (((fine, fine), False), ((fine, heavy), True)):
        stacked = jax.tree.map(lambda *leaves: jnp.stack(leaves), *states)
        duty = DutyResult(lives, system, jnp.asarray([0.9, 0.1]), stacked, ("idle", "shock"))
        shown = " ".join(screen(print_summary, dataclasses.replace(fine, duty=duty), "a shaft").split())
        assert ("pair.1 in its worst state 5.000 GPa on the inner raceway" in shown) == yields
        assert shown.count("System life at 90 %") == (0 if yields else 2)
        assert ("pair.1 at 90 % reliability" in shown) != yields
        assert "pair.2 at 90 % reliability" in shown


def test_a_duty_cycle_shows_its_least_safety_and_the_states_of_its_warnings(filled):
    life = filled.bearings["pair.1"].life
    states = [
        dataclasses.replace(
            filled,
            bearings={
                name: _with_life(one, dataclasses.replace(life, static_load=life.static_capacity / safety))
                for name, one in filled.bearings.items()
            },
            checks={"too light": jnp.asarray(safety > 5.0), "in all": jnp.asarray(True)},
        )
        for safety in (9.0, 4.0)
    ]
    stacked = jax.tree.map(lambda *leaves: jnp.stack(leaves), *states)
    lives = dict.fromkeys(filled.bearings)
    duty = DutyResult(lives, None, jnp.asarray([0.9, 0.1]), stacked, ("idle", "peak"))
    checks = {"too light": jnp.asarray(True), "in all": jnp.asarray(True)}
    found = dataclasses.replace(states[0], duty=duty, checks=checks)
    assert life_columns(states[0])["safety\nC0/P0"] == ["9.00"] * 2
    assert life_columns(found)["least\nC0/P0"] == ["4.00"] * 2
    assert [with_states(found, text) for text in checks] == ["too light (in idle)", "in all"]
    assert not any("too light" in note for note in shaft_notes(found))
    assert [one for one in shaft_warnings(found) if one in ("in all", "too light (in idle)")] == [
        "too light (in idle)",
        "in all",
    ]


def _with_life(one, life):
    return dataclasses.replace(one, life=life)


def test_json_has_the_names_of_the_interface(filled):
    told = json.loads(json.dumps(solution_to_dict(filled), allow_nan=False))
    assert list(told["bearings"]) == ["pair.1", "pair.2"]
    one, solution = told["bearings"]["pair.1"], filled.bearings["pair.1"]
    assert set(one["ring"]) == set(FREEDOMS)
    np.testing.assert_array_equal(one["force"], solution.force)
    np.testing.assert_array_equal(one["stiffness"], solution.stiffness)
    np.testing.assert_array_equal(one["elements"]["load_inner"], solution.solution.elements.load_inner)
    assert {"life", "power_loss", "on_shaft", "largest_load"} <= set(one)
    np.testing.assert_array_equal(told["shaft"]["nodes"]["position"], filled.shaft.position)
    assert {"preload", "loss_force", "closure"} <= set(told["sets"]["pair"])
    assert told["system_life"]["L10r"] == float(filled.life.L10r)


def test_data_set(filled, tmp_path):
    write_netcdf(solution_to_dataset(filled), tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc") as opened:
        back = opened.load()
    np.testing.assert_array_equal(back["bearing_force"].sel(bearing="pair.2"), filled.bearings["pair.2"].force)
    np.testing.assert_array_equal(back["pair_1_load_inner"], filled.bearings["pair.1"].solution.elements.load_inner)
    np.testing.assert_array_equal(back["node_displacement"], filled.shaft.displacement)
    assert float(back["set_preload"].sel(set="pair")) == float(filled.sets["pair"].preload)
    for name, variable in back.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name


def test_results_that_would_have_one_name_keep_the_dots_of_their_bearings(scene, filled, tmp_path):
    """A bearing beside a set may be called as one of the set's is, and as the data set calls something else."""
    with_one_more = lambda name: dataclasses.replace(
        filled, bearings={name: filled.bearings["pair.1"], **filled.bearings}
    )
    plain = solution_to_dataset(filled)
    own = sum(str(one).startswith("pair_2_") for one in plain.variables)
    for name, fronts in (
        ("pair_1", ("pair_1.", "pair.1.", "pair_2_")),
        ("bearing", ("bearing_", "pair_1_", "pair_2_")),
        ("pair", ("pair_", "pair_1_", "pair_2_")),
    ):
        solution = with_one_more(name)
        dataset = solution_to_dataset(solution)
        # all that the bearing adds is there, and nothing of the others is lost
        assert len(dataset.variables) == len(plain.variables) + own, name
        places = [f"bearings.{one}.solution.elements.load_inner" for one in (name, "pair.1", "pair.2")]
        found = labels_of(solution, [f"{path}[0]" for path in places])
        for path, front in zip(places, fronts, strict=True):
            assert dataset[f"{front}load_inner"].attrs["path"] == path
            assert dataset[f"{front}load_inner"].dims == (f"{front}element",)
            assert found[f"{path}[0]"].variable == f"{front}load_inner"
    beside = dataclasses.replace(scene, bearings=(MountedBearing("pair_1", scene.sets[0].scene, 0.0),))
    bearings = [one for one in ross_rotor(table_of(beside), beside) if one.startswith("Bearing")]
    assert bearings == ["BearingElement_pair.1", "BearingElement_pair_2", "BearingElement_pair_1"]
    write_netcdf(solution_to_dataset(with_one_more("pair_1")), tmp_path / "a.nc")
    with xr.open_dataset(tmp_path / "a.nc") as back:
        assert {"pair.1.load_inner", "pair_1.load_inner", "pair_2_load_inner"} < set(back.variables)


def test_page_and_plot(scene, filled, tmp_path):
    inputs = scene_inputs("spindle_pair", {}, scene)
    page = html_report(scene, filled, "a shaft", inputs, datetime(2026, 1, 1, tzinfo=UTC))
    assert "Plane X-Y" in page
    assert "Bearing pair.1: stiffness" in page
    save_plot(plot_solution(filled, "a shaft", scene), tmp_path / "a.png")
    save_plot(plot_solution(filled, "a shaft"), tmp_path / "b.png")
    assert (tmp_path / "a.png").stat().st_size > (tmp_path / "b.png").stat().st_size > 10_000


def test_picture_is_to_scale(scene, filled):
    """The shaft, and both halves of both bearings with their balls at the pitch circle."""
    picture = pictures(scene, filled)[0]
    areas = [item for item in picture.items if isinstance(item, Area)]
    x, y = (np.array(values) for values in zip(*areas[0].points, strict=True))
    assert (x.min(), x.max(), y.min(), y.max()) == (0.0, 60.0, -25.0, 25.0)
    balls = [np.array(area.points) for area in areas if len(area.points) == 36]
    centres = sorted({(round(float(ball[:, 0].mean()), 6), round(float(ball[:, 1].mean()), 6)) for ball in balls})
    assert centres == [(22.0, -32.5), (22.0, 32.5), (38.0, -32.5), (38.0, 32.5)]
    assert [item for item in picture.items if isinstance(item, Pointer)]
    assert svg(picture).startswith("<svg")


class Made:
    """What the bending line asks of a solution: a beam that is clamped at the left, with a load at its right end."""

    def __init__(self, scene, length, load, tip, slope):
        self.operation = scene.shaft
        self.bearings = {}
        u = np.zeros((2, 5))
        u[1, 1], u[1, 3] = tip, -slope
        loads = np.zeros((2, 5))
        loads[0, 1], loads[0, 3], loads[1, 1] = -load, load * length, load
        self.shaft = type("Nodes", (), {"position": np.array([0.0, length]), "displacement": u, "load": loads})


def test_bending_line_and_cut_loads_of_a_cantilever(scene):
    """Deflections of Timoshenko's beam between the nodes, and its bending moment F (L - x)."""
    length, load, young, poisson = 0.06, 700.0, 206e9, 0.3
    inertia, area = np.pi * 0.05**4 / 64.0, np.pi * 0.05**2 / 4.0
    shear = 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson) * area * young / (2.0 * (1.0 + poisson))
    deflection = lambda x: load * (x**2 * (3.0 * length - x) / (6.0 * young * inertia) + x / shear)
    made = Made(scene, length, load, deflection(length), load * length**2 / (2.0 * young * inertia))
    line = bending_line(made)
    np.testing.assert_allclose(line.across[0], deflection(line.position), rtol=1e-12, atol=1e-20)
    cut = cut_loads(made)
    np.testing.assert_allclose(cut.moment[0], load * (length - cut.position), rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(cut.shear[0], -load, rtol=1e-12)


def table_of(scene, radial=2e8, tilt=1e5):
    matrix = np.diag([1e8, radial, 1.5 * radial, tilt, tilt])
    values = {place.name: np.stack([matrix, 1.1 * matrix]) for place in scene.places}
    at = {place.name: float(place.position) for place in scene.places} | {"pair": 0.03}
    return ShaftStiffness(np.array([0.0, 100.0]), values, {"pair": np.stack([matrix, matrix])}, at, FREEDOMS, ())


def test_rotor_for_ross(scene, tmp_path):
    rotor = ross_rotor(table_of(scene), scene, load_direction=0.0)
    shaft = [one for name, one in rotor.items() if name.startswith("ShaftElement")]
    np.testing.assert_allclose(np.cumsum([one["L"] for one in shaft]), [0.022, 0.038, 0.06], rtol=1e-12)
    first = rotor["BearingElement_pair_1"]
    assert (first["n"], first["kyy"][0], first["kzz"][0]) == (1, 3e8, 1e8)
    np.testing.assert_allclose(first["kxx"], [2e8, 2.2e8], rtol=1e-15)
    assert first["speed"] == [0.0, 100.0]
    for version in (2, 3):
        write_ross_rotor(table_of(scene), scene, tmp_path / "rotor.toml", "a shaft", version=version)
        read = tomllib.loads((tmp_path / "rotor.toml").read_text(encoding="utf-8"))
        assert read["ross_version"] == TESTED[version]
        assert read["BearingElement_pair_1"][{2: "frequency", 3: "speed"}[version]] == [0.0, 100.0]
    with pytest.raises(ValueError, match="rigid shaft"):
        ross_rotor(table_of(scene), scene.replace({"shaft.sections": ()}))


def test_natural_frequencies_of_a_stiff_shaft(scene):
    """On soft bearings the shaft moves as a rigid body, up and down and tilting. Springs beside the rows are the same
    as rows whose tilting is coupled with their displacement."""
    radial, density = 1e4, 7850.0
    mass = density * np.pi * 0.025**2 * 0.06
    inertia = mass * (0.025**2 / 4.0 + 0.06**2 / 12.0)
    for tilt, beside, tilting in ((1.0, 0.0, False), (1.0, 0.0, True), (0.0, 4e-3, True)):
        table = table_of(scene, radial, tilt)
        for name, values in table.bearings.items():
            outwards = shift_matrix(jnp.asarray(np.sign(table.position[name] - 0.03) * beside))
            table.bearings[name] = np.asarray(outwards.T @ values @ outwards)
        found = natural_frequencies(table, scene, tilting=tilting)
        against = [2.0 * (0.008 + beside) ** 2 * k + 2.0 * tilting * tilt for k in (radial, 1.5 * radial)]
        expected = sorted(
            [np.sqrt(2.0 * k / mass) for k in (radial, 1.5 * radial)] + [np.sqrt(one / inertia) for one in against]
        )
        np.testing.assert_allclose(found[:4], expected, rtol=3e-5)


def test_stiffness_in_words_and_json(scene):
    table = table_of(scene)
    text = screen(print_shaft_stiffness, table, "a shaft")
    assert "Set pair, at 30 mm" in text
    assert "Bearing pair.2, at 38 mm" in text
    told = json.loads(json.dumps(shaft_stiffness_to_dict(table), allow_nan=False))
    assert told["bearings"]["pair.1"][1][1][1] == 1.1 * 2e8


def test_a_couple_that_is_left_out_is_said(scene, filled):
    """Gyroscopic, of the balls of one bearing: on the screen and on the page, where it exceeds a per cent of what
    friction can carry."""
    elements = lambda solution: solution.bearings["pair.1"].solution.elements
    where = lambda solution: (elements(solution).gyroscopic_couple, elements(solution).gyroscopic_limit)
    ones = np.ones(np.shape(where(filled)[0]))
    for share, said in ((2.0, "pair.1: gyroscopic couple (up to 2.00 N m a ball, 200 % of what"), (0.005, "")):
        solution = eqx.tree_at(where, filled, (share * ones, ones), is_leaf=lambda leaf: leaf is None)
        others = [name for name in solution.bearings if name != "pair.1"]
        for name in others:
            limit = lambda solution, name=name: solution.bearings[name].solution.elements.gyroscopic_limit
            solution = eqx.tree_at(limit, solution, None, is_leaf=lambda leaf: leaf is None)
        printed = " ".join(screen(print_summary, solution, "a shaft").split())
        assert ("Not modelled:" in printed) == bool(said)
        assert said in printed
        assert page_content(scene, solution).not_modelled.startswith(said)


@pytest.mark.parametrize(("moved", "at"), [([2e-6, 2e-6, 2e-6], None), ([2e-6, 1e-6, 0.0], " at 0.0 mm")])
def test_a_shaft_that_moves_as_a_whole_is_largest_nowhere(filled, moved, at):
    across = np.zeros((2, len(moved)))
    across[0] = moved
    line = BendingLine(np.array([0.0, 0.03, 0.06]), np.zeros(3), across)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jaxbearing.report.shaft.facts.bending_line", lambda solution: line)
        text = dict(shaft_facts(filled))["Deflection"]
    assert text == f"largest 2.000 um across the axis{at or ''}"


@pytest.mark.slow
def test_stiffness_of_a_pair_over_speed():
    """A rigid preload of 180 N, and one by springs: section 9 of the sheet, B1, B3, B4."""
    speeds = np.array([0.0, 10000.0, 20000.0, 24500.0]) * RPM
    rigid = jb.load_scene("spindle_pair", {"force.cutting": "none"})
    table = shaft_stiffness_over_speed(rigid, speeds, solver=solve_once)
    pair = table.sets["pair"]
    np.testing.assert_allclose(pair[:, 0, 0], [6.4604209e7, 5.412297e7, 4.577374e7, 4.709663e7], rtol=1e-5)
    np.testing.assert_allclose(pair[:, 1, 1], [2.9663395e8, 2.391855e8, 1.734533e8, 1.655977e8], rtol=1e-5)
    np.testing.assert_allclose(pair[0, 3, 3], 103035.33, rtol=1e-5)
    springs = {"set.pair.preload.spring_force": "180 N", "set.pair.preload.spring_stiffness": "0 N/m"}
    soft = shaft_stiffness_over_speed(jb.load_scene("spindle_pair", {"force.cutting": "none", **springs}), speeds[1:])
    np.testing.assert_allclose(soft.sets["pair"][:, 0, 0], [2.327814e7, 9.842043e6, 9.266583e6], rtol=1e-5)
    np.testing.assert_allclose(soft.sets["pair"][:, 1, 1], [2.071476e8, 6.805458e7, 5.59674e7], rtol=1e-5)


@pytest.mark.slow
def test_printed_table_of_the_gear_shaft():
    """Section 8 of the sheet, C4: forces on the shaft, azimuths, moments, loads."""
    solution = jb.solve(jb.load_scene("gear_shaft"))
    rows = [line.split() for line in screen(print_summary, solution, "gear_shaft").splitlines()]
    # of several tables the first
    table = {row[0]: row[1:7] for row in reversed(rows) if row and row[0] in ("front.1", "front.2", "rear")}
    assert table["front.1"] == ["20.0", "-1259.8", "535.9", "-51.6", "11.70", "261.7"]
    assert table["front.2"] == ["37.0", "+723.9", "575.4", "-40.4", "12.55", "282.6"]
    assert table["rear"] == ["180.0", "0", "1095.0", "-30.9", "0.20", "581.7"]

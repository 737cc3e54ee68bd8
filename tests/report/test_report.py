"""JSON and summary of hand-made solutions."""

import dataclasses
import io
import json

import jax.numpy as jnp
import numpy as np
import pytest
from rich.console import Console

import jaxbearing as jb
from jaxbearing._checks import Information, about, in_groups
from jaxbearing.bearings.ball.solution import BallPowerLoss
from jaxbearing.bearings.checks import input_excess
from jaxbearing.bearings.cylindrical.solution import PowerLoss, RollerResults
from jaxbearing.bearings.operation import Operation
from jaxbearing.bearings.solution import CageState, RingDisplacement, Solution
from jaxbearing.bearings.tapered.solution import TaperedPowerLoss
from jaxbearing.life.result import Life
from jaxbearing.numerics.status import Status
from jaxbearing.report.bearing.summary import _loaded_zone
from jaxbearing.report.display import bar, digits, with_unit
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.report.summary import print_summary
from jaxbearing.report.tables import result_rows

N = 8


def numbers(kind, value):
    return {field.name: jnp.asarray(value) for field in dataclasses.fields(kind)}


def solution(status=Status.CONVERGED, number=None, **changes):
    """A solution with every entry filled: load falls round the bearing, all other results are 1 (or `number`)."""
    one = 1.0 if number is None else number
    azimuth = 2.0 * np.pi * np.arange(N) / N
    load = np.maximum(np.cos(azimuth), 0.0) * 1000.0 if number is None else np.full(N, number)
    elements = {field.name: jnp.full(N, one) for field in dataclasses.fields(RollerResults)}
    elements |= {"azimuth": jnp.asarray(azimuth), "load_inner": jnp.asarray(load)}
    loss = {"drag": jnp.asarray(750.0 * one), "pocket": jnp.asarray(250.0 * one), "total": jnp.asarray(1000.0 * one)}
    fields = {
        "status": jnp.asarray(int(status)),
        "iterations": jnp.asarray(7),
        "residual_norm": jnp.asarray(1e-12),
        "inner_residual": jnp.asarray(1e-12),
        "worst_equation": jnp.asarray(1),
        "worst_element": jnp.asarray(0),
        "operation": Operation(inner_speed=1000.0, radial_load=25e3, oil_temperature=373.15, oil_flow=1e-4),
        "ring": RingDisplacement(**numbers(RingDisplacement, one)),
        "cage": CageState(**numbers(CageState, one)),
        "elements": RollerResults(**elements),
        "power_loss": PowerLoss(**loss),
        "drive_power": jnp.asarray(1000.0 * one),
        "inner_torque": jnp.asarray(one),
        "outer_torque": jnp.asarray(one),
        "force": jnp.zeros(5).at[1].set(25e3 * one),
        "stiffness": jnp.zeros((5, 5)).at[1, 1].set(2e9 * one),
        "checks": {"speed out of range": jnp.asarray(True), "load out of range": jnp.asarray(False)},
        "ring_freedom": ("radial",),
        "equation_names": ("roller balance", "ring balance"),
        "global_equations": 1,
        "unknowns": 12,
        "notes": ("cage.inner_diameter is not given",),
    }
    known = {field.name for field in dataclasses.fields(Solution)}
    return Solution(**{name: value for name, value in (fields | changes).items() if name in known})


def text_of(result, width=100, full=False, **options):
    stream = io.StringIO()
    print_summary(result, "a scene", Console(file=stream, width=width, highlight=False, **options), full)
    return stream.getvalue()


FIXED_KEYS = {
    "converged",
    "status",
    "warnings",
    "iterations",
    "residual_norm",
    "unknowns",
    "operation",
    "ring",
    "cage",
    "elements",
    "power_loss",
    "drive_power",
    "stiffness",
    "life",
}


def test_keys_of_the_json():
    result = json.loads(json.dumps(solution_to_dict(solution()), allow_nan=False))
    assert set(result) >= FIXED_KEYS
    assert set(result["ring"]) == {"axial", "radial", "lateral", "tilt", "tilt_lateral"}
    assert set(result["cage"]) == {"speed", "slip", "eccentricity_ratio", "attitude_angle"}
    assert set(result["operation"]) == {"inner_speed", "outer_speed", "radial_load", "oil_temperature", "oil_flow"}
    assert result["power_loss"] == {"drag": 750.0, "pocket": 250.0, "total": 1000.0}
    assert (result["converged"], result["status"], result["iterations"], result["unknowns"]) == (
        True,
        "converged",
        7,
        12,
    )
    assert result["warnings"] == ["speed out of range", "cage.inner_diameter is not given"]
    assert result["worst_equation"] == "ring balance"
    assert result["life"] is None
    assert all(len(array) == N for array in result["elements"].values())


def test_stiffness_is_five_by_five():
    stiffness = solution_to_dict(solution())["stiffness"]
    assert [len(row) for row in stiffness] == [5] * 5
    assert stiffness[1][1] == 2e9
    assert sum(entry is not None for row in stiffness for entry in row) == 1
    two = solution(ring_freedom=("axial", "tilt"), stiffness=jnp.arange(25.0).reshape(5, 5))
    stiffness = solution_to_dict(two)["stiffness"]
    assert (stiffness[0][0], stiffness[0][3], stiffness[3][0], stiffness[3][3]) == (0.0, 3.0, 15.0, 18.0)
    assert sum(entry is not None for row in stiffness for entry in row) == 4


def test_what_is_not_modelled():
    dry = RollerResults(
        **{
            field.name: jnp.ones(N) if field.default is dataclasses.MISSING else None
            for field in dataclasses.fields(RollerResults)
        }
    )
    result = solution_to_dict(solution(cage=None, elements=dry, power_loss=PowerLoss()))
    assert result["cage"] is None
    assert "film_inner" not in result["elements"]
    assert result["power_loss"] == {"total": None}
    assert (result["operation"]["oil_temperature"], result["operation"]["oil_flow"]) == (None, None)
    assert result["operation"]["radial_load"] == 25e3
    text = text_of(solution(cage=None, elements=dry, power_loss=PowerLoss()))
    assert "Cage" not in text
    assert "film" not in text.replace("Motion and films", "")


NOT_MODELLED = ["inner_raceway", "outer_raceway", "rolling_resistance", "element_ends", "flange", "cage_pilot"]


def test_losses_that_are_not_modelled_are_said():
    """A small loss and one that leaves out most of it look alike: what is left out is named, and nothing is not 0."""
    partly = solution()
    assert solution_to_dict(partly)["not_modelled"] == NOT_MODELLED
    (line,) = [line for line in text_of(partly, width=200).splitlines() if "Not modelled:" in line]
    assert line.split("Not modelled:")[1].strip() == ", ".join(NOT_MODELLED).replace("_", " ")
    nothing = solution(power_loss=PowerLoss(), drive_power=None, inner_torque=None, outer_torque=None)
    found = solution_to_dict(nothing)
    assert found["power_loss"] == {"total": None}
    assert found["drive_power"] is None
    assert set(found["not_modelled"]) == {*NOT_MODELLED, "drag", "pocket"}
    assert "Not modelled:" in text_of(nothing)
    assert "all power losses" in text_of(nothing)
    names = [field.name for field in dataclasses.fields(PowerLoss)]
    full = solution(power_loss=PowerLoss(**dict.fromkeys(names, jnp.ones(()))))
    assert solution_to_dict(full)["not_modelled"] == []
    assert "Not modelled" not in text_of(full)


@pytest.mark.parametrize("loss", [PowerLoss, BallPowerLoss, TaperedPowerLoss])
def test_every_kind_of_loss_may_be_left_out(loss):
    names = {field.name for field in dataclasses.fields(loss)} - {"total"}
    assert set(solution(power_loss=loss()).not_modelled) == names
    for name in names:
        one = loss(total=jnp.ones(()), **{name: jnp.ones(())})
        assert set(solution(power_loss=one).not_modelled) == names - {name}


def test_the_life_to_design_by_comes_first():
    """The modified life where it is known, and hours before revolutions, in every output."""
    numbers = {field.name: jnp.ones(()) for field in dataclasses.fields(Life) if not field.metadata.get("static")}
    numbers |= {"Lnmr_hours": jnp.asarray(570.0), "L10r_hours": jnp.asarray(1912.0), "L10h": jnp.asarray(700.0)}
    numbers |= {name: jnp.ones(N) for name in ("film_ratio_inner", "film_ratio_outer")}
    lasting = ["Lnmr_hours", "Lnmr", "L10r_hours", "L10r", "L10h", "L10"]
    known = solution(life=Life(**numbers))
    assert list(solution_to_dict(known)["life"])[:6] == lasting
    assert [row.path for row in result_rows(known) if row.path.startswith("life.")][:6] == [
        f"life.{n}" for n in lasting
    ]
    text = " ".join(text_of(known, width=300).split())
    assert text.index("570.0 h (1.000 million revolutions)") < text.index("1912 h") < text.index("700.0 h")
    plain = solution(life=Life(**numbers | {"Lnmr_hours": None, "Lnmr": None, "modification_factor": None}))
    assert "570" not in text_of(plain)
    assert next(iter(solution_to_dict(plain)["life"])) == "L10r_hours"


def test_warnings_come_in_three_groups():
    """What to act on, what was assumed, information: on the screen the assumptions are one line, which --full lists."""
    notes = ("geometry.a is not given", Information("rating.b has no effect"), "geometry.c is not given")
    checks = {Information("the oil laws are extrapolated"): jnp.asarray(True), "balls yield": jnp.asarray(True)}
    warned = solution(notes=notes, checks=checks)
    act, assumed, information = in_groups(warned.warnings)
    assert act == ["balls yield"]
    assert assumed == ["geometry.a is not given", "geometry.c is not given"]
    assert information == ["the oil laws are extrapolated", "rating.b has no effect"]
    assert warned.warnings == [*act, *assumed, *information] == solution_to_dict(warned)["warnings"]
    short, full = text_of(warned), text_of(warned, full=True)
    order = ["Warnings", "balls yield", "Notes", "assumed: 2 entries", "the oil laws", "rating.b"]
    assert [short.index(words) for words in order] == sorted(short.index(words) for words in order)
    assert "geometry.a" not in short
    assert full.index("assumed: geometry.a") < full.index("assumed: geometry.c") < full.index("the oil laws")
    # one assumption is said at once; texts of a shaft and of a load spectrum keep their group
    assert "assumed: geometry.a is not given" in text_of(solution(notes=notes[:1]))
    assert in_groups([about("rear", text) for text in warned.warnings])[2] == [f"rear: {text}" for text in information]


def test_laws_beyond_their_range_are_information():
    """No family, and no input, calls for action by a law that is extrapolated."""
    for name in ("turbine_roller", "turbine_ball", "tapered_example"):
        texts = input_excess(jb.load_scene(name))
        assert any("extrapolated" in text for text in texts)
        assert all(isinstance(text, Information) for text in texts if "extrapolated" in text)


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_null(number):
    result = solution_to_dict(solution(Status.NOT_CONVERGED, number))
    text = json.dumps(result, allow_nan=False)
    assert "NaN" not in text
    assert (result["converged"], result["status"]) == (False, "not_converged")
    assert result["drive_power"] is None
    assert result["ring"]["radial"] is None
    assert result["elements"]["load_outer"] == [None] * N
    assert result["stiffness"] == [[None] * 5] * 5
    assert result["power_loss"]["total"] is None


def test_summary():
    text = text_of(solution())
    assert "CONVERGED" in text
    assert "9549.3 rpm" in text
    assert "25 kN" in text
    assert "100 degC" in text
    assert "360 l/h" in text
    assert "75.0" in text
    assert "speed out of range" in text
    assert "3 of 8 rollers above 2 % of the largest load, -45 to 45 deg" in text
    assert "2000 N/um" in text
    assert max(len(line) for line in text.splitlines()) <= 100


@pytest.mark.parametrize("width", [40, 60, 80, 200])
@pytest.mark.parametrize("full", [False, True])
def test_summary_at_any_width(width, full):
    assert max(len(line) for line in text_of(solution(), width, full).splitlines()) <= width


def test_life_and_power_come_first_then_warnings_then_the_parts():
    numbers = {field.name: jnp.ones(()) for field in dataclasses.fields(Life) if not field.metadata.get("static")}
    numbers |= {name: jnp.ones(N) for name in ("film_ratio_inner", "film_ratio_outer")}
    known = solution(life=Life(**numbers))
    order = ["Operating point", "Life", "Lubrication", "Rating", "Power loss", "Torque", "Drive power", "Warnings"]
    order += ["drag", "Largest load", "Cage", "Inner ring", "Stiffness", "Highest pressure"]
    for full in (False, True):
        lines = text_of(known, full=full).splitlines()
        names = [name for name in order if not full or name != "Largest load"]
        places = [next(i for i, line in enumerate(lines) if line.lstrip(" -").startswith(name)) for name in names]
        assert places == sorted(places)


def test_only_the_full_summary_has_a_row_for_each_element():
    short, full = (text_of(solution(), full=full) for full in (False, True))
    assert len(short.splitlines()) < len(full.splitlines())
    assert "azimuth" not in short
    assert "azimuth" in full
    assert "Largest load      inner race 1000 N (at 0 deg)" in short
    # every other line of the short one is in the full one
    lines = set(full.splitlines())
    assert [line for line in short.splitlines() if line not in lines and "Largest load" not in line] == []


@pytest.mark.parametrize("width", [60, 80, 100])
def test_no_number_is_cut(width):
    """Films below a micrometre make the widest columns; below about 75 columns the table comes in two pieces."""
    films = {name: jnp.full(N, 0.37654e-6) for name in ("film_inner", "film_outer")}
    pressures = {name: jnp.full(N, 1.4e9) for name in ("pressure_inner", "pressure_outer")}
    elements = dataclasses.replace(solution().elements, **films, **pressures)
    text = text_of(solution(elements=elements), width, full=True)
    assert "…" not in text
    assert text.count("0.3765") >= 6
    for title in ("Q inner", "Q outer", "p inner", "p outer", "h inner", "h outer", "1000.0", "750.0"):
        assert title in text
    assert text.count("azimuth") == (2 if width < 75 else 1)
    assert max(len(line) for line in text.splitlines()) <= width


def test_a_long_label_is_not_cut():
    stream = io.StringIO()
    print_summary(solution(), "x" * 150, Console(file=stream, width=60))
    assert stream.getvalue().count("x") - stream.getvalue().count("max") >= 150
    assert "…" not in stream.getvalue()


@pytest.mark.parametrize(
    ("scale", "total", "pocket"),
    [(1.3847, "1384.7", "346.2"), (1.2e-3, "1.200", "0.300"), (1e-6, "0.001000", "0.000250")],
)
def test_small_powers_keep_their_digits(scale, total, pocket):
    loss = PowerLoss(
        drag=jnp.asarray(750.0 * scale), pocket=jnp.asarray(250.0 * scale), total=jnp.asarray(1000.0 * scale)
    )
    text = text_of(solution(power_loss=loss, drive_power=jnp.asarray(1000.0 * scale)))
    assert f" {total} " in text.split("Drive power")[0]
    assert f" {pocket} " in text
    assert f"{total} W" in text


def test_the_loaded_zone_goes_round_the_back():
    for azimuth, loaded, words in (
        ([-45.0, 0.0, 45.0, 90.0, 135.0, 180.0, -135.0, -90.0], [4, 5, 6], "135 to 225 deg"),
        ([-45.0, 0.0, 45.0, 90.0, 135.0, 180.0, -135.0, -90.0], [0, 1, 2], "-45 to 45 deg"),
        ([0.0, 120.0, -120.0], [1], "120 to 120 deg"),
    ):
        mask = np.isin(np.arange(len(azimuth)), loaded)
        assert _loaded_zone(np.asarray(azimuth), mask, "ball").endswith(words)


def test_summary_of_a_failure_prints_no_result():
    text = text_of(solution(Status.NOT_CONVERGED, np.nan))
    assert "NOT CONVERGED" in text
    assert "not_converged" in text
    assert "ring balance" in text
    assert "Power" not in text
    assert "nan" not in text.lower()


def test_summary_without_unicode():
    stream = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    print_summary(solution(), "a scene", Console(file=stream, width=100))
    stream.flush()


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (0.0, "0"),
        (1384.7, "1385"),
        (12.3456, "12.35"),
        (0.000123, "0.0001230"),
        (-3.0, "-3.000"),
        (1e-9, "1.000e-09"),
        (np.nan, "-"),
        (123456.0, "123456"),
    ],
)
def test_digits(value, expected):
    assert digits(value) == expected


def test_engineers_units():
    assert with_unit(33.57e-6, "m") == "33.57 um"
    assert with_unit(np.pi, "rad") == "180.0 deg"
    assert with_unit(100 * np.pi / 30, "rad/s") == "100.0 rpm"
    assert with_unit(0.5, "1") == "0.5000"


@pytest.mark.parametrize("fraction", [-1.0, 0.0, 1e-9, 0.3, 0.999, 1.0, 2.0, np.nan, np.inf])
@pytest.mark.parametrize("ascii_only", [True, False])
def test_bars_fit(fraction, ascii_only):
    assert len(bar(fraction, 10, ascii_only)) <= 10
    assert len(bar(1.0, 10, ascii_only)) == 10


def test_loads_that_no_contact_can_balance_are_said_so():
    text = " ".join(text_of(solution(Status.NO_EQUILIBRIUM, np.nan)).split())
    assert "NOT CONVERGED" in text
    assert "nothing balances these loads" in text
    assert "No results" in text

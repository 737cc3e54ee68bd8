"""The page "Beside measurements": each comparison is computed again and is what the page shows, and each verdict is
borne out by its deviations."""

import math
import re
import sys
from pathlib import Path

import numpy as np
import pytest

TOP = Path(__file__).parents[2]
sys.path.insert(0, str(TOP / "docs" / "generate"))

import measurements  # noqa: E402
from beside import common, heat, pictures, torque  # noqa: E402

PAGE = measurements.PAGE.read_text(encoding="utf-8")
COMPARISONS = measurements.COMPARISONS
KEPT = measurements.kept()
every = pytest.mark.parametrize("name", COMPARISONS)
each = pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=pytest.mark.slow) if one.dear else name for name, one in COMPARISONS.items()],
)
MOST_GENEROUS = 4.0
"""A verdict names at most so many times the largest deviation, or the error of the data where this is larger."""
NUMBER = r"[-+]?\d+(?:\.\d+)?"


def assert_same_numbers(ours, printed):
    """Equal texts but for the last digit of a number, which may differ between machines."""
    assert re.split(NUMBER, ours) == re.split(NUMBER, printed)
    for one, other in zip(re.findall(NUMBER, ours), re.findall(NUMBER, printed), strict=True):
        unit = 10.0 ** -len(other.partition(".")[2])
        assert float(one) == pytest.approx(float(other), rel=2e-4, abs=1.001 * unit), (one, other)


@each
def test_the_kept_numbers_are_what_is_computed(name):
    """Solves again; deviations to 2e-4, a tenth of the last digit of the most exact of them on the page and more."""
    found, kept = COMPARISONS[name].compute(), KEPT[name]
    assert list(found.headings) == list(kept.headings)
    assert_same_numbers(found.table, kept.table)
    assert_same_numbers(found.deviation, kept.deviation)
    assert found.deviations.keys() == kept.deviations.keys()
    for what, one in found.deviations.items():
        assert one == pytest.approx(kept.deviations[what], rel=2e-3, abs=2e-5 if name == "hertz" else 2e-4), what


@every
def test_the_page_shows_the_kept_numbers(name):
    one, text = COMPARISONS[name], measurements.shown(PAGE, name)
    assert text == measurements.block(one, KEPT[name])
    assert text.startswith("| ")
    assert "{" not in one.sentence


@every
def test_verdicts_are_borne_out(name):
    """A verdict covers its largest deviation and the error of the data, and is not more generous than it must be."""
    one, deviations = COMPARISONS[name], KEPT[name].deviations
    if one.believe is None:
        assert not deviations
        return
    largest = 100.0 * max(map(abs, deviations.values()))
    assert largest <= one.believe
    assert one.believe <= MOST_GENEROUS * max(largest, one.data_error)
    assert one.believe >= one.data_error


def test_nothing_else_is_kept():
    assert list(KEPT) == list(COMPARISONS)


def test_keeping_replaces_one(monkeypatch, tmp_path):
    monkeypatch.setattr(measurements, "KEPT", tmp_path / "kept.json")
    assert measurements.kept() == {}
    for deviation in (0.1, 0.2):
        for name in ("films", "hertz"):
            measurements.keep(name, common.Found(["a"], [["1"]], {"x": deviation}))
    assert list(measurements.kept()) == ["hertz", "films"]
    assert measurements.kept()["hertz"].deviation == "+20 %"


def exponent(speeds, values):
    """Of the power of the speed, from the first to the last."""
    first, last = (math.log(float(one[-1]) / float(one[0])) for one in (speeds, values))
    return last / first


def test_numbers_of_the_text_on_heat():
    """Exponents of the heat, and the rise of the oil that is named, from the kept rows."""
    rows = KEPT["nasa_35"].rows
    rpm, measured = ([row[place] for row in rows] for place in (0, 1))
    assert f"to the power of {exponent(rpm, measured):.1f}, " in PAGE
    solved = [exponent(rpm, [row[place].split()[0] for row in rows]) for place in (3, 5)]
    assert f"that of the model with {min(solved):.1f} to {max(solved):.1f}" in PAGE
    cold = [float(row[2].split()[0]) / float(row[1]) for row in rows]
    assert cold[-1] == pytest.approx(1.5, abs=0.05)
    assert "50 per cent too high at the highest speeds" in PAGE


def test_numbers_of_the_text_on_the_predicted_loss():
    rows = KEPT["turbine_roller"].rows
    assert f"the total is {float(rows[1][4]) / float(rows[0][4]):.1f} times as large" in PAGE
    # the verdict adds the interval of the priors and the error of the law, as independent parts
    value, *ends = (float(cell) for cell in rows[1][4:7])
    largest, law = 100.0 * max(abs(end / value - 1.0) for end in ends), COMPARISONS["trb_32008"].believe
    sentence = COMPARISONS["turbine_roller"].sentence
    assert f"the priors leave up to {largest:.0f}, and" in sentence
    assert f"is {law:.0f} per cent uncertain" in sentence
    assert 40.0 < np.hypot(largest, law) <= 50.0
    assert "to about 50 per cent" in sentence
    low, high = re.findall(r"\d+", KEPT["trb_32008"].deviation)
    assert f"there it comes out {low} to {high} % too high at 2200 rpm" in PAGE


def test_numbers_of_bearings_that_are_named():
    """The catalogue has one more, whose series has no factors."""
    count = sum(int(row[1]) for row in KEPT["reference_formula"].rows)
    assert COMPARISONS["reference_formula"].data.startswith(f"{count} ")
    assert count == len(common.rows_of(common.MEASURED / "skf_reference_speeds.csv")) - 1


def test_numbers_of_the_text_on_rigidity():
    example = common.script("gmn_rigidity")
    data = example.printed()
    assert f"Of all {data.bearing.max() + 1} spindle bearings" in PAGE
    largest = 100.0 * float(np.max(0.5e6 / data.rigidity))
    assert f"half a unit is up to {largest:.0f} %" in PAGE


def test_pictures_are_drawn_of_the_kept_numbers(monkeypatch, tmp_path):
    for name in ("OVERVIEW", "PREDICTION"):
        assert f"](pictures/{getattr(pictures, name).name})" in PAGE
        assert getattr(pictures, name).exists()
        monkeypatch.setattr(pictures, name, tmp_path / f"{name}.png")
    pictures.draw(COMPARISONS, KEPT)
    assert all((tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG") for name in ("OVERVIEW", "PREDICTION"))


def test_summary_is_made_of_the_page():
    assert measurements.shown(PAGE, measurements.SUMMARY) == measurements.summary(PAGE, COMPARISONS)
    anchors = set(re.findall(r"\]\(#([\w-]+)\)", PAGE))
    headings = re.findall(r"^## (.+)$", PAGE, flags=re.MULTILINE)
    assert anchors <= {re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", one).strip().lower()) for one in headings}


def test_marks_stand_in_pairs_and_each_once():
    begins = re.findall(r"<!-- (\w+) -->", PAGE)
    assert begins == re.findall(r"<!-- end (\w+) -->", PAGE)
    assert begins == [measurements.SUMMARY, *COMPARISONS]


def test_text_is_written_between_its_marks_only():
    page = "a\n<!-- x -->\nold\n<!-- end x -->\nb\n<!-- y -->\n<!-- end y -->\n"
    new = measurements.written(page, "x", "| t |")
    assert new == "a\n<!-- x -->\n\n| t |\n\n<!-- end x -->\nb\n<!-- y -->\n<!-- end y -->\n"
    assert measurements.shown(new, "x") == "| t |"
    assert measurements.written(new, "x", "| t |") == new
    with pytest.raises(ValueError, match="no marks of z"):
        measurements.shown(page, "z")
    with pytest.raises(SystemExit, match="found z; expected names among nasa_35"):
        measurements.main(["z"])


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ([-0.22, 0.03, 0.0], "-22 to +3 %"),
        ([0.0123, -0.004], "-0.4 to +1.2 %"),
        ([2.1e-4, -1e-4], "-0.010 to +0.021 %"),
        ([0.2, 0.2], "+20 %"),
    ],
)
def test_deviations_in_words(values, text):
    assert common.ends(values) == text


def test_data_are_those_of_the_scripts():
    """The script of the 35-mm bearing repeats the file, which the page reads."""
    example = common.script("nasa_35mm")
    rows = [row for row in common.rows_of(common.MEASURED / "nasa_tp2275.csv") if row["bearing"] == "35mm"]
    read = {int(row["n_rpm"]): tuple(float(row[name]) for name in ("heat_W", "T_inner_K", "T_outer_K")) for row in rows}
    assert read == example.MEASURED
    # the script of the 32216 has ten of the twelve points of Figures 5 and 6
    points = [tuple(point) for point in torque.points_32216()]
    assert len(points) == 12
    assert set(common.script("trb_32216").MEASURED) < set(points)


def test_the_rows_of_the_120_mm_bearing_contradict_themselves():
    """Heat over the capacity rate of the oil: the rise that the thermal page names too."""
    found = heat.heat_120()
    assert [row[2] for row in found.rows][-1] == "117"
    assert "117 K" in (TOP / "docs" / "thermal.md").read_text(encoding="utf-8")
    assert not found.deviations


@pytest.mark.parametrize("file", sorted(common.MEASURED.glob("*.csv")), ids=lambda path: path.stem)
def test_every_file_names_its_source_and_is_read(file):
    text = file.read_text(encoding="utf-8")
    assert text.startswith("# ")
    assert len(common.rows_of(file)) > 2
    code = "".join(path.read_text(encoding="utf-8") for path in (TOP / "docs").rglob("*.py"))
    assert f'"{file.name}"' in code

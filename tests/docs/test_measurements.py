"""The page "Beside measurements": each comparison is computed again, each verdict is borne out by its deviations, and
the table of the page is made of them."""

import dataclasses
import math
import re
import sys
from pathlib import Path

import numpy as np
import pytest

TOP = Path(__file__).parents[2]
sys.path.insert(0, str(TOP / "docs" / "generate"))

import measurements  # noqa: E402
from beside import common, guide, heat, pictures, torque  # noqa: E402

PAGE = measurements.PAGE.read_text(encoding="utf-8")
COMPARISONS = measurements.COMPARISONS
KEPT = measurements.kept()
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
    assert_same_numbers(found.told, kept.told)
    assert found.deviations.keys() == kept.deviations.keys()
    for what, one in found.deviations.items():
        assert one == pytest.approx(kept.deviations[what], rel=2e-3, abs=2e-5 if name == "hertz" else 2e-4), what


def test_comparisons_are_printed(capsys):
    measurements.main(["--show", "hertz"])
    assert capsys.readouterr().out.strip() == measurements.block(COMPARISONS["hertz"], KEPT["hertz"])
    measurements.main(["--show"])
    printed = capsys.readouterr().out
    assert all(f"Verdict: {one.sentence}\n" in printed for one in COMPARISONS.values())
    assert "{" not in printed
    for wrong in (["--shown"], ["herz"]):
        with pytest.raises(SystemExit, match=f"found {wrong[0]}; expected --kept, --show or names among nasa_35, "):
            measurements.main(wrong)


def test_verdicts_are_borne_out():
    """A verdict covers its largest deviation and the error of the data, and is not more generous than it must be."""
    for name, one in COMPARISONS.items():
        deviations = KEPT[name].deviations
        if one.believe is None:
            assert not deviations, name
            continue
        largest = 100.0 * max(map(abs, deviations.values()))
        assert largest <= one.believe, name
        assert one.believe <= MOST_GENEROUS * max(largest, one.data_error), name
        assert one.believe >= one.data_error, name


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


def numbers(cell):
    """All numbers of a cell."""
    return [float(one) for one in re.findall(NUMBER, cell)]


def column(name, heading):
    """Cells of a kept table under a heading."""
    return [row[KEPT[name].headings.index(heading)] for row in KEPT[name].rows]


def percents(name, heading):
    """Deviations in brackets of a column, per cent."""
    return [int(cell.partition("(")[2].partition(" %)")[0]) for cell in column(name, heading)]


def test_numbers_of_the_text_on_heat():
    """The largest deviation with cold oil and of the inner ring, from the kept rows."""
    heats = {heading: [numbers(cell)[0] for cell in column("nasa_35", heading)] for heading in KEPT["nasa_35"].headings}
    cold = "all oil at inlet temperature, W"
    sentence = COMPARISONS["nasa_35"].sentence
    low, high = -min(percents("nasa_35", cold)), max(percents("nasa_35", cold))
    assert f"the heat is between {low} per cent too low and {high} per cent too high" in sentence
    assert belief("nasa_35", guide.NO).endswith(f"between {low} % too low and {high} % too high")
    found, said = (heats[one] for one in KEPT["nasa_35"].headings[6:8])
    off = [one - other for one, other in zip(found, said, strict=True)]
    assert f"up to {max(off):.0f} K hotter" in COMPARISONS["nasa_35"].missed


def belief(name, kind):
    """The answer of this kind in the table at the top that rests on a comparison."""
    (found,) = (row.belief for row in guide.ROWS if row.comparison == name and row.belief.startswith(kind))
    return found


def test_numbers_of_the_text_on_the_bath():
    """The flooded torque over the measured one, Palmgren's largest deviation, and the points that are left out."""
    flooded = [1.0 + 0.01 * one for one in percents("trb_32216", "flooded")]
    said = f"it is {min(flooded):.1f} to {max(flooded):.1f} times the measured one"
    assert said in COMPARISONS["trb_32216"].sentence
    assert said in belief("trb_32216", guide.NO)
    palmgren = max(map(abs, percents("trb_32216", "Palmgren's formula")))
    assert palmgren <= 28 < palmgren + 2
    assert "within 28 per cent" in COMPARISONS["trb_32216"].sentence
    left_out = percents("trb_32216_left_out", "supply of a bath")
    bath = percents("trb_32216", "supply of a bath")
    least, worst = (1.0 + 0.01 * one for one in (min(bath), max(left_out)))
    answer = belief("trb_32216", guide.BELIEVE)
    assert f"to a factor of {worst:.1f}, on the high side" in answer
    assert f"between {1.0 / worst:.2f} and {1.0 / least:.2f} of the result" in answer
    assert f"it is {1.0 + 0.01 * min(left_out):.1f} to {worst:.1f} times the measured one" in answer
    assert f"to a factor of {worst:.1f}, on the high side" in COMPARISONS["trb_32216"].sentence
    also = 1.0 + 0.01 * max(percents("trb_32216_left_out", "flooded"))
    assert f"in Figure 7 up to {also:.1f} times" in COMPARISONS["trb_32216"].sentence
    assert belief("trb_32216", guide.NO).endswith(f"at the five {also:.1f}")
    assert numbers(KEPT["trb_32216_left_out"].deviation)[:2] == [min(left_out), max(left_out)]
    assert min(left_out) > COMPARISONS["trb_32216"].believe
    assert not {point.figure for point in torque.points_32216()} & set(torque.LEFT_OUT)
    gap = common.script("trb_32216").STARVED["gap_over_central"]
    assert f"{gap:.2f} central films" in COMPARISONS["trb_32216"].free


def test_numbers_of_the_text_on_the_32008():
    """Both readings at every speed: what the verdict says of the lowest, the middle and the highest speed."""
    one, points = COMPARISONS["trb_32008"], {}
    for celsius, rpm, *cells in KEPT["trb_32008"].rows:
        first, second, model = map(float, cells[:3])
        points[int(celsius), int(rpm)] = (first, second, model, *(int(numbers(cell)[0]) for cell in cells[3:]))
    at = lambda *speeds: [off for (_, rpm), point in points.items() for off in point[3:] if rpm in speeds]
    slow, fast = at(torque.SLOW), at(torque.FAST)
    assert f"it is {-max(slow)} to {-min(slow)} per cent too low" in one.sentence
    assert f"{-max(slow)} to {-min(slow)} % too low" in belief("trb_32008", guide.NO)
    assert f"{min(fast)} to {max(fast)} per cent too high" in one.sentence
    assert max(at(400)) < 0 < min(at(1800, 2200))
    answer = belief("trb_32008", guide.BELIEVE)
    assert f"{-max(at(400))} to {-min(at(400))} % too low at 400 rpm" in answer
    assert f"{min(fast)} to {max(fast)} % too high at 2200 rpm" in answer
    compared = [off for (_, rpm), point in points.items() for off in point[3:] if rpm > torque.SLOW]
    assert f"{len(compared)} comparisons" in one.sentence
    speeds = {rpm for _, rpm in points}
    assert len(KEPT["trb_32008"].deviations) == 2 * 2 * (len(speeds) - 1)
    # the readings of the compared points lie so far from their geometric mean, at most
    spread = max(abs(math.log(point[1] / point[0])) for (_, rpm), point in points.items() if rpm > torque.SLOW)
    assert 100.0 * math.expm1(0.5 * spread) <= one.data_error


def test_numbers_of_the_text_on_reference_speeds():
    flooded = -min(percents("reference_model", "model, flooded, rpm"))
    assert f"flooded it is up to {flooded} per cent too low" in COMPARISONS["reference_model"].sentence
    assert f"flooded to 60 % ({flooded} % is the largest" in belief("reference_model", guide.BELIEVE)
    losses = [float(row[-1]) for row in KEPT["reference_model"].rows]
    said = f"{min(losses)} to {max(losses)} times the heat that leaves"
    assert said in COMPARISONS["reference_model"].sentence
    assert said in belief("reference_model", guide.NO)
    medians = {row[0]: numbers(row[2])[0] for row in KEPT["reference_formula"].rows}
    assert [series for series, one in medians.items() if one >= 0] == ["NU 4"]
    high = {row[0]: numbers(row[3].replace(" to ", " "))[1] for row in KEPT["reference_formula"].rows}
    assert [series for series, one in high.items() if one >= 0] == ["NU 4"]
    assert f"up to {high['NU 4']:.0f} per cent too high" in COMPARISONS["reference_formula"].sentence
    assert f"up to {high['NU 4']:.0f} % high" in belief("reference_formula", guide.BELIEVE)


def test_numbers_of_the_text_on_traction_and_shocks():
    """The knee, single shock loads, and the growth with the speed."""
    off = [int(numbers(cell)[0]) for cell in column("traction", "deviation")]
    assert KEPT["traction"].deviation == f"{min(off)} to +{max(off)} %"
    printed = [float(row[1]) for row in KEPT["shocks"].rows]
    pairs = [[numbers(cell)[:2] for cell in row[2:]] for row in KEPT["shocks"].rows]
    singles = [load / own for own, row in zip(printed, pairs, strict=True) for pair in row for load in pair]
    assert min(singles) == pytest.approx(1 / 20)
    assert f"from a twentieth to {max(singles):.1f} times" in COMPARISONS["shocks"].sentence
    assert f"{1 / min(singles):.0f} times" in belief("shocks", guide.NO)
    means = [[math.sqrt(front * rear) for front, rear in row] for row in pairs]
    growth = [high / low for row in (0, 2) for low, high in zip(means[row], means[row + 1], strict=True)]
    own = [printed[row + 1] / printed[row] for row in (0, 2)]
    missed = COMPARISONS["shocks"].missed
    assert f"the printed load grows {min(own):.1f} to {max(own):.1f} times" in missed
    assert f"the computed mean {min(growth):.1f} to {max(growth):.1f} times" in missed
    # with the load the printed shocks and the computed rear loads grow, the computed front loads and means fall
    for row in (0, 1):
        for light, heavy in zip(pairs[row], pairs[row + 2], strict=True):
            assert heavy[0] < light[0]
            assert heavy[1] > light[1]
    assert all(printed[row + 2] > printed[row] for row in (0, 1))
    assert all(means[row + 2][place] < means[row][place] for row in (0, 1) for place in range(3))


def test_verdict_on_the_statements():
    """The statements that are believed hold for both scenes, and those that are not fail for at least one."""
    holds = {int(row[0]): row[2:] == ["yes", "yes"] for row in KEPT["claims"].rows}
    assert holds[6]
    assert not any(holds[number] for number in (3, 4, 9, 11))
    assert [number for number, one in holds.items() if not one] == [3, 4, 5, 8, 9, 11]
    missed = COMPARISONS["claims"].missed
    assert all(
        said in missed for said in ("Statements 3, 4 and 5 fail", "Statements 8 and 9 hang", "Statement 11 fails")
    )


def test_numbers_of_the_text_on_the_predicted_loss():
    """The range of the estimate: the judgement's interval, and the error of the law on the part that it adds."""
    rows, sentence = KEPT["turbine_roller"].rows, COMPARISONS["turbine_roller"].sentence
    answer = belief("turbine_roller", guide.UNKNOWN)
    # kW: the total and the ends of its interval
    (plain, *of_drag), (whole, *ends), *_, (flooded, *_) = ([1e-3 * float(cell) for cell in row[4:7]] for row in rows)
    assert rows[0][0].startswith("without rolling resistance")
    assert rows[-1][0] == "all losses, flooded inlets"
    assert f"{whole / plain:.1f} times smaller" in COMPARISONS["turbine_roller"].missed
    assert f"with flooded inlets it is {flooded:.1f} kW" in sentence
    added, law = whole - plain, 0.01 * COMPARISONS["trb_32008"].believe
    part = added / (1.0 + law), added / (1.0 - law)
    low, high = (end + one - added for end, one in zip(ends, part, strict=True))
    for text in (answer, sentence):
        assert f"prints {plain:.1f} kW" in text
        assert f"{whole:.1f} kW, and the truth between {low:.1f} and {high:.1f} kW" in text
    assert "on the screen, {:.1f} to {:.1f} kW".format(*of_drag) in sentence
    assert "drag and supply leave {:.1f} to {:.1f} kW".format(*ends) in sentence
    assert f"adds {added:.1f} of the {whole:.1f} kW and is believed to {100.0 * law:.0f} per cent" in sentence
    assert "this part is between {:.1f} and {:.1f} kW".format(*part) in sentence
    assert COMPARISONS["turbine_roller"].believe is None


WANTED = (
    "life", "loads on balls", "loads on rollers", "pressure", "film", "traction", "torque", "loss, ball", "loss, cyl",
    "grease", "bath", "temperatures", "cage speed", "skid", "axial stiffness", "radial and moment stiffness", "preload",
    "shock", "impact", "speed limit",
)  # fmt: skip
"""Words of the quantities that a user may want."""


def test_every_quantity_has_an_answer():
    """Each answer is one of three; each comparison with a per cent is asked for, with its own per cent."""
    shown = measurements.shown(PAGE, measurements.ANSWERS)
    assert shown == measurements.answers(COMPARISONS)
    assert measurements.shown(PAGE, measurements.KIND) == measurements.kinds()
    assert len(PAGE.split()) <= 1500
    assert all(word in shown for word in WANTED)
    for row in guide.ROWS:
        assert row.belief.startswith((guide.BELIEVE, guide.UNKNOWN, guide.NO)), row
        assert row.comparison in COMPARISONS or row.belief.startswith(guide.UNKNOWN), row
    named = {name for row in guide.ROWS for name in re.findall(r"\{(\w+)\}", row.belief)}
    assert named == {name for name, one in COMPARISONS.items() if one.believe is not None}
    assert all(row.comparison in named for row in guide.ROWS if "{" in row.belief)
    # a whole series of spindle bearings with one conformity
    series = [abs(one) for cell in column("rigidity", KEPT["rigidity"].headings[3]) for one in numbers(cell)]
    assert max(series) < 15.0
    every_one = [numbers(cell.replace(" to ", " ")) for cell in column("rigidity", "conformities of the bearings")]
    fitted = f"lie between {min(map(min, every_one)):.3f} and {max(map(max, every_one)):.3f}"
    assert any(fitted in row.belief for row in guide.ROWS if row.quantity == "axial stiffness")
    assert any("to 15 %" in row.belief for row in guide.ROWS if row.comparison == "rigidity")


def test_links_of_the_answers():
    for page, place in re.findall(r"\((\w+\.md)#([\w-]+)\)", " ".join(row.belief for row in guide.ROWS)):
        text = (TOP / "docs" / page).read_text(encoding="utf-8")
        assert place in {plain(one) for one in re.findall(r"^## (.+)$", text, flags=re.MULTILINE)}


def plain(heading):
    """Anchor of a heading."""
    return re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", heading).strip().lower())


LONGEST = 40
"""Words of a sentence."""


def test_texts_are_short_sentences():
    for one in COMPARISONS.values():
        assert one.kind in common.KINDS
        for text in (one.conditions, one.free, one.assumed, one.missed, one.sentence):
            assert text.endswith("."), text
            for sentence in re.split(r"[.:;] ", text):
                assert 2 <= len(sentence.split()) <= LONGEST, sentence
        assert re.search("fitted|chosen|reproduce", one.free), one.free


def test_kinds_are_explained():
    assert measurements.shown(PAGE, measurements.KIND) == measurements.kinds()
    assert {one.kind for one in COMPARISONS.values()} == set(common.KINDS)
    with pytest.raises(ValueError, match="kind is 'guess'; expected one of measured"):
        dataclasses.replace(COMPARISONS["hertz"], kind="guess")


def test_numbers_of_bearings_that_are_named():
    """The catalogue has one more, whose series has no factors."""
    count = sum(int(row[1]) for row in KEPT["reference_formula"].rows)
    assert COMPARISONS["reference_formula"].data.startswith(f"{count} ")
    assert count == len(common.rows_of(common.MEASURED / "skf_reference_speeds.csv")) - 1


def test_numbers_of_the_text_on_rigidity():
    data = common.script("gmn_rigidity").printed()
    assert COMPARISONS["rigidity"].data.startswith(f"{data.bearing.max() + 1} spindle bearings")
    assert any(row.case.startswith(f"{data.bearing.max() + 1} angular contact bearings") for row in guide.ROWS)
    largest = 100.0 * float(np.max(0.5e6 / data.rigidity))
    assert f"rounded by up to {largest:.0f} per cent" in COMPARISONS["rigidity"].sentence


def test_the_picture_is_drawn_of_the_kept_numbers(monkeypatch, tmp_path):
    assert f"](pictures/{pictures.OVERVIEW.name})" in PAGE
    assert pictures.OVERVIEW.exists()
    monkeypatch.setattr(pictures, "OVERVIEW", tmp_path / "overview.png")
    pictures.draw(COMPARISONS, KEPT)
    assert (tmp_path / "overview.png").read_bytes().startswith(b"\x89PNG")


def test_every_comparison_is_named_on_the_page():
    named = set(re.findall(r"\| (\w+) \|$", measurements.shown(PAGE, measurements.ANSWERS), flags=re.MULTILINE))
    named -= {"comparison"}  # the heading
    assert named <= set(COMPARISONS)
    assert set(COMPARISONS) - named == {"trb_32216_left_out"}  # the five more points of the 32216


def test_marks_stand_in_pairs_and_each_once():
    begins = re.findall(r"<!-- (\w+) -->", PAGE)
    assert begins == re.findall(r"<!-- end (\w+) -->", PAGE)
    assert begins == [measurements.ANSWERS, measurements.KIND]


def test_text_is_written_between_its_marks_only():
    page = "a\n<!-- x -->\nold\n<!-- end x -->\nb\n<!-- y -->\n<!-- end y -->\n"
    new = measurements.written(page, "x", "| t |")
    assert new == "a\n<!-- x -->\n\n| t |\n\n<!-- end x -->\nb\n<!-- y -->\n<!-- end y -->\n"
    assert measurements.shown(new, "x") == "| t |"
    assert measurements.written(new, "x", "| t |") == new
    with pytest.raises(ValueError, match="no marks of z"):
        measurements.shown(page, "z")


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

"""Tidy CSV files of traction curves: what is read, and every way in which they can be broken."""

from pathlib import Path

import numpy as np
import pytest
from table_accidents import cells_as_they_stand, mutated, number

from fitting.io import CurveError, CurveTable, read_curves

DATA = Path(__file__).parent / "data"
GOOD = "slide_to_roll [%],traction_coefficient,load [N]\n1,0.01,100\n5,0.04,100\n10,0.05,100\n"

close = lambda value, expected: np.testing.assert_allclose(value, expected, rtol=1e-14)  # one conversion of units


@pytest.fixture
def read(tmp_path):
    """Reads a text (or bytes) as a file, with a side file if given."""

    def read_text(content, side=None):
        path = tmp_path / "curves.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        if side is not None:
            (tmp_path / "curves.units.toml").write_text(side, encoding="utf-8")
        return read_curves(path)

    return read_text


def test_measured_sweeps_load_as_they_are():
    table = read_curves(DATA / "traction_etm_sweeps.csv")
    assert (table.point_count, table.curve_count) == (205, 5)
    assert table.curve_names == ("14", "100", "266", "400", "517")
    assert table.origin == "traction_etm_sweeps.csv"
    assert table.pressure is None
    np.testing.assert_array_equal(np.bincount(table.curve), [41] * 5)
    # lines 2 and 43 of the file
    for point, slide, coefficient, temperature, load, speed in [
        (0, 20.062, 0.0525, 39.8, 1646.964, 25.00),
        (41, 20.934, 0.0238, 39.8, 1644.986, 24.94),
    ]:
        close(table.slide_to_roll[point], slide / 100)
        close(table.traction_coefficient[point], coefficient)
        close(table.temperature[point], temperature + 273.15)
        close(table.load[point], load)
        close(table.entrainment_speed[point], speed * 1e-3)
    assert table.slide_to_roll.min() == -0.0031
    assert any("4 points have a traction coefficient of another sign" in note for note in table.notes)


def test_measured_median_loads_as_it_is():
    table = read_curves(str(DATA / "traction_etm_median.csv"))
    assert (table.point_count, table.curve_count) == (18, 1)
    close(table.slide_to_roll[[0, -1]], [0.00104, 0.1909])
    close(table.traction_coefficient[[0, -1]], [0.0039, 0.0572])
    assert (table.pressure, table.load, table.entrainment_speed, table.temperature) == (None, None, None, None)
    for name in ("traction_coefficient_q25", "traction_coefficient_q75", "count"):
        assert f"Column '{name}' is ignored." in table.notes


@pytest.mark.parametrize(
    ("header", "cell", "field", "expected"),
    [
        ("slide_to_roll", "0.25", "slide_to_roll", 0.25),
        ("slide_to_roll [%]", "-25", "slide_to_roll", -0.25),
        ("slide_to_roll [-]", "0.25", "slide_to_roll", 0.25),
        ("traction_coefficient [%]", "5", "traction_coefficient", 0.05),
        ("pressure [GPa]", "1.25", "pressure", 1.25e9),
        ("pressure[MPa]", "1250", "pressure", 1.25e9),
        ("pressure [ N/mm^2 ]", "1250", "pressure", 1.25e9),
        ("load [kN]", "1.5e-1", "load", 150.0),
        ("load [N]", "+150.", "load", 150.0),
        ("entrainment_speed [mm/s]", "2500", "entrainment_speed", 2.5),
        ("entrainment_speed [m/min]", ".6", "entrainment_speed", 0.01),
        ("temperature [degC]", "40", "temperature", 313.15),
        ("temperature [°C]", "-10", "temperature", 263.15),
        ("temperature [K]", "313.15", "temperature", 313.15),
        ("temperature [degF]", "104", "temperature", 313.15),
    ],
)
def test_units(header, cell, field, expected, read):
    columns = {"slide_to_roll": "0.1", "traction_coefficient": "0.02"}
    columns = {name: value for name, value in columns.items() if name != header.split("[")[0].strip()} | {header: cell}
    row = ",".join(columns.values())
    table = read(f"{','.join(columns)}\n{row}\n{row}\n")
    close(getattr(table, field), [expected, expected])
    assert getattr(table, field).dtype == np.float64


def test_units_from_a_side_file(read):
    text = "slide_to_roll,traction_coefficient,pressure,temperature,torque\n1,0.01,1.2,40,3\n2,0.02,1.2,40,3\n"
    side = '[units]\nslide_to_roll = "%"\npressure = "GPa"\ntemperature = "degC"\ntorque = "Nm"\n'
    table = read(text, side)
    close(table.slide_to_roll, [0.01, 0.02])
    close(table.pressure, [1.2e9] * 2)
    close(table.temperature, [313.15] * 2)


@pytest.mark.parametrize(
    "content",
    [
        GOOD.replace("\n", "\r\n"),
        GOOD.replace("\n", "\r"),
        b"\xef\xbb\xbf" + GOOD.encode(),
        GOOD.replace(",", ";"),
        GOOD.replace(",", "\t"),
        GOOD.replace(",", ";").replace(".", ","),
        GOOD.replace(",", "\t").replace(".", ","),
        GOOD.replace(",", " , "),
        "# a remark, with commas\n\n" + GOOD.replace("\n5", "\n\n  # another\n,,\n5"),
        GOOD.removesuffix("\n"),
        GOOD.replace("slide_to_roll [%]", '"slide_to_roll [%]"').replace("0.04", '"0.04"'),
        GOOD.replace("\n", ",\n"),
        "note;" + GOOD.replace(",", ";").replace(".", ",").replace("\n", "\n3.5,2;").removesuffix("3.5,2;"),
    ],
    ids=[
        *("crlf", "cr", "bom", "semicolon", "tab", "comma", "comma_tab", "spaces", "remarks", "no_end", "quotes"),
        *("empty_column", "ignored_column"),
    ],
)
def test_same_table_in_other_clothes(content, read):
    table = read(content)
    close(table.slide_to_roll, [0.01, 0.05, 0.1])
    close(table.traction_coefficient, [0.01, 0.04, 0.05])
    close(table.load, [100.0] * 3)


def test_content_decides_not_the_name(tmp_path):
    path = tmp_path / "curves.txt"
    path.write_text(GOOD, encoding="utf-8")
    assert read_curves(path).point_count == 3


def test_curves_by_name_in_order_of_appearance(read):
    table = read("curve,slide_to_roll,traction_coefficient\nb,0,0\na,0.1,0.01\nb,0.2,0.02\nc 1,0.1,0.01\n")
    assert table.curve_names == ("b", "a", "c 1")
    np.testing.assert_array_equal(table.curve, [0, 1, 0, 2])


def grouped(read, **columns):
    """Table of the given columns beside slide ratios and coefficients."""
    count = len(next(iter(columns.values())))
    columns = {"slide_to_roll": np.linspace(0.01, 0.1, count), "traction_coefficient": np.full(count, 0.03)} | columns
    units = {"pressure": " [GPa]", "load": " [N]", "entrainment_speed": " [m/s]", "temperature": " [degC]"}
    header = ",".join(name + units.get(name, "") for name in columns)
    return read(
        "\n".join([header, *(",".join(f"{x:.4f}" for x in row) for row in zip(*columns.values(), strict=True))])
    )


def test_curves_by_set_conditions(read):
    pressure = np.repeat([1.5, 1.0, 1.5, 1.0], 5)
    temperature = np.repeat([40.0, 40.0, 80.0, 40.0], 5)
    table = grouped(read, pressure=pressure, temperature=temperature, entrainment_speed=np.full(20, 2.0))
    assert table.curve_names == ("1.5 GPa, 40 degC", "1 GPa, 40 degC", "1.5 GPa, 80 degC")
    np.testing.assert_array_equal(table.curve, np.repeat([0, 1, 2, 1], 5))
    assert any("grouped by pressure and temperature into 3 curves" in note for note in table.notes)


def test_two_points_make_a_curve_where_values_repeat(read):
    table = grouped(read, load=np.array([20.0, 20.0, 40.0, 40.0]))
    assert table.curve_names == ("20 N", "40 N")


def test_scatter_of_measured_conditions_parts_nothing(read):
    random = np.random.default_rng(0)
    load = 1647 * (1 + 0.01 * random.uniform(-1, 1, 40))
    speed = 0.5 * (1 + 0.01 * random.uniform(-1, 1, 40))
    drift = np.linspace(39.0, 55.0, 40)  # oil warming up, much more than 2 K in all
    assert grouped(read, load=load, entrainment_speed=speed, temperature=drift).curve_names == ("1",)


def test_clear_jumps_of_measured_conditions_part_curves(read):
    random = np.random.default_rng(0)
    load = np.repeat([200.0, 100.0], 20) * (1 + 0.01 * random.uniform(-1, 1, 40))
    table = grouped(read, load=load, temperature=40 + random.uniform(-1, 1, 40))
    np.testing.assert_array_equal(table.curve, np.repeat([0, 1], 20))


def test_few_points_all_different_are_one_curve(read):
    table = grouped(read, temperature=np.array([40.0, 45.0, 43.0, 51.0]))
    assert table.curve_count == 1
    assert "Column 'temperature' scatters from 40 degC to 51 degC: taken as one condition." in table.notes


def test_suspicious_values_get_a_note(read):
    notes = read(GOOD.replace("slide_to_roll [%]", "slide_to_roll")).notes
    assert any("'slide_to_roll [%]'" in note for note in notes)
    notes = read(GOOD.replace("load [N]", "pressures")).notes
    assert "Column 'pressures' is ignored (did you mean 'pressure [GPa]'?)." in notes


def test_headings_in_capital_letters_are_read(read):
    table = read(GOOD.replace("load [N]", "Load [N]").replace("traction_coefficient", "Traction_Coefficient"))
    np.testing.assert_array_equal(table.load, read(GOOD).load)


# name: (content, line, column, words of the message)
HEADER = "slide_to_roll [%],traction_coefficient,load [N]"
BROKEN = {
    "empty": ("", None, "", ["an empty file"]),
    "blank": (" \n\n", None, "", ["an empty file"]),
    "remarks_only": ("# nothing\n", None, "", ["an empty file"]),
    "not_utf8": (GOOD.encode() + "2,0.02,1\n# Größe\n".encode("latin-1"), 6, "", ["UTF-8"]),
    "utf16": (GOOD.encode("utf-16"), 1, "", ["UTF-8"]),
    "null_bytes": (b"\0\0\0", 1, "slide_to_roll", ["'slide_to_roll [%]'"]),
    "missing_slide": ("\n" + GOOD.replace("slide_to_roll", "srr"), 2, "slide_to_roll", ["required"]),
    "misspelt_slide": (GOOD.replace("slide_to_roll", "slide_to_rol"), 1, "slide_to_roll", ["Did you mean 'slide_"]),
    "missing_coefficient": (
        "slide_to_roll,mu\n1,1\n2,2\n",
        1,
        "traction_coefficient",
        ["'mu'", "Did you mean 'traction_"],
    ),
    "quartile": ("slide_to_roll,traction_coefficient_q75,mu\n1,1,1\n", 1, "traction_coefficient", ["the column 'mu'"]),
    "load_of_another_name": (GOOD.replace("load", "normal force"), 1, "normal force", ["no column 'load'"]),
    "speed_of_another_name": (GOOD.replace("load [N]", "speed [m/s]"), 1, "speed", ["'entrainment_speed [m/s]'"]),
    "spaces_between": (GOOD.replace(",", "   "), 1, "slide_to_roll", ["',', ';' or tabs"]),
    "duplicate": ("load [kN]," + GOOD, 1, "load", ["2 columns of this name"]),
    "duplicate_other_unit": ("slide_to_roll," + GOOD, 1, "slide_to_roll", ["2 columns"]),
    "pressure_and_load": ("pressure [GPa]," + GOOD, 1, "load", ["'pressure' and a column 'load'"]),
    "mixed_header": (GOOD.replace(",load", ";load"), 1, "", ["';' and ',' between columns", "one separator"]),
    "mixed_row": (GOOD.replace("5,0.04,100", "5;0.04;100"), 3, "", ["1 cell and ';'", "3 cells"]),
    "mixed_row_tab": (GOOD.replace("5,0.04,100", "5,0.04\t100"), 3, "", ["2 cells and a tab"]),
    "too_many_cells": (GOOD.replace("5,0.04,", "5,0,04,"), 3, "", ["4 cells", "3 cells separated by ','", "line 1"]),
    "too_few_cells": ("\n#\n" + GOOD.replace("0.05,", ""), 6, "", ["2 cells", "line 3"]),
    "open_quote": (GOOD.replace("5,0.04", '5,"0.04'), 3, "", ["quotation marks"]),
    "text": (GOOD.replace("0.04", "abc"), 3, "traction_coefficient", ["the text 'abc'", "a number"]),
    "thousands": (GOOD.replace(",", ";").replace("100", "1.000,5"), 2, "load", ["'1.000,5'"]),
    "underscore": (GOOD.replace("0.04", "0_04"), 3, "traction_coefficient", ["the text '0_04'"]),
    "other_digits": (GOOD.replace("0.04", "٣"), 3, "traction_coefficient", ["a number"]),
    "decimal_comma": (GOOD.replace("0.05", '"0,05"'), 4, "traction_coefficient", ["';' or a tab"]),
    "two_decimal_marks": (GOOD.replace(",", ";").replace("0.04", "0,04"), 3, "traction_coefficient", ["in line 2"]),
    "nan": (GOOD.replace("0.04", "NaN"), 3, "traction_coefficient", ["'NaN', which is not finite"]),
    "infinity": (GOOD.replace("\n5", "\n-inf"), 3, "slide_to_roll", ["not finite"]),
    "too_large": (GOOD.replace("0.04", "1e999"), 3, "traction_coefficient", ["not finite"]),
    "too_large_in_si": (GOOD.replace("[N]", "[GN]").replace("100", "1e305"), 2, "load", ["1e+305 GN"]),
    "empty_cell": (GOOD.replace("0.05", ""), 4, "traction_coefficient", ["an empty cell"]),
    "header_again": (GOOD + GOOD, 5, "", ["the header once more"]),
    "header_only": (HEADER + "\n", 1, "", ["a header without points"]),
    "one_row": (HEADER + "\n1,0.01,100\n", 2, "", ["a single point"]),
    "no_unit": (GOOD.replace(" [N]", ""), 1, "load", ["no unit", "'load [N]'", "curves.units.toml"]),
    "empty_unit": (GOOD.replace("[N]", "[]"), 1, "load", ["no unit"]),
    "unknown_unit": (GOOD.replace("[N]", "[Newtons per]"), 1, "load", ["'Newtons per', which is not known"]),
    "code_for_a_unit": (GOOD.replace("[N]", "[9**9**9]"), 1, "load", ["not known"]),
    "wrong_dimension": (GOOD.replace("[N]", "[GPa]"), 1, "load", ["the unit 'GPa'", "another kind", "a force"]),
    "percent_of_load": (GOOD.replace("[N]", "[%]"), 1, "load", ["the unit '%'", "a force"]),
    "unit_of_a_ratio": (GOOD.replace("[%]", "[m/s]"), 1, "slide_to_roll", ["'m/s'", "a ratio"]),
    "unit_of_curve": (GOOD.replace("load [N]", "curve [N]"), 1, "curve", ["without a unit"]),
    "difference_of_temperatures": (GOOD.replace("load [N]", "temperature [delta_degC]"), 1, "temperature", ["differ"]),
    "load_zero": (GOOD.replace("0.04,100", "0.04,0"), 3, "load", ["0 N", "> 0"]),
    "pressure_negative": (GOOD.replace("load [N]", "pressure [GPa]").replace("100", "-1"), 2, "pressure", ["-1 GPa"]),
    "speed_zero": (GOOD.replace("load [N]", "entrainment_speed [m/s]").replace("100", "0"), 2, "entrainment_speed", []),
    "absolute_zero": (
        GOOD.replace("load [N]", "temperature [degC]").replace("0.05,100", "0.05,-300"),
        4,
        "temperature",
        ["-300 degC", "above absolute zero"],
    ),
    "no_sliding": ("slide_to_roll,traction_coefficient\n0,0.01\n-0.0,0.02\n", None, "slide_to_roll", ["all 0"]),
    "curve_without_name": (
        GOOD.replace("load [N]", "curve").replace("0.05,100", "0.05,"),
        4,
        "curve",
        ["an empty cell"],
    ),
}


def check(error, file, line, column, words):
    assert (error.file, error.line, error.column) == (str(file), line, column)
    message = str(error)
    places = [f"line {line}"] if line is not None else []
    places += [f"column '{column}'"] if column else []
    assert message.startswith(f"{file}: {', '.join(places)}: found " if places else f"{file}: found ")
    assert "; expected " in message
    assert message.isprintable()
    assert len(message) < len(str(file)) + 400
    for word in words:
        assert word in message


@pytest.mark.parametrize("name", BROKEN)
def test_broken_file(name, read, tmp_path):
    content, line, column, words = BROKEN[name]
    with pytest.raises(CurveError) as caught:
        read(content)
    check(caught.value, tmp_path / "curves.csv", line, column, words)


# name: (side file, name of the file, line, column, words)
SIDE = "slide_to_roll,traction_coefficient,load\n1,0.01,100\n2,0.02,100\n"
BROKEN_SIDE = {
    "not_toml": ("[units]\nload = N\n", "curves.units.toml", 2, "", ["TOML syntax"]),
    "empty": ("", "curves.units.toml", None, "", ["no table [units]"]),
    "no_table": ("units = 3\n", "curves.units.toml", None, "", ["no table [units]"]),
    "other_table": ("[unit]\nload = 'N'\n", "curves.units.toml", None, "", ["'unit'"]),
    "nested": ("a = " + "[" * 5000, "curves.units.toml", None, "", ["too deeply"]),
    "unknown_column": ("[units]\nloads = 'N'\n", "curves.units.toml", None, "loads", ["Did you mean 'load'"]),
    "number": ("[units]\nload = 3\n", "curves.units.toml", None, "load", ["the number 3"]),
    "unknown_unit": ("[units]\nload = 'foo'\n", "curves.units.toml", None, "load", ["'foo', which is not known"]),
    "wrong_dimension": ("[units]\nload = 'K'\n", "curves.units.toml", None, "load", ["another kind"]),
    "percent": ("[units]\nload = '%'\n", "curves.units.toml", None, "load", ["'%'"]),
    "forgotten": ("[units]\nslide_to_roll = '%'\n", "curves.csv", 1, "load", ["no unit"]),
}


@pytest.mark.parametrize("name", BROKEN_SIDE)
def test_broken_side_file(name, read, tmp_path):
    side, file, line, column, words = BROKEN_SIDE[name]
    with pytest.raises(CurveError) as caught:
        read(SIDE, side)
    check(caught.value, tmp_path / file, line, column, words)


def test_two_units_for_one_column(read, tmp_path):
    assert read(GOOD, "[units]\nload = 'N'\n").point_count == 3
    with pytest.raises(CurveError) as caught:
        read(GOOD, "[units]\nload = 'kN'\n")
    check(caught.value, tmp_path / "curves.csv", 1, "load", ["'N' in the header and 'kN'"])


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("nowhere.csv", ["no such file"]),
        ("", ["a folder"]),
        ("a\0b", ["cannot be read"]),
        ("x" * 300, ["cannot be read"]),
        ("curves.csv/x", ["cannot be read"]),
    ],
)
def test_no_file(name, words, tmp_path):
    (tmp_path / "curves.csv").write_text(GOOD, encoding="utf-8")
    with pytest.raises(CurveError) as caught:
        read_curves(tmp_path / name)
    assert caught.value.line is None
    for word in words:
        assert word in str(caught.value)


def test_the_message_as_a_whole(read, tmp_path):
    with pytest.raises(CurveError) as caught:
        read(GOOD.replace("0.04", "abc"))
    expected = (
        f"{tmp_path / 'curves.csv'}: line 3, column 'traction_coefficient': found the text 'abc'; expected a number."
    )
    assert str(caught.value) == expected


def test_no_bytes_lead_to_another_error(read):
    """Files broken at random: a table or a `CurveError`, never anything else."""
    random = np.random.default_rng(0)
    seeds = [text for text, *_ in BROKEN.values()] + [(DATA / "traction_etm_median.csv").read_bytes()]
    alphabet = b",;\t\r\n\"'[]%.0123456789eE+-naif \0\xff\xc3\xa9#_()"
    for _ in range(400):
        seed = seeds[random.integers(len(seeds))]
        content = bytearray(seed if isinstance(seed, bytes) else seed.encode()) or bytearray(b",")
        for _ in range(random.integers(1, 6)):
            place, byte = random.integers(len(content)), alphabet[random.integers(len(alphabet))]
            if random.random() < 0.5:
                content[place] = byte
            else:
                content.insert(place, byte)
        try:
            table = read(bytes(content))
        except CurveError as error:
            assert str(error).isprintable()  # noqa: PT017
        else:
            assert np.isfinite(table.slide_to_roll).all()


def test_accidents_are_refused_or_read_right(read, tmp_path):
    """Of a spreadsheet, a slip of the hand, a cut transfer."""
    good = 0
    for seed in range(400):
        content = mutated(GOOD.replace("5,0.04", "-5,-0.04"), seed)
        try:
            table = read(content)
        except CurveError as error:
            check(error, tmp_path / "curves.csv", error.line, error.column, [])
            continue
        good += 1
        head, *rows = cells_as_they_stand(content)
        for name in ("slide_to_roll", "traction_coefficient", "load"):
            places = [i for i, cell in enumerate(head) if cell.split("[")[0].strip() == name]
            if name == "load" and not places:
                continue
            (place,) = places
            scale = {"[%]": 0.01, "[kN]": 1e3}.get(head[place].removeprefix(name).strip(), 1.0)
            close(getattr(table, name), [scale * number(row[place]) for row in rows])
    assert 40 < good < 200


def test_the_minus_of_typesetters(read):
    table = read(GOOD.replace("5,0.04", "\N{MINUS SIGN}5,\N{MINUS SIGN}0.04"))
    close(table.slide_to_roll, [0.01, -0.05, 0.1])
    close(table.traction_coefficient, [0.01, -0.04, 0.05])


def test_a_table_refuses_what_does_not_fit_together():
    one, two = np.ones(1), np.ones(2)
    index = np.zeros(2, dtype=np.int64)
    with pytest.raises(ValueError, match="not both"):
        CurveTable(two, two, index, ("a",), pressure=two, load=two)
    with pytest.raises(ValueError, match="every index"):
        CurveTable(two, two, index, ("a", "b"))
    with pytest.raises(Exception, match="traction_coefficient"):  # the checked annotations come first
        CurveTable(two, one, index, ("a",))

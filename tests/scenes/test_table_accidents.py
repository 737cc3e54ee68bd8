"""CSV files of time tables and of cases after accidents: each is read right, or refused in one sentence."""

import os

import numpy as np
import pytest
from table_accidents import cells_as_they_stand, mutated, number
from typer.testing import CliRunner

import jaxbearing as jb
from jaxbearing.cli.main import app
from jaxbearing.scenes.csv_files import name_and_unit
from jaxbearing.scenes.time_tables import read_time_table
from jaxbearing.scenes.units import FORCE, SPEED, TIME, registry
from jaxbearing.sweeps.case_lists import list_of
from jaxbearing.sweeps.fields import SceneSource

TIMES = "time [ms],speed [rpm]\n0,7000\n2.5,8000.5\n5,9000\n7.5,14000\n"
LOADS = "time [s],load [kN]\n0,50\n0.25,25.5\n0.5,0\n"
CASES = (
    "operation.inner_speed [rpm],operation.radial_load [kN],operation.oil_temperature [degC],drag.coefficient\n"
    "5000,10,80,0.3\n7500.5,12.5,-10,0.45\n10000,20,120,1e-1\n"
)
SOURCE = SceneSource.of("reference_roller")
DIMENSIONS = {"time": TIME, "speed": SPEED, "load": FORCE}


def sentence(error, file):
    """What every refusal is: one line that names the file, what was found and what is expected."""
    said = str(error)
    assert said.startswith(str(file))
    assert said.isprintable()
    assert said.count("found ") >= 1 <= said.count("expected ")
    assert len(said) < len(str(file)) + 700


def in_si(cell, unit, si):
    return registry().Quantity(number(cell), registry().Unit(unit)).to(si).magnitude


def right_table(content, found):
    """Whether a time table holds what stands in the file."""
    (*head,), *rows = cells_as_they_stand(content)
    for i, cell in enumerate(head):
        name, unit = name_and_unit(cell)
        values = [number(row[i]) if name == "factor" else in_si(row[i], unit, DIMENSIONS[name].si) for row in rows]
        np.testing.assert_allclose(found.times if name == "time" else found.values, values, rtol=1e-14)
    assert np.all(np.diff(found.times) > 0.0)


def right_cases(content, found):
    """Whether a list of cases does."""
    fields, cases = found
    (*head,), *rows = cells_as_they_stand(content)
    assert [name_and_unit(cell)[0] for cell in head] == list(cases.paths)
    for i, (cell, field) in enumerate(zip(head, fields.values(), strict=True)):
        unit = name_and_unit(cell)[1]
        values = [number(row[i]) if not unit else in_si(row[i], unit, field.dimension.si) for row in rows]
        np.testing.assert_allclose(cases.values[i], values, rtol=1e-14)


def read(content, file, reader, right):
    file.write_bytes(content)
    try:
        found = reader(file)
    except jb.SceneError as error:
        sentence(error, file)
        return False
    right(content, found)
    return True


READERS = {
    "speed": (TIMES, lambda file: read_time_table(str(file), "speed", "simulation.speed_table.file"), right_table),
    "load": (LOADS, lambda file: read_time_table(str(file), "load", "simulation.load_table.file"), right_table),
    "cases": (CASES, lambda file: list_of(file, SOURCE), right_cases),
}


@pytest.mark.parametrize("kind", READERS)
def test_accidents(kind, tmp_path):
    text, *how = READERS[kind]
    good = sum(read(mutated(text, seed), tmp_path / "table.csv", *how) for seed in range(400))
    # one in six or so does no harm
    assert 25 < good < 150


@pytest.mark.slow
@pytest.mark.parametrize("kind", READERS)
def test_many_accidents(kind, tmp_path):
    text, *how = READERS[kind]
    good = sum(read(mutated(text, seed), tmp_path / "table.csv", *how) for seed in range(400, 8000))
    assert 500 < good < 2500


@pytest.mark.parametrize("kind", READERS)
def test_random_bytes(kind, tmp_path):
    _, *how = READERS[kind]
    dice = np.random.default_rng(0)
    for size in (0, 1, 2, 5, 30, 1000):
        for _ in range(10):
            assert not read(dice.bytes(size), tmp_path / "table.csv", *how)


CLOTHES = {
    "crlf": lambda text: text.replace("\n", "\r\n").encode(),
    "cr": lambda text: text.replace("\n", "\r").encode(),
    "bom": lambda text: b"\xef\xbb\xbf" + text.encode(),
    "quotes": lambda text: (
        text.replace("7500.5", '"7500.5"').replace("drag.coefficient", '"drag.coefficient"').encode()
    ),
    "semicolons": lambda text: text.replace(",", ";").encode(),
    "decimal commas": lambda text: text.replace(",", ";").replace("0.5", "0,5").replace("12.5", "12,5").encode(),
    "tabs and decimal commas": lambda text: text.replace(",", "\t").replace(".5", ",5").replace("0.", "0,").encode(),
    "spaces": lambda text: text.replace(",", " , ").encode(),
    "minus sign": lambda text: text.replace("-10", "\N{MINUS SIGN}10").encode(),
    "empty rows and columns": lambda text: (text.replace("\n", ",,\n") + ",,,,,\n\n").encode(),
    "remarks": lambda text: ("# by hand\n\n" + text.replace("7500.5", "\n # a remark, too\n7500.5")).encode(),
    "no end": lambda text: text.rstrip().encode(),
    "form feed": lambda text: text.replace("\n7500.5", " \f\n7500.5").encode(),
}


@pytest.mark.parametrize("name", CLOTHES)
def test_same_cases_in_other_clothes(name, tmp_path):
    file = tmp_path / "cases.csv"
    text = CASES.replace("0.45", "0.5")
    if "commas" in name:
        text = text.replace("0.3", "0.5").replace("1e-1", "0.5")
    file.write_text(text, encoding="utf-8")
    _, expected = list_of(file, SOURCE)
    np.testing.assert_allclose(expected.values[1], [1e4, 1.25e4, 2e4], rtol=1e-15)
    np.testing.assert_allclose(expected.values[2], [353.15, 263.15, 393.15], rtol=1e-15)
    file.write_bytes(CLOTHES[name](text))
    _, found = list_of(file, SOURCE)
    assert found.paths == expected.paths
    np.testing.assert_array_equal(found.values, expected.values)


# name: (text, words of the message)
REFUSED = {
    "more cells than columns": (
        "operation.radial_load [N]\n1500,5\n",
        "line 2: found 2 cells; expected 1 separated by",
    ),
    "a column without a name": ("operation.radial_load [N],\n1500,5\n", "line 1: found a column without a name"),
    "twice": ("operation.radial_load [N],operation.radial_load [kN]\n1,1\n", "this field twice"),
    "two decimal marks": ("operation.radial_load [N];drag.coefficient\n1,5;0.3\n", "a decimal comma, as in line 2"),
    "thousands": ("operation.radial_load [N];drag.coefficient\n1.500,5;0,3\n", "found the text '1.500,5'"),
    "an open quotation mark": ('operation.radial_load [N]\n"15\n12\n', "line 2: found a line that cannot be parted"),
    "not available": ("operation.radial_load [N]\n1500\nNA\n", "line 3: operation.radial_load: found the text 'NA'"),
    "endless": ("operation.radial_load [GN]\n1e305\n", "line 2: operation.radial_load: found the text '1e+305 GN'"),
    "null bytes": ("operation.radial_load [N]\n15\0\n", r"found the text '15\x00'"),
    "the header again": ("drag.coefficient\n1\ndrag.coefficient\n", "line 3: drag.coefficient: found the text 'drag."),
}


@pytest.mark.parametrize("name", REFUSED)
def test_cases_that_are_refused(name, tmp_path):
    text, words = REFUSED[name]
    file = tmp_path / "cases.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(jb.SceneError) as refused:
        list_of(file, SOURCE)
    sentence(refused.value, file)
    assert words in str(refused.value)


COMMANDS = {
    "cases": ("sweep", "reference_roller", "--list", "table.csv"),
    "speed": (
        "simulate",
        "turbine_roller_dynamic",
        "--set",
        "simulation.speed_table.file=table.csv",
        "--duration=1 ms",
    ),
}


@pytest.mark.parametrize("seed", range(0, 200, 20))
@pytest.mark.parametrize("kind", COMMANDS)
def test_on_the_command_line(kind, seed, tmp_path, monkeypatch):
    """Exit code 2, one line, and nothing is written."""
    monkeypatch.chdir(tmp_path)
    text, *how = READERS[kind]
    while read(mutated(text, seed), tmp_path / "table.csv", *how):
        seed += 1
    result = CliRunner().invoke(app, [*COMMANDS[kind], "--out", "out.nc"])
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith("error: table.csv")
    assert result.stderr.count("\n") == 1
    assert os.listdir(tmp_path) == ["table.csv"]

"""`jaxbearing fields`: what a scene file may hold."""

import json

import pytest
from typer.testing import CliRunner

from jaxbearing.cli.main import app
from jaxbearing.scenes.reader import KINDS, builtin_names, builtin_text

RUN = CliRunner()


def test_without_a_kind_the_kinds_are_listed():
    assert RUN.invoke(app, ["fields"]).output.split() == list(KINDS)
    assert json.loads(RUN.invoke(app, ["fields", "--json"]).output) == list(KINDS)


@pytest.mark.parametrize("kind", KINDS)
def test_every_field_of_the_built_in_scenes_is_among_them(kind):
    import tomllib

    rows = json.loads(RUN.invoke(app, ["fields", kind, "--json"]).output)
    assert all(row["expected"] or row["default"] for row in rows)
    paths = {row["path"] for row in rows}
    for name in builtin_names():
        tables = tomllib.loads(builtin_text(name))
        if tables.pop("kind") == kind:
            for table, given in tables.items():
                if isinstance(given, list):  # bearings, sets and forces have names of their own
                    continue
                assert {f"{table}.{field}" for field in given} <= paths, name


def test_a_table_for_people():
    lines = RUN.invoke(app, ["fields", "ball_bearing"]).output.splitlines()
    assert lines[0] == 'kind = "ball_bearing"'
    assert any(line.split()[:2] == ["pitch_diameter", "required"] for line in lines)
    assert any(line.startswith("operation.displacement ") for line in lines)


def test_an_unknown_kind():
    result = RUN.invoke(app, ["fields", "ball_bearings"])
    assert result.exit_code == 2
    assert "did you mean 'ball_bearing'" in result.output.lower() or "ball_bearing" in result.output

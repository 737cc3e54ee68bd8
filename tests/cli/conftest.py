"""The command in-process, in an empty folder, with no compilation cache."""

import sys
from typing import NamedTuple

import jax
import pytest

import jaxbearing
from jaxbearing.cli.main import main
from jaxbearing.numerics.status import Status


class Result(NamedTuple):
    code: int
    out: str
    err: str


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("JAXBEARING_CACHE", "off")
    return tmp_path


@pytest.fixture
def jaxbearing_command(folder, monkeypatch, capfd):
    def run(*arguments: str) -> Result:
        monkeypatch.setattr("sys.argv", ["jaxbearing", *arguments])
        capfd.readouterr()
        with pytest.raises(SystemExit) as ended:
            main()
        return Result(ended.value.code or 0, *capfd.readouterr())

    return run


@pytest.fixture
def failing_solve(monkeypatch):
    def solve_once(scene):
        solution = jaxbearing.solve(scene, throw=False)
        object.__setattr__(solution, "status", jax.numpy.asarray(int(Status.DIVERGED)))
        return solution

    # the package's `solve` is the verb: the module of that name is reached by `sys.modules`
    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solve_once)

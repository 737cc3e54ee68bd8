"""The command in-process, in an empty folder, with no compilation cache."""

from typing import NamedTuple

import pytest

from jaxbearing.cli.main import main


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

"""Every dotted name of the package that README, docs and changelog mention is there, where a reader looks for it."""

import importlib
import json
import re
import subprocess
import sys
import types
from pathlib import Path

import pytest
from command_process import environment

import fitting
import jaxbearing

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
NAME = re.compile(r"(?<![\w./'\"-])(jb|jaxbearing|fitting)((?:\.[A-Za-z_]\w*)+)(?![\w/-])")
IMPORT = re.compile(r"^\s*from ((?:jaxbearing|fitting)[\w.]*) import ([\w, ]+)$", flags=re.MULTILINE)
NO_NAMES = {"py", "toml", "md", "html", "nc"}
"""Endings of files."""


def mentioned():
    found = {}
    for page in PAGES:
        text, where = page.read_text(encoding="utf-8"), page.relative_to(ROOT).as_posix()
        names = [package + path for package, path in NAME.findall(text) if path.rpartition(".")[2] not in NO_NAMES]
        names += [
            f"{module}.{name.split()[0]}" for module, listed in IMPORT.findall(text) for name in listed.split(",")
        ]
        for name in names:
            found.setdefault(name, where)
    return found


MENTIONED = mentioned()


def resolved(name):
    """As Python resolves the name: an attribute, or a module that can be imported, of what is before the dot."""
    package, *parts = name.split(".")
    at = fitting if package == "fitting" else jaxbearing
    for part in parts:
        if isinstance(at, types.ModuleType) and not hasattr(at, part):
            importlib.import_module(f"{at.__name__}.{part}")
        at = getattr(at, part)
    return at


def is_there(name):
    try:
        return resolved(name) is not None
    except (AttributeError, ImportError):
        return False


@pytest.fixture(scope="module")
def at_once():
    """What `import jaxbearing as jb` offers before anything else is imported."""
    program = "import json, jaxbearing as jb; print(json.dumps([name for name in dir(jb) if hasattr(jb, name)]))"
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment(), capture_output=True, text=True, check=True
    )
    return set(json.loads(done.stdout))


def test_names_are_found():
    assert {"jb.solve", "jb.trajectory", "jaxbearing.contacts.film.Moes", "fitting.fit"} <= set(MENTIONED)


def test_names_are_there(at_once):
    missing = {name: page for name, page in MENTIONED.items() if not is_there(name)}
    assert not missing
    late = [name for name in MENTIONED if name.startswith("jb.") and name.split(".")[1] not in at_once]
    assert not late, "they are there only after another import"


def test_all_that_is_offered_is_there(at_once):
    assert {"sweeps", "plots", "trajectory", "quasi_static_start", "pocket_loads", *jaxbearing._LAZY} <= at_once


def test_nothing_else_is_offered(at_once):
    """Names of the package and no imports of its own."""
    assert at_once == {*jaxbearing.__all__, "__doc__", "__version__"}
    for name in jaxbearing.__all__:
        assert resolved(f"jb.{name}") is not None


def test_fitting_has_a_name_that_is_not_generic():
    import jaxbearing.fitting as same

    assert same is fitting
    assert jaxbearing.fitting is fitting

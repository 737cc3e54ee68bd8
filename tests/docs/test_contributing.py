"""The page on changing the code: its layers, its tables of files, and what it says that a family is asked."""

import re
from pathlib import Path

import test_layers

from jaxbearing.bearings.bearing import AbstractBearing
from jaxbearing.bearings.motion.family import AbstractDynamics, AbstractMotion

PAGE = (Path(__file__).parents[2] / "docs" / "contributing.md").read_text(encoding="utf-8")
FAMILIES = ("ball", "cylindrical", "tapered")
OWN = tuple(f"{layer}/{name}/" for layer in ("bearings", "scenes") for name in FAMILIES)


def test_files_that_know_a_family():
    known = set()
    for path in test_layers.modules(test_layers.PACKAGE):
        name = path.relative_to(test_layers.PACKAGE).as_posix()
        modules = tuple(f"jaxbearing.bearings.{family}." for family in FAMILIES)
        if not name.startswith(OWN) and any(
            f"{one}.".startswith(modules) for one in test_layers.imported_modules(path)
        ):
            known.add(name)
    (listed,) = re.findall(
        r"^<!-- files that know a family -->\n```text\n(.*?)^```", PAGE, flags=re.MULTILINE | re.DOTALL
    )
    assert known == set(listed.split())


def test_layers_of_the_page_are_those_that_are_enforced():
    """Lines such as ` 3  contacts, gaps    one contact, one film`: rank and modules."""
    picture = PAGE.split("```text\n")[1].split("```")[0]
    lines = re.findall(r"^ *(\d+)  (\w+(?:, \w+)*)(?:  .*)?$", picture, flags=re.MULTILINE)
    ranks = [int(rank) for rank, _ in lines]
    assert ranks == sorted(set(ranks), reverse=True), "one line a layer, the highest first"
    modules = {test_layers.layer(path) for path in test_layers.modules(test_layers.PACKAGE)}
    of_the_page = {name: int(rank) for rank, names in lines for name in names.split(", ")}
    assert of_the_page == {name: test_layers.RANK[name] for name in modules}
    (used,) = re.findall(r"It uses layers up to (\d+) \(its readers of files also (\d+)\)", PAGE)
    reads = {name.split(".")[1] for name in test_layers.FITTING_IO_MAY_USE}
    assert int(used[0]) == test_layers.FITTING_MAY_USE
    assert {test_layers.RANK[name] for name in reads} == {int(used[1])}


def test_what_a_family_is_asked_is_there():
    (table,) = re.findall(r"^\| asked by \|.*?\n\n", PAGE, flags=re.MULTILINE | re.DOTALL)
    asked = {name for row in table.strip().splitlines()[2:] for name in re.findall(r"`(\w+)`", row.split("|")[-2])}
    assert asked <= set(dir(AbstractBearing))
    assert set(AbstractBearing.__abstractmethods__) <= asked | {"slips"}


def test_files_of_the_table_are_there():
    (table,) = re.findall(r"^\| to add \| new \|.*?\n\n", PAGE, flags=re.MULTILINE | re.DOTALL)
    files = re.findall(r"`((?:\w+/)*\w+\.py)`", table)
    here = {path.relative_to(test_layers.PACKAGE).as_posix() for path in test_layers.modules(test_layers.PACKAGE)}
    in_families = {"scene.py", "geometry.py", "solution.py", "schema.py", "build.py", "writer.py"}
    assert set(files) - in_families <= here


def test_what_a_moving_family_is_asked_is_there():
    section = PAGE.split("returns the family's `AbstractMotion`:")[1].partition("## Tests")[0]
    _, motion, dynamics = section.split("| asked |")
    for part, kind in ((motion, AbstractMotion), (dynamics, AbstractDynamics)):
        rows = [row.split("|")[1] for row in part.splitlines() if row.startswith("| `")]
        asked = {name for row in rows for name in re.findall(r"`(\w+)`", row)}
        assert set(kind.__abstractmethods__) <= asked <= set(dir(kind))

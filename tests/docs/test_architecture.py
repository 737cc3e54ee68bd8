"""The picture of the layers in the documentation is the one that `tests/test_layers.py` enforces."""

import re
from pathlib import Path

import test_layers

PAGE = (Path(__file__).parents[2] / "docs" / "architecture.md").read_text(encoding="utf-8")


def layers_of_the_page():
    """Rank of each module, from lines such as ` 3  contacts, gaps    one contact, one film`."""
    (picture,) = re.findall(r"^```text\n(.*?)^```", PAGE, flags=re.MULTILINE | re.DOTALL)
    lines = re.findall(r"^ *(\d+)  (\w+(?:, \w+)*)(?:  .*)?$", picture, flags=re.MULTILINE)
    ranks = [int(rank) for rank, _ in lines]
    assert ranks == sorted(set(ranks), reverse=True), "one line a layer, the highest first"
    return {name: int(rank) for rank, names in lines for name in names.split(", ")}


def modules_of_the_package():
    return {test_layers.layer(path) for path in test_layers.modules(test_layers.PACKAGE)}


def test_layers_of_the_page_are_those_that_are_enforced():
    assert layers_of_the_page() == {name: test_layers.RANK[name] for name in modules_of_the_package()}


def test_every_package_is_described():
    (table,) = re.findall(r"^\| package \|.*?\n\n", PAGE, flags=re.MULTILINE | re.DOTALL)
    described = set(re.findall(r"`(\w+)`", "".join(row.split("|")[1] for row in table.strip().splitlines())))
    folders = {path.parent.name for path in test_layers.PACKAGE.glob("*/__init__.py")}
    assert folders <= described <= modules_of_the_package()
    assert "fitting" in described


def test_fitting_uses_what_the_page_says():
    (used,) = re.findall(r"It uses layers up to (\d+) \(its readers of files also (\d+)\)", PAGE)
    reads = {name.split(".")[1] for name in test_layers.FITTING_IO_MAY_USE}
    assert int(used[0]) == test_layers.FITTING_MAY_USE
    assert {test_layers.RANK[name] for name in reads} == {int(used[1])}

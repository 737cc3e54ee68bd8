"""Imports go down the layers only, and nothing below the edge reads files, units or draws."""

import ast
import subprocess
from pathlib import Path

import pytest

from jaxbearing import _solvers

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "jaxbearing"
FITTING = ROOT / "fitting"

# A module may import from layers of a lower rank, and from its own.
RANK = {
    "_types": 0,
    "_forwarding": 0,
    "_version": 0,
    # names solvers, and imports the one that is asked for
    "_solvers": 0,
    "_checks": 2,
    "_derived": 2,
    "_scene": 2,
    "_shown": 1,
    "_identity": 2,
    "time_laws": 2,
    "distribution": 2,
    "joint": 2,
    "designations": 2,
    "numerics": 1,
    "programs": 2,
    "materials": 2,
    "lubricants": 2,
    "contacts": 3,
    "gaps": 3,
    "ehl": 4,
    "machines": 4,
    # seats of a bearing, which know no bearing
    "mounting": 4,
    "thermal": 4,
    # formulas of standards; bearings feed them with their contacts
    "life": 4,
    "bearings": 5,
    # formulas of catalogues beside a solution
    "makers": 6,
    # several bearings together: they know bearings, and no verb
    "shafts": 6,
    "solve": 7,
    "port": 8,
    "lanes": 8,
    "program_size": 8,
    "simulate": 7,
    "sensitivity": 7,
    "loss_interval": 8,
    "scenes": 9,
    "report": 9,
    # figures use the panels and units of the pages; the pages know no figure
    "plots": 10,
    # sweeps are labelled and kept in files: a verb of the edge
    "sweeps": 10,
    "sweep": 10,
    "comparison": 10,
    # scenes from designations
    "catalogue": 10,
    # many solves of one bearing: sweeps with statements about them
    "studies": 11,
    # tolerances are sampled by sweeps
    "tolerance": 11,
    # the states of a spectrum are solved like the cases of a sweep
    "spectrum": 11,
    # uses the estimation core of the package `fitting`, as the verb `fit` does
    "calibration": 12,
    "cli": 12,
    # a second name of the package beside this one
    "fitting": 12,
    "__init__": 12,
    "__main__": 13,
}
SIBLINGS = {("lubricants", "materials"), ("materials", "lubricants"), ("contacts", "gaps"), ("gaps", "contacts")}
EDGE_ONLY = {
    "pint",
    "pydantic",
    "matplotlib",
    "xarray",
    "rich",
    "typer",
    "tomllib",
    "json",
    "platformdirs",
    "jinja2",
    "plotly",
}
FITTING_MAY_USE = RANK["machines"]
FITTING_IO_MAY_USE = ("jaxbearing.scenes.", "jaxbearing.report.")
FITTING_IO_ONLY = {"pint", "csv", "tomllib", "json", "rich", "matplotlib", "pydantic", "pydantic_core"}


def modules(folder):
    return sorted(folder.rglob("*.py"))


def layer(path):
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported_names(path, nodes=ast.walk):
    """(module, name in it) of every import statement in a file; the name is None for a module as a whole.

    **Arguments:** `nodes`: gives the nodes of a tree that count."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    for node in nodes(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, None) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = "".join(f"{part}." for part in parts[: len(parts) - node.level]) if node.level else ""
            for alias in node.names:
                yield (f"{package}{node.module}", alias.name) if node.module else (f"{package}{alias.name}", None)


def imported_modules(path):
    """Full name of the module of every import statement in a file."""
    return (module for module, _ in imported_names(path))


def imports(path, package):
    """(first part inside jaxbearing or None, top-level module) of every import statement in a file."""
    for name in imported_modules(path):
        pieces = name.split(".")
        inside = pieces[1] if pieces[0] == package and len(pieces) > 1 else None
        yield inside, pieces[0]


def test_imports_go_down():
    wrong = []
    for path in modules(PACKAGE):
        here = layer(path)
        assert here in RANK, f"give {here} a rank"
        for inside, top in imports(path, "jaxbearing"):
            # compiled programs are kept in files, in the cache folder of the user
            if RANK[here] < RANK["scenes"] and here != "programs" and top in EDGE_ONLY:
                wrong.append(f"{path} imports {top}, which belongs to the edge")
            if top == "fitting" and here not in ("calibration", "cli", "fitting"):
                wrong.append(f"{path} imports fitting")
            if inside is None or here == "__init__":
                continue
            if RANK.get(inside, 0) > RANK[here]:
                wrong.append(f"{path} imports {inside}, a layer above {here}")
            if (here, inside) in SIBLINGS:
                wrong.append(f"{path} imports its sibling layer {inside}")
    assert not wrong


def test_fitting_knows_no_bearing():
    wrong = []
    for path in modules(FITTING):
        reads_files = path.is_relative_to(FITTING / "io")
        for name in imported_modules(path):
            if reads_files and name.startswith(FITTING_IO_MAY_USE):
                continue
            top, inside = [*name.split("."), None][:2]
            if top == "jaxbearing" and inside is not None and RANK[inside] > FITTING_MAY_USE:
                wrong.append(f"{path} imports {name}")
            if top in FITTING_IO_ONLY and not reads_files:
                wrong.append(f"{path} imports {top}, which belongs to fitting/io")
    assert not wrong


def test_top_level_is_as_agreed():
    allowed = {"pyproject.toml", "README.md", "jaxbearing", "fitting", "tests", "notebooks", "docs", "mkdocs.yml"}
    allowed |= {"LICENSE", "CHANGELOG.md"}
    # committed files only: results that somebody wrote beside them are no part of the project
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode != 0:
        pytest.skip("not a git checkout")
    assert {name.split("/")[0] for name in listed.stdout.splitlines() if not name.startswith((".", '"'))} <= allowed


def _imports_of_the_package():
    """Module -> modules of the package that it imports when it runs, at its top or inside functions."""
    files = {".".join(path.relative_to(ROOT).with_suffix("").parts): path for path in modules(PACKAGE)}
    files = {name.removesuffix(".__init__"): path for name, path in files.items()}

    def imported(path):
        for module, name in imported_names(path, _running):
            whole = f"{module}.{name}" if name else module
            # what is no module itself stands in one
            yield whole if whole in files else whole.rpartition(".")[0]

    return {name: set(imported(path)) & files.keys() for name, path in files.items()}


def _running(node):
    """All nodes below a node, but for imports that only a type checker sees."""
    for child in ast.iter_child_nodes(node):
        if not (isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test)):
            yield child
            yield from _running(child)


def test_imports_make_no_circle():
    """Modules that import each other, at the top or inside functions, cannot be understood alone. Scenes find their
    solvers by name (`_solvers`)."""
    graph = _imports_of_the_package()
    assert len(graph) > 600

    def reached(name):
        seen, open_ends = set(), [name]
        while open_ends:
            for other in graph[open_ends.pop()] - seen:
                seen.add(other)
                open_ends.append(other)
        return seen

    leads_to = {name: reached(name) for name in graph}
    circles = {name: sorted(other for other in leads_to[name] if name in leads_to[other]) for name in graph}
    assert not {name: others for name, others in circles.items() if name in leads_to[name]}


def test_solvers_are_there():
    """The table names functions, and methods of scenes; no module is imported before it is asked for."""
    for kind, functions in _solvers._FUNCTIONS.items():
        for method in functions:
            assert callable(_solvers.solver(kind, method)), (kind, method)

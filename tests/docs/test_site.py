"""The documentation site without its builder: generated pages, links, names of fields and sections, examples."""

import ast
import dataclasses
import functools
import importlib
import re
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

import jaxbearing as jb
from jaxbearing import _forwarding
from jaxbearing.scenes.fields import is_known, tables_at
from jaxbearing.scenes.reader import KINDS, builtin_names, schema_of_kind

TOP = Path(__file__).parents[2]
DOCS = TOP / "docs"
PAGES = sorted(DOCS.rglob("*.md"))
MADE = ("changelog.md", "command_line.md")
sys.path.insert(0, str(DOCS / "generate"))

import api_pages  # noqa: E402
import command_line  # noqa: E402
import links  # noqa: E402
import name_pages  # noqa: E402
import result_pages  # noqa: E402
import scene_pages  # noqa: E402


def test_links_of_pages_lead_to_files():
    dead = []
    for path in PAGES:
        text = re.sub(r"```.*?```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        targets = [one for one in re.findall(r"\]\(([^)\s#]+)", text) if "://" not in one]
        dead += [(path.name, target) for target in targets if not (path.parent / target).exists()]
        for target, place in re.findall(r"\]\(([^)\s#:]*)#([^)\s]+)\)", text):
            page = path.parent / target if target else path
            if not page.exists() or place not in anchors(page):
                dead.append((path.name, f"{target}#{place}"))
    assert not dead


@functools.cache
def anchors(page):
    """Names of the headings of a page, as the pages of the site have them."""
    found = set()
    for heading in re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE):
        own = re.search(r"\{ ?#([\w-]+) ?\}", heading)
        found.add(own[1] if own else re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", heading).strip().lower()))
    return found


def test_every_public_name_is_there_and_on_its_page():
    """The page that is kept is the one that the packages make (`python docs/generate/name_pages.py`). A name that is
    taken from it gets an entry in `jaxbearing/_forwarding.py`, and the changelog says where it is now."""
    assert name_pages.FILE.read_text(encoding="utf-8") == name_pages.page()
    for module, names in name_pages.public_names().items():
        for name in names:
            assert getattr(importlib.import_module(module), name) is not None, (module, name)
    assert callable(jb.thermal.warm_up)  # not the module where it is


def test_names_that_moved_still_work_and_warn():
    """For one release: those of modules, and modules."""
    old_names = [*_forwarding.NAMES, "bearings.roller_profile.RollerProfile", "scenes.oils.load_oil"]
    old_names += ["bearings.ball_geometry.BallGeometry", "thermal.warm_up.warm_up"]
    for old in old_names:
        module, _, name = f"jaxbearing.{old}".rpartition(".")
        with pytest.warns(DeprecationWarning, match=rf"{old} has moved to jaxbearing\."):
            assert callable(getattr(importlib.import_module(module), name))
        with pytest.raises(AttributeError, match="nothing_of_this_name"), warnings.catch_warnings(action="ignore"):
            getattr(importlib.import_module(module), "nothing_of_this_name")  # noqa: B009
    for old, new in _forwarding.MODULES.items():
        importlib.import_module(f"jaxbearing.{new}")
        assert importlib.import_module(f"jaxbearing.{old}").__doc__ == f"It has moved to `jaxbearing.{new}`."


def test_start_page_leads_to_every_page():
    """Whoever reads the pages in the repository has no navigation beside them."""
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    linked = {(DOCS / target).resolve() for target in re.findall(r"\]\(([^)\s#:]+)", text)}
    pages = {path.resolve() for path in (*PAGES, *(TOP / "notebooks").glob("*.ipynb"))}
    assert pages - linked == {(DOCS / "index.md").resolve()}


def test_references_of_pages_are_public_names():
    missing = []
    for path in PAGES:
        for name in re.findall(r"\]\[((?:jaxbearing|fitting)[\w.]*)\]", path.read_text(encoding="utf-8")):
            module, _, member = name.rpartition(".")
            try:
                importlib.import_module(name)
            except ModuleNotFoundError:
                if not hasattr(importlib.import_module(module), member):
                    missing.append((path.name, name))
    assert not missing


def test_fields_that_pages_name_exist():
    models = [schema_of_kind(kind)[0] for kind in KINDS]
    tables = {name for model in models for name in model.model_fields if tables_at(model, (name,))}
    missing = []
    for path in PAGES:
        for field in re.findall(r"`(\w+(?:\.\w+)+)(?: = [^`]*)?`", path.read_text(encoding="utf-8")):
            names = field.split(".")
            asked = names[0] in tables and names[0] != "cage" and path.stem != "results"
            if asked and not any(is_known(model, names) for model in models):
                missing.append((path.name, field))
    assert not missing


def test_links_of_the_readme_become_pages():
    text = "[a](docs/claims.md) [b](CHANGELOG.md) [c](https://x.org/docs/a.md) [d](notebooks/rheology.ipynb)"
    expected = "[a](claims.md) [b](changelog.md) [c](https://x.org/docs/a.md) [d](notebooks/rheology.md)"
    assert links.of_top_level(text) == expected
    assert links.of_page("[a](../notebooks/x.ipynb) [b](y.md)", "life.md") == "[a](notebooks/x.md) [b](y.md)"
    assert links.of_page("[a](../../docs/life.md) [b](y.ipynb)", "notebooks/x.md") == "[a](../life.md) [b](y.md)"


def test_navigation_names_pages_that_are_there():
    nav = (TOP / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:")[2]
    named = re.findall(r"[\w/]+\.md", nav)
    assert len(named) == len(set(named))
    assert {name for name in named if not (DOCS / name).exists()} == set(MADE)
    theory = {f"theory/{path.name}" for path in (DOCS / "theory").glob("*.md")}
    assert theory <= set(named)


def test_page_of_the_command_line_has_every_option():
    page = command_line.page()
    for verb in ("scenes", "solve", "report", "sweep", "simulate", "stiffness", "fit"):
        assert f"## jaxbearing {verb}" in page
    assert "| `--latin-hypercube COUNT` |" in page
    assert "3 not converged" in page


def test_page_of_scene_files():
    """The page that is kept is the one that the schemas make (`python docs/generate/scene_pages.py`)."""
    page = scene_pages.page()
    assert scene_pages.FILE.read_text(encoding="utf-8") == page
    for name in builtin_names():
        assert f"| `{name}` | " in page
    assert "| `diametral_clearance` | m | length | required |" in page
    assert "| `roller_length` | m | length > 0 | required |" in page
    assert "| `c2` | K | temperature difference > 0 | required | C2 |" in page
    assert "| `through_flow_fraction` |  | number between 0 and 1 | 1.0 |" in page
    assert "'mean_pressure' or 'distributed' | mean_pressure | the law at the mean Hertz pressure, or marched" in page
    assert "As in `ball_bearing`: `turbulence`, `guidance`, " in page
    anchors = re.findall(r"\{ #([\w-]+) \}", page)
    assert len(anchors) == len(set(anchors)) > 50
    assert set(re.findall(r"\]\(#([\w-]+)\)", page)) <= set(anchors)


def test_every_field_of_every_kind_has_a_line():
    page = scene_pages.page()
    for kind in KINDS:
        model, _ = schema_of_kind(kind)
        for _, table in scene_pages._below(model):
            for field in scene_pages.fields(table, None):
                assert f"| `{field.name}` | {field.unit} |" in page
                assert field.expected or field.tables


def test_page_of_results_has_every_labelled_class():
    """The page that is kept is the one that the labels make (`python docs/generate/result_pages.py`)."""
    page = result_pages.page()
    assert result_pages.FILE.read_text(encoding="utf-8") == page
    assert "| `power_loss.drag` | W | " in page
    assert "| `elements.raceway_control` | percent | 100: outer race control, 0: inner race control |" in page
    shown = {one for classes in result_pages.SECTIONS.values() for one in classes.values()}
    modules = {sys.modules[one.__module__] for one in shown}
    for module in modules:
        for one in vars(module).values():
            labelled = isinstance(one, type) and dataclasses.is_dataclass(one) and one.__module__ == module.__name__
            if labelled and any("unit" in field.metadata for field in dataclasses.fields(one)):
                inputs = one.__name__.startswith(("Disk", "TwoDiskLaws"))
                # the classes of a family show what they have from the one of all families
                inherited = any(issubclass(other, one) for other in shown)
                assert inherited or inputs, f"{one} is on no page"


def test_every_public_module_is_on_one_page_of_the_api():
    pages = api_pages.pages(TOP)
    names = re.findall(r"^::: (.+)$", "\n".join(pages.values()), flags=re.MULTILINE)
    assert len(names) == len(set(names))
    assert {"jaxbearing.solve", "jaxbearing.contacts.film", "fitting.io.pcs", "fitting.fit"} <= set(names)
    assert not [name for name in names if ".cli" in name or "._" in name]


@pytest.mark.slow
def test_example_of_a_law_prints_what_the_page_says(tmp_path):
    page = (DOCS / "contributing.md").read_text(encoding="utf-8")
    assert '```python\n"""A viscosity law of one\'s own' in links.with_files(page, DOCS)
    command = [sys.executable, str(DOCS / "examples" / "vogel_law.py")]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert f"```text\n{ran.stdout}```" in page


@pytest.mark.slow
def test_python_of_the_page_on_motion_runs(capsys):
    page = (DOCS / "cage_dynamics.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    names = {}
    exec(compile(block, "cage_dynamics.md", "exec"), names)
    assert "nan" not in capsys.readouterr().out
    assert names["more"].completed


@pytest.mark.slow
def test_python_of_the_fitting_page_prints_what_it_says(tmp_path, monkeypatch, capsys):
    page = (DOCS / "fitting.md").read_text(encoding="utf-8")
    (curves,) = re.findall(r"```csv\n(.*?)```", page, flags=re.DOTALL)
    (tmp_path / "curves.csv").write_text(curves, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    (block,) = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    names = {}
    exec(compile(block, "fitting.md", "exec"), names)
    assert f"```text\n{capsys.readouterr().out}```" in page
    modulus, stress = names["result"].parameters["shear_modulus"], names["result"].parameters["stress"]
    # as many digits as the table of the page has
    assert f"{1e-3 * modulus.value:#.3g}   kPa" in page
    assert f"{1e-6 * stress.value:#.4g}   MPa" in page


def test_lists_and_parts_of_docstrings():
    pytest.importorskip("markdown")
    gfm_lists = importlib.import_module("gfm_lists")
    lines = ["**Arguments:**", "- `a`: x,", "  more", "- `b`", "", "**Validity:** y", "**Reference:** z"]
    expected = ["**Arguments:**", "", *lines[1:6], "", "**Reference:** z"]
    assert gfm_lists.with_blank_lines(lines) == expected
    assert gfm_lists.with_blank_lines(["```", "a", "- b", "```"]) == ["```", "a", "- b", "```"]


def test_arguments_written_below_a_class_are_found():
    pytest.importorskip("griffe")
    docstrings = importlib.import_module("docstrings")
    tree = ast.parse((TOP / "jaxbearing" / "lubricants" / "simple_viscosity.py").read_text(encoding="utf-8"))
    found = docstrings.init_docstrings(tree)
    assert set(found) == {"ConstantViscosity", "IsoviscousLiquid", "Barus", "Roelands"}
    assert "`pressure_viscosity`: alpha, 1/Pa, >= 0." in found["Barus"]


def test_formulas_become_mathml():
    pytest.importorskip("latex2mathml")
    maths = importlib.import_module("maths")
    page = maths.to_mathml(r'a <span class="arithmatex">\(a &lt; b^2\)</span>')
    assert page.startswith("a <math")
    assert "<mo>&#x0003C;</mo><msup><mi>b</mi>" in page
    assert "arithmatex" not in page
    sine = maths.to_mathml(r'<div class="arithmatex">\[\sin x + \sin(x) + \sin^2 x\]</div>')
    assert sine.count("<mspace") == 1
    assert 'display="block"' in sine

"""Every kind of result has its outputs where the registry looks for them; what draws and writes knows no kind."""

import importlib
from pathlib import Path

import pytest
import test_layers

from jaxbearing.report import registry

REPORT = Path(registry.__file__).parent
STEADY = ("summary", "json_report", "dataset", "plots", "page_content")
RUN = ("summary", "json_report", "dataset", "plots", "animation")
OUTPUTS = [
    *((folder, module) for folder in registry.FOLDERS.values() for module in STEADY),
    *((folder, module) for folder in registry.RUNS.values() for module in RUN),
]


@pytest.mark.parametrize(("folder", "module"), OUTPUTS)
def test_outputs_are_there(folder, module):
    found = importlib.import_module(f"jaxbearing.report.{folder}.{module}")
    assert callable(getattr(found, registry._FUNCTIONS[module]))


@pytest.mark.parametrize("name", [*registry.FOLDERS, *registry.RUNS])
def test_kinds_are_classes(name):
    module, _, kind = name.rpartition(".")
    found = getattr(importlib.import_module(module), kind)
    assert f"{found.__module__}.{found.__qualname__}" == name


def test_another_kind_is_named():
    with pytest.raises(TypeError, match="no summary of a str"):
        registry.output("a text", "summary", "summary")


@pytest.mark.parametrize("path", sorted((REPORT / "backends").rglob("*.py")), ids=lambda path: path.name)
def test_backends_know_no_kind_of_result(path):
    shared = {"colours", "diagrams", "display", "files", "page_content", "panels", "backends"}
    for name in test_layers.imported_modules(path):
        inside = name.split(".")[1:] if name.startswith("jaxbearing.") else []
        if inside and inside[0] == "report":
            assert inside[1] in shared, f"{path.name} imports {name}"
        else:
            assert not inside or inside[0].startswith("_"), f"{path.name} imports {name}"


def test_charts_are_described_without_a_library():
    for path in REPORT.glob("*/panels.py"):
        assert not {"matplotlib", "plotly"} & {name.split(".")[0] for name in test_layers.imported_modules(path)}

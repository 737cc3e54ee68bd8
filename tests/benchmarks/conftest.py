"""The whole report is made on request only: `python -m pytest tests/benchmarks`."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


def pytest_collection_modifyitems(config, items):
    """Asked for: the folder (or the file) of the benchmarks by name, and no expression of markers."""
    named = [Path(str(argument).split("::")[0]).resolve() for argument in config.args]
    here = Path(__file__).parent.resolve()
    wanted = not config.option.markexpr and any(path == here or here in path.parents for path in named)
    if not wanted:
        skip = pytest.mark.skip(reason="the whole report: python -m pytest tests/benchmarks")
        for item in items:
            if item.get_closest_marker("report"):
                item.add_marker(skip)

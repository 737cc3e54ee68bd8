"""`python -m pytest tests/benchmarks` makes the whole report and leaves the slow tests of the single benchmarks out;
`python -m pytest tests/benchmarks/test_benchmarks.py` runs all of those. Other choices of tests leave out what is
marked `report`: the report itself, and those that take too long for every submission."""

import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent.resolve()
sys.path.insert(0, str(HERE))


def pytest_collection_modifyitems(config, items):
    named = [Path(str(argument).split("::")[0]).resolve() for argument in config.args]
    if config.option.markexpr or not any(HERE in (path, path.parent) for path in named):
        left_out, reason = "report", "long: python -m pytest tests/benchmarks, or a file of this folder"
    elif HERE in named:
        left_out, reason = "slow", "not the report: name the file, or -m slow"
    else:
        return
    for item in items:
        if HERE in item.path.parents and item.get_closest_marker(left_out):
            item.add_marker(pytest.mark.skip(reason=reason))

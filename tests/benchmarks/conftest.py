"""`python -m pytest tests/benchmarks` makes the whole report, which stands for the slow tests here: they are smaller
runs of the same. `python -m pytest tests/benchmarks/test_benchmarks.py` runs all of those; other choices of tests leave
out what is marked `report`."""

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
        left_out, reason = "slow", "smaller than the whole report"
    else:
        return
    for item in items:
        if HERE in item.path.parents and item.get_closest_marker(left_out):
            item.add_marker(pytest.mark.skip(reason=reason))

"""`python -m pytest tests/benchmarks` makes the whole report, which stands for the slow tests here: they are smaller
runs of the same. No other choice of tests makes it, but for that of its own file."""

import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent.resolve()
sys.path.insert(0, str(HERE))


def pytest_collection_modifyitems(config, items):
    named = [Path(str(argument).split("::")[0]).resolve() for argument in config.args]
    if config.option.markexpr or not {HERE, HERE / "test_report.py"} & set(named):
        left_out, reason = "report", "the whole report: python -m pytest tests/benchmarks"
    else:
        left_out, reason = "slow", "smaller than the whole report"
    for item in items:
        if HERE in item.path.parents and item.get_closest_marker(left_out):
            item.add_marker(pytest.mark.skip(reason=reason))

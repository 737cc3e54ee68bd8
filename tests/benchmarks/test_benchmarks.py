"""The benchmarks run, their errors are what they promise, and scipy finds the same; times are not looked at.

Those of the bearings spend their time in XLA and run here without its optimizations.
"""

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

from jaxbearing.contacts import PRESETS

pytestmark = pytest.mark.slow


def script(name):
    path = Path(__file__).parent / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


@pytest.mark.usefixtures("optimized")
@pytest.mark.parametrize(("name", "repetitions"), [("mobil_jet_ii", 40), ("pennzane", 10)])
def test_rheology_comes_back_and_its_intervals_are_honest(name, repetitions):
    """Of 40 intervals that hold the true value with 95 %, fewer than 33 do so with 0.07 %; of 10, fewer than 6 with
    0.006 %. The study with 200 is the script's."""
    module = script("rheology_fit")
    assert np.max(np.abs(module.recovery(name, accuracy=1e-2))) < 1e-6
    inside, failed = module.coverage(name, repetitions, accuracy=1e-2)
    assert failed == 0
    assert np.all(inside * repetitions >= (33 if repetitions == 40 else 6))


@pytest.mark.filterwarnings("ignore:The iteration is not making good progress")  # scipy says so of its failures
def test_roller_bearing():
    module = script("roller_bearing")
    figures = module.benchmark(quick=True)
    module.print_table(figures)
    for rows in figures.values():
        assert rows["closure"] < 1e-10
        for row in rows["batch"].values():
            assert row["failed"] == 0
            assert row["error"] < 1e-9
        for (_, start), (_, solved, attempts, error) in rows["scipy"].items():
            # where scipy solves the full equations it finds our cage speed, but for the 1e-7 shift of the land law
            assert error < 1e-6
            assert solved == attempts or start == "first guess"


def test_ball_bearing():
    module = script("ball_bearing")
    figures = module.benchmark(quick=True)
    module.print_table(figures)
    for rows in figures.values():
        assert rows["error"] < 1e-9
        for row in rows["batch"].values():
            assert row["failed"] == 0
            assert row["error"] < 1e-9
        for _, _, _, error in rows["scipy"].values():
            assert error < 1e-6  # where scipy solves the equations it finds our displacement


@pytest.mark.usefixtures("optimized")
def test_traction():
    module = script("traction")
    figures = module.benchmark(quick=True)
    module.print_table(figures)
    assert figures["radau_tight"] < 1e-7  # our finest march and Radau: the same equations
    for accuracy, resolution in PRESETS.items():
        assert figures["ours"][resolution]["error"] < accuracy
    for (strips, tolerance), (error, _) in figures["radau"].items():
        assert error < 10 * tolerance + 10.0 ** (-strips / 4)

"""Which cases: grids, lists, samples."""

import numpy as np
import pytest

from jaxbearing.sweeps import Cases, grid, latin_hypercube, listed, random


def test_grid_is_the_product_and_its_last_field_varies_fastest():
    cases = grid({"a": [1.0, 2.0, 3.0], "b": [10.0, 20.0]})
    assert (len(cases), cases.shape) == (6, (3, 2))
    rows = [(a, b) for a in (1.0, 2.0, 3.0) for b in (10.0, 20.0)]
    part = cases.part(1, 5)
    assert list(zip(part["a"], part["b"], strict=True)) == rows[1:5]
    assert cases.part(5, 99)["b"].tolist() == [20.0]


def test_list():
    cases = listed({"a": [1.0, 2.0, 3.0], "b": [5.0, 7.0, 6.0]})
    assert cases.shape == (3,)
    assert cases.part(1, 3)["b"].tolist() == [7.0, 6.0]
    assert {"a": 3.0, "b": 7.0} in cases.corners()


@pytest.mark.parametrize("sample", [random, latin_hypercube])
def test_samples_are_within_bounds_and_come_back_with_their_seed(sample):
    bounds = {"a": (-1.0, 3.0), "b": (1e-3, 1e3, "log")}
    cases, again, other = sample(bounds, 200, seed=5), sample(bounds, 200, seed=5), sample(bounds, 200, seed=6)
    for values, same, different, (low, high) in zip(
        cases.values, again.values, other.values, ((-1.0, 3.0), (1e-3, 1e3)), strict=True
    ):
        assert low <= values.min() < values.max() <= high
        assert values.tobytes() == same.tobytes() != different.tobytes()


def test_latin_hypercube_has_one_case_in_each_part_of_every_range():
    n = 64
    a, b = latin_hypercube({"a": (0.0, 2.0), "b": (1.0, 100.0, "log")}, n).values
    for part in (a / 2.0, np.log(b) / np.log(100.0)):
        assert sorted(np.floor(part * n).astype(int).tolist()) == list(range(n))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: grid({}), "a field to vary"),
        (lambda: grid({"a": []}), "a: expected one or more finite numbers"),
        (lambda: grid({"a": [1.0, np.nan]}), "a: expected one or more finite numbers"),
        (lambda: listed({"a": [1.0], "b": [1.0, 2.0]}), "as many values of each"),
        (lambda: grid({"a": np.ones(4000), "b": np.ones(4000)}), "16000000 cases are too many"),
        (lambda: grid({"bearing.a.b": [1.0], "bearing.a_b": [2.0]}), "both be called bearing_a_b"),
        (lambda: random({"a": (0.0, 1.0, "log")}, 3), "needs values > 0"),
        (lambda: random({"a": (0.0, 1.0)}, 0), "found 0 cases"),
    ],
)
def test_refusals(make, words):
    with pytest.raises(ValueError, match=words):
        make()


def test_a_grid_needs_no_memory_for_its_cases():
    cases = Cases("grid", ("a", "b"), (np.arange(3000.0), np.arange(3000.0)))
    assert cases.part(8_999_999, 9_000_000) == {"a": [2999.0], "b": [2999.0]}

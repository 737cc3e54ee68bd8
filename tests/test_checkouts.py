"""The comparison of the numbers of two checkouts."""

import math

import numpy as np
from checkouts import compared, compared_cases


def test_equal_trees_do_not_differ():
    tree = {"speed": 3.0, "loads": [1.0, 2.0], "name": "a", "ok": True}
    assert compared(tree, tree) == (3, 0, 0, 0.0, "")


def test_a_list_is_compared_by_its_largest_number():
    row = compared({"loads": [1000.0, 1e-9]}, {"loads": [1000.0, 2e-9]})
    assert math.isclose(row.worst, 1e-12)
    assert row.where == "loads[1]"


def test_numbers_of_one_alone_are_counted():
    row = compared({"a": 1.0, "b": 2.0}, {"b": 2.0, "c": 1.0, "d": 1.0})
    assert (row.common, row.only_old, row.only_new) == (1, 1, 2)


def test_a_number_that_is_lost_is_seen():
    row = compared({"a": 1.0, "b": 1.0}, {"a": math.nan, "b": 2.0})
    assert row.worst == math.inf
    assert row.where == "a"


def test_counts_of_the_solver_are_no_results():
    assert compared({"iterations": 4}, {"iterations": 5}).common == 0


def test_round_off_of_nothing_is_no_difference():
    assert compared({"spin": [1e-18, -2e-18]}, {"spin": [3e-18, 0.0]}).worst == 0.0
    assert compared({"spin": [1e-18, 0.0]}, {"spin": [1.0, 0.0]}).worst > 1.0


def test_random_scenes_are_compared_case_by_case():
    """One of four fails in the new one, one takes another step, a load differs by 1e-6."""
    old = {
        "status": np.array([0, 0, 0, 1]),
        "iterations": np.array([5, 5, 6, 50]),
        "elements.load": np.array([[1.0, 2.0], [1.0, 4.0], [3.0, np.nan], [np.nan, np.nan]]),
        "residual_norm": np.ones(4),
    }
    new = dict(old, status=np.array([1, 0, 0, 1]), iterations=np.array([50, 5, 7, 50]), residual_norm=np.zeros(4))
    new["elements.load"] = np.array([[9.0, 9.0], [1.0, 4.0 + 4e-6], [3.0, np.nan], [1.0, 1.0]])
    *counts, worst, where = compared_cases(old, new)
    assert (counts, where) == ([4, 3, 2, 1], "elements.load")
    assert math.isclose(worst, 1e-6, rel_tol=1e-6)
    lost = dict(old, **{"elements.load": np.full((4, 2), np.nan)})
    assert compared_cases(old, lost)[4] == math.inf

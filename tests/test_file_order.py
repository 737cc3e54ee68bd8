"""Order of the files of a run: another file is the first one, and none is left out (`--begin-at`)."""

import itertools
from types import SimpleNamespace

from file_order import begun_at

ITEMS = [SimpleNamespace(path=path, name=name) for path in "abcdefg" for name in range(3)]


def test_every_test_once_with_its_file():
    for text in ("", "one", "5d62a7aa"):
        found = begun_at(text, ITEMS)
        assert sorted((one.path, one.name) for one in found) == [(one.path, one.name) for one in ITEMS]
        # files are whole and in turn
        paths = [path for path, _ in itertools.groupby(found, key=lambda one: one.path)]
        place = "abcdefg".index(paths[0])
        assert "".join(paths) == ("abcdefg" * 2)[place : place + 7]
        assert [one.name for one in found] == [0, 1, 2] * 7


def test_every_file_is_the_first_one_in_turn():
    firsts = {begun_at(f"commit {number}", ITEMS)[0].path for number in range(100)}
    assert firsts == set("abcdefg")


def test_no_tests_at_all():
    assert begun_at("any", []) == []

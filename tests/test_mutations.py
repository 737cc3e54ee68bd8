"""The list of hand-made errors fits the code: each text stands there once, and its tests exist."""

import pytest
from mutations import MUTATIONS, ROOT


def test_thirty():
    assert len({(one.file, one.old) for one in MUTATIONS}) == len(MUTATIONS) == 30


@pytest.mark.parametrize("mutation", MUTATIONS, ids=lambda one: one.what)
def test_the_text_stands_there_once(mutation):
    assert (ROOT / mutation.file).read_text(encoding="utf-8").count(mutation.old) == 1
    assert mutation.new != mutation.old
    for name in mutation.tests.split():
        assert (ROOT / "tests" / name).is_file()

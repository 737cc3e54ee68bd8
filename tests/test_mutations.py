"""The list of hand-made errors fits the code: each text stands there once, and its tests exist."""

from mutations import MUTATIONS, ROOT


def test_thirty():
    assert len({(one.file, one.old) for one in MUTATIONS}) == len(MUTATIONS) == 30


def test_the_texts_stand_there_once():
    stands = lambda one: (ROOT / one.file).read_text(encoding="utf-8").count(one.old) == 1 and one.new != one.old
    assert not [one.what for one in MUTATIONS if not stands(one)]
    assert all((ROOT / "tests" / name).is_file() for one in MUTATIONS for name in one.tests.split())

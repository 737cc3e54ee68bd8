"""Kept estimates: every standard designation has one, and it is the one that is computed."""

import numpy as np
import pytest

from jaxbearing.catalogue import estimate as computing
from jaxbearing.catalogue import find, parse
from jaxbearing.catalogue.geometry import Geometry
from jaxbearing.catalogue.kept import HEADING, kept_designations, kept_file, kept_geometry, key_of, row_of
from jaxbearing.catalogue.terms import angle_of

REMAKE = "jaxbearing/catalogue/data/estimates.csv is out of date: run python docs/generate/kept_estimates.py"


def inputs(text):
    bearing = parse(text)
    return bearing, angle_of(bearing, None)


def different():
    """A designation for each estimate, by the beginning of its row."""
    return {key_of(*inputs(text)): text for text in kept_designations()}


def check(texts):
    for text in texts:
        bearing, angle = inputs(text)
        kept, computed = kept_geometry(bearing, angle), computing.estimate(bearing, {}, angle)
        assert kept is not None, f"{text} has no kept estimate. {REMAKE}"
        for name, one, other in zip(Geometry._fields, kept, computed, strict=True):
            # round-off of another processor; angles of 0 have no relative error
            found, wanted = (np.asarray(value, float) for value in (one, other))
            np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-15, err_msg=f"{text}: {name}. {REMAKE}")


def test_the_file_has_each_estimate_once():
    heading, *rows = kept_file().read_text(encoding="utf-8").splitlines()
    assert heading == HEADING, REMAKE
    width = len(key_of(*inputs("6207")).split(","))
    assert [",".join(row.split(",")[:width]) for row in rows] == list(different()), REMAKE


WRITTEN = ["6205-2RS1/C3", "618/8", "7312", "7312-B", "7205 BEP", "7014 C", "71910 ACD/P4A", "70 14 E"]
WRITTEN += ["NUP 311 ECP", "N 210", "30206", "32010 X", "32310 B"]


@pytest.mark.parametrize("text", WRITTEN)
def test_suffixes_and_types_have_one(text):
    assert kept_geometry(*inputs(text)) is not None


def test_kept_estimates_are_those_that_are_computed():
    """The middle size of each series, type and suffix."""
    groups = {}
    for text in different().values():
        bearing = parse(text)
        group = (bearing.kind, bearing.series, bearing.contact_angle, text.endswith("B"))
        groups.setdefault(group, []).append(text)
    assert len(groups) > 50
    check(names[len(names) // 2] for names in groups.values())


@pytest.mark.slow
def test_all_kept_estimates_are_those_that_are_computed():
    check(different().values())


@pytest.mark.parametrize("text", ["6207", "7014 C", "NU 311", "30206"])
def test_rows_hold_every_number_in_full(text):
    bearing, angle = inputs(text)
    kept = kept_geometry(bearing, angle)
    assert kept is not None
    assert row_of(bearing, angle, kept) in kept_file().read_text(encoding="utf-8").splitlines()
    assert type(kept.n_elements.value) is int
    assert kept.contact_angle.given == (text != "30206")


def test_what_is_given_is_computed(monkeypatch):
    def refused(*_):
        raise LookupError

    monkeypatch.setattr(computing, "estimate", refused)
    assert find("6207").geometry.n_elements.value == 9
    assert find("6207", radial_load=3e3, oil="ISO VG 68").geometry == find("6207").geometry
    with pytest.raises(LookupError):
        find("6207", n_elements=9)
    with pytest.raises(LookupError):
        find("7207", contact_angle=0.5)


def test_an_estimate_of_other_dimensions_is_not_kept():
    bearing, angle = inputs("6207")
    assert kept_geometry(bearing._replace(width=18.0), angle) is None
    assert kept_geometry(bearing, angle._replace(deviation=0.1)) is None

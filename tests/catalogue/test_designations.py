"""Designations: what they say, what they do not, boundary dimensions against makers' tables, clearances."""

import itertools

import pytest
from makers_tables import NOT_IN_THE_TABLES, rated_bearings, spindle_bearings

from jaxbearing import SceneError
from jaxbearing.catalogue import find, known_designations, parse
from jaxbearing.catalogue.designation import RADIAL_SERIES, TAPERED_SERIES, bore_of, parse_several
from jaxbearing.catalogue.dimensions import bores, boundary_dimensions, clearance_limits


@pytest.mark.parametrize(
    ("text", "kind", "series", "sizes"),
    [
        ("6207", "deep_groove", "62", (35, 72, 17)),
        ("608", "deep_groove", "60", (8, 22, 7)),
        ("16005", "deep_groove", "160", (25, 47, 8)),
        ("61805", "deep_groove", "618", (25, 37, 7)),
        ("618/8", "deep_groove", "618", (8, 16, 4)),
        ("7312-B", "angular_contact", "73", (60, 130, 31)),
        ("7014 C", "spindle", "70", (70, 110, 20)),
        ("71910", "spindle", "719", (50, 72, 12)),
        ("NU 311", "cylindrical", "3", (55, 120, 29)),
        ("NU 2311", "cylindrical", "23", (55, 120, 43)),
        ("nup2210", "cylindrical", "22", (50, 90, 23)),
        ("N 1010", "cylindrical", "10", (50, 80, 16)),
        ("30206", "tapered", "302", (30, 62, 17.25)),
        ("33217", "tapered", "332", (85, 150, 49)),
        # the bore after a stroke: ISO 15
        ("62/22", "deep_groove", "62", (22, 50, 14)),
        ("60/500", "deep_groove", "60", (500, 720, 100)),
        ("618/500-MA", "deep_groove", "618", (500, 620, 56)),
        ("NU 10/500", "cylindrical", "10", (500, 720, 100)),
        # ISO 355, d x D x T
        ("32904", "tapered", "329", (20, 37, 12)),
        ("32914", "tapered", "329", (70, 100, 20)),
        # of makers: prefixes and suffixes
        ("B7014-C-T-P4S", "spindle", "70", (70, 110, 20)),
        ("HR30206J", "tapered", "302", (30, 62, 17.25)),
        ("32008XU", "tapered", "320", (40, 68, 19)),
        # D, steep: the 313 of others
        ("HR30305DJ", "tapered", "313", (25, 62, 18.25)),
    ],
)
def test_types_series_and_sizes(text, kind, series, sizes):
    found = parse(text)
    assert (found.kind, found.series) == (kind, series)
    assert (found.bore, found.outside, found.width) == sizes


@pytest.mark.parametrize("text", ["nu 311", "NU311", "NU-311", " nu_311 ", "NU 311 ECP", "NU311E", "NU 311-EC/C3"])
def test_ways_of_writing(text):
    found = parse(text)
    assert (found.kind, found.design, found.series, found.bore) == ("cylindrical", "NU", "3", 55.0)


@pytest.mark.parametrize("text", ["6205 2RS", "6205-2RSH", "6205ZZ", "62052Z", "6205-2RS1/C3", "6205 P5"])
def test_seals_and_classes_are_noted(text):
    found = parse(text)
    assert (found.bore, found.outside, found.width) == (25.0, 52.0, 15.0)
    assert found.notes
    assert not [note for note in found.notes if "not understood" in note]
    assert found.clearance_class == ("C3" if "C3" in text else "CN")


@pytest.mark.parametrize("text", ["608", "608-2RS", "608 ZZ", "608ZZ", "6082RS", "608-2Z/C3", "608 C3"])
def test_bores_of_one_digit(text):
    found = parse(text)
    assert (found.bore, found.outside, found.width) == (8.0, 22.0, 7.0)
    assert not [note for note in found.notes if "not understood" in note]


def test_the_number_ends_at_a_separator():
    """625 with seals, and 6252 with a seal on one side."""
    assert parse("625-2RS").bore == 5.0
    assert parse("6252-RS").bore == 260.0


def test_angles_of_suffixes():
    angles = {
        "7205 B": 40,
        "7205-BEP": 40,
        "7205 AC": 25,
        "7014 C": 15,
        "71910 CD": 15,
        "71910 ACD/P4A": 25,
        "7014 E": 25,
        # prefix and suffixes of Schaeffler: the 2 of a seal is no class of clearance
        "B7208-C-2RSD-T-P4S-UL": 15,
        "B7014-E-T-P4S": 25,
        # of NSK and NTN
        "7206A": 30,
        "7210A5TYNDBLP5": 25,
        "7206CTYNSULP4": 15,
    }
    assert {text: parse(text).contact_angle for text in angles} == angles
    assert parse("7205").contact_angle is None
    # a class of clearance is no angle
    assert parse("7205 C3").contact_angle is None


def test_what_is_not_understood_is_refused():
    """It may change the bearing: D of tapered bearings is a steep angle, E of deep groove bearings more balls."""
    for text, part in {
        "6205 &": "&",
        "6308 NU 308": "NU308",
        "30320D": "D",
        "32206 D": "D",
        "6205 ETN9": "E",
        "6308 K9": "K9",
    }.items():
        with pytest.raises(SceneError, match=f"of which '{part}' is not understood"):
            parse(text)


def test_several_designations():
    for text, expected in {
        "6308 NU 308": ["6308", "NU 308"],
        "NU 311 ECP": ["NU 311 ECP"],
        "6205 2RS, 6206": ["6205 2RS", "6206"],
        "7014 C 6205 N 210 30206": ["7014 C", "6205", "N 210", "30206"],
    }.items():
        assert [one.text for one in parse_several(text)] == expected
    with pytest.raises(SceneError, match="NU399"):
        parse_several("6205 NU 399")


def test_steep_and_middle_angles_of_tapered_bearings():
    """NSK, Rolling bearings: D is steep, 28 deg 48 min 39 s as the series 313, C is the middle one, 20 deg."""
    assert parse("30305D").usual_angle == parse("31305").usual_angle == pytest.approx(28.81)
    assert parse("30305D").cup_width == parse("31305").cup_width
    assert parse("HR32206CJ").usual_angle == parse("32206 B").usual_angle == 20.5
    # a set of normal ones, and a class of clearance
    assert parse("30305 DF").usual_angle == parse("30305 C3").usual_angle == parse("30305").usual_angle


def test_hybrid_bearings_have_ceramic_balls():
    for text in ("HCB71910-C-T-P4S", "71910 ACE/HCP4A", "6205 HC5C3"):
        assert parse(text).ceramic, text
        assert find(text).tables()["materials"] == {"rings": "52100", "balls": "Si3N4"}
    assert not parse("71910 C").ceramic


@pytest.mark.parametrize(
    ("text", "suffix"),
    [
        ("7312 BECBP", "CB"),
        ("7312-B DB", "DB"),
        ("7312 B-TVP-UA", "UA"),
        ("71910 CDGA/P4A", "GA"),
        ("32210 J2/DF", "DF"),
    ],
)
def test_suffixes_of_sets(text, suffix):
    notes = parse(text).notes
    said = f"{suffix}: of bearings for sets; the scene has one bearing, without preload: a scene of the kind shaft"
    assert [note for note in notes if note.startswith(said)]
    assert not [note for note in notes if "not understood" in note]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("6299", "'6219'"),
        ("NU 399", "'NU 309'"),
        ("22210", "spherical roller bearing, which is not modelled"),
        ("51110", "thrust bearing"),
        ("UER207", "insert bearing"),
        ("NKI 20/16", "needle"),
        ("HS7014-C", "small balls"),
        ("QJ 208 MA", "four-point contact ball bearing, whose dimensions are not in the tables"),
        ("6185", "'618/5'"),
        ("", "such as 6207"),
        ("deep groove", "such as 6207"),
    ],
)
def test_unknown_designations(text, words):
    with pytest.raises(SceneError, match="such as 6207") as error:
        parse(text)
    assert words in str(error.value)


def test_every_known_designation_is_read_back():
    known = list(known_designations())
    assert len(known) > 1000
    assert len(set(known)) == len(known)
    for text in known:
        found = parse(text)
        assert found.bore < found.outside
        assert found.notes == ()


@pytest.mark.parametrize("row", rated_bearings(), ids=lambda row: row.designation)
def test_dimensions_of_a_catalogue(row):
    if row.designation in NOT_IN_THE_TABLES:
        with pytest.raises(SceneError):
            parse(row.designation)
        return
    found = parse(row.designation)
    assert (found.bore, found.outside, found.width) == (row.bore, row.outside, row.width)


def test_dimensions_of_spindle_bearings():
    series = {"618": "18", "619": "19", "60": "10", "62": "02"}
    for row in spindle_bearings():
        code = row.designation.split()[1]
        name = code[:3] if code[:3] in series else code[:2]
        assert boundary_dimensions("spindle", series[name], row.bore) == (row.outside, row.width), row.designation
        assert bore_of(code.removeprefix(name)) == row.bore


def test_sizes_grow_with_the_bore():
    tables = [(kind, name) for kind, table in RADIAL_SERIES.items() for name in table.values()]
    tables += [("tapered", name) for name in TAPERED_SERIES]
    for kind, series in tables:
        rows = [boundary_dimensions(kind, series, bore) for bore in bores(kind, series)]
        for smaller, larger in itertools.pairwise(rows):
            assert smaller[0] < larger[0]
            assert smaller[1] <= larger[1]


def test_cups_are_narrower_than_cones_and_both_than_the_bearing():
    for series in TAPERED_SERIES:
        for bore in bores("tapered", series):
            _, total, cone, cup, angle, spread = boundary_dimensions("tapered", series, bore)
            assert cup < cone <= total
            assert 10.0 < angle < 30.0
            assert 0.0 < spread < 3.0


@pytest.mark.parametrize(
    ("kind", "bore", "expected"),
    [
        ("deep_groove", 25, {"C2": (1, 11), "CN": (5, 20), "C3": (13, 28), "C4": (23, 41)}),
        ("deep_groove", 30, {"CN": (5, 20)}),
        ("deep_groove", 30.01, {"CN": (6, 20)}),
        ("cylindrical", 55, {"C2": (10, 40), "CN": (40, 70), "C3": (60, 90), "C4": (80, 110)}),
    ],
)
def test_clearances(kind, bore, expected):
    assert {name: clearance_limits(kind, name, bore) for name in expected} == expected


def test_clearance_classes_follow_each_other():
    for kind, bore in [(kind, bore) for kind in ("deep_groove", "cylindrical") for bore in range(3, 200)]:
        limits = [clearance_limits(kind, name, float(bore)) for name in ("C2", "CN", "C3", "C4")]
        assert all(least < greatest for least, greatest in limits)
        assert limits == sorted(limits)
    assert clearance_limits("deep_groove", "CN", 1000.0) is None

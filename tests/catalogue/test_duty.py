"""Oil and operation of standard bearings: what is given, what is an example, and losses from catalogue data alone."""

import math
import tomllib

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.catalogue import find
from jaxbearing.scenes.reader import scene_from_tables

OIL = {"oil": "ISO VG 68", "inner_speed": 1500.0 * math.pi / 30.0}


def operation(name, **duty):
    return find(name, **duty).tables()["operation"]


def test_what_is_given_stands_in_the_file():
    found = find("6207", radial_load=3e3, oil_temperature=343.15, oil_flow=1e-5 / 3.6, base="ester", **OIL)
    tables = found.tables()
    assert tables["laws"] == "best"
    assert tables["oil"] == {"grade": "ISO VG 68", "base": "ester"}
    assert tables["catalogue"] == {"designation": "6207"}
    assert tables["operation"] == {
        "inner_speed": "1500 rpm",
        "radial_load": "3000 N",
        "axial_load": "0 N",
        "oil_temperature": "70 degC",
        "oil_flow": "10 l/h",
    }
    # the attitude of the balls is that of the preset
    assert "kinematics" not in tables


def test_an_oil_by_its_name_has_no_base():
    assert find("30206", oil="fva3").tables()["oil"] == {"name": "fva3"}


def test_without_an_oil_the_scene_is_dry():
    found = find("6207")
    assert {"laws", "oil"}.isdisjoint(found.tables())
    assert found.tables()["catalogue"] == {"designation": "6207"}
    assert found.scene().contact is None
    assert '# laws = "best"' in found.text()
    assert 'jaxbearing new 6207 --oil "ISO VG 68"' in found.text()


def test_the_line_for_the_cleanliness_gives_a_modified_life():
    text = find("NU 311", **OIL).text()
    assert "# cleanliness" in text
    tables = tomllib.loads(text.replace("# cleanliness", "cleanliness"))
    assert scene_from_tables(tables, "NU 311").rating.says_cleanliness
    assert "cleanliness" not in find("NU 311").text()


def test_an_example_keeps_its_ratio_to_the_load_that_is_given():
    assert operation("30206", radial_load=2e3)["axial_load"] == "2000 N"
    assert operation("30206", axial_load=-1e3)["radial_load"] == "1000 N"
    assert operation("30206", axial_load=1e3, radial_load=2e3)["axial_load"] == "1000 N"
    # a deep groove bearing's example has no axial load
    assert operation("6207", radial_load=2e3)["axial_load"] == "0 N"
    assert operation("6207", axial_load=1e3)["radial_load"] == operation("6207")["radial_load"]
    assert "axial_load" not in operation("NU 311", radial_load=2e3)


@pytest.mark.parametrize("name", ["6207", "7312-B", "7014 C", "NU 311", "30206"])
def test_rolling_resistance_is_on_with_an_oil(name):
    contact = find(name, **OIL).scene().contact
    assert contact.rolling is not None
    assert contact.traction is not None


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"base": "PAO"}, "base is only allowed with an oil"),
        ({"oil_temperature": 333.0}, "oil_temperature is only allowed with an oil"),
        ({"oil": "fva3", "base": "PAO"}, "base is only allowed with the grade"),
        ({"oil": "ISO VG 68", "oil_temperature": -1.0}, "oil_temperature must be > 0"),
        ({"radial_load": math.inf}, "radial_load must be finite"),
    ],
)
def test_refused(given, words):
    with pytest.raises(ValueError, match=words):
        find("6207", **given)


def test_an_unknown_oil_is_refused_with_the_nearest():
    with pytest.raises(jb.SceneError, match="ISO VG 68"):
        find("6207", oil="ISO VG 70").scene()
    with pytest.raises(jb.SceneError, match="fva3"):
        find("6207", oil="fva").scene()


def test_text_is_written_as_a_string_of_the_file():
    found = find("6207", oil="ISO VG 68")
    found = found._replace(designation=found.designation._replace(text='6207 "'))
    assert found.tables()["catalogue"] == {"designation": '6207 "'}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["6207", "NU 311", "30206"])
def test_losses_from_catalogue_data_alone(name):
    solution = jb.solve(find(name, **OIL).scene())
    losses = {part: float(value) for part, value in vars(solution.power_loss).items() if value is not None}
    assert losses["rolling_resistance"] > 0.0
    np.testing.assert_allclose(sum(losses.values()), 2.0 * losses["total"], rtol=1e-12)
    assert solution.rolling_by_race.law

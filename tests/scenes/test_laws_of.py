"""Laws of the raceways from the table of a scene file: a field of the class needs no line in the builders."""

import pytest

import jaxbearing as jb
from jaxbearing.contacts import Moes
from jaxbearing.contacts.laws import ContactLaws
from jaxbearing.contacts.viscous import VISCOUS_LAWS
from jaxbearing.lubricants import VISCOUS_FUNCTIONS
from jaxbearing.scenes.bearing.build import laws_of
from jaxbearing.scenes.table import Table


class WavyLaws(ContactLaws):
    waviness: float = 0.0
    copy: float = 0.0  # tables have a method of that name


class WavyTable(Table):
    film: str
    waviness: float


class SmoothTable(Table):
    film: str
    hysteresis: float | None = None


def test_a_field_of_the_class_is_taken_from_the_table():
    found = laws_of(WavyLaws, WavyTable, WavyTable(film="moes", waviness=3e-7), film=Moes())
    assert found.waviness == 3e-7
    assert isinstance(found.film, Moes)


def test_a_field_that_the_table_lacks_has_its_default():
    found = laws_of(WavyLaws, SmoothTable, SmoothTable(film="moes"), film=Moes())
    assert found.waviness == found.copy == 0.0
    assert found.entrainment_smoothing == ContactLaws(Moes()).entrainment_smoothing


@pytest.mark.parametrize("name", ["turbine_roller", "tapered_example", "turbine_ball"])
def test_numbers_reach_the_laws_of_every_family(name):
    scene = jb.load_scene(name, {"contact.hysteresis": 0.02})
    assert float(scene.contact.hysteresis) == 0.02


@pytest.mark.parametrize("name", ["turbine_roller", "tapered_example", "turbine_ball"])
def test_no_law_is_left_a_name(name):
    laws = {"film", "thermal", "traction", "rolling"}
    contact = jb.load_scene(name, {"contact.rolling_resistance": "true"}).contact
    assert not [law for law in laws if isinstance(getattr(contact, law), str)]


def test_oils_know_the_viscous_functions_of_traction():
    assert tuple(VISCOUS_LAWS) == VISCOUS_FUNCTIONS

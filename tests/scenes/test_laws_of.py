"""Laws of the raceways from the table of a scene file: a field of the class needs no line in the builders."""

from types import SimpleNamespace

import pytest

import jaxbearing as jb
from jaxbearing.contacts import Moes
from jaxbearing.contacts.laws import ContactLaws
from jaxbearing.scenes.bearing.build import laws_of


class WavyLaws(ContactLaws):
    waviness: float = 0.0


def test_a_field_of_the_class_is_taken_from_the_table():
    found = laws_of(WavyLaws, SimpleNamespace(waviness=3e-7, film="moes"), film=Moes())
    assert found.waviness == 3e-7
    assert isinstance(found.film, Moes)


def test_a_field_that_the_table_lacks_has_its_default():
    found = laws_of(WavyLaws, SimpleNamespace(hysteresis=None), film=Moes())
    assert found.waviness == 0.0
    assert found.entrainment_smoothing == ContactLaws(Moes()).entrainment_smoothing


@pytest.mark.parametrize("name", ["turbine_roller", "tapered_example", "turbine_ball"])
def test_numbers_reach_the_laws_of_every_family(name):
    scene = jb.load_scene(name, {"contact.hysteresis": 0.02})
    assert float(scene.contact.hysteresis) == 0.02

"""Words of catalogues lead to fields that there are."""

import pytest

from jaxbearing.scenes.engineers_words import _FIELDS, usual_word
from jaxbearing.scenes.fields import names_at
from jaxbearing.scenes.reader import KINDS, schema_of_kind

TABLES = ("rating", "operation", "oil", "geometry")


@pytest.mark.parametrize("field", _FIELDS)
def test_every_field_is_one_of_a_scene(field):
    models = [schema_of_kind(kind)[0] for kind in KINDS if kind.endswith("bearing")]
    assert any(field in names_at(model, (table,)).names for model in models for table in TABLES)


def test_no_word_is_a_field_itself():
    words = [word for several in _FIELDS.values() for word in several]
    assert not set(words) & set(_FIELDS)


def test_the_table_decides_between_fields():
    assert usual_word("Z", ["n_balls", "bore"]) == "n_balls"
    assert usual_word("z", ["n_rollers"]) == "n_rollers"
    assert usual_word("z", ["density"]) == ""

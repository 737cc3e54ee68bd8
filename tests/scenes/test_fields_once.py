"""A field of a scene is said once, on its class: tables of files state only what is particular to files."""

import dataclasses
import importlib.metadata

import pytest

import jaxbearing as jb
from jaxbearing.contacts import DowsonHigginson, Gupta, MartinBlend, NijenbanningVennerMoes
from jaxbearing.contacts.viscous import BairWiner
from jaxbearing.numerics.checks import Checked
from jaxbearing.scenes.field_list import tables_of_kind
from jaxbearing.scenes.fields import plain_table_at
from jaxbearing.scenes.inputs import described_field
from jaxbearing.scenes.laws import ENTRY_POINTS
from jaxbearing.scenes.reader import KINDS, model_of, schema_of_kind
from jaxbearing.scenes.table import Table
from jaxbearing.scenes.table_of import table_of, type_of
from jaxbearing.sweeps.fields import label_of

RESTATED = {
    ("FilmModelTable", "accuracy"): "files choose the mesh by it: one of the accuracies that were measured",
    ("DiskOperationTable", "slide_to_roll"): "files take per cent and ranges",
    ("PerturbationTable", "amplitude"): "speed and load of a bearing do not reverse, the speed of a line contact may",
    ("InletRampTable", "stop"): "by default a ramp ends at the operating point",
    ("RampTable", "start"): "speed and load of a bearing do not reverse",
    ("RampTable", "stop"): "speed and load of a bearing do not reverse; by default a ramp ends at the operating point",
    ("LifeTable", "weibull"): "files have a word for the slopes of the standards",
    ("SpeedRampTable", "start"): "by default the speed stops",
    ("SpeedRampTable", "stop"): "by default the speed stops",
}
"""Fields that a table states although its class has them -> the reason."""


def tables():
    """Every table of a kind of scene, once, with the class that it describes."""
    found = {}
    for kind in KINDS:
        model, scene = schema_of_kind(kind)
        found[model] = scene
        found |= {table: built for _, table, built in tables_of_kind(kind)}
    return found


def stated(table):
    """(class of the table, field) of what the bodies of the table and its parents state."""
    for owner in table.__mro__:
        if issubclass(owner, Table) and "made_from" not in vars(owner):
            yield from ((owner.__name__, name) for name in vars(owner).get("__annotations__", {}))


def test_no_table_states_what_its_class_says():
    restated = set()
    for table, built in tables().items():
        of_class = {name for name, (_, own) in table.made_from.items()}
        if built is not None:
            of_class |= {field.name for field in dataclasses.fields(built) if type_of(field) is not None}
        restated |= {(owner, name) for owner, name in stated(table) if name in of_class}
    assert restated == set(RESTATED)


def test_most_fields_follow_from_classes():
    """Of those that hold no table and no name of a law."""
    made = {(table.__name__, name) for table in tables() for name in table.made_from}
    assert len(made) > 180


def test_fields_of_a_class_have_its_default_unit_and_bound():
    part = next(table for table in tables() if table.__name__ == "FlangeTable")
    assert part.model_fields["angle"].default == 0.0
    with pytest.raises(
        jb.SceneError, match="found the text '91 deg'; expected an angle >= 0 and below 90 degrees with a"
    ):
        jb.load_scene("turbine_roller", {"flange.angle": "91 deg"})


def test_a_field_that_a_table_leaves_out_must_exist():
    class Part(Checked):
        pass

    with pytest.raises(AssertionError, match="nothing"):
        table_of(Part, leave_out=("nothing",))


class Entry:
    """An entry point that holds an object, or fails."""

    value = "other_package.laws:Law"

    def __init__(self, name, held):
        self.name, self._held = name, held

    def load(self):
        if isinstance(self._held, Exception):
            raise self._held
        return self._held


class OwnLineFilm(DowsonHigginson):
    """A film law of another package."""


class OwnPointFilm(NijenbanningVennerMoes):
    """A film law of another package."""


class OwnFactor(Gupta):
    """A thermal factor of another package."""


class OwnFlow(BairWiner):
    """A viscous function of another package."""


HELD = {
    "own_line_film": OwnLineFilm,
    "own_point_film": OwnPointFilm,
    "own_factor": OwnFactor,
    "own_flow": OwnFlow,
    "broken": ImportError("no module named 'other_package'"),
}


@pytest.fixture
def looked_up(monkeypatch):
    """Entry points of another package; returns the names that are looked up."""
    names, installed = [], importlib.metadata.entry_points

    def entry_points(group, **params):
        if group != ENTRY_POINTS:
            return installed(group=group, **params)
        name = params["name"]
        names.append(name)
        return [Entry(name, HELD[name])] if name in HELD else []

    monkeypatch.setattr(importlib.metadata, "entry_points", entry_points)
    return names


def test_laws_of_this_package_look_nothing_up(looked_up):
    for name in jb.builtin_names():
        jb.load_scene(name)
    assert looked_up == []


def test_laws_of_another_package(looked_up):
    changes = {"film": "own_line_film", "thermal": "own_factor", "traction": "own_flow"}
    laws = jb.load_scene("turbine_roller", {f"contact.{name}": law for name, law in changes.items()}).contact
    # an unloaded roller needs the rigid film, as with the laws of this package
    assert isinstance(laws.film, MartinBlend)
    assert isinstance(laws.film.film, OwnLineFilm)
    assert isinstance(laws.thermal, OwnFactor)
    assert isinstance(laws.traction.viscous, OwnFlow)
    ball = jb.load_scene("turbine_ball", {"contact.film": "own_point_film"})
    assert isinstance(ball.contact.film, OwnPointFilm)
    disks = jb.load_scene("two_disk_mobil_jet_ii", {"contact.film": "own_point_film"})
    assert isinstance(disks.contact.film, OwnPointFilm)
    assert isinstance(
        jb.load_scene("tapered_example", {"contact.flange_film": "own_point_film"}).rib.film, OwnPointFilm
    )
    assert set(looked_up) == {"own_line_film", "own_factor", "own_flow", "own_point_film"}


@pytest.mark.parametrize(
    ("scene", "field", "name", "words"),
    [
        ("turbine_roller", "film", "broken", ["'broken'", "other_package.laws:Law", "ImportError", "can be loaded"]),
        ("turbine_roller", "film", "own_point_film", ["'own_point_film'", "a subclass of AbstractLineFilm"]),
        ("turbine_ball", "film", "own_line_film", ["'own_line_film'", "a subclass of AbstractPointFilm"]),
        ("turbine_roller", "thermal", "own_flow", ["a subclass of AbstractThermalFactor"]),
        ("turbine_roller", "film", "own_film", ["the text 'own_film'", "one of 'moes', 'dowson_higginson'"]),
        ("two_disk_mobil_jet_ii", "film", "own_line_film", ["'own_line_film'", "a film of a point contact"]),
    ],
)
def test_a_law_of_another_package_that_does_not_fit(looked_up, scene, field, name, words):
    with pytest.raises(jb.SceneError) as caught:
        jb.load_scene(scene, {f"contact.{field}": name})
    assert caught.value.path == f"contact.{field}"
    assert len(caught.value.problems) == 1
    assert all(word in str(caught.value) for word in words), str(caught.value)


@pytest.mark.parametrize("name", jb.builtin_names())
def test_outputs_take_labels_from_the_class(name):
    """Of every field that a file of this kind may have: unit and words of a swept field, words on the page of inputs,
    also where only the file has the field (`kinematics.inner_share`)."""
    scene = jb.load_scene(name)
    model = model_of(scene)
    for table in filter(lambda one: plain_table_at(model, one), model.model_fields):
        for field, (owner, own) in plain_table_at(model, table).made_from.items():
            said = owner.__dataclass_fields__[own].metadata
            found, words = label_of(scene, f"{table}.{field}"), said.get("description") or field.replace("_", " ")
            assert (found["units"] == "1") == (said.get("unit", "1") == "1"), field
            assert found["long_name"] == words
            if said.get("description"):
                assert described_field(scene, (table, field)) == words


def test_fields_that_only_files_have_are_described():
    scene = jb.load_scene("turbine_ball")
    words = described_field(scene, ("kinematics", "gyroscopic_friction"))
    assert "coefficient of friction mu that caps what a race carries" in words
    assert "relative error of the traction forces" in described_field(scene, ("contact", "traction_accuracy"))
    assert described_field(scene, ("kinematics", "no_such_thing")) == "no such thing"

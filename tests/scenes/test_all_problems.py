"""All problems of a scene are said at once: two faults are refused together as each is by itself, and no more."""

import itertools
import tomllib

import pytest

import jaxbearing as jb
from jaxbearing.scenes.errors import SceneError
from jaxbearing.scenes.reader import builtin_text, scene_from_tables

# one fault each, by the path that is refused
ROLLER = {
    "geometry.pitch_diameter": "142 N",
    "geometry.contact_length": "15 mm",
    "materials.rings": "M51",
    "oil.name": "mobil_jet_2",
    "contact.film": "mos",
    "contact.thermal": "gupt",
    "contact.traction_accuracy": "1e-2",
    "cage.guidence": "inner_ring",
    "cage.inner_diameter": "147 mm",
    "flange.angle": "90 deg",
    "drag.coefficient": "-1",
    "drag.through_flow_fraction": "2",
    "operation.oil_flow": "none",
    "operation.inner_speed": "175 Hz",
    "profile.drop": "3 um",
    "rating.roughness_elements": "none",
    "simulation.solver": "tsit",
    "simulation.rotating_load.load": "-1 N",
}
BASE = {
    "rating.roughness_rings": "0.1 um",
    "rating.roughness_elements": "0.1 um",
    "simulation.solver": "tsit5",
    "simulation.rotating_load.load": "1 N",
    "simulation.rotating_load.speed": "1 rpm",
    "contact.traction_model": "mean_pressure",
}
BALL = {
    "geometry.n_balls": "0",
    "geometry.contact_angel": "30 deg",
    "materials.balls.density": "7 kg",
    "kinematics.gyroscopic_sign": "-1",
    "kinematics.attitude": "middle",
    "contact.heathcote": "1",
    "operation.misalignment": "1 mrad",
    "oil.viscosity.law": "constnt",
    "cage.n_lands": "0",
}
LINE = {
    "geometry.reduced_radius_rolling": "0 mm",
    "materials.body_1.poisson_ratio": "0.7",
    "contact.nodes": "7",
    "operation.load_per_length": "none",
    "simulation.speed_ramp.start": "0",
    "simulation.tolerance": "-1",
}
# what the classes refuse when the parts, or the bearing from its parts, are built
# refused by a part, and between parts: neither hides the other
BOTH = {
    "geometry.n_rollers": "100",
    "flange.height": "50 mm",
    "cage.inner_diameter": "1 mm",
    "drag.coefficient": "-1",
    "operation.inner_speed": "0 rpm",
}
CLASSES = {
    "cage.inner_diameter": "120 mm",
    "cage.pocket_clearance": "10 mm",
    "flange.height": "20 mm",
    "operation.inner_speed": "0 rpm",
}


def refused(name, overrides):
    """Paths that are refused, in the order of the message."""
    with pytest.raises(jb.SceneError) as caught:
        jb.load_scene(name, overrides)
    for one in caught.value.problems:
        assert one.found
        assert one.expected
        assert str(one).partition(": ")[2] in str(caught.value)
    return [one.path or one.file for one in caught.value.problems]


def together(name, faults, base):
    alone = {path: refused(name, {**base, path: value}) for path, value in faults.items()}
    for path, found in alone.items():
        assert len(found) == 1, path
        assert found[0].startswith(path.rpartition(".")[0]), path
    pairs = list(itertools.combinations(faults, 2))
    if len(faults) > 6:  # of many those of one table, and the others in halves
        pairs = [pair for pair in pairs if len({path.partition(".")[0] for path in pair}) == 1]
    for some in [*pairs, tuple(faults)[::2], tuple(faults)[1::2], tuple(faults)]:
        found = refused(name, {**base, **{path: faults[path] for path in some}})
        assert sorted(found) == sorted({one for path in some for one in alone[path]}), some


@pytest.mark.parametrize(
    ("name", "faults", "base"),
    [
        ("turbine_roller", ROLLER, BASE),
        ("turbine_ball", BALL, {"operation.moment": "0 N*m"}),
        ("satellite_contact_1", LINE, {}),
    ],
    ids=["roller", "ball", "line"],
)
def test_of_the_file(name, faults, base):
    together(name, faults, base)


@pytest.mark.parametrize("faults", [CLASSES, BOTH], ids=["between parts", "of parts and between them"])
def test_of_the_classes(faults):
    together("turbine_roller", faults, {})


@pytest.mark.parametrize(
    ("name", "number", "rule"),
    [
        ("turbine_ball", {"geometry.conformity_inner": "0.4"}, {"geometry.n_balls": "40"}),
        ("turbine_ball", {"geometry.conformity_outer": "wide"}, {"geometry.n_balls": "40"}),
        ("turbine_roller", {"geometry.diametral_clearance": "9"}, {"geometry.n_rollers": "60"}),
        ("deep_groove_6205", {"operation.inner_speed": "3"}, {"operation.radial_load": "0 N"}),
    ],
)
def test_rules_of_a_class_that_do_not_need_the_number_that_is_refused(name, number, rule):
    base = {"operation.axial_load": "none"} if name == "deep_groove_6205" else {}
    alone = {path for fault in (number, rule) for path in refused(name, base | fault)}
    found = refused(name, base | number | rule)
    assert len(found) == len(alone)
    assert set(found) == alone


def test_rules_of_a_class_that_need_the_number_that_is_refused():
    faults = {"geometry.ball_diameter": "9", "geometry.n_balls": "40"}
    assert refused("turbine_ball", faults) == ["geometry.ball_diameter"]


def test_what_depends_on_a_refused_field_is_left_undecided():
    # a contact_length that is longer than the roller, whose length is not known
    faults = {"geometry.contact_length": "15 mm", "geometry.roller_length": "14 N"}
    assert refused("turbine_roller", faults) == ["geometry.roller_length"]
    # a name that is probably meant for the missing field is one problem
    assert refused("turbine_roller", {"cage.guidance": "none", "cage.guidence": "inner_ring"}) == ["cage.guidence"]
    # neither of two, if one of them is wrong
    assert refused("deep_groove_6205", {"geometry.diametral_clearance": "3"}) == ["geometry.diametral_clearance"]


def test_of_the_changes():
    changes = {"geometry.n_rolers": "none", "contact.film.order": "3", "cagee": "none", "drag.coefficient": "-1"}
    expected = ["geometry.n_rolers", "contact.film.order", "cagee", "drag.coefficient"]
    assert sorted(refused("turbine_roller", changes)) == sorted(expected)


def test_an_error_of_the_program_is_no_refusal(monkeypatch):
    """A rule that breaks by itself is not passed over where nothing is refused."""

    def broken(self):
        raise TypeError("a rule of the program")

    monkeypatch.setattr(jb.RollerGeometry, "_problems", broken)
    with pytest.raises(TypeError, match="a rule of the program"):
        jb.load_scene("turbine_roller")


def test_a_field_without_its_table_is_one_problem():
    """It is no table of temperatures, although the names are near."""
    with pytest.raises(SceneError) as refused:
        jb.load_scene("deep_groove_6205", {"oil_temperature": "60 degC"})
    assert len(refused.value.problems) == 1
    assert "Did you mean 'operation.oil_temperature'?" in str(refused.value)


def test_a_class_of_cleanliness_may_be_a_code():
    with pytest.raises(SceneError, match="the ISO 4406 code of circulating oil, such as '-/17/14'"):
        jb.load_scene("deep_groove_6205", {"rating.cleanliness": "normal"})


def _misspelt(table, path, name):
    return {
        (name if path == (key,) else key): _misspelt(value, path[1:], name)
        if path[:1] == (key,) and path[1:]
        else value
        for key, value in table.items()
    }


def test_one_misspelt_field_is_one_problem():
    """The name as it stands, and none of what seems to lack since it was not read."""
    cases = {
        "deep_groove_6205_mounted": [
            *((path, "qqq") for path in (("geometry",), ("oil",), ("thermal",), ("operation", "inner_speed"))),
            (("geometry", "outside_diameter"), "diameter"),
            (("geometry", "conformity_inner"), "inner"),
            (("geometry", "pitch_diameter"), "pitch"),
            (("operation", "moment"), "momnt"),
        ],
        "four_point_qj": [(("rating", "reliability"), "Reliability"), (("materials", "rings", "density"), "qqq")],
    }
    for name, misspelt in cases.items():
        tables = tomllib.loads(builtin_text(name))
        for path, wrong in misspelt:
            with pytest.raises(SceneError, match=f"{wrong}: found the unknown name") as refused:
                scene_from_tables(_misspelt(tables, path, wrong), name)
            assert len(refused.value.problems) == 1, str(refused.value)


def test_a_field_that_is_given_is_not_suggested():
    """The suggestion is one of the fields that the table lacks."""
    tables = tomllib.loads(builtin_text("deep_groove_6205_mounted"))
    for path, wrong in {
        "geometry.outside_diameter": "diameter",
        "materials.balls": "bals",
        "geometry.n_balls": "z",
    }.items():
        with pytest.raises(SceneError, match=f"Did you mean '{path.rpartition('.')[2]}'"):
            scene_from_tables(_misspelt(tables, tuple(path.split(".")), wrong), "scene")

"""Marks in the comments of a scene file: read, said, shown among the inputs."""

import jaxbearing as jb
from jaxbearing.scenes.inputs import scene_inputs
from jaxbearing.scenes.marks import Mark, marks_in, marks_of, notes_of_file

TEXT = """
kind = "shaft"  # a note of the author

[geometry]  # of a table
n_balls        = 9          # estimated: 8 to 10
ball_diameter  = "11 # mm"  # given
pitch_diameter = '53 mm'    # from the apex, estimated: 52 to 54 mm
clearance      = "13 um"    # unmounted, normal class
bore           = 0.035      # standard; not assumed
[operation]
radial_load = {mean = "3 kN", deviation = "1 kN"}  # an example
axial_load  = "1 kN"                               # assumed, light
"""


def test_marks_in_a_text():
    assert marks_in(TEXT) == {
        "geometry.n_balls": Mark("estimated"),
        "geometry.pitch_diameter": Mark("estimated"),
        "geometry.clearance": Mark("", unmounted=True),
        "operation.radial_load": Mark("an example"),
        "operation.axial_load": Mark("assumed"),
    }


def written(folder, name, **known):
    path = folder / f"{name.replace(' ', '_')}.toml"
    path.write_text(jb.catalogue.find(name, **known).text(), encoding="utf-8")
    return path


def test_every_number_of_a_new_scene_that_nobody_gave_is_marked(tmp_path):
    for name in ("6207", "NU 311", "30206", "7014 C"):
        said = " ".join(notes_of_file(written(tmp_path, name, oil="ISO VG 68")))
        assert "geometry.pitch_diameter" in said or "geometry.roller_half_angle" in said
        assert "assumed: materials.rings" in said
        assert "an example: operation.inner_speed, operation.radial_load" in said
        assert "operation.oil_temperature" in said
        assert "geometry.bore" not in said
        given = written(tmp_path, name, oil="ISO VG 68", radial_load=1e3, oil_temperature=330.0, inner_speed=100.0)
        assert "operation.radial_load" not in " ".join(notes_of_file(given))


def test_the_clearance_is_that_before_mounting(tmp_path):
    path = written(tmp_path, "6207")
    before = "geometry.diametral_clearance is the clearance before mounting"
    assert any(before in text for text in notes_of_file(path))
    assert not any(before in text for text in notes_of_file(path, {"geometry.diametral_clearance": "5 um"}))
    fits = {"fits.shaft_tolerance": "k5", "fits.housing_tolerance": "H7"}
    assert not any(before in text for text in notes_of_file(path, fits))


def test_materials_of_the_seats(tmp_path):
    """They are said of built-in scenes too, which have no marks."""
    changes = {"fits.housing_material": "aluminium"}
    assert notes_of_file("deep_groove_6205_fitted", changes) == ["fits.shaft_material is not given: assumed steel"]
    (note,) = notes_of_file("deep_groove_6205_fitted")
    assert note == "fits.shaft_material and fits.housing_material are not given: assumed steel"
    assert notes_of_file("deep_groove_6205") == []


def test_an_override_takes_the_mark_away(tmp_path):
    path = written(tmp_path, "6207")
    assert "geometry.n_balls" in marks_of(path)
    assert "geometry.n_balls" not in marks_of(path, {"geometry.n_balls": 8})
    assert not any(name.startswith("materials") for name in marks_of(path, {"materials": "none"}))
    assert marks_of("deep_groove_6205") == {}


def test_marks_of_the_bearings_on_a_shaft(tmp_path):
    written(tmp_path, "6207")
    shaft = tmp_path / "shaft.toml"
    shaft.write_text(
        'kind = "shaft"\n[[bearing]]\nname = "front"\nscene = "6207.toml"\nmaterials.rings = "M50"\n', encoding="utf-8"
    )
    found = marks_of(shaft)
    assert found["bearing.front.geometry.n_balls"] == Mark("estimated")
    assert "bearing.front.materials.rings" not in found
    assert not any("operation" in path for path in found)
    assert any("bearing.front.geometry.diametral_clearance is" in text for text in notes_of_file(shaft))


def test_inputs_say_where_their_values_come_from(tmp_path):
    path = written(tmp_path, "NU 311", oil="ISO VG 68")
    changes = {"contact.film": "moes"}
    inputs = scene_inputs(path, changes, jb.load_scene("reference_roller"))
    marks = {one.path: one.mark for rows in inputs.values() for one in rows}
    assert marks["geometry.n_rollers"] == "estimated, by the file"
    assert marks["operation.inner_speed"] == "an example, by the file"
    assert marks["cage.guiding_clearance"] == "estimated by laws = 'best'"
    assert marks["contact.thermal"] == "by laws = 'best'"
    assert marks["contact.film"] == marks["geometry.bore"] == ""

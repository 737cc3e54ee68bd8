"""Names that engineers type: materials, kinds of bearings, codes of cleanliness."""

import itertools

import pytest

import jaxbearing as jb
from jaxbearing import SceneError, load_scene
from jaxbearing.bearings.rating import CLEANLINESS_CLASSES, cleanliness_named
from jaxbearing.life.modification import CLEANLINESS
from jaxbearing.materials import ALIASES, CATALOGUE, catalogue_material, material_named
from jaxbearing.scenes.kinds import ALIASES as KINDS_ALSO
from jaxbearing.scenes.reader import KINDS

RATED = {"rating.viscosity_ratio": 1.5}


@pytest.mark.parametrize(
    ("given", "name"),
    [
        *((word, "52100") for word in ("100Cr6", "100 Cr 6", "AISI 52100", "SUJ2", "1.3505", "52100")),
        *((word, "M50") for word in ("M-50", "m50", "AISI M50")),
        *((word, "Si3N4") for word in ("ceramic", "Ceramic", "silicon nitride", "si3n4")),
        ("aluminum", "aluminium"),
        ("cast iron", "cast_iron"),
    ],
)
def test_materials(given, name):
    assert material_named(given) == name
    assert catalogue_material(given) is CATALOGUE[name]
    scene = jb.load_scene("deep_groove_6205", {"materials.balls": f'"{given}"'})
    assert scene.materials.balls == jb.load_scene("deep_groove_6205", {"materials.balls": name}).materials.balls


def test_other_words_are_no_material():
    for word in ("", "M51", "steal", "none"):
        assert material_named(word) is None
    assert set(ALIASES.values()) <= set(CATALOGUE)
    with pytest.raises(jb.SceneError, match="Did you mean 'Si3N4'"):
        jb.load_scene("deep_groove_6205", {"materials.balls": "Si3N5"})


def test_a_field_of_a_material_by_another_name():
    with pytest.raises(jb.SceneError, match=r"is 52100 with this value"):
        jb.load_scene("deep_groove_6205", {"materials.balls": "100Cr6", "materials.balls.density": "7800 kg/m^3"})


@pytest.mark.parametrize("kind", ["deep_groove_ball_bearing", "Deep groove ball bearing", "ball bearing", "ball"])
def test_kinds(kind):
    plain = jb.load_scene("deep_groove_6205")
    assert jb.load_scene("deep_groove_6205", {"kind": f'"{kind}"'}) == plain


def test_every_further_kind_stands_for_one():
    assert set(KINDS_ALSO.values()) <= set(KINDS)
    assert not set(KINDS_ALSO) & set(KINDS)
    with pytest.raises(jb.SceneError, match=r"kind: found the text 'roller'; expected one of"):
        jb.load_scene("deep_groove_6205", {"kind": "roller"})


@pytest.mark.parametrize(
    ("code", "name"),
    [
        ("-/13/10", "online_filter_13"),
        ("13/10", "online_filter_13"),
        ("12/9", "online_filter_13"),
        ("16/14/11", "online_filter_15"),
        ("-/15/12", "online_filter_15"),
        ("20/17/14", "online_filter_17"),
        ("18/16/13", "online_filter_17"),
        # one number is beyond the cleaner class
        ("-/15/13", "online_filter_17"),
        ("22/19/16", "online_filter_19"),
        ("grease_normal", "grease_normal"),
    ],
)
def test_codes_of_cleanliness(code, name):
    assert cleanliness_named(code) == name
    assert jb.Rating(cleanliness=code).cleanliness == name
    scene = jb.load_scene("deep_groove_6205", {"rating.cleanliness": f'"{code}"', **RATED})
    assert scene.rating.cleanliness == name


def test_oil_that_is_dirtier_than_all_classes_is_refused():
    assert set(CLEANLINESS_CLASSES) == set(CLEANLINESS)
    for code in ("-/20/17", "19/17", "dirty"):
        with pytest.raises(jb.SceneError, match=r"rating.cleanliness: found the text .*online_filter_19"):
            jb.load_scene("deep_groove_6205", {"rating.cleanliness": f'"{code}"', **RATED})
        with pytest.raises(ValueError, match="cleanliness"):
            jb.Rating(cleanliness=code)


def test_saved_by_the_names_of_the_catalogue(tmp_path):
    scene = jb.load_scene("deep_groove_6205", {"materials.balls": "ceramic", "rating.cleanliness": "20/17/14", **RATED})
    jb.save_scene(scene, tmp_path / "a.toml")
    text = (tmp_path / "a.toml").read_text(encoding="utf-8")
    assert '"Si3N4"' in text
    assert '"online_filter_17"' in text
    assert jb.load_scene(tmp_path / "a.toml") == scene


def test_kinds_that_are_not_modelled_suggest_none():
    """However near the name is to that of a kind."""
    changes = {"deep_groove_6205": "kind", "gear_shaft": "bearing.rear.kind"}
    for (scene, path), given in itertools.product(
        changes.items(), ("needle_bearing", "spherical roller bearing", "thrust")
    ):
        with pytest.raises(SceneError, match="which is not modelled") as error:
            load_scene(scene, {path: given})
        assert "Did you mean" not in str(error.value)
    with pytest.raises(SceneError, match="Did you mean 'tapered_roller_bearing'"):
        load_scene("deep_groove_6205", {"kind": "tapered_rollr_bearing"})

"""`laws = "best"`: what it stands for, what a scene gives itself, what is estimated, what is left out."""

import warnings

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.priors import DRAG
from jaxbearing.scenes.field_list import tables_of_kind
from jaxbearing.scenes.fields import is_known
from jaxbearing.scenes.presets import BEST, GUIDING_CLEARANCE, POCKET_CLEARANCE, listing
from jaxbearing.scenes.reader import schema_of_kind

OIL = {"oil.grade": "ISO VG 68", "operation.oil_temperature": "60 degC"}
BEST_BALL = {"laws": "best", "kinematics": "none", **OIL, "operation.oil_flow": "2 l/h"}


def loaded(name, changes):
    """A scene, and what is said of its preset."""
    with pytest.warns(jb.PresetUsedWarning) as said:
        scene = jb.load_scene(name, changes)
    (one,) = said
    return scene, str(one.message)


def roller(**changes):
    """The roller bearing of the source with nothing but geometry, oil and operation."""
    tables = {
        "kind": "cylindrical_roller_bearing",
        "laws": "best",
        "geometry": {
            "n_rollers": 30,
            "pitch_diameter": "142 mm",
            "roller_diameter": "12 mm",
            "roller_length": "14 mm",
            "diametral_clearance": "30 um",
        },
        "materials": {"rings": "M50", "rollers": "M50"},
        "oil": {"name": "mobil_jet_ii"},
        "operation": {
            "inner_speed": "10500 rpm",
            "radial_load": "25 kN",
            "oil_flow": "150 l/h",
            "oil_temperature": "100 degC",
        },
    }
    for path, value in changes.items():
        table, _, name = path.partition("__")
        if name:
            tables.setdefault(table, {})[name] = value
        else:
            tables[table] = value
    with pytest.warns(jb.PresetUsedWarning) as said:
        scene = jb.scene_from_mapping(tables)
    return scene, str(said[0].message)


def test_a_ball_bearing():
    scene, said = loaded("deep_groove_6205", BEST_BALL)
    listed = jb.load_scene(
        "deep_groove_6205",
        {
            "kinematics": "none",
            **OIL,
            "operation.oil_flow": "2 l/h",
            "contact.film": "nijenbanning",
            "contact.thermal": "gupta",
            # of the default rheology of standard oils
            "contact.traction": "elsharkawy_hamrock",
            "contact.rolling_resistance": "biboulet_houpert",
            "kinematics.attitude": "equilibrium",
            "cage.guidance": "inner_ring",
            "cage.guiding_clearance": f"{1e3 * GUIDING_CLEARANCE * 38.5e-3:.3g} mm",
            "cage.pocket_clearance": f"{1e3 * POCKET_CLEARANCE * 7.938e-3:.3g} mm",
            "cage.land_width": "1.19 mm",
            "drag.coefficient": DRAG["ball"].nominal,
        },
    )
    assert scene == listed
    for words in ("contact.film = 'nijenbanning'", "estimated: cage.guiding_clearance = '0.154 mm'"):
        assert words in said


def test_a_roller_bearing():
    scene, said = roller()
    assert scene.contact.traction.viscous == jb.load_scene("turbine_roller").contact.traction.viscous
    assert type(scene.contact.film) is type(jb.load_scene("turbine_roller").contact.film)
    assert scene.contact.resists_rolling
    assert scene.cage is not None
    assert float(scene.drag.coefficient) == 0.3
    assert "drag.coefficient = 0.3" in said.split("estimated")[1]


def test_a_tapered_roller_bearing():
    scene, said = loaded("tapered_example", {"laws": "best", "contact": "{}"})
    named = jb.load_scene("tapered_example", {"contact.rolling_resistance": "full_range"})
    assert scene == named
    assert "contact.flange_film = 'chittenden'" in said
    # this file names all laws itself, and without [contact] there is none
    assert jb.load_scene("tapered_example", {"laws": "best"}) == jb.load_scene("tapered_example")
    dry = {"contact": "none", "drag": "none"}
    assert jb.load_scene("tapered_example", {"laws": "best", **dry}) == jb.load_scene("tapered_example", dry)


def test_single_fields_prevail():
    scene, said = roller(contact__film="grubin", cage__pocket_clearance="200 um", drag__coefficient=0.5)
    assert type(scene.contact.film).__name__ != "Moes"
    assert float(scene.cage.pocket_clearance) == pytest.approx(200e-6)
    assert float(scene.drag.coefficient) == 0.5
    assert "contact.film" not in said
    assert "cage.land_width" in said
    mean = roller(contact__traction_model="mean_pressure")[0].contact.traction
    assert type(mean).__name__ == "MeanPressureTraction"


@pytest.mark.parametrize("way", ["file", "set"])
def test_none_leaves_out(way):
    if way == "file":
        scene, said = roller(contact__thermal="none", drag="none")
    else:
        changes = {"laws": "best", "contact": "{}", "contact.thermal": "none", "drag": "none"}
        scene, said = loaded("turbine_roller", changes)
    assert type(scene.contact.thermal).__name__ == "NoThermalReduction"
    assert scene.drag is None
    assert "drag" not in said


def test_without_traction_nothing_slides():
    scene, said = roller(contact__traction="none")
    assert (scene.contact.traction, scene.cage, scene.drag) == (None, None, None)
    assert "cage: nothing slides without contact.traction" in said


def test_tilting_rollers_keep_friction_and_cage():
    scene, said = roller(operation__misalignment="1 mrad")
    assert scene.contact.traction is not None
    assert scene.cage is not None
    assert "contact.traction" not in said.partition("left out")[2]


def test_drag_needs_a_flow_and_this_is_said():
    scene, said = loaded("deep_groove_6205", {**BEST_BALL, "operation.oil_flow": "none"})
    assert scene.drag is None
    assert "left out: drag: operation.oil_flow is not given" in said


def test_elements_that_stand_close_have_small_pockets():
    scene, _ = roller(geometry__n_rollers=36)
    gap = 142e-3 * np.sin(np.pi / 36) - 12e-3
    assert float(scene.cage.pocket_clearance) == pytest.approx(0.3 * gap, rel=0.01)


def test_what_is_missing_is_refused_by_its_own_name():
    with pytest.raises(jb.SceneError, match="oil: found nothing"):
        jb.load_scene("deep_groove_6205", {"laws": "best"})
    with pytest.raises(jb.SceneError, match=r"laws: found the text 'bets'; expected 'best'.*Did you mean 'best'"):
        jb.load_scene("deep_groove_6205", {"laws": "bets"})
    with pytest.raises(jb.SceneError, match="laws"):
        jb.load_scene("two_disk_etm", {"laws": "best"})


def test_saved_law_by_law(tmp_path):
    scene, _ = loaded("deep_groove_6205", BEST_BALL)
    jb.save_scene(scene, tmp_path / "a.toml")
    text = (tmp_path / "a.toml").read_text(encoding="utf-8")
    assert "laws" not in text
    assert 'film = "nijenbanning"' in " ".join(text.split())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert jb.load_scene(tmp_path / "a.toml") == scene


@pytest.mark.parametrize("kind", BEST)
def test_every_law_of_the_list_is_a_field(kind):
    model, _ = schema_of_kind(kind)
    listed = dict(listing(kind))
    assert listed
    assert all(is_known(model, path.split(".")) for path in listed)
    tables = {path for path, _, _ in tables_of_kind(kind)}
    assert {path.partition(".")[0] for path in listed} <= tables


@pytest.mark.slow
def test_first_scenes_are_solved():
    """A bearing, an oil and its duty: films, traction, rolling resistance, cage and drag."""
    ball = jb.solve(loaded("deep_groove_6205", BEST_BALL)[0])
    losses = {name for name, value in vars(ball.power_loss).items() if value is not None}
    assert {"inner_raceway", "outer_raceway", "rolling_resistance", "drag", "cage_pilot"} <= losses
    assert float(ball.power_loss.total) > 0.0
    found = jb.solve(roller()[0])
    assert float(found.power_loss.total) > 0.0


@pytest.mark.parametrize(
    ("designation", "ring"),
    [("NU 210", "outer_ring"), ("NJ 210", "outer_ring"), ("N 210", "inner_ring"), (None, "inner_ring")],
)
def test_ribs_guide_the_cage_of_rollers(designation, ring):
    scene, said = roller(**({} if designation is None else {"catalogue__designation": designation}))
    assert scene.cage.guidance == ring
    assert f"assumed: cage.guidance = '{ring}'" in said


def test_without_a_cage_rollers_roll():
    scene, said = roller(cage="none")
    assert (scene.cage, scene.contact.traction) == (None, None)
    assert "contact.traction: sliding rollers need a cage" in said

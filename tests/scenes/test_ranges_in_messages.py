"""A message that refuses a value names what is allowed, and what it names is allowed indeed."""

import re

import pytest

import jaxbearing as jb

ANGLE = r"above ([\d.]+) degrees and below ([\d.]+) degrees"


def refused(scene, changes):
    with pytest.raises(jb.SceneError) as error:
        jb.load_scene(scene, changes)
    return str(error.value)


@pytest.mark.parametrize("end_radius", ["108 mm", "40 mm", "112 mm"])
@pytest.mark.parametrize("angle", ["0.1 deg", "14 deg", "60 deg"])
def test_range_of_the_flange_angle(end_radius, angle):
    """Both ends: a thousandth of a degree inside is a bearing, and outside is none."""
    sphere = {"geometry.end_radius": end_radius}
    low, high = map(
        float, re.search(ANGLE, refused("tapered_example", sphere | {"geometry.flange_angle": angle})).groups()
    )
    assert 0.0 <= low < high
    for inside in (low + 1e-3, high - 1e-3):
        jb.load_scene("tapered_example", sphere | {"geometry.flange_angle": f"{inside} deg"})
    for outside in (low - 1e-3, high + 1e-3):
        assert re.search(ANGLE, refused("tapered_example", sphere | {"geometry.flange_angle": f"{outside} deg"}))


@pytest.mark.parametrize(
    ("scene", "field"),
    [
        ("deep_groove_6205", "geometry.n_balls"),
        ("reference_roller", "geometry.n_rollers"),
        ("tapered_example", "geometry.n_rollers"),
    ],
)
def test_most_elements(scene, field):
    changes = {"cage": "none", "contact": "none"} if scene == "reference_roller" else {}
    (most,) = map(int, re.findall(r"at most (\d+)", refused(scene, changes | {field: "500"})))
    jb.load_scene(scene, changes | {field: str(most)})
    assert "at most" in refused(scene, changes | {field: str(most + 1)})


def test_range_of_the_end_radius():
    """Up to the apex of the roller's cone: beyond, the rib would be closer than a sphere of this radius."""
    for given in ("1 mm", "2 m"):
        low, high = re.search(
            r"above ([\d.]+) m .* below ([\d.]+) m", refused("tapered_example", {"geometry.end_radius": given})
        ).groups()
        inside = {"geometry.end_radius": f"{float(high) * 0.999} m"}
        assert "expected above" in refused("tapered_example", inside | {"geometry.flange_angle": "80 deg"})
        outside = {"geometry.end_radius": f"{float(high) * 1.001} m"}
        assert "geometry.end_radius: found" in refused("tapered_example", outside)
        assert float(low) < 0.108 < float(high)


def test_longest_tapered_roller():
    text = refused("tapered_example", {"geometry.roller_length": "2 m"})
    assert float(re.search(r"expected below ([\d.]+) m", text)[1]) < 2.0


@pytest.mark.parametrize(
    ("field", "value"),
    [("youngs_modulus", "200 GPa"), ("poisson_ratio", "0.31"), ("density", "7.8 g/cm^3")],
)
def test_one_property_of_a_named_material(field, value):
    """The message says what to write, and that is a scene with this property and the others of the material."""
    text = refused("deep_groove_6205", {f"materials.rings.{field}": value})
    path, table = re.search(r"(materials\.rings)=(\{.*\}) is 52100", text).groups()
    rings = jb.load_scene("deep_groove_6205", {path: table}).materials.rings
    named = jb.load_scene("deep_groove_6205").materials.rings
    wanted = {"youngs_modulus": 200e9, "poisson_ratio": 0.31, "density": 7800.0}
    for name in wanted:
        expected = wanted[name] if name == field else float(getattr(named, name))
        assert float(getattr(rings, name)) == pytest.approx(expected, rel=1e-6)

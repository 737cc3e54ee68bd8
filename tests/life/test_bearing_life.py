"""Life of solved scenes: the reference case, what modifies it, who has one, failed lanes, gradients."""

import dataclasses
from types import SimpleNamespace

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.ball.geometry import BallGeometry
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.bearings.bearing_life import bearing_life, catalogue_life, ineffective_inputs, rated_by, with_life
from jaxbearing.bearings.profile import RollerProfile
from jaxbearing.bearings.rating import Rating
from jaxbearing.contacts import CrownedProfile
from jaxbearing.life.reference import roller_damage_rate
from jaxbearing.life.result import Life
from jaxbearing.materials import CATALOGUE, reduced_modulus
from jaxbearing.report.bearing.life_facts import life_headlines, lives_in_words

STEEL = CATALOGUE["52100"]


def reference_case(speed=0.0):
    return BallBearing(
        BallGeometry(7, 43.5e-3, 11.5e-3, 0.52, 0.52, diametral_clearance=0.0),
        BallMaterials(STEEL, STEEL),
        BallOperation(speed, radial_load=1000.0),
        BallAttitude("outer"),
        rating=Rating(dynamic_capacity=23400.0),
    )


@pytest.fixture(scope="module")
def turning():
    """The solved reference case at 100 rad/s."""
    return jb.solve(reference_case(100.0))


added = eqx.filter_jit(with_life)


def test_reference_case_of_the_standard(turning):
    life = jb.solve(reference_case()).life
    np.testing.assert_allclose(life.L10r, 13163.0, rtol=1e-4)
    np.testing.assert_allclose(life.L10, 23.4**3, rtol=1e-12)
    assert np.isinf(life.L10r_hours)  # at rest
    life = turning.life
    np.testing.assert_allclose(life.L10r_hours, life.L10r * 1e6 * 2.0 * np.pi / 100.0 / 3600.0, rtol=1e-12)
    np.testing.assert_allclose((23400.0 / life.equivalent_load) ** 3, life.L10r, rtol=1e-12)


def test_what_has_no_effect_is_said(turning):
    rating = Rating(cleanliness="grease_normal", roughness_rings=0.2e-6, roughness_elements=0.1e-6)
    solution = added(reference_case(100.0).replace({"rating": rating}), turning)
    assert solution.life.modification_factor is solution.life.film_ratio_inner is None
    for name in ("rating.cleanliness", "rating.roughness_rings"):
        (note,) = [text for text in solution.warnings if name in text]
        assert "no effect without" in note
    rating = Rating(cleanliness="grease_normal", viscosity_ratio=2.0)
    given = added(reference_case(100.0).replace({"rating": rating}), turning)
    assert given.life.Lnmr > given.life.L10r
    assert not any("no effect" in text for text in given.warnings)


CUT = {
    "straight": ("reference_roller", {}, 30),
    "misaligned": ("reference_roller", {"operation.misalignment": 1e-3}, 30),
    "profiled": ("reference_roller", {"profile": RollerProfile(CrownedProfile(drop=5e-6), n_laminae=24)}, 24),
    "tapered": ("tapered_example", {}, 30),
    "tapered, profiled": ("tapered_example", {"profile": RollerProfile(CrownedProfile(drop=5e-6), n_laminae=24)}, 24),
}


@pytest.mark.parametrize(
    ("case", "asked"),
    [
        ("straight", None),
        ("straight", 42),
        ("misaligned", 42),
        ("profiled", None),
        ("tapered", None),
        ("tapered, profiled", 42),
    ],
)
def test_laminae_of_the_rating_are_those_asked_for(case, asked, monkeypatch):
    """Every kind of roller bearing: as many as `rating.n_laminae` says, else as its contacts have."""
    name, changes, own = CUT[case]
    scene = jb.load_scene(name)
    parts = dict.fromkeys(part for part in ("contact", "cage", "flange", "drag", "rib") if hasattr(scene, part))
    scene = scene.replace(parts | changes | {"rating": Rating(n_laminae=asked)})
    counts = []

    def seen(inner, outer, *args, factors):
        counts.append((inner.shape[1], outer.shape[1], len(factors)))
        return roller_damage_rate(inner, outer, *args, factors=factors)

    monkeypatch.setattr("jaxbearing.bearings.bearing_life.roller_damage_rate", seen)
    eqx.filter_eval_shape(lambda: jb.solve(scene, throw=False))
    assert counts == [(asked or own,) * 3]


@pytest.mark.parametrize(
    ("name", "elements", "power"),
    [("deep_groove_6205", "balls", 2), ("reference_roller", "rollers", 1), ("tapered_example", "rollers", 1)],
)
def test_static_rating_of_ceramic_elements_in_every_kind_of_bearing(name, elements, power):
    """C0 at the same Hertz pressure: (E' of steel / E' of the pair)^2 of points, ^1 of lines; C is not concerned."""
    scene = jb.load_scene(name).replace({"materials.rings": STEEL, "rating": Rating()})
    solid = SimpleNamespace(
        load_inner=jnp.ones(4), load_outer=jnp.ones(4), load_inner_second=None, load_outer_second=None
    )
    laminae = SimpleNamespace(inner=jnp.ones((4, 30)), outer=jnp.ones((4, 30)), profiled=False)

    def rated(material):
        contacts = scene.replace({f"materials.{elements}": material}).rated_contacts(solid, laminae)
        return rated_by(contacts, scene.rating, (jnp.asarray(True), jnp.asarray(False)))

    steel, ceramic = rated(STEEL), rated(CATALOGUE["Si3N4"])
    ratio = float(reduced_modulus(STEEL, STEEL) / reduced_modulus(STEEL, CATALOGUE["Si3N4"]))
    np.testing.assert_allclose(ceramic.static_capacity / steel.static_capacity, ratio**power, rtol=1e-14)
    assert ceramic.dynamic_capacity == steel.dynamic_capacity


def test_lives_at_the_reliability_of_the_rating(turning):
    """a_1 of ISO 281:2007 at 98 % is 0.37, for every kind of life that the bearing has, on the screen too: also without
    data on lubrication; L10 lives stay those at 90 %."""
    numbers = {field.name: jnp.ones(()) for field in dataclasses.fields(Life) if field.default is dataclasses.MISSING}
    numbers |= {"L10r_hours": jnp.asarray(1000.0), "L10h": jnp.asarray(500.0), "L10": jnp.asarray(50.0)}
    life = Life(**numbers, reliability=0.98)
    np.testing.assert_allclose([life.Lnr_hours, life.Lnh, life.Ln], [370.0, 185.0, 18.5], rtol=1e-14)
    assert life.Lnm is life.Lnmh is None
    first, second = lives_in_words(life)
    assert first.startswith(
        "at 98 % reliability: basic reference life Lnr 370.0 h (0.3700 million revolutions); ISO 281 Ln"
    )
    assert second.startswith("at 90 % reliability: basic reference life L10r 1000 h")
    (only,) = lives_in_words(Life(**numbers, Lnmr=jnp.ones(()), Lnmr_hours=jnp.ones(())))
    assert only.startswith("at 90 % reliability: modified life Lnmr 1.000 h")
    assert "Lnr" not in only
    standing = Life(
        **(numbers | {"L10r_hours": jnp.asarray(np.inf), "L10h": jnp.asarray(np.inf), "L10": jnp.asarray(np.inf)})
    )
    (only,) = lives_in_words(standing)
    assert only == "at 90 % reliability: basic reference life L10r 1.000 million revolutions; ISO 281 L10 unlimited"
    assert dict(life_headlines(standing)) == {
        "life L10r, 90 %": "1.000 million revolutions",
        "life L10, 90 %": "unlimited",
    }
    scene = reference_case(100.0).replace({"rating.reliability": 0.98})
    rated = eqx.filter_jit(bearing_life)(scene, turning)
    assert rated.reliability == 0.98
    np.testing.assert_allclose(rated.Ln / turning.life.L10, 0.37, rtol=1e-12)


def test_catalogue_life_of_given_loads():
    """Also of a radial load alone, which opens the bearing. None under a moment, and in the direction in which the
    bearing carries nothing."""
    ball, roller = (jb.load_scene(name) for name in ("angular_contact_218", "tapered_example"))
    ball = ball.replace({"rating": Rating(dynamic_capacity=100e3)})
    roller = roller.replace({"rating": Rating(dynamic_capacity=100e3)})
    plane = jb.load_scene("reference_roller").replace({"rating": Rating(dynamic_capacity=100e3)})
    for scene, exponent in ((ball, 3.0), (roller, 10.0 / 3.0)):
        alone = scene.at_operation(axial_load=0.0, radial_load=5e3)
        np.testing.assert_allclose(catalogue_life(alone).L10, 20.0**exponent, rtol=1e-12)
        assert np.isnan(catalogue_life(scene.at_operation(axial_load=-1e3, radial_load=5e3)).L10)
    assert np.isnan(catalogue_life(roller.at_operation(moment=100.0)).L10)
    life = catalogue_life(plane.at_operation(radial_load=5e3))
    np.testing.assert_allclose(life.L10, 20.0 ** (10.0 / 3.0), rtol=1e-12)
    with pytest.raises(ValueError, match="needs a scene with a rating"):
        catalogue_life(plane.replace({"rating": None}))


def test_settings_of_other_kinds_of_bearings_are_said_to_have_no_effect():
    names = [field.name for field in dataclasses.fields(Life) if field.default is dataclasses.MISSING]
    life = Life(**dict.fromkeys(names, jnp.ones(())))
    for name, rating, expected in (
        ("deep_groove_6205", Rating(n_laminae=40, edge_factor=True), ["n_laminae", "edge_factor"]),
        ("reference_roller", Rating(grooves="scene"), ["grooves"]),
        ("reference_roller", Rating(n_laminae=40, edge_factor=True), []),
    ):
        notes = ineffective_inputs(jb.load_scene(name).replace({"rating": rating}), life)
        assert [f"rating.{field}" in note for field, note in zip(expected, notes, strict=True)] == [True] * len(
            expected
        )


@pytest.mark.slow
def test_modified_life_of_a_lubricated_roller_bearing():
    scene = jb.load_scene("reference_roller").replace(dict.fromkeys(("contact.traction", "cage", "flange", "drag")))
    conditions = {"cleanliness": "online_filter_15", "roughness_rings": 0.2e-6, "roughness_elements": 0.1e-6}
    plain = jb.solve(scene)
    assert plain.life is None
    solution = jb.solve(scene.replace({"rating": Rating(**conditions)}))
    for name in ("load_inner", "film_inner"):
        np.testing.assert_allclose(getattr(solution.elements, name), getattr(plain.elements, name), rtol=1e-11)
    life = solution.life
    assert 0.1 < life.viscosity_ratio < 4.0
    np.testing.assert_allclose(life.Lnmr, life.modification_factor * life.L10r, rtol=1e-12)
    np.testing.assert_allclose(life.film_ratio_inner, solution.elements.film_inner / np.hypot(0.2e-6, 0.1e-6))
    # without clearance and evenly loaded, G1 of the check values: 1.5 at C/P = 4, and (C/P)^(2/3)
    assert 0.5 < life.L10r / life.L10 < 4.0
    safer = jb.solve(scene.replace({"rating": Rating(**conditions, reliability=0.99)})).life
    np.testing.assert_allclose(safer.Lnmr, 0.25 * life.Lnmr, rtol=1e-12)


@pytest.mark.slow
def test_gradient_through_the_solve_and_failed_lanes():
    scene = jb.load_scene("deep_groove_6205").replace({"rating": Rating()})
    rate = lambda load: jb.solve(scene.at_operation(radial_load=load), throw=False).life.damage_rate
    slope = jax.grad(rate)(1500.0)
    np.testing.assert_allclose(slope, (rate(1500.5) - rate(1499.5)), rtol=1e-6)
    # a lane that fails spoils no shared derivative
    dry = jb.load_scene("reference_roller").replace(dict.fromkeys(("contact", "oil", "cage", "flange", "drag")))
    dry = dry.replace({"rating": Rating()})
    loads = jnp.asarray([5e3, -1.0, 2e4])

    def lives(clearance):
        one = lambda load: jb.solve(
            dry.replace({"operation.radial_load": load, "geometry.diametral_clearance": clearance}), throw=False
        )
        found = jax.vmap(one)(loads)
        return jnp.sum(jnp.where(found.converged, found.life.damage_rate, 0.0)), found.life.L10r

    (_, each), slope = jax.value_and_grad(lives, has_aux=True)(20e-6)
    assert np.isnan(each[1])
    assert np.all(np.isfinite(each[jnp.asarray([0, 2])]))
    assert np.isfinite(slope)


def test_refusals():
    with pytest.raises(ValueError, match=r"rating\.dynamic_capacity must be > 0"):
        Rating(dynamic_capacity=-1.0)
    with pytest.raises(ValueError, match=r"rating\.roughness_elements: found nothing"):
        Rating(roughness_rings=1e-7)


@pytest.mark.parametrize(
    ("name", "low", "high"), [("deep_groove_6205", 14.0e3, 14.0e3), ("angular_contact_218", 106e3, 108e3)]
)
def test_built_in_balls_have_the_rating_of_catalogues(name, low, high):
    """Catalogues rate grooves of 0.52, whatever the bearing's; the scene says which were taken."""
    scene = jb.load_scene(name).replace({"rating": Rating()})
    capacity = catalogue_life(scene).dynamic_capacity
    margin = 0.02 if low == high else 0.03
    assert low * (1.0 - margin) < capacity < high * (1.0 + margin)
    assert any("conformity 0.52" in note for note in scene.assumptions())
    own = scene.replace({"rating": Rating(grooves="scene")})
    assert any("conformities of the scene" in note for note in own.assumptions())
    assert abs(catalogue_life(own).dynamic_capacity / capacity - 1.0) > 0.04


def test_a_solution_has_the_rating_of_catalogues_and_says_how():
    solution = jb.solve(jb.load_scene("angular_contact_218").replace({"rating": Rating()}))
    assert 0.97 * 106e3 < solution.life.dynamic_capacity < 1.03 * 108e3
    assert any("conformity 0.52" in note for note in solution.notes)

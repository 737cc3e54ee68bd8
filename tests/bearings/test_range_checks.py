"""The one table of range checks, crossed with the kinds of bearings: what each says, where, and of which contacts."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.checks import EDGE_LOADED, LARGEST_TILT, input_excess, result_excess
from jaxbearing.bearings.facts import (
    MEAN_OF_LINE,
    MEAN_OF_POINT,
    RACEWAYS,
    Contacts,
    Facts,
)
from jaxbearing.bearings.ring_shape import FlexibleRing
from jaxbearing.bearings.solution import CageState, RingDisplacement
from jaxbearing.lubricants.ranges import FITTED_PRESSURE, FITTED_TEMPERATURES
from jaxbearing.materials import BALL_PRESSURE, ROLLER_PRESSURE

INNER, OUTER = RACEWAYS
RIB = "the rib"
DRY = dict.fromkeys(("contact", "oil", "cage", "flange", "drag"))
UNSHEARED = dict.fromkeys(("contact.traction", "cage", "flange", "drag"))
SHOULDERS = {"geometry.shoulder_angle_inner": 1.2, "geometry.shoulder_angle_outer": 1.2}

KINDS = {
    "yield": "races yield",
    "skid": " skid on ",
    "would skid": "rollers would skid",
    "behind": "beyond 90°",
    "other shoulder": "the other shoulder",
    "cut off": "contact ellipse cut off",
    "tilt": "by more than 10 mrad",
    "unstable": "equilibrium is unstable",
    "edge": "loaded on an edge",
    "squeezed": "takes up the whole clearance",
    "hot": "oil in the contacts",
    "sheared": "traction rheology is extrapolated",
    "rough": "asperities carry more than 1 %",
    "thermal loading": "thermal loading beyond 20",
    "slide ratio": "slide ratio of a loaded contact",
    "cage": "cage eccentricity",
    "clearance": "clearance beyond what bearings have",
    "hot inlet": "inlet oil beyond 200 degC",
    "cold inlet": "inlet oil below -20 degC",
    "slow": "less than 100 rpm",
    "standing cage": "hold the cage still",
    "wide land": "land wider than a third",
    "apex": "load_position is 0",
    "thick rim": "thicker than a fifth of its radius",
    "wall": "more than the wall between",
}
"""Kind of check -> words of its text, which no other one has."""
OF_RACES = {"yield", "skid", "behind", "other shoulder", "cut off", "edge", "hot", "sheared", "thermal loading"}
OF_RACES |= {"slide ratio", "rough"}

FAMILIES = {
    "dry balls": ("deep_groove_6205", {}, "yield behind", "", "tilt unstable clearance"),
    "balls in a flexible ring": (
        "deep_groove_6205",
        {"outer_ring": FlexibleRing(thickness=3e-3, width=15e-3, housing_stiffness=5e9)},
        "yield behind",
        "",
        "tilt unstable thick_rim clearance",
    ),
    "balls": (
        "turbine_ball",
        SHOULDERS,
        "yield skid behind other_shoulder cut_off hot sheared thermal_loading slide_ratio",
        "",
        "cage hot_inlet cold_inlet slow wide_land",
    ),
    "dry rollers": ("turbine_roller", DRY, "yield", "", "clearance"),
    "rollers": (
        "turbine_roller",
        {},
        "yield skid hot sheared thermal_loading slide_ratio",
        "",
        "cage clearance hot_inlet cold_inlet slow standing_cage wide_land",
    ),
    "rough rollers": (
        "turbine_roller",
        {"contact.mixed": jb.contacts.MixedFriction(3e-7)},
        "yield skid hot sheared rough thermal_loading slide_ratio",
        "",
        "cage clearance hot_inlet cold_inlet standing_cage wide_land",
    ),
    "tilting rollers": (
        "turbine_roller",
        UNSHEARED | {"operation.misalignment": 1e-3},
        "yield edge hot thermal_loading slide_ratio",
        "",
        "tilt squeezed clearance hot_inlet cold_inlet slow standing_cage",
    ),
    "tapered rollers": (
        "tapered_example",
        {"operation.moment": 0.0, "rating": None},
        "yield edge hot sheared thermal_loading",
        "yield cut_off hot sheared",
        "would_skid tilt hot_inlet cold_inlet slow apex",
    ),
}
"""Scene, changes, checks of the raceways, of the rib, and of the whole bearing."""


def family(name):
    scene, changes, *_ = FAMILIES[name]
    return jb.load_scene(scene).replace(changes)


def kind_and_place(text):
    (kind,) = [kind for kind, words in KINDS.items() if words in text]
    places = [place for place in (INNER, OUTER, RIB, "inner ring's", "outer ring's") if place in text]
    renamed = {"inner ring's": INNER, "outer ring's": OUTER}
    return kind, renamed.get(places[0], places[0]) if places and kind in OF_RACES else None


@pytest.mark.parametrize("name", FAMILIES)
def test_every_kind_of_bearing_has_its_checks(name):
    """Traced, not compiled, and without the second way to the root: the texts that a solve of this kind may say."""
    options = jb.NewtonOptions(continuation=False)
    solution = eqx.filter_eval_shape(lambda scene: jb.solve(scene, throw=False, options=options), family(name))
    found = sorted(map(kind_and_place, solution.range_checks), key=str)
    words = lambda text: [word.replace("_", " ") for word in text.split()]
    races, rib, whole = FAMILIES[name][2:]
    expected = [(kind, place) for kind in words(races) for place in RACEWAYS]
    expected += [(kind, RIB) for kind in words(rib)] + [(kind, None) for kind in words(whole)]
    assert found == sorted(expected, key=str)


COUNT, LAMINAE = 5, 30
LIMITS = {
    # kind -> field of the contacts, its limit, how much less is usual
    "yield": ("pressure", None),
    "skid": ("sliding", 0.1 * 10.0),
    "behind": ("angle", 0.5 * np.pi),
    "cut off": ("past_edge", 0.0),
    "hot": ("temperature", FITTED_TEMPERATURES[1]),
    "sheared": ("pressure", None),
    "rough": ("load_share", 0.01),
    "slide ratio": ("sliding", 2.0 * 10.0),
}


def contacts_of(scene):
    """Raceways where nothing leaves a range; the outer one has a million times the inner one's load."""
    ones = jnp.ones((2, COUNT))
    balls = isinstance(scene.contact, jb.contacts.PointLaws)
    load = jnp.asarray([1e-3, 1e3])[:, None] * ones
    return Contacts(
        RACEWAYS,
        load,
        1e9 * ones,
        MEAN_OF_POINT if balls else MEAN_OF_LINE,
        laws=scene.contact,
        mean_speed=10.0 * ones,
        sliding=0.01 * ones,
        temperature=350.0 * ones,
        load_share=0.0 * ones if scene.contact.mixed is not None else None,
        laminae=jnp.ones((2, COUNT, LAMINAE)) * load[..., None] / LAMINAE,
        angle=0.5 * ones if balls else None,
        past_edge=-0.1 * ones if balls else None,
        edges=("the inner ring's shoulder", "the outer ring's shoulder") if balls else (),
    )


@eqx.filter_jit
def excess_of(scene, contacts, facts, ring, cage):
    inlet = scene.oil.at(scene.operation.oil_temperature)
    return result_excess(scene, Facts((contacts._replace(inlet=inlet),), **facts), ring, cage)


def warned(scene, contacts, **facts):
    zero = jnp.zeros(())
    ring = RingDisplacement(zero, zero, zero, facts.pop("tilt", zero), zero)
    cage = CageState(zero, zero, facts.pop("eccentricity", zero), zero)
    found = jax.device_get(excess_of(scene, contacts, facts, ring, cage))
    return {kind_and_place(text) for text, excess in found.items() if excess > 0}


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("name", ["balls", "rollers", "rough rollers", "tilting rollers", "tapered rollers"])
def test_every_check_of_every_contact(name, side):
    """Just beyond its limit one loaded contact of one race is said there and nowhere else; just below, or without load,
    nothing is, whatever the other race carries."""
    scene = family(name)
    usual = contacts_of(scene)
    assert warned(scene, usual) == set()
    idle = usual._replace(load=usual.load.at[side, 3].set(0.0))
    limits = dict(LIMITS)
    limits["yield"] = ("pressure", BALL_PRESSURE if name == "balls" else ROLLER_PRESSURE)
    limits["sheared"] = ("pressure", FITTED_PRESSURE / usual.mean_share)
    for kind, (field, limit) in limits.items():
        if kind.replace(" ", "_") not in FAMILIES[name][2].split():
            continue
        put = lambda contacts, value, field=field: contacts._replace(
            **{field: getattr(contacts, field).at[side, 3].set(value)}
        )
        small = 1e-6 * max(abs(limit), 1.0)
        assert (kind, RACEWAYS[side]) in warned(scene, put(usual, limit + small)), kind
        assert (kind, RACEWAYS[side]) not in warned(scene, put(usual, limit - small)), kind
        others = warned(scene, put(usual, limit + small)) | warned(scene, put(idle, limit + small))
        assert not [place for _, place in others if place == RACEWAYS[1 - side]], kind
        assert warned(scene, put(idle, limit + small)) == set(), kind


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("name", ["tilting rollers", "tapered rollers"])
def test_loads_on_an_edge(name, side):
    scene = family(name)
    usual = contacts_of(scene)
    for share, said in ((EDGE_LOADED - 1e-6, set()), (EDGE_LOADED + 1e-6, {("edge", RACEWAYS[side])})):
        heavy = usual.laminae.at[side, 3, 0].set(share * usual.load[side, 3] / LAMINAE)
        assert warned(scene, usual._replace(laminae=heavy)) == said


def test_checks_of_the_whole_bearing():
    rollers, tilting, tapered = (family(name) for name in ("rollers", "tilting rollers", "tapered rollers"))
    assert warned(rollers, contacts_of(rollers), eccentricity=jnp.asarray(0.981)) == {("cage", None)}
    for scene in (tilting, tapered):
        usual = contacts_of(scene)
        for sign in (-1.0, 1.0):
            assert warned(scene, usual, tilt=jnp.asarray(sign * 1.001 * LARGEST_TILT)) == {("tilt", None)}
            assert warned(scene, usual, tilt=jnp.asarray(sign * 0.999 * LARGEST_TILT)) == set()
    reserve = jnp.ones((2, COUNT))
    assert warned(tapered, contacts_of(tapered), traction_reserve=reserve) == set()
    assert warned(tapered, contacts_of(tapered), traction_reserve=reserve.at[1, 2].set(-1e-6)) == {("would skid", None)}


def test_the_worst_skid_is_said():
    """`turbine_ball` at 10 N and 20 000 rpm: 2.3 N on the inner race, where balls slide with 78 m/s, under the 508 N of
    their centrifugal force on the outer race."""
    scene = family("balls")
    ones = jnp.ones((2, 1))
    skidding = contacts_of(scene)._replace(
        load=jnp.asarray([[2.333], [508.5]]) * ones,
        **{
            name: getattr(contacts_of(scene), name)[:, :1] for name in ("pressure", "temperature", "angle", "past_edge")
        },
        mean_speed=jnp.asarray([[45.0], [5.0]]),
        sliding=jnp.asarray([[-77.7], [0.01]]),
    )
    assert ("skid", INNER) in warned(scene, skidding)


INPUTS = {
    "clearance": ("geometry.diametral_clearance", -3e-4, ("rollers", "dry rollers", "tilting rollers", "dry balls")),
    "play": ("geometry.diametral_clearance", 5e-3, ("rollers", "dry rollers", "tilting rollers")),
    "hot inlet": ("operation.oil_temperature", 474.0, ("balls", "rollers", "tilting rollers", "tapered rollers")),
    "cold inlet": ("operation.oil_temperature", 253.0, ("balls", "rollers", "tilting rollers", "tapered rollers")),
    "slow": ("operation.inner_speed", 10.0, ("balls", "rollers", "tilting rollers", "tapered rollers")),
    "wide land": ("cage.land_width", 0.05, ("balls", "rollers")),
    "apex": ("operation.load_position", 0.0, ("tapered rollers",)),
    "thick rim": ("outer_ring.thickness", 8e-3, ("balls in a flexible ring",)),
}


@pytest.mark.parametrize("kind", INPUTS)
def test_checks_of_the_scene_itself(kind):
    """Said by all kinds of bearings that the number concerns, and not by the built-in scenes as they are."""
    path, value, names = INPUTS[kind]
    for name in names:
        said = lambda scene: {kind_and_place(text)[0] for text, excess in input_excess(scene).items() if excess > 0}
        scene = family(name)
        usual = scene.replace({"operation.load_position": -0.1}) if name == "tapered rollers" else scene
        assert said(usual) == set(), name
        assert said(usual.replace({path: value})) == {"clearance" if kind == "play" else kind}, name


def test_rollers_that_yield_are_said():
    solve = jax.jit(lambda scene: jb.solve(scene, throw=False))
    dry = family("dry rollers")
    for change, expected in (
        ({}, set()),
        ({"operation.radial_load": 2e6}, {"yield"}),
        ({"geometry.diametral_clearance": -1.2e-3}, {"yield", "clearance"}),
    ):
        found = solve(dry.replace(change))
        assert bool(found.converged)
        assert {kind_and_place(text)[0] for text, broken in found.range_checks.items() if broken} == expected

"""Inner flexible rings on their shaft, of all families: an independent solve, balances, limits, derivatives,
refusals."""

import dataclasses
import functools

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from rings_that_bend import check_derivatives, lobes, pressing, unbalance
from roller_cases import dry_roller, reference_roller
from scipy.optimize import root

import jaxbearing as jb
from jaxbearing.bearings.bearing import AbstractBearing
from jaxbearing.bearings.cylindrical.steady import build_system
from jaxbearing.bearings.ring_shape import FlexibleInnerRing, FlexibleRing, InnerRoundness, OuterRoundness
from jaxbearing.bearings.solution import RING_FREEDOMS
from jaxbearing.contacts import palmgren_stiffness
from jaxbearing.materials import reduced_modulus
from jaxbearing.report.bearing.facts import facts
from jaxbearing.report.bearing.ring_panels import rigid_counterpart, ring_panels

THICK = {"thickness": 8e-3, "width": 20e-3, "harmonics": 6}
"""Rings of the roller bearing."""
THIN = {"thickness": 3e-3, "width": 14e-3, "harmonics": 4}
"""Rings of the small bearings."""


def on_shaft(scene: AbstractBearing, **changes) -> AbstractBearing:
    return dataclasses.replace(scene, inner_ring=FlexibleInnerRing(**({"shaft_stiffness": 5e9} | THIN | changes)))


def rollers(**parts) -> AbstractBearing:
    """Table 13's bearing at rest."""
    return dataclasses.replace(dry_roller().at_operation(inner_speed=0.0), **parts)


def rigid_rollers(height=0.0) -> AbstractBearing:
    """The shaft may move sideways, and the inner raceway has lobes beside the load line, the outer one may have."""
    parts = {"inner_roundness": lobes(InnerRoundness, 2, height, 0.3), "outer_roundness": lobes(OuterRoundness, 3, 0.0)}
    return rollers(ring_freedom=("radial", "lateral"), **parts)


def bent_rollers(height=0.0, housing=2e10, **changes) -> AbstractBearing:
    """Both rings bend: one program for all."""
    outer = FlexibleRing(**(THICK | {"harmonics": 4}), housing_stiffness=housing)
    return on_shaft(dataclasses.replace(rigid_rollers(height), outer_ring=outer), **(THICK | changes))


@functools.cache
def ball(**changes: str) -> AbstractBearing:
    """The 6205 under a radial load, an axial one and a moment: its inner ring tilts."""
    loads = {"radial_load": "3 kN", "axial_load": "500 N", "moment": "5 N*m"} | changes
    return jb.load_scene("deep_groove_6205", {f"operation.{name}": value for name, value in loads.items()})


def bent_balls(height=0.0, **changes) -> AbstractBearing:
    """Its inner ring moves in all five degrees of freedom, and its raceway has lobes beside the load line."""
    scene = ball(radial_load_lateral="1 kN", moment_lateral="3 N*m")
    return on_shaft(dataclasses.replace(scene, inner_roundness=lobes(InnerRoundness, 2, height, 0.3)), **changes)


@functools.cache
def tapered(**changes: str) -> AbstractBearing:
    loads = {"operation.axial_load": "2 kN", "operation.radial_load": "4 kN"} | changes
    return jb.load_scene("tapered_example", {"contact": "none", **loads})


def four_point() -> AbstractBearing:
    loads = {"operation.radial_load": "8 kN", "operation.axial_load": "3 kN"}
    return on_shaft(jb.load_scene("four_point_qj", loads), thickness=6e-3, width=25e-3)


def films() -> AbstractBearing:
    oil = {"oil.name": "mobil_jet_ii", "operation.oil_temperature": "60 degC", "contact.film": "hamrock_dowson"}
    scene = jb.load_scene("deep_groove_6205", oil | {"operation.radial_load": "3 kN", "operation.moment": "none"})
    return on_shaft(scene)


def sliding_balls() -> AbstractBearing:
    scene = jb.load_scene("turbine_ball", {"operation.radial_load": "5 kN", "contact.traction_accuracy": "1e-2"})
    return on_shaft(scene, thickness=8e-3, width=30e-3, shaft_stiffness=1e10)


def influence(radius: float, sizes: dict, bed: float, angle: np.ndarray) -> np.ndarray:
    """Deflections at angles by unit loads there, m/N, of a ring on springs: the sum of the harmonics."""
    modulus, height, width = 210e9, sizes["thickness"], sizes["width"]
    bending, axial = modulus * width * height**3 / 12.0, modulus * width * height
    between, found = angle[:, None] - angle[None, :], 0.0
    for order in range(sizes["harmonics"] + 1):
        own = bending * (order**2 - 1) ** 2 / radius**4 / (1.0 + bending / (axial * radius**2))
        own = axial / radius**2 if order == 0 else own
        found = found + np.cos(order * between) / (np.pi * radius * (2.0 if order == 0 else 1.0) * (own + bed))
    return found


def test_both_rings_against_scipy():
    """Approaches of the rollers and the displacement of the shaft are the unknowns; no amplitude is."""
    scene = bent_rollers()
    solution = jb.solve(scene)
    geometry, load = scene.geometry, 25e3
    azimuth = np.asarray(solution.elements.azimuth)
    bends = influence(0.5 * 154e-3 + 4e-3, THICK | {"harmonics": 4}, 2e10, azimuth)
    bends = bends + influence(0.5 * 130e-3 - 4e-3, THICK, 5e9, azimuth)
    modulus = reduced_modulus(scene.materials.rings, scene.materials.rollers)
    line = float(palmgren_stiffness(geometry.contact_length, modulus)) * geometry.contact_length

    def loads(approach):
        # two equal contacts, one behind the other
        return line * (0.5 * np.maximum(approach, 0.0)) ** (10.0 / 9.0)

    def misfit(x):
        approach, shift = 1e-5 * x[:-1], 1e-5 * x[-1]
        found = loads(approach)
        fit = shift * np.cos(azimuth) - 0.5 * geometry.diametral_clearance - bends @ found - approach
        return np.append(fit / 1e-5, (np.sum(found * np.cos(azimuth)) - load) / load)

    begin = 2.0 * np.cos(azimuth)
    found = root(misfit, np.append(begin, 7.0), method="hybr", options={"xtol": 1e-13})
    assert np.max(np.abs(misfit(found.x))) < 1e-11
    expected = loads(1e-5 * found.x[:-1])
    np.testing.assert_allclose(solution.elements.load_inner, expected, rtol=1e-8, atol=1e-8 * np.max(expected))
    np.testing.assert_allclose(solution.ring.radial, 1e-5 * found.x[-1], rtol=1e-9)
    for side in ("outer", "inner"):
        assert unbalance(scene, solution, side) < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize(
    "make",
    [
        pytest.param(lambda: on_shaft(ball(moment="none", radial_load_lateral="1 kN")), id="dry balls, two loads"),
        pytest.param(
            lambda: on_shaft(dry_roller().replace({"operation.misalignment": 1e-4}), **THICK),
            id="tilting rollers",
        ),
        pytest.param(four_point, id="four contacts"),
        pytest.param(films, id="balls, films"),
        pytest.param(sliding_balls, id="balls, sliding, cage"),
        pytest.param(lambda: on_shaft(reference_roller(), **THICK), id="rollers, sliding, cage"),
        pytest.param(lambda: on_shaft(jb.load_scene("tapered_example")), id="tapered, films"),
    ],
)
def test_the_ring_is_in_balance(make):
    """Of dry rollers: `test_both_rings_against_scipy`; of dry balls: tests/shafts/test_bent_rings.py."""
    scene = make()
    solution, rigid = jb.solve(scene), jb.solve(dataclasses.replace(scene, inner_ring=None))
    assert unbalance(scene, solution, "inner") < 1e-9
    # the ring yields under the most loaded element
    assert float(np.max(solution.elements.load_inner)) < float(np.max(rigid.elements.load_inner))
    if solution.drive_power is not None:
        np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-8)
    # the elements carry the load on the seat of the ring
    azimuth, load = np.asarray(solution.elements.azimuth), float(scene.operation.radial_load)
    carried = np.sum(pressing(scene, solution, "inner") * np.cos(azimuth))
    np.testing.assert_allclose(carried, load, rtol=1e-2 if solution.cage is not None else 1e-8)


def test_stiffness_of_a_tilting_ring_is_symmetric():
    """At rest all forces come of one energy, with the exact rotation of the ring too; the stiffness is its second
    derivative with the amplitudes in equilibrium."""
    scene = bent_balls().replace({"operation.inner_speed": 0.0})
    stiffness = np.asarray(jb.solve(scene).stiffness)
    unit = np.sqrt(np.diag(stiffness))
    scaled = stiffness / unit / unit[:, None]
    np.testing.assert_allclose(scaled, scaled.T, atol=1e-9)
    assert np.max(np.abs(scaled - np.diag(np.diag(scaled)))) > 0.01


@pytest.mark.parametrize("name", ["rollers", "balls"])
def test_stiff_seats_are_the_rigid_rings(name):
    stiff = bent_rollers(housing=1e16, shaft_stiffness=1e16) if name == "rollers" else bent_balls(shaft_stiffness=1e16)
    found, rigid = jb.solve(stiff), jb.solve(dataclasses.replace(stiff, inner_ring=None, outer_ring=None))
    largest = np.max(rigid.elements.load_inner)
    np.testing.assert_allclose(found.elements.load_inner, rigid.elements.load_inner, rtol=1e-5, atol=1e-7 * largest)
    np.testing.assert_allclose(found.ring.radial, rigid.ring.radial, rtol=1e-5)
    # rings that bend yield under the most loaded element
    bent = jb.solve(bent_rollers() if name == "rollers" else bent_balls())
    assert np.max(bent.elements.load_inner) < 0.999 * largest


def test_no_harmonics_are_the_same_equations():
    rigid, none = (jax.jit(build_system)(scene) for scene in (rollers(), on_shaft(rollers(), harmonics=0)))
    assert eqx.tree_equal(rigid, none)
    assert none.inner is None


def test_a_lobe_that_the_ring_follows():
    """A soft ring takes the shape that lobes of its raceway ask for: no load changes by much."""
    soft = lambda height: bent_rollers(height, housing=1e16, thickness=0.5e-3, shaft_stiffness=1e8)
    bent, rigid = (
        [np.max(jb.solve(scene(height)).elements.load_inner) for height in (0.0, 20e-6)]
        for scene in (soft, rigid_rollers)
    )
    assert abs(bent[1] - bent[0]) < 0.2 * abs(rigid[1] - rigid[0])


def most_loaded(scene):
    return jb.solve(scene).elements.load_inner[0]


def test_derivatives():
    """Of rollers between two rings that bend, by numbers of both rings and of their lobes."""

    def most(housing, shaft, thickness, inner, outer):
        scene = bent_rollers(housing=housing, shaft_stiffness=shaft, thickness=thickness)
        oval = InnerRoundness(lobe_order=[2.0], lobe_height=jnp.stack([inner]), lobe_angle=[0.3])
        outer_lobes = OuterRoundness(lobe_order=[3.0], lobe_height=jnp.stack([outer]), lobe_angle=[0.2])
        return most_loaded(dataclasses.replace(scene, inner_roundness=oval, outer_roundness=outer_lobes))

    check_derivatives(most, (2e10, 5e9, 8e-3, 5e-6, 4e-6))


@pytest.mark.slow
@pytest.mark.parametrize("make", [ball, tapered])
def test_derivatives_of_other_families(make):
    check_derivatives(
        lambda shaft, thickness: most_loaded(on_shaft(make(), shaft_stiffness=shaft, thickness=thickness)),
        (5e9, 4e-3),
    )


FREE = {
    "rollers": lambda: bent_rollers(3e-6),
    "balls": lambda: bent_balls(3e-6).replace({"operation.radial_load_lateral": 0.0, "operation.moment_lateral": 0.0}),
}
LOADS = {"rollers": [0.0, 25e3, 0.0], "balls": [500.0, 3e3, 0.0]}
"""Axial, radial, lateral, N."""


@pytest.mark.parametrize("name", ["rollers", pytest.param("balls", marks=pytest.mark.slow)])
def test_reaction_is_the_load(name):
    # a lobe beside the load line pushes the ring sideways
    scene = FREE[name]()
    solution = jb.solve(scene)
    held = jb.reaction(scene, [float(getattr(solution.ring, freedom)) for freedom in RING_FREEDOMS], at="ring")
    load = LOADS[name]
    np.testing.assert_allclose(held.force[:3], load, atol=4e-9 * max(load))
    np.testing.assert_allclose(held.stiffness[1:3, 1:3], solution.stiffness[1:3, 1:3], rtol=1e-6)
    np.testing.assert_allclose(held.inner_ring.deflection, solution.inner_ring.deflection, atol=1e-13)
    if name == "rollers":
        np.testing.assert_allclose(held.outer_ring.deflection, solution.outer_ring.deflection, atol=1e-14)


def test_refusals():
    with pytest.raises(ValueError, match=r"inner_ring\.width: a flexible ring needs a width"):
        on_shaft(ball(), width=None).replace({"geometry.width": None})
    with pytest.raises(
        ValueError, match=r"inner_ring\.thickness: expected less than the radius of the inner raceway, 65"
    ):
        on_shaft(rollers(), thickness=66e-3)
    with pytest.raises(ValueError, match=r"inner_ring\.shaft_stiffness must be > 0"):
        FlexibleInnerRing(shaft_stiffness=0.0, **THICK)
    with pytest.raises(ValueError, match=r"inner_ring\.harmonics"):
        FlexibleInnerRing(shaft_stiffness=1e10, **(THICK | {"harmonics": 61}))
    with pytest.raises(jb.SceneError, match=r"inner_ring\.shaft_stiffness"):
        jb.load_scene("tapered_example", {"inner_ring.thickness": "4 mm"})
    for name in ("turbine_ball_dynamic", "turbine_roller_dynamic"):
        with pytest.raises(ValueError, match="inner_ring: "):
            on_shaft(jb.load_scene(name))
        still = on_shaft(jb.load_scene(name).replace({"simulation": None}))
        with pytest.raises(ValueError, match="inner_ring: a transient run has rigid"):
            jb.simulate(still, 1e-4)
        with pytest.raises(ValueError, match="inner_ring: a transient run has rigid"):
            jb.simulate_batch(still, 1e-4, {"operation.inner_speed": np.array([1e3])})


def test_a_thick_ring_has_a_warning():
    solution = jb.solve(bent_rollers(thickness=15e-3))
    assert [text for text in solution.warnings if "the inner ring is thicker than a fifth" in text]


def test_screen_and_charts():
    scene = bent_rollers()
    # as of a bearing with a rigid outer ring
    solution = dataclasses.replace(jb.solve(scene), outer_ring=None)
    assert "bends outwards by" in dict(facts(solution))["Inner ring"]
    names = ["inner_ring_load", "inner_ring_shape", "inner_ring_deflection"]
    panels = ring_panels(solution, rigid_counterpart(scene, solution))
    assert [panel.name for panel in panels] == names
    # the shape is drawn smaller where the elements press the ring inwards
    drawn = {series.name: np.asarray(series.y) for series in panels[1].series}
    assert drawn["deformed"][0] < drawn["round"][0]


def test_scene_files(tmp_path):
    scene = on_shaft(rollers(), shaft_shear_stiffness=2e9, shear=True)
    path = tmp_path / "ring.toml"
    jb.save_scene(scene, path)
    read = jb.load_scene(path)
    assert jax.tree.structure(read.inner_ring) == jax.tree.structure(scene.inner_ring)
    for here, there in zip(*map(jax.tree.leaves, (scene.inner_ring, read.inner_ring)), strict=True):
        np.testing.assert_allclose(here, there, rtol=1e-15)

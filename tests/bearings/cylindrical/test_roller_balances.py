"""Balances that must close, whatever the numbers: forces, powers, symmetry, and parts that are left out."""

import dataclasses
import functools

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from roller_cases import HARD_CASES, changed, dry_roller, reference_roller, turbine_roller

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.forces import CageParts, forces_without_pocket, friction_on_rings
from jaxbearing.bearings.cylindrical.solution import PowerLoss
from jaxbearing.bearings.cylindrical.steady import build_system
from jaxbearing.bearings.interactions import friction_totals
from jaxbearing.contacts import (
    BibouletHoupertRollingResistance,
    FullRangeRollingResistance,
    JoinedRollingResistance,
    NoThermalReduction,
    RigidRollingResistance,
)
from jaxbearing.contacts.laws import ContactState
from jaxbearing.numerics.arrow import evaluate

SCENES = {"reference": reference_roller, "turbine": turbine_roller}


def leaves(solution):
    return [np.asarray(leaf) for leaf in jax.tree.leaves((solution.ring, solution.elements, solution.power_loss))]


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
@pytest.mark.parametrize("case", HARD_CASES.values(), ids=HARD_CASES.keys())
def test_power_and_forces_close(scene, case):
    scene = changed(scene(), case)
    solution = jb.solve(scene)
    losses = solution.power_loss
    # torques and dissipations are assembled apart: only right signs make them agree
    np.testing.assert_allclose(solution.drive_power, losses.total, rtol=1e-8)
    parts = [value for name, value in vars(losses).items() if name != "total" and value is not None]
    np.testing.assert_allclose(sum(parts), losses.total, rtol=1e-13)
    assert min(parts) >= 0.0
    elements = solution.elements
    carried = jnp.sum(elements.load_inner * jnp.cos(elements.azimuth))
    np.testing.assert_allclose(carried, scene.operation.radial_load, rtol=1e-9)
    assert solution.residual_norm <= 1e-10
    assert all(np.isfinite(leaf).all() for leaf in leaves(solution))


@pytest.mark.parametrize(
    "change",
    [
        pytest.param({"flange.ring": "outer"}, marks=pytest.mark.slow),
        {"operation.outer_speed": 300.0},
        {"operation.outer_speed": -400.0},
        {"operation.inner_speed": 0.0, "operation.outer_speed": 900.0},
        pytest.param(
            {"cage.guidance": "outer_ring", "flange.ring": "both", "operation.outer_speed": 250.0},
            marks=pytest.mark.slow,
        ),
    ],
    ids=str,
)
def test_power_closes_with_both_rings_turning(change):
    solution = jb.solve(turbine_roller().replace(change))
    np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("outer_speed", [0.0, -400.0, 700.0])
@pytest.mark.parametrize(
    "law",
    [
        RigidRollingResistance(),
        JoinedRollingResistance(),
        FullRangeRollingResistance(),
        BibouletHoupertRollingResistance(),
    ],
    ids=lambda law: law.name,
)
def test_power_closes_with_rolling_resistance(law, outer_speed):
    scene = reference_roller().replace({"contact.rolling": law, "operation.outer_speed": outer_speed})
    solution = jb.solve(scene)
    assert float(solution.power_loss.rolling_resistance) > 100.0
    by_race = solution.rolling_by_race
    np.testing.assert_allclose(by_race.inner + by_race.outer, solution.power_loss.rolling_resistance, rtol=1e-14)
    np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-12)


@pytest.mark.slow
def test_rolling_resistance_doubles_the_loss_of_the_reference():
    """The figure of an independent implementation: it adds 3.25 kW at the nominal point."""
    solution = jb.solve(reference_roller().replace({"contact.rolling": RigidRollingResistance()}))
    np.testing.assert_allclose(solution.power_loss.rolling_resistance, 3250.0, rtol=2e-3)  # three digits are given


@pytest.mark.slow
@pytest.mark.parametrize("n_rollers", [1, 5])
def test_few_rollers_at_100_rpm(n_rollers):
    """Sliding of 1e-9 m/s under 25 kN on a roller: what a difference of surface speeds cannot resolve."""
    geometry = dataclasses.replace(turbine_roller().geometry, n_rollers=n_rollers)
    solution = jb.solve(changed(turbine_roller(), {"geometry": geometry, "rpm": 100.0}))
    np.testing.assert_allclose(solution.drive_power, solution.power_loss.total, rtol=1e-8)


def test_raceways_act_as_they_are_acted_upon():
    """The moment about the bearing axis of what a roller gets from both races is what their rings are driven with."""
    random = np.random.default_rng(1)
    traction, rolling = (jnp.asarray(random.normal(size=(2, 30))) for _ in range(2))
    contact = ContactState(jnp.ones((2, 30)), None, traction, rolling, jnp.zeros(()))
    parts = CageParts(pocket=None, land=None, guidance="inner_ring")
    speeds = jnp.full(30, 500.0), jnp.full(30, 6000.0)

    @eqx.filter_jit
    def got_and_driven(scene, state):
        system, still = build_system(scene), jnp.zeros((2, 30))
        forces = forces_without_pocket(system.kinematics, system.contact, state, parts, *speeds)
        got = jnp.sum(forces.tangential * system.kinematics.pitch_radius + forces.moment)
        friction = friction_on_rings(system.kinematics, state, still, still, None, None)
        found = friction_totals(PowerLoss, friction, system.kinematics)
        return got, found.inner_torque + found.outer_torque

    # both kinds of force together, and each by itself
    for state in (contact, contact._replace(rolling_force=None), contact._replace(traction=jnp.zeros((2, 30)))):
        np.testing.assert_allclose(*got_and_driven(reference_roller(), state), rtol=1e-12)


def test_dry_has_no_power_and_carries_the_load():
    solution = jb.solve(dry_roller())
    assert solution.power_loss.total is solution.drive_power is None  # nothing is modelled: that is no loss of 0
    assert "rolling_resistance" in solution.not_modelled
    elements = solution.elements
    carried = jnp.sum(elements.load_inner * jnp.cos(elements.azimuth))
    np.testing.assert_allclose(carried, 25e3, rtol=1e-12)
    across = jnp.sum(elements.load_inner * jnp.sin(elements.azimuth))
    np.testing.assert_allclose(across, 0.0, atol=1e-9)


@jax.jit
@functools.partial(jax.grad, argnums=(0, 1))
def slopes_of_the_dry_ring(speed, load):
    return jb.solve(dry_roller().at_operation(inner_speed=speed, radial_load=load)).ring.radial


def test_dry_at_rest():
    solution = jb.solve(dry_roller().at_operation(inner_speed=0.0))
    np.testing.assert_allclose(solution.elements.load_inner, solution.elements.load_outer, rtol=1e-14)
    assert np.isfinite(slopes_of_the_dry_ring(0.0, 25e3)[0])


def test_mirror_symmetry():
    """The load is on a symmetry line of an even row: loads, but not speeds' partners, mirror exactly."""
    load = np.asarray(jb.solve(turbine_roller()).elements.load_inner)
    np.testing.assert_allclose(load[1:], load[1:][::-1], rtol=1e-12)


def test_lateral_freedom_is_not_used_by_a_symmetric_bearing():
    """An active lateral degree of freedom stays at 0 and changes nothing."""
    one = jb.solve(dry_roller())
    two = jb.solve(dry_roller().replace({"ring_freedom": ("radial", "lateral")}))
    np.testing.assert_allclose(two.ring.radial, one.ring.radial, rtol=1e-12)
    np.testing.assert_allclose(two.ring.lateral, 0.0, atol=1e-18)
    assert two.unknowns == one.unknowns + 1
    np.testing.assert_allclose(two.stiffness[1, 1], one.stiffness[1, 1], rtol=1e-9)


def test_stiffness_is_the_derivative_of_the_load():
    scene = dry_roller()
    flexibility = slopes_of_the_dry_ring(float(scene.operation.inner_speed), 25e3)[1]
    np.testing.assert_allclose(jb.solve(scene).stiffness[1, 1], 1.0 / flexibility, rtol=1e-7)


@pytest.mark.slow
def test_stiffness_is_the_derivative_of_the_load_with_films():
    ring = lambda load: jb.solve(reference_roller().at_operation(radial_load=load)).ring.radial
    flexibility = jax.grad(ring)(25e3)
    np.testing.assert_allclose(jb.solve(reference_roller()).stiffness[1, 1], 1.0 / flexibility, rtol=1e-7)


def test_film_without_traction_rolls_without_slip():
    scene = turbine_roller().replace({"contact.traction": None})
    solution = jb.solve(scene)
    assert solution.unknowns == 31
    assert solution.cage is None
    assert solution.power_loss.total is solution.drive_power is None
    assert "rolling_resistance" in solution.not_modelled
    np.testing.assert_allclose(solution.elements.sliding_inner, 0.0, atol=1e-12)
    assert any("no effect" in text for text in solution.warnings)
    # swollen by films of about a micrometre, the ring sits less deep than dry
    assert solution.ring.radial < jb.solve(dry_roller().replace({"materials": scene.materials})).ring.radial


def test_leaving_parts_out_costs_nothing():
    """Equations fall without each part; unknowns fall without the cage."""

    def equations(scene):
        system = eqx.filter_eval_shape(build_system, scene)
        unknowns = eqx.filter_eval_shape(lambda system: system.initial(), system)
        jaxpr, _, _ = eqx.filter_make_jaxpr(evaluate)(system, unknowns)
        return len(jaxpr.eqns), sum(leaf.size for leaf in jax.tree.leaves(unknowns))

    full = turbine_roller()
    count, unknowns = equations(full)
    assert unknowns == 62
    assert equations(dry_roller())[1] == 1
    smaller = {
        "flange": {"flange": None},
        "drag": {"drag": None},
        "rails": {"cage.pocket_axial_clearance": None},
        "thermal": {"contact.thermal": NoThermalReduction()},
        "traction": {"contact.traction": None},
        "film": {"contact": None},
        "cage": {"contact.traction": None, "cage": None, "flange": None, "drag": None},
    }
    for name, change in smaller.items():
        fewer, left = equations(full.replace(change))
        assert fewer < count, name
        assert left == (62 if name in ("flange", "drag", "rails", "thermal") else 1 if name == "film" else 31), name


def test_lubricated_without_cage_is_refused():
    with pytest.raises(ValueError, match="simulate"):
        turbine_roller().replace({"cage": None})

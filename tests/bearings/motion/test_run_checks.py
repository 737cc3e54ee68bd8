"""Range checks of transient runs: whatever a steady solve would warn of at one of the instants, and nothing else."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import history_of

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.kinematics import roller_kinematics
from jaxbearing.bearings.cylindrical.motion.checks import run_excess
from jaxbearing.bearings.motion.checks import AT_SOME_TIME, largest

SCENE = jb.load_scene("turbine_roller_dynamic")
excess = eqx.filter_jit(run_excess)
TIME, ROLLER = 3, 5


@pytest.fixture
def calm():
    """Instants of rollers that roll, loaded alike."""
    made = history_of(SCENE).instants
    shape = np.shape(made.elements.load_inner)
    motion, full = roller_kinematics(SCENE.geometry, SCENE.operation), lambda value: jnp.full(shape, value)
    values = {
        "load_inner": full(1000.0),
        "load_outer": full(1500.0),
        "pressure_inner": full(1.1e9),
        "pressure_outer": full(1.2e9),
        "orbital_speed": full(motion.free_orbit),
        "spin_speed": full(motion.free_spin),
        "temperature_rise_inner": full(5.0),
        "temperature_rise_outer": full(5.0),
    }
    speed = jnp.full(shape[0], jnp.asarray(SCENE.operation.inner_speed))
    return eqx.tree_at(
        lambda i: (*(getattr(i.elements, name) for name in values), i.cage.eccentricity_ratio, i.inner_speed),
        made,
        (*values.values(), jnp.full(shape[0], 0.5), speed),
    )


def said(instants):
    found = {text: float(value) for text, value in excess(SCENE, instants).items()}
    assert all(text.startswith(AT_SOME_TIME) and not np.isnan(value) for text, value in found.items())
    return [text.removeprefix(AT_SOME_TIME) for text, value in found.items() if value > 0]


def changed(instants, field, value):
    """One roller at one time."""
    return eqx.tree_at(
        lambda i: getattr(i.elements, field), instants, getattr(instants.elements, field).at[TIME, ROLLER].set(value)
    )


def test_nothing_is_said_of_a_calm_run(calm):
    assert said(calm) == []


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("pressure_inner", 4.1e9, "4 GPa on the inner raceway"),
        ("pressure_outer", 4.1e9, "4 GPa on the outer raceway"),
        ("spin_speed", 1.0, "skid on the inner raceway"),
        ("orbital_speed", 1.0, "skid on the outer raceway"),
        ("temperature_rise_inner", 200.0, "oil in the contacts of the inner raceway beyond 200 degC"),
        ("pressure_inner", 2.5e9, "mean contact pressure beyond 1.8 GPa on the inner raceway"),
    ],
)
def test_one_contact_at_one_time_is_enough(calm, field, value, words):
    found = said(changed(calm, field, value))
    assert any(words in text for text in found), found


def test_contacts_without_load_do_not_count(calm):
    one = changed(changed(calm, "spin_speed", 1.0), "load_inner", 0.0)
    found = said(changed(one, "load_outer", 0.0))
    assert found == []


def test_a_cage_that_touches_once_is_warned_of(calm):
    touching = eqx.tree_at(lambda i: i.cage.eccentricity_ratio, calm, calm.cage.eccentricity_ratio.at[TIME].set(0.99))
    assert [text for text in said(touching) if "cage eccentricity beyond 0.98" in text]


def test_rings_that_change_their_speed_are_not_taken_for_skidding(calm):
    """Rolling goes by the speed of the ring at that time."""
    slower = dataclasses.replace(SCENE.operation, inner_speed=0.5 * SCENE.operation.inner_speed)
    motion = roller_kinematics(SCENE.geometry, slower)
    run = eqx.tree_at(
        lambda i: (i.inner_speed, i.elements.orbital_speed, i.elements.spin_speed),
        calm,
        (
            calm.inner_speed.at[TIME].set(slower.inner_speed),
            calm.elements.orbital_speed.at[TIME].set(motion.free_orbit),
            calm.elements.spin_speed.at[TIME].set(motion.free_spin),
        ),
    )
    assert said(run) == []


def test_pieces_of_a_run_are_one_run(calm):
    pieces = [excess(SCENE, calm), excess(SCENE, changed(calm, "pressure_inner", 4.1e9))]
    whole = largest(pieces)
    assert whole.keys() == pieces[0].keys()
    assert all(float(whole[text]) == max(float(piece[text]) for piece in pieces) for text in whole)


def test_an_instant_at_which_a_run_breaks_off_silences_nothing(calm):
    """Its last state may not be finite."""
    broken = jax.tree.map(lambda leaf: jnp.full_like(leaf, jnp.nan), excess(SCENE, calm))
    whole = largest([excess(SCENE, changed(calm, "pressure_inner", 4.1e9)), broken])
    assert any("4 GPa on the inner raceway" in text for text, value in whole.items() if value > 0)
    names = ("load_inner", "load_outer", "pressure_inner", "pressure_outer", "orbital_speed", "spin_speed")
    last = lambda i: tuple(getattr(i.elements, name) for name in names)
    hot = changed(calm, "pressure_outer", 4.1e9)
    ends = eqx.tree_at(last, hot, tuple(leaf.at[-1].set(jnp.nan) for leaf in last(hot)))
    assert any("4 GPa on the outer raceway" in text for text in said(ends))

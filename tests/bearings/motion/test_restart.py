"""A state of a run belongs to one bearing or contact: every number and every part that describes it is compared, by
name; what may change is what MAY_CHANGE names."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing._identity import ALIKE, differences, identity_from, identity_of
from jaxbearing.bearings.motion.history import LastState
from jaxbearing.bearings.motion.run import MAY_CHANGE, identity
from jaxbearing.bearings.parts import azimuths
from jaxbearing.ehl import FilmState
from jaxbearing.ehl import last_state as film

BEARING = jb.load_scene("turbine_roller_dynamic")
CONTACT = jb.load_scene("satellite_contact_1")


def state_of_bearing(scene=BEARING):
    """At rest on the pitch circle."""
    count = scene.geometry.n_rollers
    zero, azimuth = np.asarray(0.0), np.asarray(azimuths(scene.geometry, count))
    numbers = (zero, np.zeros((3, count)), np.zeros(6), zero, zero, zero, azimuth)
    return LastState(*numbers, has_cage=scene.cage is not None, identity=identity(scene))


def state_of_contact(scene=CONTACT):
    """Only its identity is like this scene's."""
    nodes, one = scene.contact.nodes, np.asarray(1.0)
    values = (np.zeros(nodes), one, np.zeros((3, nodes)), np.zeros(3), np.zeros((3, nodes)), np.ones(2))
    return FilmState(*values, np.asarray(1), one, identity_of(scene, film.MAY_CHANGE))


def refused(scene, state, duration=1e-3):
    with pytest.raises(ValueError, match="restart: ") as error:
        scene.check_restart(state, duration)
    return str(error.value)


NUMBERS = [(BEARING, path) for path in identity(BEARING).numbers]
NUMBERS += [(CONTACT, path) for path in identity_of(CONTACT, film.MAY_CHANGE).numbers if path != "contact.nodes"]


@pytest.mark.parametrize(("scene", "path"), NUMBERS, ids=[f"{type(scene).__name__}-{path}" for scene, path in NUMBERS])
def test_every_number_counts(scene, path):
    """A millionth more of it is another bearing; the least that a change of units makes of it is not."""
    state = state_of_bearing() if scene is BEARING else state_of_contact()
    value = float(np.asarray(state.identity.numbers[path]))
    number = lambda factor: (
        state.identity.numbers | {path: np.asarray(value * factor + (value == 0.0) * (factor - 1.0))}
    )
    other = dataclasses.replace(state.identity, numbers=number(1.0 + 1e-6))
    message = refused(scene, dataclasses.replace(state, identity=other))
    assert f"{path} is " in message
    assert f" there and {value:.10g} here" in message
    if value:
        alike = dataclasses.replace(state.identity, numbers=number(1.0 + 0.1 * ALIKE))
        assert differences(alike, state.identity) == []


CHANGES = {
    "geometry.roller_diameter": 12.1e-3,
    "geometry.diametral_clearance": 10e-6,
    "geometry.contact_length": 9e-3,
    "cage.pocket_clearance": 290e-6,
    "cage.guidance": "outer_ring",
    "flange": None,
    "materials.rollers": dataclasses.replace(BEARING.materials.rollers, density=3200.0),
}


@pytest.mark.parametrize("path", CHANGES)
def test_parts_and_settings_count(path):
    assert f"{path}" in refused(BEARING.replace({path: CHANGES[path]}), state_of_bearing())


def test_what_may_change():
    """Another operating point, oil, friction laws, drag, simulation."""
    changes = {"operation.inner_speed": 900.0, "operation.oil_temperature": 350.0, "drag.coefficient": 0.9}
    changes |= {"oil.viscosity": CONTACT.oil.viscosity, "contact": jb.load_scene("turbine_roller").contact}
    BEARING.replace(changes | {"simulation": jb.Simulation()}).check_restart(state_of_bearing())
    BEARING.replace({"drag": None}).check_restart(state_of_bearing())
    assert set(MAY_CHANGE) <= {field.name for field in dataclasses.fields(BEARING)}


def test_several_differences_are_named():
    scene = BEARING.replace({"geometry.roller_length": 13e-3, "geometry.contact_length": 9e-3, "cage.land_width": 2e-3})
    scene = scene.replace({"cage.guiding_clearance": 100e-6, "cage.pocket_clearance": 100e-6})
    message = refused(scene, state_of_bearing())
    assert message.startswith("restart: a state of another bearing: geometry.roller_length is ")
    assert message.endswith(", and 2 more (in SI units)")


def test_of_a_lane():
    """In a batch the numbers may be traced."""
    many = jax.vmap(lambda c: jax.tree.map(jnp.asarray, identity(BEARING.replace_geometry(diametral_clearance=c))))
    found = many(jnp.asarray([1e-5, 3e-5]))
    one = jax.tree.map(lambda leaf: np.asarray(leaf)[0], found)
    assert differences(one, identity(BEARING.replace_geometry(diametral_clearance=1e-5))) == []


def test_there_and_back():
    told = identity(BEARING).told()
    assert identity_from(told).told() == told
    with pytest.raises(ValueError, match=r"could not convert|inhomogeneous|setting an array"):
        identity_from({"geometry": [1, [2, 3]]})


def test_a_bearing_whose_first_element_is_elsewhere():
    """Its own state goes on; that of the bearing turned does not."""
    turned = BEARING.replace({"geometry.first_element_angle": 0.1})
    turned.check_restart(state_of_bearing(turned), 1e-3)
    assert "first_element_angle" in refused(turned, state_of_bearing(turned.replace_geometry(first_element_angle=0.2)))

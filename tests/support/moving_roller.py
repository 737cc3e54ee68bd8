"""The moving roller bearing of the check values, and compiled functions of it that tests share."""

import equinox as eqx
import jax
import jax.numpy as jnp
from roller_cases import RPM, reference_roller

from jaxbearing.bearings.cylindrical.motion.start import build_dynamics
from jaxbearing.bearings.motion.settings import Simulation
from jaxbearing.bearings.motion.start import quasi_static_start

ZERO = jnp.zeros(())


def table_16(drag=1.2):
    """The bearing of Table 16 with the reference laws."""
    return reference_roller().replace(
        {"cage.guiding_clearance": 240e-6, "operation.inner_speed": 14000 * RPM, "drag.coefficient": drag}
    )


@eqx.filter_jit
def built(scene, simulation):
    return build_dynamics(scene, simulation)


@eqx.filter_jit
def started(scene, simulation):
    return quasi_static_start(scene, simulation)


@eqx.filter_jit
def all_at(dynamics, time, state):
    """Forces and rates."""
    return dynamics.at(time, state), dynamics.rates(time, state)


def shaken(dynamics, state, size=0.3, seed=0):
    """A state away from any balance."""
    keys = jax.random.split(jax.random.PRNGKey(seed))
    shake = lambda key, values: values + size * jax.random.normal(key, values.shape, dtype=values.dtype)
    return state._replace(elements=shake(keys[0], state.elements), globals=shake(keys[1], state.globals))


def start_of(drag=1.2, simulation=None):
    return started(table_16(drag), Simulation() if simulation is None else simulation)


def rolling(drag=1.2, simulation=None):
    """Equations of motion, and rollers that roll without slip round a centred cage; compiles faster than a start."""
    dynamics = built(table_16(drag), Simulation() if simulation is None else simulation)
    motion = dynamics.system.kinematics
    still = jnp.zeros(30)
    spin = jnp.full(30, motion.roller_radius * motion.free_spin)
    return dynamics, dynamics.scaled(jnp.stack([still, still, spin]), jnp.asarray([20e-6, -60e-6, 0.0, 0.0, 0.0, 0.0]))

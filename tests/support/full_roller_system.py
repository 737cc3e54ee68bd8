"""The steady roller bearing with nothing eliminated: 3N + 4 equations, as a user of a general root finder writes them.

Unknowns: ln(Qi), spin and pocket net load of every roller; ring displacement, cage speed and the two offsets of the
cage. The pocket balance and the land balance, which the library eliminates in closed form and by a scalar root, are
equations here, and the land force is that of the moving film in two dimensions, not the inverse of the static one.
"""

import jax
import jax.numpy as jnp
import numpy as np

from jaxbearing.bearings.cylindrical.equations import LENGTH_UNIT, LubricatedRollerSystem
from jaxbearing.gaps.journal import OFFSET_SHIFT
from jaxbearing.numerics.arrow import ArrowPoint


def split(system: LubricatedRollerSystem, y):
    n = system.azimuth.shape[0]
    return y[:n], y[n : 2 * n], y[2 * n : 3 * n], y[3 * n], y[3 * n + 1], y[3 * n + 2 :]


def full_residual(system: LubricatedRollerSystem, y):
    """Scaled residual of all 3N + 4 equations, forces over `friction_scale`, lengths over 10 um."""
    cage, motion = system.cage, system.kinematics
    log_load, spin_offset, net_load, ring, orbit_offset, offset = split(system, y)
    scale = system.friction_scale()
    orbit = motion.free_orbit + motion.orbit_unit * orbit_offset
    spin = motion.free_spin + motion.spin_unit * spin_offset
    orbits = jnp.broadcast_to(orbit, spin.shape)

    inner_load = jnp.exp(log_load)
    load = jnp.stack([inner_load, inner_load + system.centrifugal(orbits)])
    mean_speed, sliding = motion.surface_speeds(orbits - motion.free_orbit, spin - motion.free_spin)
    contact = system.laws.evaluate(system.contact, load, mean_speed, sliding, system.oil, system.inlet)
    inner, outer = contact.traction
    approach = system.contact.palmgren_approach(load)
    gap = system.radial_clearance + jnp.sum(approach - contact.film, axis=0)
    approach_error = (gap - ring * LENGTH_UNIT * jnp.cos(system.azimuth)) / LENGTH_UNIT

    flange = cage.inner_flange.evaluate(-spin, motion.inner_speed - orbits)
    rails = cage.rails.evaluate(-spin)
    drag = cage.drag.force(motion.pitch_radius * orbits, cage.drag_density)
    pocket = cage.pocket.balance(net_load * scale, spin, system.inlet.viscosity)
    front, rear = pocket.load_front, pocket.load_rear
    friction = pocket.friction_front + pocket.friction_rear
    moment = motion.roller_radius * (friction - inner - outer) + flange.moment + rails.moment
    tangential = rear - front - drag + inner - outer + flange.tangential_force + rails.tangential_force

    cosine, sine = jnp.cos(system.azimuth), jnp.sin(system.azimuth)
    backward = rear - front + rails.tangential_force
    difference = pocket.friction_rear - pocket.friction_front
    force_x = jnp.sum(backward * cosine + difference * sine)
    force_y = jnp.sum(backward * sine - difference * cosine)
    moments = -backward * motion.pitch_radius - friction * motion.roller_radius - rails.moment

    land, viscosity, zero = cage.land, system.inlet.viscosity, jnp.zeros(())
    journal, bush = motion.inner_speed, orbit
    k_z, c_f = land.film_factors(system.inlet.density, viscosity, journal - bush)
    ex, ey = offset * land.clearance
    on_journal = land.force_on_journal(ex, ey, zero, zero, journal, bush, viscosity, k_z)
    length = jnp.sqrt(ex**2 + ey**2)
    around = (on_journal[1] * ex - on_journal[0] * ey) / length
    _, on_bush = land.torques(length / land.clearance, around, journal, bush, viscosity, c_f)

    n = system.azimuth.shape[0]
    return jnp.concatenate(
        [
            approach_error,
            moment / (scale * motion.roller_radius),
            tangential / scale,
            jnp.stack(
                [
                    jnp.sum(inner_load * cosine) / system.load_scale() - 1.0,
                    (jnp.sum(moments) + land.n_lands * on_bush) / (scale * motion.pitch_radius * n),
                    (force_x - land.n_lands * on_journal[0]) / scale,
                    (force_y - land.n_lands * on_journal[1]) / scale,
                ]
            ),
        ]
    )


def extend(system: LubricatedRollerSystem, point: ArrowPoint):
    """The full unknowns that belong to reduced ones: pocket loads and cage offset in equilibrium with them."""
    state = system.at(point)
    land = system.land_at(point, state)
    force = jnp.sum(state.cage_force, axis=1)
    net = (state.pocket.load_front - state.pocket.load_rear) / system.friction_scale()
    # the film force on the journal balances the load on the cage; the line of centres leads it by the attitude angle
    load_angle = jnp.arctan2(-force[1], -force[0])
    angle = load_angle + land.attitude_angle
    offset = land.eccentricity_ratio * jnp.stack([jnp.cos(angle), jnp.sin(angle)])
    offset = offset - jnp.asarray([OFFSET_SHIFT, 0.0])  # the moving film shifts the journal by this much
    # the library's unknown is the change of the speed at the outer race, at this cage speed
    spin = point.elements[1] - point.globals[-1]
    return jnp.concatenate([point.elements[0], spin, net, point.globals, offset])


def scipy_functions(system: LubricatedRollerSystem):
    """Jitted residual and exact dense Jacobian (forward autodiff), for `scipy.optimize.root`."""
    residual = jax.jit(lambda y: full_residual(system, y))
    jacobian = jax.jit(jax.jacfwd(lambda y: full_residual(system, y)))
    return (lambda y: np.asarray(residual(y))), (lambda y: np.asarray(jacobian(y)))

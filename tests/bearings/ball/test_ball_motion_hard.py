"""Hard cases of moving balls with a closed traction law: each ends, and balances its energy."""

import dataclasses

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from moving_balls import LEVER, PITCH, dynamics, moving_cage

from jaxbearing.bearings.ball.motion import energy
from jaxbearing.bearings.ball.motion.bodies import MovingRing, TurningBody
from jaxbearing.bearings.motion.run import FIELD
from jaxbearing.numerics.integrate import integrate_segment
from jaxbearing.numerics.integrator import IntegratorOptions
from jaxbearing.numerics.status import Status
from jaxbearing.time_laws import Ramp, RotatingLoad

RPM = np.pi / 30.0
FULL = (6.40406772e-05, 586.971646, 4355.18646, 2181.90913, -36.2951835, 4001.15667, 0.485958274)
"""Steady state at 40 kN and 12 500 rpm: displacement, orbit, spins, load and angle on the outer race."""


def bearing(
    loads=(40e3, 0.0, 0.0), load=(1.0, 1.0), speed=(1.0, 1.0), time=1e-5, turning=0.0, clearance=300e-6, imbalance=0.0
):
    """All balls of Table 15 with cage and a ring that moves in all degrees of freedom; `load` and `speed`: first and
    last factor of a ramp that lasts `time`."""
    cage = eqx.tree_at(
        lambda c: (c.pocket.clearance, c.imbalance), moving_cage(), (jnp.asarray(clearance), jnp.asarray(imbalance))
    )
    body = TurningBody(jnp.asarray(5.0), jnp.asarray(0.015), jnp.asarray(0.02))
    load_of_ring = jnp.asarray([*loads, 0.0, 0.0])
    ring = MovingRing(body, load_of_ring, jnp.zeros(5), jnp.asarray(1e4), jnp.asarray(LEVER), (True,) * 5)
    ramp = lambda ends: Ramp(*map(jnp.asarray, (ends[0], ends[1], time)))
    rotating = RotatingLoad(jnp.asarray(turning), jnp.asarray(12500 * RPM))
    of = dynamics(FULL[1], cage=cage, ring=ring, load=ramp(load), rotating_load=rotating)
    return dataclasses.replace(of, speed=ramp(speed))


def begun(of, share=1.0, tilt=0.0, radius=0.5 * 20.638e-3):
    """The steady state of 40 kN, at a share of its speeds."""
    displacement, orbit, *spins, outer, angle = FULL
    grooves = of.levers.grooves
    arm = grooves.offset[1] + (outer / grooves.stiffness[1]) ** (2.0 / 3.0)
    x, r = arm * np.cos(0.5 * np.pi - angle) - of.free_offset, arm * np.cos(angle) - of.free_radius
    v = (share - float(of.speed.factor(jnp.zeros(())))) * PITCH * orbit
    one = jnp.stack([jnp.zeros(()), jnp.asarray(v), *(share * radius * jnp.asarray(spins)), x, r, *jnp.zeros(2)])
    shared = jnp.zeros(22).at[12].set(displacement).at[0].set(x).at[3].set(tilt * PITCH).at[11].set(v)
    return of.scaled(jnp.tile(one[:, None], (1, 20)), shared)


@eqx.filter_jit
def run(of, state, end):
    options = IntegratorOptions(tolerance=1e-5)
    found = integrate_segment(
        FIELD, state, jnp.zeros(()), end[None], of, options, jnp.asarray(1e-7), idle=len(energy.WORKS)
    )
    ends = [(time, of.at(time, each)) for time, each in ((jnp.zeros(()), state), (found.last_time, found.last))]
    stored = [energy.kinetic_energy(of, now) for _, now in ends]
    return found, stored, of.unscaled(found.last)[2], ends[1][1]


CASES = {
    "combined load": (bearing((20e3, 8e3, 1e3)), 2e-3, 1.0, 0.0),
    "no axial load": (bearing((0.0, 0.0, 0.0)), 2e-3, 1.0, 0.0),
    "load step of 20 kN in 10 us": (bearing((40e3, 0.0, 0.0), load=(0.5, 1.0)), 1e-3, 1.0, 0.0),
    "balls leave the inner race": (bearing((2e3, 8e3, 0.0)), 2e-3, 1.0, 0.0),
    "turning load": (bearing((20e3, 0.0, 0.0), turning=5e3), 2e-3, 1.0, 0.0),
    "imbalance of the cage": (bearing(imbalance=1e-4), 2e-3, 1.0, 0.0),
    "narrow pockets": (bearing((20e3, 5e3, 0.0), clearance=50e-6), 2e-3, 1.0, 0.0),
    "tilted cage": (bearing(), 2e-3, 1.0, 1e-3),
    "5 kN at 20 000 rpm": (bearing((5e3, 0.0, 0.0), speed=(1.6, 1.6)), 2e-3, 1.6, 0.0),
    "10 N at 20 000 rpm": (bearing((10.0, 0.0, 0.0), speed=(1.6, 1.6)), 2e-3, 1.6, 0.0),
    "stop and reversal": (bearing(speed=(1.0, -0.5), time=3e-3), 4e-3, 1.0, 0.0),
    "start from 1 % of the speed": (bearing(speed=(0.01, 1.0), time=4e-3), 5e-3, 0.01, 0.0),
}


@pytest.mark.parametrize("name", CASES)
def test_hard_case(name):
    of, end, share, tilt = CASES[name]
    found, (begin, last), works, _ = run(of, begun(of, share, tilt), jnp.asarray(end))
    assert int(found.status) == Status.CONVERGED
    work = dict(zip(energy.WORKS, map(float, works), strict=True))
    spent = work["dissipation"] + work["damping"] + work["pocket_films"] + work["raceways"]
    left = work["drive"] + work["load"] - spent - float(last - begin)
    # 1e-5 of the work of the shaft, or of the energy that moves where the shaft takes as much back as it gives
    size = max(abs(work["drive"]), work["dissipation"])
    print(f"{name}: {int(found.accepted)}+{int(found.rejected)} steps, {size:.4g} J, open {left / size:.1e}")
    assert abs(left) < 1e-5 * size

r"""Rolling resistance of balls that roll without sliding: what the frictionless model leaves to constraint forces.

Without a traction law the motion of a ball is that of race control: no sliding along rolling on either race, no spin on
the controlling one. The forces that keep it so, $F_{ti} = -F_{to}$ along the orbit and the moment $M_s$ about the
normal of the controlling race, do no work; they follow from the balance of the ball against its rolling resistances
$M_{ri}, M_{ro}$ (`friction`: moments about the axis and about the radius, force along the tangent). With
$c = \cos(\alpha_o - \alpha_i)$, $s = \sin(\alpha_o - \alpha_i)$:

- outer control: $F_{ti} = \frac2D\frac{M_{ro} + cM_{ri}}{1 + c}$, $M_{so} = \frac{s}{1 + c}(M_{ro} - M_{ri})$;
- inner control: $F_{ti} = \frac2D\frac{M_{ri} + cM_{ro}}{1 + c}$, $M_{si} = \frac{s}{1 + c}(M_{ri} - M_{ro})$.

The torques of the rings are assembled from them and from the resistances, so that the drive power is the power of the
resistances alone. Balls with one orbital speed for all (`kinematics.orbit` "common") slide a little on frictionless
races, and no balance of a single ball says what holds it: there the torques are those of ideal constraints,
$T_i = \sum M_r\,\partial\omega_r/\partial\omega_i$ and $T_o$ alike (virtual work; the rates of roll are linear in the
speeds of the rings).

**Validity:** as the law of the resistance, which moves nothing: loads, angles and speeds are those without it.
**Reference:** own derivation.
"""

import dataclasses
from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .equations import AbstractBallEquations
from .state import BallsState


class RollingBalance(NamedTuple):
    """Constraint forces F_t along the orbit, N, and moments M_s about the normals, N m, of each ball, races first."""

    forward: Float[Array, "2 ball"]
    about: Float[Array, "2 ball"]


def rolling_resistance(system: AbstractBallEquations, state: BallsState) -> Float[Array, "contact ball"] | None:
    """Moments M_r against the roll, N m, of the sign that `friction` gives them; `None` where the scene models none."""
    turn = system.arcs.senses * state.races.roll
    contact = state.contact
    if system.arcs.single:
        cosines = jnp.cos(state.angle)
        contact = system.geometry.contacts(cosines[0], cosines[1], system.reduced_modulus)
    return system.laws.rolling_moment(contact, state.load, state.film, state.races.mean_speed, turn, system.inlet)


def rolling_balance(
    system: AbstractBallEquations, state: BallsState, resistance: Float[Array, "2 ball"]
) -> RollingBalance:
    """See the module; of balls with two contacts."""
    inner, outer = resistance
    turned = state.angle[1] - state.angle[0]
    cosine, sine = jnp.cos(turned), jnp.sin(turned)
    arm, zero = 2.0 / system.kinematics.ball_diameter, jnp.zeros_like(inner)
    if system.attitude == "outer":
        push = arm * (outer + cosine * inner) / (1.0 + cosine)
        about = jnp.stack([zero, sine * (outer - inner) / (1.0 + cosine)])
    else:
        push = arm * (inner + cosine * outer) / (1.0 + cosine)
        about = jnp.stack([sine * (inner - outer) / (1.0 + cosine), zero])
    return RollingBalance(jnp.stack([push, -push]), about)


def constraint_torques(
    system: AbstractBallEquations, state: BallsState, resistance: Float[Array, "contact ball"]
) -> tuple[Float[Array, ""], Float[Array, ""]]:
    """Torques on the rings, N m, of balls whose motion is a linear function of the speeds of the rings; see the module.
    **Arguments:** `resistance`: of each contact, N m."""

    def power(inner_speed: Array, outer_speed: Array) -> Array:
        """Power of the given resistances, W, as the rings turn."""
        motion = dataclasses.replace(system.kinematics, inner_speed=inner_speed, outer_speed=outer_speed)
        turning = dataclasses.replace(system, kinematics=motion)
        rolls = turning.races_of(turning.constrained(state), state.angle).roll
        return system.multiplicity * jnp.sum(system.arcs.senses * resistance * rolls)

    inner, outer = jax.grad(power, argnums=(0, 1))(system.kinematics.inner_speed, system.kinematics.outer_speed)
    return inner, outer

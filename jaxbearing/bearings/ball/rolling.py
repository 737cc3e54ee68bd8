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

from .core import orbit_totals
from .equations import LubricatedBallSystem
from .state import BallsState


class RollingBalance(NamedTuple):
    """Resistances of each ball, races first: M_r against the roll, N m, of the sign that `friction` gives
    them, and the constraint forces F_t along the orbit, N, and moments M_s about the normals, N m."""

    resistance: Float[Array, "2 ball"]
    forward: Float[Array, "2 ball"]
    about: Float[Array, "2 ball"]


def rolling_balance(system: LubricatedBallSystem, state: BallsState) -> RollingBalance | None:
    """See the module; `None` where the scene models no rolling resistance."""
    side = jnp.asarray([[1.0], [-1.0]])
    cosines = jnp.cos(state.angle)
    contact = system.geometry.contacts(cosines[0], cosines[1], system.reduced_modulus)
    resistance = system.laws.rolling_moment(
        contact, state.load, state.film, state.races.mean_speed, side * state.races.roll, system.inlet
    )
    if resistance is None:
        return None
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
    return RollingBalance(resistance, jnp.stack([push, -push]), about)


def common_orbit_torques(
    system: LubricatedBallSystem, state: BallsState, resistance: Float[Array, "2 ball"]
) -> tuple[Float[Array, ""], Float[Array, ""]]:
    """Torques on the rings where all balls orbit at one speed, N m; see the module. **Arguments:** `resistance`: of
    each ball, N m."""
    inner_angle, outer_angle = state.angle

    def power(inner_speed: Array, outer_speed: Array) -> Array:
        """Power of the given resistances, W, as the rings turn."""
        motion = dataclasses.replace(system.kinematics, inner_speed=inner_speed, outer_speed=outer_speed)
        rolling = motion.rolling(inner_angle, outer_angle, state.motion.attitude)
        own = rolling.orbital_speed
        less, weight = jnp.sum(orbit_totals(state.load[0], own, jnp.zeros_like(own)), axis=1)
        together = rolling._replace(orbital_speed=jnp.full_like(own, -less / weight))
        rolls = motion.inner_race(together, inner_angle).roll, motion.outer_race(together, outer_angle).roll
        return system.multiplicity * jnp.sum(resistance[0] * rolls[0] - resistance[1] * rolls[1])

    inner, outer = jax.grad(power, argnums=(0, 1))(system.kinematics.inner_speed, system.kinematics.outer_speed)
    return inner, outer

"""Laws for the contact friction that carries the gyroscopic couple of a ball."""

import abc
from typing import ClassVar

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._types import Scalar, Values
from ...numerics.checks import Checked, bounded, demand, numbers_or_none
from ...numerics.precision import as_float

NO_LOAD = 1e-9
"""Load added to the sum of the inner and outer loads, N, to avoid a division by 0 for unloaded balls."""


USUAL_FRICTION = 0.05
"""Coefficient of friction of a lubricated contact that slides."""


class AbstractGyroscopic(Checked):
    r"""Friction forces $T_i, T_o$ on the ball that balance the couple $M_g = J\omega_R\omega_m\sin\beta$.

    By Euler's equation the contacts must exert the couple $+M_ge_t$ on the ball. Each contact carries the part
    $-(D/2)F_kb_k\times n_k$ of it, with $F_k = -T_k$ and $T_i + T_o = 2M_g/D$. This is `sign` +1. `sign` -1 is the sign
    printed by Harris and in the source's eqs. (14)-(15), for comparison with the literature.
    """

    part: ClassVar[str] = "kinematics"
    sign: eqx.AbstractVar[Scalar]

    def __check_init__(self):
        super().__check_init__()
        if numbers_or_none(self.sign) is not None:
            demand(
                "kinematics.gyroscopic.sign must be 1 or -1",
                abs(self.sign) == 1.0,
                lambda: f"kinematics.gyroscopic_sign must be 1 or -1, got {float(self.sign):g}",
            )

    @abc.abstractmethod
    def friction(
        self, couple: Values, diameter: Values, inner_load: Values, outer_load: Values
    ) -> tuple[Float[Array, "..."], Float[Array, "..."]]:
        """$T_i, T_o$, N.

        **Arguments:** `couple`: $M_g$, N m; `diameter`: D, m; `inner_load`, `outer_load`: contact loads, N, >= 0."""


class SharedCouple(AbstractGyroscopic):
    r"""Given shares of the couple, $T_k = \lambda_kM_g/D$: $(\lambda_i, \lambda_o)$ = (0, 2) under outer race control,
    (1, 1) otherwise (source eqs. (14)-(15)).

    **Limits:** an unloaded inner contact has friction too, so at light load and high speed no equilibrium exists.

    **Arguments:**
    - `inner_share`, `outer_share`: share of the couple that the race carries, in units of half the couple; together 2.
    - `sign`: sign of the friction forces, 1 or -1.
    """

    inner_share: Scalar = bounded("between 0 and 2", unit="1", converter=as_float, default=1.0)
    outer_share: Scalar = bounded("between 0 and 2", unit="1", converter=as_float, default=1.0)
    sign: Scalar = eqx.field(converter=as_float, default=1.0)

    def friction(self, couple, diameter, inner_load, outer_load):
        return self.inner_share * couple / diameter, self.outer_share * couple / diameter


class CappedCouple(AbstractGyroscopic):
    r"""Shares in proportion to the loads, limited by friction: $T_k = \mu Q_k\tanh[2M_g/(D\mu(Q_i + Q_o))]$.

    **Limits:** a small couple is carried fully; for a large one the forces are $\mu Q_k$ and the rest is not carried.
    The ball would then start to turn about $e_t$, which this law leaves out.

    **Arguments:**
    - `friction_coefficient`: coefficient of friction mu that caps what a race carries (a force of mu Q_k), > 0.
    - `sign`: sign of the friction forces, 1 or -1.
    """

    friction_coefficient: Scalar = bounded(
        "> 0", unit="1", name="gyroscopic_friction", converter=as_float, default=USUAL_FRICTION
    )
    sign: Scalar = eqx.field(converter=as_float, default=1.0)

    def friction(self, couple, diameter, inner_load, outer_load):
        limit = self.friction_coefficient * (inner_load + outer_load + NO_LOAD)
        taken = self.friction_coefficient * jnp.tanh(2.0 * couple / (diameter * limit))
        return taken * inner_load, taken * outer_load


class ResolvedCouple(eqx.Module):
    """Gyroscopic couple carried by the transverse traction of the contacts: the ball also turns about the tangent of
    the orbit and slides across the rolling direction."""

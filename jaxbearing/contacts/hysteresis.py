"""Rolling resistance by elastic hysteresis: the bodies give back less elastic energy than they have taken up."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.safe import smooth_sign
from .line import SPEED_FLOOR, LineContact
from .point import PointContact


def line_hysteresis(contact: LineContact, load: Values, mean_speed: Values, loss: Values) -> Float[Array, "..."]:
    r"""Rolling force $P = M/R$ of a line contact, N, with the sign of the mean speed; $M = \frac{2}{3\pi}\alpha_vQb$.

    The pressure is displaced towards the inlet, like the pressure of a film. The moment therefore acts on both bodies
    like the rolling force of a film and takes the power $Pu$.

    **Limits:** 0 without load and at rest; the sign is $u/\sqrt{u^2 + u_\epsilon^2}$, $u_\epsilon$ = 1e-6 m/s.
    **Validity:** elastic contacts; the loss of hard steel is about 0.005 to 0.01 and not known more precisely.
    **Reference:** Johnson, *Contact Mechanics*, ch. 9, from memory.

    **Arguments:** `load`, N, >= 0; `mean_speed` (u1 + u2)/2, m/s, signed; `loss`: fraction $\alpha_v$ of the
    elastic work that is lost.
    """
    moment = 2.0 / (3.0 * jnp.pi) * loss * load * contact.half_width(load)
    return moment / contact.reduced_radius * smooth_sign(mean_speed, SPEED_FLOOR)


def point_hysteresis(contact: PointContact, load: Values, roll: Values, loss: Values) -> Float[Array, "..."]:
    r"""Moment $\frac{3}{16}\alpha_vQa$ that resists the roll of a point contact, N m, with the sign of the roll.

    a is the semi-axis of the ellipse along rolling.

    **Limits:** 0 without load and without roll; the change of sign is smoothed over a rolling speed of 1e-6 m/s.
    **Validity:** as `line_hysteresis`.
    **Reference:** Johnson, *Contact Mechanics*, ch. 9, from memory.

    **Arguments:** `roll`: angular speed of the relative roll, rad/s, signed; others as for `line_hysteresis`.
    """
    size = 3.0 / 16.0 * loss * load * contact.ellipse(load).rolling
    return size * smooth_sign(roll * contact.reduced_radius_rolling, SPEED_FLOOR)

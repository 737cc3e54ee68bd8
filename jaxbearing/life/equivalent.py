r"""Equivalent loads of bearings under a radial and an axial load: P of ISO 281 with X and Y, P0 of ISO 76 with X0, Y0.

[T] The rows at 0, 15, 30 and 40 degrees, also of X0 and Y0, are as a maker prints them (Koyo, technical data of the
general catalogue: equivalent loads); the other rows are from memory ([M]). [C] Each row agrees with the limit e printed
beside it, $e = (1 - X)/Y$. P is therefore continuous, and the larger of $F_r$ and $XF_r + YF_a$.
"""

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar
from ..numerics.arguments import require_angle, require_count, require_numbers
from .capacity import MILLIMETRE

STEP = np.radians(5.0)
"""Step between the contact angles of the tables, which begin at 0, rad."""
LARGEST_ANGLE = 9.0 * STEP
"""Largest contact angle of a radial bearing, rad; the tables end there."""
RELATIVE_LOADS = np.array([0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89])
"""F_a/(Z D^2), N/mm^2, for the columns of Y. [D] It equals (f0 F_a/C0) cos(alpha), since C0 = f0 Z D^2 cos(alpha).
[T] The maker's columns at 15 degrees, 0.178 to 7.14, are these values over cos(alpha)."""

X = np.array([0.56, 0.56, 0.46, 0.44, 0.43, 0.41, 0.39, 0.37, 0.35, 0.33])
"""Factor X of ball bearings at contact angles of 0, 5, ... 45 degrees; deep-groove bearings have 0 degrees."""
_GROOVE = [2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00]
Y = np.array(
    [
        _GROOVE,
        _GROOVE,
        [1.88, 1.71, 1.52, 1.41, 1.34, 1.23, 1.10, 1.01, 1.00],
        [1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00],
        *([factor] * 9 for factor in (1.00, 0.87, 0.76, 0.66, 0.57, 0.50)),
    ]
)
"""Factor Y of ball bearings: rows by contact angle, as X; columns by relative load."""
X_STATIC = np.array([0.6, *[0.5] * 9])
"""Factor X0 of single-row ball bearings, by contact angle as X."""
Y_STATIC = np.array([0.50, 0.52, 0.50, 0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22])
"""Factor Y0 of single-row ball bearings, by contact angle as X."""
ROLLER_STATIC = (0.5, 0.22)
"""X0 and Y0/cot(alpha) of roller bearings with a contact angle [M]."""


_TABLE = np.column_stack([X, X_STATIC, Y_STATIC, Y])


@jax.jit
def _at_angle(contact_angle: Scalar) -> Array:
    """X, X0, Y0 and the row of Y at a contact angle, interpolated linearly; NaN beyond the last angle of the tables."""
    place = jnp.asarray(contact_angle) / STEP
    lower = jnp.clip(jnp.floor(place), 0.0, len(_TABLE) - 2.0)
    rows, first = jnp.asarray(_TABLE), lower.astype(int)
    share = place - lower
    # round-off must not put the last angle outside
    inside = place <= LARGEST_ANGLE / STEP * (1.0 + 1e-12)
    return jnp.where(inside, (1.0 - share) * rows[first] + share * rows[first + 1], jnp.nan)


def _require_ball(contact_angle: Scalar, **loads: Scalar) -> None:
    require_angle("contact_angle", contact_angle)
    require_numbers(">= 0 and below 90 degrees", contact_angle=contact_angle)
    require_numbers(">= 0", **loads)


def ball_equivalent_load(
    radial: Scalar, axial: Scalar, contact_angle: Scalar, n_balls: int | Scalar, ball_diameter: Scalar
) -> Float[Array, ""]:
    r"""Equivalent load $P = \max(F_r, XF_r + YF_a)$ of a single-row ball bearing, N (ISO 281).

    X depends on the contact angle, Y also on $F_a/(ZD^2)$ if the angle is below 20 degrees; both are interpolated.

    **Evidence:** [T] at 0, 15, 30, 40 degrees, otherwise [M]; [C] the printed limits e. **Validity:** contact angles up
    to 45 degrees (NaN beyond); $F_a/(ZD^2)$ from 0.172 to 6.89 N/mm^2 (outside: Y at the nearer end).

    **Arguments:** `radial`, `axial`: loads >= 0, N; `contact_angle`: nominal, rad, 0 for a deep-groove bearing;
    `ball_diameter`, m.
    """
    _require_ball(contact_angle, radial=radial, axial=axial)
    require_count("n_balls", n_balls)
    require_numbers("> 0", ball_diameter=ball_diameter)
    relative = axial / (n_balls * jnp.square(jnp.asarray(ball_diameter) / MILLIMETRE))
    factors = _at_angle(contact_angle)
    y = jnp.interp(relative, jnp.asarray(RELATIVE_LOADS), factors[3:])
    return jnp.maximum(radial, factors[0] * radial + y * axial)


def ball_static_load(radial: Scalar, axial: Scalar, contact_angle: Scalar) -> Float[Array, ""]:
    r"""Equivalent static load $P_0 = \max(F_r, X_0F_r + Y_0F_a)$ of a single-row ball bearing, N (ISO 76).

    **Evidence:** [T] at 0, 15, 30, 40 degrees, otherwise [M]. **Validity:** contact angles up to 45 degrees (NaN
    beyond).
    **Arguments:** as `ball_equivalent_load`.
    """
    _require_ball(contact_angle, radial=radial, axial=axial)
    factors = _at_angle(contact_angle)
    return jnp.maximum(radial, factors[1] * radial + factors[2] * axial)


def roller_static_load(radial: Scalar, axial: Scalar, contact_angle: Scalar) -> Float[Array, ""]:
    r"""Equivalent static load of a single-row roller bearing with a contact angle, N (ISO 76):
    $P_0 = \max(F_r, 0.5F_r + 0.22\cot\alpha\,F_a)$.

    **Evidence:** [M].
    **Arguments:** `radial`, `axial`: loads >= 0, N; `contact_angle`: of the outer raceway, rad.
    """
    require_angle("contact_angle", contact_angle)
    require_numbers("above 0 and below 90 degrees", contact_angle=contact_angle)
    require_numbers(">= 0", radial=radial, axial=axial)
    x, y = ROLLER_STATIC
    return jnp.maximum(radial, x * radial + y / jnp.tan(contact_angle) * axial)

"""Division of cylindrical and tapered rollers into laminae along their length."""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..contacts import AbstractTiltedLine, SlicedLine, StraightLine, alike_modulus, palmgren_stiffness
from ..contacts.profile import AbstractProfile
from ..numerics.safe import positive_power
from ..numerics.structure import count
from .rating import LAMINAE


class RollerProfile(eqx.Module):
    """Laminae of the rollers, with or without a profile. Without this part the rollers are straight, and their contacts
    are integrated in closed form.

    **Arguments:**
    - `shape`: profile of the rollers; `None` for straight rollers.
    - `n_laminae`: number of laminae of a roller; structure.
    """

    shape: AbstractProfile | None = None
    n_laminae: int = count("profile.n_laminae", LAMINAE, least=1)


def roller_line(
    profile: RollerProfile | None, modulus: Float[Array, ""] | Float[Array, "2 1"], length: Scalar
) -> AbstractTiltedLine:
    """Raceway contacts of a roller that may tilt: in closed form if `profile` is `None`, otherwise in laminae.

    **Arguments:** `modulus`: reduced modulus E' of both raceway contacts, or of the inner and the outer one, Pa;
    `length`: length of the roller, m.
    """
    alike = alike_modulus(modulus)
    stiffness, ratio = palmgren_stiffness(length, alike), modulus / alike if jnp.ndim(modulus) else None
    if profile is None:
        return StraightLine(stiffness, length, ratio=ratio)
    return SlicedLine(stiffness, length, profile=profile.shape, count=profile.n_laminae, ratio=ratio)


def own_laminae(profile: RollerProfile | None) -> int:
    """Number of laminae of a roller in the results. Without a profile only the results use laminae."""
    return LAMINAE if profile is None else profile.n_laminae


def pressed_load(stiffness: Array, length: Array, pressed: Array, slope: Array) -> Array:
    """Approximate loads of straight rollers between two races, N, from which the load scale of a held ring follows.

    **Arguments:** `stiffness`: K of each of the two equal contacts of a roller, N/m^(19/9); `length`: length of the
    rollers, m; `pressed`: sum of the deflections of both contacts at the middle of each roller, m; `slope`: change of
    this sum along the roller.
    """
    # the two contacts of a roller are in series, so that each has half of the deflection
    depth = 0.5 * jnp.maximum(pressed + 0.5 * length * jnp.abs(slope), 0.0)
    return stiffness * length * positive_power(depth, 10.0 / 9.0)

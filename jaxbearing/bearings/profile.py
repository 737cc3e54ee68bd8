"""Rollers cut into laminae along their length: the same part for cylindrical and tapered rollers."""

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
    """Laminae of the rollers, with or without a profile; without this part contacts are straight and integrated in
    closed form.

    **Arguments:**
    - `shape`: `None`: straight.
    - `n_laminae`: number of laminae of a roller; structure.
    """

    shape: AbstractProfile | None = None
    n_laminae: int = count("profile.n_laminae", LAMINAE, least=1)


def roller_line(
    profile: RollerProfile | None, modulus: Float[Array, ""] | Float[Array, "2 1"], length: Scalar
) -> AbstractTiltedLine:
    """The contacts of a roller that may tilt with the raceways: in closed form without a profile, else in its laminae.

    **Arguments:** E' of both raceways, or of the inner and the outer one, Pa; m.
    """
    alike = alike_modulus(modulus)
    stiffness, ratio = palmgren_stiffness(length, alike), modulus / alike if jnp.ndim(modulus) else None
    if profile is None:
        return StraightLine(stiffness, length, ratio=ratio)
    return SlicedLine(stiffness, length, profile=profile.shape, count=profile.n_laminae, ratio=ratio)


def own_laminae(profile: RollerProfile | None) -> int:
    """Number of laminae into which the results cut a roller; without a profile only they do."""
    return LAMINAE if profile is None else profile.n_laminae


def pressed_load(stiffness: Array, length: Array, pressed: Array, slope: Array) -> Array:
    """About the loads of straight rollers between two races, N: a scale of the load that a held ring needs.

    **Arguments:** K of contacts that are alike, N/m^(19/9), and length, m, of the rollers; by how much the races press
    each together at its middle, m, and how that changes along it.
    """
    # both contacts of a roller, one behind the other
    depth = 0.5 * jnp.maximum(pressed + 0.5 * length * jnp.abs(slope), 0.0)
    return stiffness * length * positive_power(depth, 10.0 / 9.0)

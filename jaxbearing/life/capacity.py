"""Basic dynamic load ratings of radial bearings from their geometry (ISO 281)."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..numerics.arguments import require_angle, require_count, require_numbers

MILLIMETRE = 1e-3
LARGE_BALL = 25.4
"""Ball diameter, mm, above which the rating grows with D^1.4 instead of D^1.8."""
CONFORMITIES, SIZE_RATIOS = "above 0.5 and at most 1", ">= 0 and below 1"
POLE = 0.505
"""Smallest conformity in the formulas, which have a pole at 0.5; smaller conformities are rated as this one."""


def ball_size_ratio(ball_diameter: Scalar, pitch_diameter: Scalar, contact_angle: Scalar) -> Float[Array, ""]:
    """Size ratio gamma = D cos(alpha)/d_m of balls or rollers. **Arguments:** diameters D and d_m, m; angle, rad."""
    require_angle("contact_angle", contact_angle)
    require_numbers("> 0", ball_diameter=ball_diameter, pitch_diameter=pitch_diameter)
    gamma = jnp.asarray(ball_diameter * jnp.cos(contact_angle) / pitch_diameter)
    require_numbers(SIZE_RATIOS, gamma=gamma)
    return gamma


def groove_ratio(
    gamma: Scalar, conformity_inner: Scalar, conformity_outer: Scalar, constant: float
) -> Float[Array, ""]:
    """Ratio A of the capacities of the inner and the outer contact of a ball (Lundberg and Palmgren).

    **Arguments:** `constant`: 1.04 in ISO 281, 1.044 in ISO 16281.
    """
    require_numbers(SIZE_RATIOS, gamma=gamma)
    require_numbers(CONFORMITIES, conformity_inner=conformity_inner, conformity_outer=conformity_outer)
    f_i, f_e = jnp.maximum(conformity_inner, POLE), jnp.maximum(conformity_outer, POLE)
    grooves = f_i * (2.0 * f_e - 1.0) / (f_e * (2.0 * f_i - 1.0))
    return jnp.asarray(constant * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * grooves**0.41)


def roller_ratio(gamma: Scalar, constant: float) -> Float[Array, ""]:
    """Ratio B of the capacities of the inner and the outer contact of a roller.

    **Arguments:** `constant`: 1.04 in ISO 281, 1.038 in ISO 16281.
    """
    require_numbers(SIZE_RATIOS, gamma=gamma)
    return jnp.asarray(constant * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0))


def ball_factor(gamma: Scalar, conformity_inner: Scalar, conformity_outer: Scalar) -> Float[Array, ""]:
    r"""Factor $f_c$ of ball bearings, for N and mm.

    $f_c = 0.41\cdot98.0665\lambda[1 + A^{10/3}]^{-0.3}\gamma^{0.3}(1-\gamma)^{1.39}(1+\gamma)^{-1/3}
    (2f_i/(2f_i - 1))^{0.41}$, $\lambda$ = 0.95, A by `groove_ratio`.

    **Evidence:** [T] with $f_i = f_e$ = 0.52: 46.7, 55.5, 59.6, 59.9, 56 at gamma 0.05, 0.10, 0.16, 0.20, 0.30.
    **Validity:** conformities above 0.505 (smaller ones are replaced by 0.505).
    """
    ratio = groove_ratio(gamma, conformity_inner, conformity_outer, 1.04)
    f_i = jnp.maximum(conformity_inner, POLE)
    shape = gamma**0.3 * (1.0 - gamma) ** 1.39 / (1.0 + gamma) ** (1.0 / 3.0)
    groove = (2.0 * f_i / (2.0 * f_i - 1.0)) ** 0.41
    return 0.41 * 98.0665 * 0.95 * (1.0 + ratio ** (10.0 / 3.0)) ** -0.3 * shape * groove


def ball_capacity(
    n_balls: int | Scalar,
    ball_diameter: Scalar,
    pitch_diameter: Scalar,
    contact_angle: Scalar,
    conformity_inner: Scalar = 0.52,
    conformity_outer: Scalar = 0.52,
    material_factor: Scalar = 1.3,
) -> Float[Array, ""]:
    r"""Basic dynamic load rating C of one row of balls, N: $C = b_mf_c(\cos\alpha)^{0.7}Z^{2/3}D^{1.8}$, D in mm;
    above 25.4 mm with $3.647D^{1.4}$ in place of $D^{1.8}$ (at 25.4 mm the two differ by 5e-6).

    **Evidence:** [T] for $f_c$. Catalogue ratings are computed with conformities of 0.52, the default; real ones give a
    few per cent less. $b_m$ = 1.3: [M].

    **Arguments:** diameters, m; `contact_angle`: nominal, rad, 0 for a deep-groove bearing.
    """
    require_count("n_balls", n_balls)
    require_numbers("> 0", material_factor=material_factor)
    gamma = ball_size_ratio(ball_diameter, pitch_diameter, contact_angle)
    diameter = jnp.asarray(ball_diameter) / MILLIMETRE
    size = jnp.where(diameter > LARGE_BALL, 3.647 * diameter**1.4, diameter**1.8)
    factor = ball_factor(gamma, conformity_inner, conformity_outer)
    return material_factor * factor * jnp.cos(contact_angle) ** 0.7 * n_balls ** (2.0 / 3.0) * size


def roller_factor(gamma: Scalar) -> Float[Array, ""]:
    r"""Factor $f_c$ of roller bearings, for N and mm: $207.9\cdot0.83\gamma^{2/9}(1-\gamma)^{29/27}(1+\gamma)^{-1/4}
    [1 + B^{9/2}]^{-2/9}$, B by `roller_ratio`.

    **Evidence:** [T] 74.1, 84.2, 88.8, 83.8 at gamma 0.05, 0.10, 0.18, 0.30.
    """
    require_numbers(SIZE_RATIOS, gamma=gamma)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    return 207.9 * 0.83 * shape * (1.0 + roller_ratio(gamma, 1.04) ** 4.5) ** (-2.0 / 9.0)


def roller_capacity(
    n_rollers: int | Scalar,
    roller_diameter: Scalar,
    pitch_diameter: Scalar,
    length: Scalar,
    contact_angle: Scalar = 0.0,
    material_factor: Scalar = 1.1,
) -> Float[Array, ""]:
    r"""Basic dynamic load rating C of one row of rollers, N: $C = b_mf_c(L\cos\alpha)^{7/9}Z^{3/4}D^{29/27}$, L and D
    in mm.

    **Evidence:** [T] for $f_c$; $b_m$ = 1.1 (cylindrical, tapered and machined needle rollers): [M].

    **Arguments:** `roller_diameter`, at mid length, m; `pitch_diameter`, at mid length of the rollers, m; `length`:
    effective length of a roller, m; `contact_angle`: of the outer raceway, rad.
    """
    require_count("n_rollers", n_rollers)
    require_numbers("> 0", roller_diameter=roller_diameter, length=length, material_factor=material_factor)
    gamma = ball_size_ratio(roller_diameter, pitch_diameter, contact_angle)
    length, diameter = jnp.asarray(length) / MILLIMETRE, jnp.asarray(roller_diameter) / MILLIMETRE
    size = (length * jnp.cos(contact_angle)) ** (7.0 / 9.0) * diameter ** (29.0 / 27.0)
    return material_factor * roller_factor(gamma) * size * n_rollers**0.75

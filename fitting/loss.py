"""Distance of a model from the measurements: errors of each point, and robust losses that limit outliers."""

import math
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

LOSSES = ("linear", "soft_l1", "cauchy")
MAD_TO_SIGMA = 1.4826
"""Standard deviation of normal errors over their median absolute value."""


FLOOR = 0.2
"""Floor of the default error: that of a coefficient of this part of the curve's largest one."""


class Errors(NamedTuple):
    """Standard deviation of a measured coefficient: root of the sum of squares of a relative part, a constant part, and
    the curve's slope times the error of the slide-to-roll ratio. Only the ratios between points matter, because the
    size of the errors is estimated from the residuals.

    `relative`: part of the coefficient; `floor`: constant part, a coefficient, None: `relative` times `FLOOR` times the
    largest coefficient of the curve; `slide_to_roll`: standard deviation of the slide-to-roll ratio, 0: exact.
    """

    relative: float = 0.02
    floor: float | None = None
    slide_to_roll: float = 0.0

    def deviation(self, coefficient: np.ndarray, curve: np.ndarray, slope: np.ndarray | float = 0.0) -> np.ndarray:
        """Standard deviation of each point. **Arguments:** `curve`: number of each point's curve; `slope`: derivative
        of the coefficient by the slide-to-roll ratio."""
        size = np.abs(coefficient)
        floor = np.full(size.shape, 0.0 if self.floor is None else self.floor)
        if self.floor is None:
            for number in np.unique(curve):
                floor[curve == number] = self.relative * FLOOR * np.max(size[curve == number])
        total = np.square(self.relative * size) + np.square(floor) + np.square(np.asarray(slope) * self.slide_to_roll)
        return np.sqrt(np.where(total > 0, total, 1.0))


def robust(residual: Float[Array, "..."], kind: str) -> Float[Array, "..."]:
    r"""The residual whose square is the loss: $r^2$ (linear), $2(\sqrt{1+r^2}-1)$ (soft_l1), $\ln(1+r^2)$ (cauchy).

    Smooth, odd, slope 1 at 0. **Arguments:** `residual` in units of the error beyond which a point counts less.

    **Raises:** `ValueError` for an unknown kind.
    """
    if kind == "linear":
        return residual
    square = jnp.square(residual)
    if kind == "soft_l1":
        return residual * jnp.sqrt(2.0 / (1.0 + jnp.sqrt(1.0 + square)))
    if kind == "cauchy":
        small = square < 1e-8
        ratio = jnp.log1p(square) / jnp.where(small, 1.0, square)
        return residual * jnp.sqrt(jnp.where(small, 1.0 - 0.5 * square, ratio))
    raise ValueError(f"loss: found {kind!r}, expected one of {', '.join(LOSSES)}")


def robust_with_slope(residual: np.ndarray, kind: str) -> tuple[np.ndarray, np.ndarray]:
    """Value and derivative of `robust`, as numpy arrays."""
    bent = np.asarray(robust(jnp.asarray(residual), kind))
    # the square is rho, whose derivative is 2 psi = 2 bent * slope
    small = np.abs(residual) < 1e-6
    slope = influence(residual, kind) / np.where(small, 1.0, bent)
    return bent, np.where(small, 1.0, slope)


TUNING = {"linear": math.inf, "soft_l1": 1.345, "cauchy": 2.385}
"""Residual, in standard deviations, at which a robust loss departs from the square: 95 % efficiency with normal errors
(soft_l1: Huber's value)."""


def influence(residual: np.ndarray, kind: str) -> np.ndarray:
    r"""Influence $\psi = \rho'/2$ of a residual in the normal equations. **Arguments:** `residual` in units of `TUNING`
    standard deviations."""
    square = np.square(residual)
    if kind == "linear":
        return residual
    return residual / (np.sqrt(1.0 + square) if kind == "soft_l1" else 1.0 + square)


def variance_factor(residual: np.ndarray, kind: str, parameters: int) -> float:
    r"""Variance factor of the covariance of an M-estimate, $\frac{\sum\psi^2/(n-k)}{(\overline{\psi'})^2}$.

    With the linear loss it is the residual variance. **Arguments:** `residual` in units of `TUNING` standard
    deviations; `parameters`: number k of fitted parameters.
    **Reference:** Huber (1981), *Robust Statistics*, sec. 7.6.
    """
    square = np.square(residual)
    if kind == "linear":
        slope = np.ones_like(residual)
    elif kind == "soft_l1":
        slope = (1.0 + square) ** -1.5
    else:
        slope = (1.0 - square) / np.square(1.0 + square)
    degrees = max(len(residual) - parameters, 1)
    return float(np.sum(np.square(influence(residual, kind))) / degrees / np.mean(slope) ** 2)


def scale_of(residual: np.ndarray) -> float:
    """Robust standard deviation of residuals, never 0."""
    return max(MAD_TO_SIGMA * float(np.median(np.abs(residual))), float(np.finfo(float).tiny) ** 0.5)

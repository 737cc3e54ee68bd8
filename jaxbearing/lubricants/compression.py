"""Density of a lubricant under pressure."""

import jax.numpy as jnp

from .._types import Batch, Values

RATE = 0.6e-9
"""1/Pa: slope of the density ratio at ambient pressure."""
SATURATION = 1.7e-9
"""1/Pa."""


def dowson_higginson_ratio(pressure: Values) -> Batch:
    r"""Density over that at ambient pressure, $1 + \frac{0.6\,p}{1 + 1.7\,p}$, p in GPa.

    **Limits:** 1 at p = 0, 1.353 as p grows. **Validity:** mineral oils; the law knows no other oil and no temperature.
    **Reference:** Dowson and Higginson, *Elastohydrodynamic Lubrication* (1966).

    **Arguments:** `pressure`, Pa, >= 0.
    """
    return jnp.asarray(1.0 + RATE * pressure / (1.0 + SATURATION * pressure), dtype=float)

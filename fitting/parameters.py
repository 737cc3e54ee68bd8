"""Parameters of the rheology in coordinates of the fit: scaled, centred on the data, positive ones as logarithms."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from jaxbearing.lubricants import ExponentialRheology

NAMES = (
    "shear_modulus",
    "shear_modulus_pressure",
    "shear_modulus_temperature",
    "stress",
    "stress_pressure",
    "stress_temperature",
)
"""Fields of `ExponentialRheology` that are fitted: G0, alpha_G, beta_G, tau_00, alpha_tau, beta_tau."""
UNITS = ("Pa", "1/Pa", "K", "Pa", "1/Pa", "K")
SYMBOLS = ("G0", "alpha_G", "beta_G", "tau0", "alpha_tau", "beta_tau")
POSITIVE = (True, False, False, True, False, False)
"""Flags of the positive parameters, which are fitted as their logarithms."""
SCALES = np.array([1.0, 1e-9, 1e3, 1.0, 1e-9, 1e3])
"""Unit of each natural coordinate in SI: ln, 1/GPa, kK."""
LARGEST_LOG = 80.0
"""Largest magnitude of the natural logarithm of G0 and tau0 in Pa: 35 decades."""
GROUPS = ((0, 1, 2), (3, 4, 5))
"""Indices of value, pressure coefficient and temperature coefficient, for the shear modulus and for the stress."""


class Centre(NamedTuple):
    """Reference point in the middle of the data, where they determine G and tau best.

    `pressure`: middle of the mean contact pressures, Pa; `inverse_temperature`: middle of 1/T, 1/K. The spans are the
    largest minus the smallest values.
    """

    pressure: float
    inverse_temperature: float
    pressure_span: float
    inverse_temperature_span: float

    @classmethod
    def of(cls, mean_pressure: np.ndarray, temperature: np.ndarray) -> "Centre":
        inverse = 1.0 / np.asarray(temperature)
        middle = lambda x: float(0.5 * (np.min(x) + np.max(x)))
        span = lambda x: float(np.max(x) - np.min(x))
        return cls(middle(mean_pressure), middle(inverse), span(mean_pressure), span(inverse))


def natural(rheology: ExponentialRheology) -> np.ndarray:
    """Natural coordinates, shape (6,): ln G0, alpha_G in 1/GPa, beta_G in kK, ln tau, ..."""
    values = np.array([float(getattr(rheology, name)) for name in NAMES])
    return np.where(POSITIVE, np.log(np.where(POSITIVE, values, 1.0)), values / SCALES)


def with_natural(rheology: ExponentialRheology, coordinates: Float[Array, " parameter"]) -> ExponentialRheology:
    """The rheology with these natural coordinates; differentiable. ln G0 and ln tau0 are limited to +-80, so that any
    trial of an optimiser stays finite."""
    coordinates = jnp.where(jnp.asarray(POSITIVE), jnp.clip(coordinates, -LARGEST_LOG, LARGEST_LOG), coordinates)
    values = [jnp.exp(coordinates[i]) if POSITIVE[i] else coordinates[i] * SCALES[i] for i in range(len(NAMES))]
    where = lambda r: [getattr(r, name) for name in NAMES]
    return eqx.tree_at(where, rheology, values)


def values_of(coordinates: np.ndarray) -> np.ndarray:
    """SI values of natural coordinates, with the same limits as in `with_natural`."""
    coordinates = np.asarray(coordinates)
    logarithms = np.clip(np.where(POSITIVE, coordinates, 0.0), -LARGEST_LOG, LARGEST_LOG)
    return np.where(POSITIVE, np.exp(logarithms), coordinates * SCALES)


def centred_directions(centre: Centre, reference_temperature: float, free: np.ndarray) -> np.ndarray:
    """Matrix (6, 6) from centred to natural coordinates; columns of parameters that are not free are 0.

    The first centred coordinate u0 of a group is ln G (or ln tau) at the centre of the data, so a change of alpha or
    beta alone rotates the law about that point: ln G0 = u0 - alpha p_c - beta (1/T_c - 1/T_0).
    """
    matrix = np.diag(free.astype(float))
    lever = (centre.pressure * SCALES[1], (centre.inverse_temperature - 1.0 / reference_temperature) * SCALES[2])
    for value, *coefficients in GROUPS:
        if free[value]:
            for index, arm in zip(coefficients, lever, strict=True):
                matrix[value, index] = -arm if free[index] else 0.0
    return matrix

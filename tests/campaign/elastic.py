"""Elastic contacts written once more in numpy and scipy, from the literature and without the package."""

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk


def reduced_modulus(a: tuple[np.ndarray, np.ndarray], b: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """E', Pa, of two (Young's modulus, Poisson's ratio)."""
    return 2.0 / ((1.0 - a[1] ** 2) / a[0] + (1.0 - b[1] ** 2) / b[0])


def palmgren(load: np.ndarray, length: np.ndarray, modulus: np.ndarray) -> np.ndarray:
    """Approach of a line contact, m."""
    return 0.39 * (8.0 / modulus) ** 0.9 * np.maximum(load, 0.0) ** 0.9 / length**0.8


def line_pressure(load: np.ndarray, radius: np.ndarray, length: np.ndarray, modulus: np.ndarray) -> np.ndarray:
    """Hertz pressure of a line contact, Pa."""
    return np.sqrt(np.maximum(load, 0.0) * modulus / (2.0 * np.pi * radius * length))


def load_at_line_pressure(pressure: float, radius: np.ndarray, length: np.ndarray, modulus: np.ndarray) -> np.ndarray:
    return 2.0 * np.pi * radius * length / modulus * pressure**2


def _ellipticity(ratio: float) -> float:
    """k = longer over shorter semi-axis for R across over R along rolling >= 1 (Johnson, Contact Mechanics, 4.2)."""
    if ratio < 1.0 + 1e-12:
        return 1.0

    def error(log_k: float) -> float:
        k = np.exp(log_k)
        m = 1.0 - 1.0 / k**2
        return (k**2 * ellipe(m) - ellipk(m)) / (ellipk(m) - ellipe(m)) - ratio

    return float(np.exp(brentq(error, 1e-9, 12.0, xtol=1e-14)))


def point_stiffness(along: np.ndarray, across: np.ndarray, modulus: np.ndarray) -> np.ndarray:
    """K of Q = K delta^1.5, N/m^1.5 (Harris; Johnson): circular contacts 2/3 sqrt(R) E' with R = R along = R across."""
    ratio = np.maximum(along, across) / np.minimum(along, across)
    k = np.vectorize(_ellipticity)(ratio)
    m = 1.0 - 1.0 / k**2
    curvature = 1.0 / along + 1.0 / across
    return np.pi * k * modulus * np.sqrt(2.0 * ellipe(m) / (9.0 * curvature * ellipk(m) ** 3))


def point_pressure(load: np.ndarray, along: np.ndarray, across: np.ndarray, modulus: np.ndarray) -> np.ndarray:
    """Hertz pressure of an elliptical contact, Pa."""
    ratio = np.maximum(along, across) / np.minimum(along, across)
    k = np.vectorize(_ellipticity)(ratio)
    second = ellipe(1.0 - 1.0 / k**2)
    short = np.cbrt(6.0 * second * load / (np.pi * k * (1.0 / along + 1.0 / across) * modulus))
    return 1.5 * load / (np.pi * k * short**2)

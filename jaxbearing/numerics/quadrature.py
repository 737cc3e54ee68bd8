"""Gauss-Legendre nodes as constants of a trace."""

from functools import lru_cache

import numpy as np


@lru_cache(maxsize=32)
def gauss_legendre(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights of the n-point Gauss-Legendre rule on [0, 1] (float64, shape (n,) each).

    Exact for polynomials of degree 2n - 1; the weights sum to 1. The arrays are read-only, since
    every caller shares them.
    """
    if n < 1:
        raise ValueError(f"gauss_legendre needs n >= 1, got {n}")
    nodes, weights = np.polynomial.legendre.leggauss(n)
    nodes, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    nodes.flags.writeable = False
    weights.flags.writeable = False
    return nodes, weights

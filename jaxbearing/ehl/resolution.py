"""Number of nodes and inlet length of a line contact for a required accuracy of its steady films.

Both errors follow the group $x = M/H = \\frac{\\pi}{8}a^2/(Rh)$ of Moes' numbers, h by Moes' formula: the inlet
zone is about $x^{-2/3}$ half widths long. They were measured against Richardson's extrapolation of 801 and 1601 nodes
and against an inlet of 32 half widths (`tests/benchmarks/accuracy.py`): the larger of the errors of central and minimum
film, both of which come out too low, for Barus' oil, whose films are the hardest to compute.
"""

import numpy as np

from .._types import Values
from .mesh import INLET

INLETS = (INLET, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0)
NODES = (201, 301, 401, 501, 651, 801, 1101, 1601, 2201, 3201)
FILM_SHARE = 0.5
"""Share of the permitted error that the cut inlet may cause."""


def mesh_error(nodes: int, ratio: Values, material: Values) -> Values:
    r"""Relative error of the films by the mesh,
    $[0.009 + 0.037(x/50)^{4/3}((L^2 + 0.64)^{1/2}/10)^{0.8}](200/(n - 1))^2$.

    **Validity:** a bound for x from 3 to 300 and L up to 25, at most twice the error there; second order is reached
    where it is below about 0.1.

    **Arguments:** `ratio` x; `material`: Moes' L.
    """
    sharp = 0.037 * (ratio / 50.0) ** (4.0 / 3.0) * ((material**2 + 0.64) ** 0.5 / 10.0) ** 0.8
    return (0.009 + sharp) * (200.0 / (nodes - 1)) ** 2


def cut_error(inlet: float, ratio: Values) -> Values:
    r"""Relative error of the films by an inlet of X half widths, $0.017x^{-1.3}(4/X)^{3.1}$, within a factor of 2
    for x from 0.4 to 25. **Arguments:** `inlet`: X; `ratio`: x."""
    return 0.017 * ratio**-1.3 * (4.0 / inlet) ** 3.1


def chosen(accuracy: float, fewest: int, ratio: float, material: float, inlet: float | None) -> tuple[int, float]:
    """Number of nodes and inlet length that keep the sum of both errors below `accuracy` (for a given `inlet` that of
    the mesh alone), else the finest mesh.

    **Arguments:** `accuracy`, relative, of the films; `fewest` nodes; `ratio`, `material`: x and L; `inlet`, half
    widths, or None: chosen too (then it uses its share of the error).
    """
    left = accuracy
    if inlet is None:
        inlet = next((length for length in INLETS if cut_error(length, ratio) <= FILM_SHARE * accuracy), INLETS[-1])
        left = accuracy - min(float(np.asarray(cut_error(inlet, ratio))), FILM_SHARE * accuracy)
    enough = (n for n in NODES if n >= fewest and mesh_error(n, ratio, material) <= left)
    return next(enough, NODES[-1]), inlet

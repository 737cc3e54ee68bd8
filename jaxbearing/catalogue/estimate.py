r"""Internal geometry from boundary dimensions and ratings: the most probable one, with intervals.

For every number of rolling elements, and every usual size of balls and cylindrical rollers, the other unknowns x follow
from a least-squares problem

$$\min_x \sum_k \left(\frac{g_k(x) - m_k}{s_k}\right)^2,$$

whose terms are the usual proportions (`proportions.py`), the given numbers (with $s_k$ = 1e-5), and the logarithms of
printed over computed ratings. The ratings are those of `life.capacity` and `life.static`, with their derivatives by
JAX. The candidates are compared by their probabilities in Laplace's approximation, $e^{-\chi^2/2}\det(J^TJ)^{-1/2}$,
which also weight them in the intervals.
"""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from ..life.capacity import ball_capacity, roller_capacity
from ..life.static import ball_static_capacity, roller_static_capacity
from ..numerics.small_linear import cholesky, cholesky_solve
from ..programs import KeptProgram
from .designation import Designation
from .geometry import Estimate, Geometry
from .proportions import BALL_SIZES, FILL_ANGLE, GAP, ROLLER_SIZES, Normal
from .terms import GIVEN, UNKNOWNS, terms_of

STEPS = 12
"""Gauss-Newton steps. The problems are nearly linear in these unknowns: the last step is below 1e-9."""
LONGEST_STEP = 0.3
LANES = 512
"""Number of candidates of a program; fewer are padded, so that one program serves all bearings of a family."""
QUANTILE = 1.645
"""Half width of an interval of 90 % in standard deviations."""
FILLS = (0.5, 0.985)
"""Smallest and largest Z D/(pi d_m), the filled part of the pitch circle, of candidates."""


def estimate(bearing: Designation, known: Mapping[str, float], angle: Normal) -> Geometry:
    """The internal geometry of a bearing.

    **Arguments:**
    - `bearing`: its designation, with the boundary dimensions.
    - `known`: numbers, SI, by name: "n_elements", "diameter", "pitch_diameter", "length", "dynamic_capacity",
      "static_capacity".
    - `angle`: contact angle, rad, with a deviation of 0 if it is given.

    **Raises:** `ValueError` for numbers that do not fit any geometry of this size.
    """
    rollers = bearing.kind in ("cylindrical", "tapered")
    terms = {name: np.array(values) for name, values in terms_of(bearing, known, angle).items()}
    counts, sizes, standard = _candidates(bearing, known, terms)
    mask = np.arange(LANES) < len(counts)
    padded = [np.resize(column, LANES).astype(float) for column in (counts, sizes)]
    size_weight = np.asarray(0.0 if math.isnan(sizes[0]) else 1.0 / GIVEN)
    program = _PROGRAMS["roller" if rollers else "ball"]
    # without usual sizes the column is NaN and its weight 0, so the number that replaces NaN has no effect
    out = program(padded[0], np.nan_to_num(np.log(padded[1])), size_weight, terms)
    return _chosen({name: np.asarray(value) for name, value in out.items()}, mask, counts, known, angle, standard)


def _candidates(
    bearing: Designation, known: Mapping[str, float], terms: Mapping[str, Any]
) -> tuple[np.ndarray, np.ndarray, bool]:
    """Numbers of elements and diameters, mm, of the candidates, and whether the diameters are usual sizes. Candidates
    with known diameters come with the likeliest first; a diameter of NaN is an unknown of the least-squares problem."""
    middle, pitch = math.exp(terms["mean"][0]), math.exp(terms["mean"][1])
    spread = 1.0 / terms["weight"][0]
    sizes, standard = np.empty(0), False
    if "diameter" in known:
        sizes = np.array([1e3 * known["diameter"]])
    else:
        sizes = _usual_sizes(bearing.kind, middle, spread)
        standard = len(sizes) > 0
    trial = sizes if len(sizes) else np.array([middle * math.exp(-2.0 * spread), middle * math.exp(2.0 * spread)])
    numbers = np.arange(3, 200)
    if "n_elements" in known:
        numbers = np.array([round(known["n_elements"])])
    if not len(sizes):
        fits = [number for number in numbers if _fills(number, trial, pitch).any() or len(numbers) == 1]
        fits = fits or [round(FILLS[1] * math.pi * pitch / middle)]
        return np.array(fits), np.full(len(fits), math.nan), standard
    count, size = (column.ravel() for column in np.meshgrid(numbers, sizes, indexing="ij"))
    kept = _fills(count, size, pitch) | (len(numbers) == 1)
    if not kept.any():
        raise ValueError("element_diameter: no number of such elements fills the pitch circle by 50 to 98 %")
    count, size = count[kept], size[kept]
    order = np.argsort(np.abs(np.log(size / middle)) / spread + np.abs(np.log(count * size / (2.7 * pitch))) / 0.1)
    return count[order][:LANES], size[order][:LANES], standard


def _usual_sizes(kind: str, middle: float, spread: float) -> np.ndarray:
    """Usual diameters of balls or cylindrical rollers within four standard deviations of `middle`, mm; `spread` is the
    standard deviation of the logarithm. Empty for tapered rollers and for a `middle` beyond the list."""
    if kind == "tapered":
        return np.empty(0)
    sizes = np.unique(np.round(ROLLER_SIZES if kind == "cylindrical" else BALL_SIZES, 6))
    if not sizes[0] < middle < sizes[-1]:
        return np.empty(0)
    return sizes[np.abs(np.log(sizes / middle)) < 4.0 * spread]


def _fills(count: np.integer | np.ndarray, size: np.ndarray, pitch: float) -> np.ndarray:
    fill = count * size / (math.pi * pitch)
    return (fill > FILLS[0]) & (fill < FILLS[1])


def _solved(
    ratings: Callable[[Array, Array], Array], counts: Array, sizes: Array, size_weight: Array, terms: dict[str, Array]
) -> dict[str, Array]:
    """The solutions of all candidates side by side; `ratings` gives ln of C and C0 from unknowns and number of
    elements."""

    def candidate(count: Array, size: Array) -> dict[str, Array]:
        residual = lambda x: _residual(x, count, size, size_weight, terms, ratings)

        def step(state: tuple[Array, ...], _: None) -> tuple[tuple[Array, ...], None]:
            """The residual and the factor of the normal equations at the state, and the next state."""
            x = state[0]
            left, jacobian = residual(x), jax.jacfwd(residual)(x)
            factor = cholesky(jacobian.T @ jacobian)
            change = cholesky_solve(factor, -jacobian.T @ left)
            longest = jnp.maximum(jnp.max(jnp.abs(change)), LONGEST_STEP)
            return (x + change * LONGEST_STEP / longest, x, left, factor), None

        start = terms["mean"].at[0].set(jnp.where(size_weight > 0.0, size, terms["mean"][0]))
        nothing = jnp.zeros(len(UNKNOWNS) + 6), jnp.eye(len(UNKNOWNS))
        (_, x, left, factor), _ = jax.lax.scan(step, (start, start, *nothing), length=STEPS)
        return {
            "x": x,
            "misfit": left @ left + 2.0 * jnp.sum(jnp.log(jnp.diagonal(factor))),
            "variance": jnp.diagonal(jax.vmap(partial(cholesky_solve, factor))(jnp.eye(len(UNKNOWNS)))),
            "ratings": ratings(x, count),
        }

    return jax.vmap(candidate)(counts, sizes)


def _residual(
    x: Array, count: Array, size: Array, size_weight: Array, terms: dict[str, Array], ratings: Callable[..., Array]
) -> Array:
    diameter, pitch = jnp.exp(x[0]), jnp.exp(x[1])
    log_fill = jnp.log(count / math.pi) + x[0] - x[1]
    gap = GAP[0] + GAP[1] * diameter + GAP[2] * pitch
    # arcsin is at most pi/2: candidates leave the balls room
    angle = (count - 1.0) * 2.0 * jnp.arcsin(jnp.minimum(diameter / pitch, 0.99))
    fills = jnp.stack([log_fill, log_fill + jnp.log1p(gap / diameter), jnp.log(angle / math.radians(FILL_ANGLE))])
    return jnp.concatenate(
        [
            (x - terms["mean"]) * terms["weight"],
            (ratings(x, count) - terms["rating"]) * terms["rating_weight"],
            (fills - terms["fill"]) * terms["fill_weight"],
            jnp.reshape((x[0] - size) * size_weight, (1,)),
        ]
    )


def _ball_ratings(x: Array, count: Array) -> Array:
    """Natural logarithms of C and C0, N, of ball bearings."""
    size, pitch = 1e-3 * jnp.exp(x[0]), 1e-3 * jnp.exp(x[1])
    inner, outer = 0.5 + jnp.exp(x[3]), 0.5 + jnp.exp(x[4])
    dynamic = ball_capacity(count, size, pitch, x[5], inner, outer)
    return jnp.log(jnp.stack([dynamic, ball_static_capacity(count, size, pitch, x[5], inner)]))


def _roller_ratings(x: Array, count: Array) -> Array:
    """Natural logarithms of C and C0, N, of roller bearings."""
    sizes = 1e-3 * jnp.exp(x[0]), 1e-3 * jnp.exp(x[1]), 1e-3 * jnp.exp(x[2]), x[5]
    return jnp.log(jnp.stack([roller_capacity(count, *sizes), roller_static_capacity(count, *sizes)]))


def _balls(counts: Array, sizes: Array, size_weight: Array, terms: dict[str, Array]) -> dict[str, Array]:
    return _solved(_ball_ratings, counts, sizes, size_weight, terms)


def _rollers(counts: Array, sizes: Array, size_weight: Array, terms: dict[str, Array]) -> dict[str, Array]:
    return _solved(_roller_ratings, counts, sizes, size_weight, terms)


_PROGRAMS = {"ball": KeptProgram(_balls, quick=True), "roller": KeptProgram(_rollers, quick=True)}


def _chosen(
    out: Mapping[str, np.ndarray],
    mask: np.ndarray,
    counts: np.ndarray,
    given: Mapping[str, float],
    angle: Normal,
    standard: bool,
) -> Geometry:
    """The geometry of the likeliest candidate, with intervals from all candidates."""
    misfit = np.where(mask & np.isfinite(out["misfit"]), out["misfit"], np.inf)
    best = int(np.argmin(misfit))
    if not np.isfinite(misfit[best]):
        raise ValueError("no geometry of this size has the numbers that were given")
    chance = np.exp(-0.5 * (misfit - misfit[best]))
    chance = chance / chance.sum()

    def spread(values: np.ndarray, variance: np.ndarray | float) -> tuple[float, float]:
        kept = np.where(chance > 0.0, values, 0.0)
        mean = float(chance @ kept)
        within = float(chance @ (np.where(chance > 0.0, variance, 0.0) + np.where(chance > 0.0, kept - mean, 0.0) ** 2))
        reach = QUANTILE * math.sqrt(within)
        at = float(values[best])
        return min(mean - reach, at), max(mean + reach, at)

    def of(name: str, field: str, law: Callable[[float], float]) -> Estimate:
        index = UNKNOWNS.index(name)
        values = out["x"][:, index]
        least, greatest = spread(values, out["variance"][:, index])
        if field in given or (name == "angle" and angle.is_known):
            # the term that holds it leaves round-off
            exact = float(given.get(field, angle.mean))
            return Estimate(exact, exact, exact, True)
        return Estimate(law(float(values[best])), law(least), law(greatest))

    length = lambda value: 1e-3 * math.exp(value)
    groove = lambda value: 0.5 + math.exp(value)
    number = int(counts[best])
    least, greatest = spread(np.resize(counts, len(mask)).astype(float), 0.0)
    n_elements = Estimate(number, math.floor(least + 0.5), math.ceil(greatest - 0.5), "n_elements" in given)
    ratings = np.exp(out["ratings"][best])
    return Geometry(
        n_elements=n_elements,
        diameter=of("diameter", "diameter", length),
        pitch_diameter=of("pitch", "pitch_diameter", length),
        length=of("length", "length", length),
        conformity_inner=of("inner_groove", "", groove),
        conformity_outer=of("outer_groove", "", groove),
        contact_angle=of("angle", "contact_angle", float),
        dynamic_capacity=float(ratings[0]),
        static_capacity=float(ratings[1]),
        standard_size=standard,
    )

r"""The delta method: scatter of results from the derivatives at the means.

$$\mu_y = y(\mu) + \sum_s g_s\,(E[u_s] - u_s(\mu))$$
$$\sigma_y^2 = \sum_k \Big(d_k + \sum_s g_s\beta_s a_{sk}\Big)^2\sigma_k^2
+ \sum_s g_s^2(\mathrm{Var}\,u_s - \beta_s^2\sigma_s^2)$$

$u_s$ is the interference that presses the rings at seat $s$ (`seats`). $d_k$ is the derivative of the result by field
$k$ with all $u_s$ fixed, $g_s$ its derivative by $u_s$, $a_{sk}$ the derivative of the interference in operation by
field $k$, $\beta_s$ the gain. If no seat may come loose, this is
$\sigma_y^2 = \sum_k (\partial y/\partial x_k)^2\sigma_k^2$. All fields are independent of each other, except those of a
posterior: these add $\partial y/\partial x_k\,\partial y/\partial x_j\,C_{kj}$ for each two of them, and are followed
along the principal axes of their distribution, which are independent.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from ..distribution import SIGMAS, Distribution
from ..loss_interval import SHARES, at_shares
from .derivatives import Slopes
from .outcome import Spread
from .results import labels_of
from .scatter import Scatter, name_of
from .seats import Seat, seat_of

Evaluated = Callable[[Mapping[str, float]], Slopes | None]
"""Results and derivatives at other numbers of the scene."""
_OF_SEAT = {"shaft": "fit.interference_inner", "housing": "fit.interference_outer"}
LIKELY = 0.9
"""Share of the bearings between the likely limits of a result."""
_SHARES = (np.arange(20_001) + 0.5) / 20_001
"""Middles of equally likely parts of a distribution."""
_MIXED = 400
"""Number of values of a distribution that are added to a normal variable; few suffice, as its curve is smooth."""
_TAIL = 1e-12
"""Probability outside of the interval in which a limit is searched for."""
_HALVINGS = 40
"""Number of bisections in that search; they end at 1e-12 of the first interval."""
_ROUND_OFF = 1e-12
"""Fraction of the variance that counts as round-off."""
_BENT = 0.1
"""Departure from a straight line, over the distance between the worst cases, above which a note is given."""


@dataclass(frozen=True)
class _Lines:
    """Derivatives of one result.

    **Arguments:**
    - `direct`: derivative by each field, with the interference that presses the rings fixed.
    - `pressed`: derivative by the interference that presses the rings, seat by seat.
    - `running`: derivative of the interference in operation by each field, seat by seat.
    """

    direct: dict[str, float]
    pressed: dict[str, float]
    running: dict[str, dict[str, float]]

    def by(self, path: str, gains: Mapping[str, float]) -> float:
        """Derivative by a field.

        **Arguments:** `gains`: change of what presses the rings with the interference in operation, seat by seat.
        """
        seats = (slope * gains[seat] * self.running[seat][path] for seat, slope in self.pressed.items())
        return self.direct[path] + sum(seats)


def spreads_of(
    scatter: Scatter, names: tuple[str, ...], at_means: Slopes, evaluated: Evaluated
) -> tuple[dict[str, Spread], list[str]]:
    """Scatter of each result, and notes in words.

    **Arguments:** `at_means`: results and derivatives at the means, from a solve that converged; `evaluated`: gives
    them at other numbers, or `None` for numbers that the scene refuses.
    """
    seats = _seats(scatter, at_means)
    at_tight = at_means
    if any(seat.slope == 0.0 for seat in seats.values()):
        at_tight = evaluated(scatter.means | {name_of(seat.name): seat.tight for seat in seats.values()})
        assert at_tight is not None  # every interference is a number of the scene
    lines = {name: _lines(name, scatter, seats, at_means, at_tight) for name in names}
    corners = {name: _corners(name, scatter, seats, line, at_means, at_tight) for name, line in lines.items()}
    solved = (evaluated(numbers) for pair in corners.values() for numbers in pair)
    cases = [at_means, *(case for case in solved if case is not None and _good(case))]
    labels = labels_of(at_means.solution, names)
    gains = {name: seat.slope for name, seat in seats.items()}
    curves, along = _curves(scatter, evaluated), _along_axes(scatter, evaluated)
    spreads = {}
    for name, own in lines.items():
        shift, shares = _moments(own, scatter, seats)
        variance = sum(shares.values())
        ends = [float(case.values[name]) for case in cases]
        spreads[name] = Spread(
            value=float(at_means.values[name]),
            mean=float(at_means.values[name]) + shift,
            deviation=float(np.sqrt(variance)),
            likely=_likely(
                own,
                gains,
                scatter,
                float(at_means.values[name]),
                shift,
                variance,
                {path: np.array([float(case.values[name]) for case in solved]) for path, solved in curves.items()},
                [None if cases is None else np.array([float(case.values[name]) for case in cases]) for cases in along],
            ),
            worst_low=min(ends),
            worst_high=max(ends),
            unit=labels[name].unit,
            description=labels[name].description,
            contributions={path: share / variance if variance > 0.0 else 0.0 for path, share in shares.items()},
            derivatives={path: own.by(path, gains) for path in scatter.fields},
        )
    at_ends = {name: tuple(map(evaluated, pair)) for name, pair in corners.items()}
    return spreads, [*_loose_notes(seats), *_bent_notes(spreads, scatter, at_ends)]


def _good(case: Slopes) -> bool:
    return bool(np.all(case.solution.converged))


def _seats(scatter: Scatter, at_means: Slopes) -> dict[str, Seat]:
    """The seats whose pressing interference may have a bend within the scatter."""
    seats = {}
    for name in scatter.seats:
        assert scatter.fits is not None
        running = at_means.slopes[_OF_SEAT[name]]
        slopes = {path: 1.0 if path == name_of(name) else float(running[path]) for path in scatter.fields}
        interference, now = scatter.means[name_of(name)], float(at_means.values[_OF_SEAT[name]])
        deviation = float(np.sqrt(max(sum(_parts(slopes, scatter).values()), 0.0)))
        seat = seat_of(scatter.fits, name, interference, now, deviation)
        if seat.bends_within:
            seats[name] = seat
    return seats


def _lines(name: str, scatter: Scatter, seats: Mapping[str, Seat], at_means: Slopes, at_tight: Slopes) -> _Lines:
    slopes = {path: float(at_means.slopes[name][path]) for path in scatter.fields}
    if name in _OF_SEAT.values():
        # the interference itself has no bend
        return _Lines(slopes, {}, {})
    pressed = {seat: float(at_tight.slopes[name][name_of(seat)]) for seat in seats}
    running = {seat: {p: float(at_means.slopes[_OF_SEAT[seat]][p]) for p in scatter.fields} for seat in seats}
    for seat, own in seats.items():
        running[seat][name_of(seat)] = 1.0
        for path in scatter.fields:
            slopes[path] -= pressed[seat] * own.slope * running[seat][path]
        if name_of(seat) in slopes:
            # an interference acts only by its part that presses the rings
            slopes[name_of(seat)] = 0.0
    return _Lines(slopes, pressed, running)


def _parts(slopes: Mapping[str, float], scatter: Scatter) -> dict[str, float]:
    """Part of each field in the variance of a linear result; fields that scatter together share their covariance."""
    parts = {path: (slopes[path] * field.deviation) ** 2 for path, field in scatter.fields.items()}
    for (path, other), covariance in scatter.covariances.items():
        parts[path] += slopes[path] * slopes[other] * covariance
    return parts


def _moments(lines: _Lines, scatter: Scatter, seats: Mapping[str, Seat]) -> tuple[float, dict[str, float]]:
    """Shift of the mean, and the part of each field in the variance."""
    gains = {seat: fit.gain for seat, fit in seats.items()}
    shares = _parts({path: lines.by(path, gains) for path in scatter.fields}, scatter)
    shift = sum(lines.by(path, gains) * (field.mean - field.nominal) for path, field in scatter.fields.items())
    for seat, slope in lines.pressed.items():
        own = seats[seat]
        mean, variance = own.moments()
        shift += slope * (mean - own.pressing)
        rest = slope**2 * max(variance - (own.gain * own.deviation) ** 2, 0.0)
        for path, part in _parts(lines.running[seat], scatter).items():
            shares[path] += rest * part / own.deviation**2 if own.deviation > 0.0 else 0.0
    return shift, shares


def _curves(scatter: Scatter, evaluated: Evaluated) -> dict[str, list[Slopes]]:
    """Solves over the distribution of each lognormal field, at `SHARES` of it, the others at their nominal values: such
    a field scatters too far for a straight line. Fields for which a solve fails are left out."""
    curves = {}
    for path, field in scatter.fields.items():
        if field.shape == "lognormal" and path not in scatter.together:
            cases = [evaluated(scatter.means | {path: float(x)}) for x in field.quantiles(SHARES)]
            solved = [case for case in cases if case is not None and _good(case)]
            if len(solved) == len(cases):
                curves[path] = solved
    return curves


_AXIS = Distribution(0.0, 1.0)
"""Distribution of the coordinate along a principal axis of a posterior."""


def _along_axes(scatter: Scatter, evaluated: Evaluated) -> list[list[Slopes] | None]:
    """Solves along each principal axis of the fields that scatter together, at `SHARES` of it; `None` for an axis on
    which a solve fails."""
    if scatter.joint is None:
        return []
    along: list[list[Slopes] | None] = []
    for axis in scatter.joint.axes:
        cases = [evaluated(scatter.means | scatter.joint.at(far * axis)) for far in _AXIS.quantiles(SHARES)]
        solved = [case for case in cases if case is not None and _good(case)]
        along.append(solved if len(solved) == len(cases) else None)
    return along


def _axis_steps(
    scatter: Scatter, slopes: Mapping[str, float], value: float, along: list[np.ndarray | None]
) -> dict[str, np.ndarray]:
    """Change of a result along each principal axis, at equally likely coordinates; linear where solves failed."""
    if scatter.joint is None:
        return {}
    tangent = scatter.joint.tangent * np.array([slopes[path] for path in scatter.joint.fields])
    steps = {}
    for number, (axis, solved) in enumerate(zip(scatter.joint.axes, along, strict=True)):
        line = float(tangent @ axis) * _AXIS.quantiles(_SHARES)
        steps[f"axis {number}"] = line if solved is None else at_shares(_AXIS, solved, _SHARES) - value
    return steps


def _likely(
    lines: _Lines,
    gains: Mapping[str, float],
    scatter: Scatter,
    value: float,
    shift: float,
    variance: float,
    curves: Mapping[str, np.ndarray],
    along: list[np.ndarray | None],
) -> tuple[float, float]:
    """Results below which 5 % and 95 % of the bearings are, by the linear model; the nonlinear part of the seats counts
    as a normal variable.

    **Arguments:** `value`: result at the nominal values; `shift` of the mean from it; `curves`: results at `SHARES`
    of the fields that are followed by solves instead of a line; `along`: the same for the principal axes of the fields
    that scatter together.
    """
    slopes = {path: lines.by(path, gains) for path in scatter.fields}
    alone = [path for path in scatter.fields if path not in scatter.together]
    bent = [path for path in alone if slopes[path] and scatter.fields[path].shape != "normal"]
    mean, steps = value + shift, _axis_steps(scatter, slopes, value, along)
    for path in scatter.together:
        mean -= slopes[path] * (scatter.fields[path].mean - scatter.fields[path].nominal)
    for path in bent:
        field = scatter.fields[path]
        if path in curves:
            mean -= slopes[path] * (field.mean - field.nominal)
            steps[path] = at_shares(field, curves[path], _SHARES) - value
        else:
            steps[path] = slopes[path] * (field.quantiles(_SHARES) - field.mean)
    parts = _parts(slopes, scatter)
    rest = variance - sum(parts[path] for path in (*bent, *scatter.together))
    normal = float(np.sqrt(max(rest, 0.0))) if rest > _ROUND_OFF * variance else 0.0
    ends = 0.5 * (1.0 - LIKELY), 0.5 * (1.0 + LIKELY)
    if len(steps) > 1:
        # each field takes its values in an order of its own
        order, total = np.random.default_rng(0), Distribution(mean, normal).quantiles(_SHARES)
        total = sum((order.permutation(step) for step in steps.values()), total)
        low, high = np.quantile(total, ends)
        return float(low), float(high)
    around = mean + (np.sort(next(iter(steps.values()))) if steps else np.zeros(1))
    low, high = (_mixed_quantile(around, normal, end) for end in ends)
    return low, high


def _mixed_quantile(around: np.ndarray, deviation: float, share: float) -> float:
    """Quantile of a sum: one of the equally likely numbers `around`, plus a normal variable."""
    if deviation == 0.0:
        return float(np.quantile(around, share))
    step = max(1, around.size // _MIXED)
    every = around[step // 2 :: step]
    normal = Distribution(0.0, deviation)
    low, high = (
        float(every[0] + normal.quantiles(np.array(_TAIL))),
        float(every[-1] + normal.quantiles(np.array(1.0 - _TAIL))),
    )
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        below = np.mean([NormalDist(0.0, deviation).cdf(middle - value) for value in every])
        low, high = (middle, high) if below < share else (low, middle)
    return 0.5 * (low + high)


def _corners(
    name: str, scatter: Scatter, seats: Mapping[str, Seat], lines: _Lines, at_means: Slopes, at_tight: Slopes
) -> tuple[dict[str, float], dict[str, float]]:
    """Numbers of the scene in both worst cases of a result: all fields at the limits that make it smallest,
    and largest, by its derivatives."""
    if name == "fit.contact_angle" and not any((*lines.direct.values(), *lines.pressed.values())):
        # without clearance the angle is 0, and so is its slope: its worst cases are those of the clearance
        lines = _lines("fit.clearance", scatter, seats, at_means, at_tight)
    low, high = dict(scatter.means), dict(scatter.means)
    tight = dict.fromkeys(seats, 1.0)
    slopes = {path: lines.by(path, tight) for path in scatter.fields}
    for path, field in scatter.fields.items():
        if slopes[path]:
            low[path], high[path] = (
                (field.lowest, field.highest) if slopes[path] > 0.0 else (field.highest, field.lowest)
            )
    if scatter.joint is not None:
        # all of them at their own limits at once would be outside of their joint distribution
        offset, _ = scatter.joint.steepest(slopes)
        low |= scatter.joint.at(-SIGMAS * offset)
        high |= scatter.joint.at(SIGMAS * offset)
    return low, high


_WHERE = {"shaft": "the inner ring may be loose on the shaft", "housing": "the outer ring may be loose in the housing"}


def _loose_notes(seats: Mapping[str, Seat]) -> list[str]:
    """Notes on seats that are loose in some bearings and tight in others."""
    notes = []
    for name, seat in seats.items():
        if any(abs(seat.mean - bend) < 3.0 * seat.deviation for _, bend in seat.bends):
            share = seat.loose_share
            notes.append(
                f"{_WHERE[name]} within the limits ({_percent(share)} of the bearings): the delta method takes what "
                "presses the rings as a rectified normal variable; compare with Monte Carlo (samples)"
            )
    return notes


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %" if share < 0.995 else f"{100.0 * share:.4g} %"


def _bent_notes(
    spreads: Mapping[str, Spread], scatter: Scatter, at_ends: Mapping[str, tuple[Slopes | None, ...]]
) -> list[str]:
    """Notes on results that are not linear up to the limits of the fields, or whose solve fails there."""
    bent, failed = [], []
    for name, spread in spreads.items():
        if not spread.moves:
            continue
        ends = [case for case in at_ends[name] if case is not None and _good(case)]
        if len(ends) < 2:
            failed.append(name)
            continue
        low, high = (float(case.values[name]) for case in ends)
        below, above = (_reach(spread, scatter, end) for end in (False, True))
        width = max(spread.worst_high - spread.worst_low, below + above)
        off = max(abs(spread.value - below - low), abs(spread.value + above - high))
        if width > 0.0 and off > _BENT * width:
            bent.append(f"{name} ({100.0 * off / width:.0f} %)")
    notes = []
    if bent:
        notes.append(
            f"not linear within the limits, by so much of the range of the worst cases: {', '.join(bent)}; "
            "compare the delta method with Monte Carlo (samples)"
        )
    if failed:
        notes.append(f"the solve fails in a worst case of {', '.join(failed)}")
    return notes


def _reach(spread: Spread, scatter: Scatter, high: bool) -> float:
    """Distance of a worst case from the result at the means, by the derivatives at the means."""
    reach = 0.0 if scatter.joint is None else SIGMAS * scatter.joint.steepest(spread.derivatives)[1]
    for path, slope in spread.derivatives.items():
        if path in scatter.together:
            continue
        field = scatter.fields[path]
        end = field.highest if (slope > 0.0) == high else field.lowest
        reach += abs(slope * (end - field.nominal))
    return reach

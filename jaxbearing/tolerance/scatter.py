"""Which numbers of a scene scatter: fields that are given as distributions, and seats that have a tolerance class."""

import dataclasses
import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import jax

from .._scene import AbstractScene
from ..bearings import priors
from ..distribution import Distribution
from ..joint import JointDistribution
from ..loss_interval import numbers_among
from ..mounting import Fits, iso286
from ..numerics.precision import as_float
from ..scenes.errors import SceneError
from ..scenes.reader import distributions_in, scene_from_tables, warn_of_preset
from ..sweeps.cases import Cases, listed
from ..sweeps.fields import SceneSource
from ..sweeps.recipe import Direct, in_scene

SEATS = {"shaft": ("bore", iso286.shaft_limits, iso286.bore_limits)}
"""Seat -> dimension of the bearing, function for the limits of the mating part, function for those of the bearing."""
SEATS["housing"] = ("outside_diameter", iso286.hole_limits, iso286.outside_limits)
_NOTHING = (
    "found no field that scatters; expected one given as {mean = ..., deviation = ...}, {low = ..., high = ...} or "
    "{median = ..., log_deviation = ...}, or a tolerance class in [fits] with at = 'mean'"
)

_ISOLATED = (
    f"{priors.DRAG_FIELD} is not given: it is that of an isolated ball and does not scatter; a number, such as "
    f"{priors.DRAG['ball'].nominal:g}, scatters by an assumed distribution"
)


@dataclasses.dataclass(frozen=True)
class Scatter:
    """A scene and the numbers in it that scatter.

    **Arguments:**
    - `scene`: scene with all fields at their means; seats with a tolerance class have numbers instead of it.
    - `fields`: distribution of each number that scatters, by dotted path, in SI.
    - `origins`: where the distribution of a seat comes from, in words.
    - `notes`: for the user.
    - `joint`: distribution of the fields that scatter together; each of them is also in `fields`, by itself.
    """

    scene: AbstractScene
    fields: dict[str, Distribution]
    origins: dict[str, str]
    notes: tuple[str, ...]
    joint: JointDistribution | None = None

    @property
    def together(self) -> tuple[str, ...]:
        """The fields that scatter together."""
        return () if self.joint is None else self.joint.fields

    @property
    def covariances(self) -> dict[tuple[str, str], float]:
        """Covariance of each two different fields that scatter together, in both orders, SI."""
        if self.joint is None:
            return {}
        matrix, fields = self.joint.of_values, self.joint.fields
        count = range(len(fields))
        return {(fields[i], fields[j]): float(matrix[i, j]) for i in count for j in count if i != j}

    @property
    def fits(self) -> Fits | None:
        """Fits of the seats, with numbers instead of tolerance classes."""
        return getattr(self.scene, "fits", None)

    @property
    def seats(self) -> tuple[str, ...]:
        """The seats of the bearing that have an interference."""
        fitted = lambda seat: getattr(self.fits, interference_of(seat), None) is not None
        return tuple(seat for seat in SEATS if fitted(seat))

    @property
    def means(self) -> dict[str, float]:
        """Means of all fields that scatter, medians of lognormal ones, and the interference of each seat."""
        seats = {name_of(seat): float(getattr(self.fits, interference_of(seat))) for seat in self.seats}
        return seats | {path: field.nominal for path, field in self.fields.items()}

    def recipe(self, cases: Cases) -> Direct:
        """Recipe for the scenes of the samples. **Raises:** as `scatter_of`."""
        return in_scene(self.scene, cases)


def interference_of(seat: str) -> str:
    return f"{seat}_interference"


def name_of(seat: str) -> str:
    """Dotted path of the interference of a seat."""
    return f"fits.{interference_of(seat)}"


def scatter_of(
    scene: AbstractScene,
    over: Mapping[str, object] | None = None,
    drag_prior: bool = True,
    posterior: JointDistribution | None = None,
) -> Scatter:
    """The numbers of a scene that scatter.

    **Arguments:** `over`: dotted path -> `Distribution`, or a mapping {"mean": ..., "deviation": ...} or {"low": ...,
    "high": ...} with a "shape" where it is uniform or lognormal, or {"median": ..., "log_deviation": ...} with "low"
    and "high" where it is cut off; SI numbers. `drag_prior`: True if the drag coefficient of a bearing scatters
    as `bearings.priors.DRAG`, unless it has another distribution. Where the supply is a level, the gap at the inlets
    scatters too, whatever `drag_prior` is.
    `posterior`: fields that scatter together; those that the scene does not have are left out.

    **Raises:** `ValueError` for what is no distribution, for a field that is no number of the scene, for one that has
    two distributions, for a posterior without a field of the scene, and where nothing scatters; `AttributeError` for a
    field that is not there.
    """
    distributions = {} if over is None else over
    if not isinstance(distributions, Mapping) or not all(isinstance(path, str) for path in distributions):
        raise ValueError(f"over must map dotted paths of fields to distributions, got {over!r}")
    fields = {path: _distribution(path, value) for path, value in distributions.items()}
    scene = jax.tree.map(as_float, scene)
    joint, left_out = _joint(scene, posterior, fields)
    if joint is not None:
        fields |= joint.marginals
    seats = dict(_seats(scene, fields))
    origins = {name_of(seat): f"{_class_of(scene, seat)} and the normal class of the bearing" for seat in seats}
    notes = [*left_out, *_unscattered(scene)]
    if joint is not None:
        origins |= dict.fromkeys(joint.fields, "posterior")
    origins |= {path: meaning for path in fields if (meaning := priors.meaning(scene, path))}
    prior = priors.drag_prior(scene) if drag_prior else None
    if prior is not None and fields.setdefault(priors.DRAG_FIELD, prior) == prior:
        origins[priors.DRAG_FIELD] = priors.prior_in_words(prior)
        notes += _prior_note(scene, prior)
    elif drag_prior and priors.DRAG_FIELD not in fields and priors.isolated(scene):
        notes.append(_ISOLATED)
    changes: dict[str, object] = {f"fits.{seat}_tolerance": None for seat in seats}
    supply = priors.supply_prior(scene)
    if supply is not None:
        # a level is a word: the number that it stands for scatters in its place
        changes[priors.LEVEL_FIELD] = None
        if fields.setdefault(priors.SUPPLY_FIELD, supply) == supply:
            origins[priors.SUPPLY_FIELD] = priors.prior_in_words(supply)
    changes |= {name_of(seat): own.mean for seat, own in seats.items()}
    changes |= {path: field.nominal for path, field in fields.items()}
    fields |= {name_of(seat): own for seat, own in seats.items()}
    fields = {path: field for path, field in fields.items() if field.deviation > 0.0 or field.lowest < field.highest}
    if not fields:
        raise ValueError(_NOTHING)
    ends = listed({path: [field.nominal, field.lowest, field.highest] for path, field in fields.items()})
    scene = jax.tree.map(as_float, scene.replace(changes))
    in_scene(scene, ends)
    return Scatter(scene, fields, origins, tuple(notes), joint)


def _joint(
    scene: AbstractScene, posterior: JointDistribution | None, others: Mapping[str, Distribution]
) -> tuple[JointDistribution | None, list[str]]:
    """The posterior of those of its fields that the scene has, and a note on its other fields."""
    if posterior is None:
        return None, []
    twice = [path for path in posterior.fields if path in others]
    if twice:
        raise ValueError(f"{twice[0]}: found a distribution and a posterior; expected one of them")
    there = numbers_among(scene, posterior.marginals)
    if priors.supply_prior(scene) is not None and priors.SUPPLY_FIELD in posterior.fields:
        there[priors.SUPPLY_FIELD] = posterior.marginals[priors.SUPPLY_FIELD]
    own = [path for path in posterior.fields if path in there]
    if not own:
        raise ValueError(f"posterior: found none of its fields {', '.join(posterior.fields)} in the scene")
    missing = [path for path in posterior.fields if path not in own]
    notes = [f"posterior: the scene does not have {', '.join(missing)}"] if missing else []
    return posterior.only(own), notes


def _prior_note(scene: Any, prior: Distribution) -> Iterator[str]:
    """Yields a note if the assumed distribution replaces the drag coefficient of the scene."""
    coefficient = float(scene.drag.coefficient)
    if not math.isclose(coefficient, prior.nominal, rel_tol=1e-9):
        yield (
            f"{priors.DRAG_FIELD}: the scene's {coefficient:g} gives way to the assumed distribution, whose median is "
            f"{prior.nominal:g}; give your own distribution, or switch it off (--no-drag-prior, drag_prior=False)"
        )


def scatter_of_source(
    source: str | Path,
    overrides: Mapping[str, str] | None = None,
    drag_prior: bool = True,
    posterior: JointDistribution | None = None,
) -> tuple[str, Scatter]:
    """Name of a scene file or built-in scene, and what scatters in it; `drag_prior` and `posterior` as those of
    `scatter_of`. A posterior prevails over the distributions of the file and the priors of its oil.

    **Raises:** `SceneError`; `ValueError` where nothing scatters.
    """
    read = SceneSource.of(source, overrides)
    distributions = distributions_in(read.tables, read.label, read.overrides, priors=True)
    scene = scene_from_tables(read.tables, read.label, read.overrides)
    warn_of_preset(read.tables, read.label, read.overrides)
    for path, distribution in distributions.items():
        _require_plain(read, path, distribution)
    if posterior is not None:
        distributions = {path: own for path, own in distributions.items() if path not in posterior.fields}
    return read.label, scatter_of(scene, distributions, drag_prior, posterior)


def _require_plain(read: SceneSource, path: str, distribution: Distribution) -> None:
    """Checks that the scene holds a field as the file gives it. **Raises:** `SceneError`."""
    cases = listed({path: [distribution.nominal, distribution.lowest, distribution.highest]})
    try:
        plain = isinstance(read.recipe(cases, {path: read.field(path, read.label)}), Direct)
    except SceneError:
        raise
    except ValueError:
        plain = False
    if not plain:
        expected = "one value: this field is a setting from which the scene computes others, it does not scatter"
        raise SceneError(read.label, path, "a distribution", expected)


def _distribution(path: str, value: Any) -> Distribution:
    """The distribution that is given for a field. **Raises:** `ValueError` that names the field."""
    if isinstance(value, Distribution):
        return value
    names = set(value) if isinstance(value, Mapping) else set()
    forms = {"mean", "deviation"}, {"low", "high"}
    lognormal = {"median", "log_deviation"} <= names <= {"median", "log_deviation", "low", "high"}
    if names - {"shape"} not in forms and not lognormal:
        raise ValueError(
            f"{path}: found {value!r}; expected a Distribution, or a mapping with either mean and deviation, or low "
            "and high, or median and log_deviation"
        )
    try:
        if lognormal:
            return Distribution.lognormal(**value)
        if "mean" in names:
            return Distribution(**value)
        return Distribution.between(**value)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{path}: {error}") from None


def _class_of(scene: Any, seat: str) -> str | None:
    return None if getattr(scene, "fits", None) is None else getattr(scene.fits, f"{seat}_tolerance")


def _seats(scene: Any, fields: Mapping[str, Distribution]) -> Iterator[tuple[str, Distribution]]:
    """Distribution of the interference of each seat that has a tolerance class.

    The two parts of a seat are made independently: their variances add up, each the square of a sixth of its
    tolerance. The limits are those of both parts together.
    """
    for seat, (dimension, of_part, of_bearing) in SEATS.items():
        tolerance = _class_of(scene, seat)
        if tolerance is None or scene.fits.at != "mean" or name_of(seat) in fields:
            continue
        diameter = getattr(scene.geometry, dimension)
        widths = [float(limits.upper - limits.lower) for limits in (of_part(tolerance, diameter), of_bearing(diameter))]
        low, high = (float(limit) for limit in scene.fits.limits(seat, diameter))
        yield seat, Distribution(0.5 * (low + high), math.hypot(*widths) / 6.0, "normal", low, high)


def _unscattered(scene: AbstractScene) -> Iterator[str]:
    fits = getattr(scene, "fits", None)
    if fits is not None and fits.at != "mean" and any(_class_of(scene, seat) is not None for seat in SEATS):
        yield f"fits.at = '{fits.at}': seats with a tolerance class stand at this limit and do not scatter"

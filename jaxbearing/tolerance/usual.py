"""Usual tolerances of the inputs of a scene: how far bearing, oil and operating point differ from the drawing.

Tolerances of bore, outside diameter and clearance come from tables of standards (ISO 492 and ISO 5753-1, normal
classes, and ISO 286 for the seats). Distributions that a scene gives itself are used as they are. All others are
assumptions, listed here with their reasons; they serve to rank inputs, and are no substitute for a drawing.
"""

import fnmatch
import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import equinox as eqx
import jax
import numpy as np

from .._scene import AbstractScene
from ..bearings import priors
from ..bearings.bearing import AbstractBearing
from ..catalogue.dimensions import clearance_limits
from ..distribution import Distribution
from ..mounting import iso286
from ..sensitivity import UsualTolerance
from ..shafts.paths import NUMBERED
from ..shafts.scene import ShaftSystem

BORE_OVER_PITCH = 0.7
"""Ratio of bore to pitch diameter by which a scene without a bore is found in the table of clearances."""
NOT_IN_THE_TABLE = 0.3
"""Tolerance over the clearance itself, where the table of clearances has no such bearing."""


class Assumed(NamedTuple):
    """An assumed tolerance.

    **Arguments:** `paths`: dotted paths, `*` for any part; `part`: relative tolerance, or `size`: absolute
    tolerance, SI; `reason`: in words.
    """

    paths: tuple[str, ...]
    part: float = 0.0
    size: float = 0.0
    reason: str = "assumed"


ASSUMED = (
    Assumed(("geometry.ball_diameter", "geometry.roller_diameter"), size=5e-6, reason="assumed: sorted lots"),
    Assumed(("geometry.roller_length", "geometry.contact_length"), size=50e-6),
    Assumed(("geometry.conformity_*",), size=0.003, reason="assumed: 0.003 of the ball diameter"),
    Assumed(("geometry.roller_half_angle",), size=math.radians(0.5 / 60.0), reason="assumed: 0.5 minutes of arc"),
    Assumed(("geometry.flange_angle",), size=math.radians(5.0 / 60.0), reason="assumed: 5 minutes of arc"),
    Assumed(("geometry.end_radius",), part=0.05),
    Assumed(("geometry.flange_stiffness",), part=0.5),
    Assumed(("geometry.flange_gap",), part=0.3),
    Assumed(("profile.*",), part=0.2),
    Assumed(("materials.*.youngs_modulus",), part=0.01),
    Assumed(("materials.*.poisson_ratio",), part=0.03),
    Assumed(("materials.*.density",), part=0.005),
    Assumed(("*.thermal_expansion",), part=0.05),
    Assumed(("materials.*.conductivity", "materials.*.heat_capacity"), part=0.2),
    Assumed(("cage.*_clearance", "flange.axial_clearance"), part=0.2),
    Assumed(("cage.land_width", "cage.*_diameter", "flange.height"), size=0.1e-3),
    Assumed(("flange.angle",), size=math.radians(0.1)),
    Assumed(("drag.through_flow_fraction",), part=0.3),
    Assumed(("oil.viscosity.viscosity*",), part=0.1, reason="ISO 3448: 10 % of a grade"),
    Assumed(("oil.pressure_viscosity.value",), part=0.15),
    Assumed(("oil.rheology.stress", "oil.rheology.shear_modulus"), part=0.3),
    Assumed(("oil.density.value",), part=0.01),
    Assumed(("oil.conductivity.value", "oil.heat_capacity.value"), part=0.05),
    Assumed(("contact.mixed.roughness", "rib.mixed.roughness", "rating.roughness_*"), part=0.3),
    Assumed(("contact.mixed.mu_boundary", "rib.mixed.mu_boundary"), part=0.2),
    Assumed(("contact.hysteresis",), part=0.5),
    Assumed(("contact.supply.*",), part=0.3),
    Assumed(("rating.*_capacity",), part=0.05),
    Assumed(("rating.fatigue_load_limit",), part=0.1),
    Assumed(("rating.viscosity_ratio",), part=0.2),
    Assumed(("temperatures.*", "thermal.ambient", "thermal.oil_inlet"), size=5.0, reason="assumed: 5 K"),
    Assumed(("thermal.conductance.*", "thermal.factor.*"), part=0.3),
    Assumed(("operation.oil_temperature", "operation.temperature"), size=5.0, reason="assumed: 5 K"),
    Assumed(("operation.*_speed",), part=0.01),
    Assumed(("operation.oil_flow", "operation.*load*", "operation.moment*"), part=0.1),
    Assumed(("operation.displacement.*", "operation.pressure"), part=0.1),
    Assumed(("operation.misalignment*",), part=0.2),
)
"""Assumed tolerances; the first one that fits a path counts. Those of loads, speeds and temperatures say how well an
operating point is usually known."""
ON_SHAFTS = (
    Assumed(("bearing.*.position", "set.*.position", "force.*.position"), size=0.1e-3),
    Assumed(("bearing.*.closure", "bearing.*.expansion", "set.*.expansion", "set.*.preload.offset"), size=1e-6),
    Assumed(("set.*.preload.*",), part=0.2),
    Assumed(("*.support.*",), part=0.3),
    Assumed(("force.*.pitch_radius", "shaft.sections.*.length"), size=0.1e-3),
    Assumed(("shaft.sections.*_diameter",), size=0.05e-3),
    Assumed(("force.*.azimuth", "force.*.pressure_angle", "force.*.helix_angle"), size=math.radians(0.5)),
    Assumed(("force.*",), part=0.1),
    Assumed(("shaft.speed",), part=0.01),
    Assumed(("shaft*.youngs_modulus",), part=0.01),
)
"""Assumed tolerances of the other parts of a shaft, without its bearings."""


def usual_tolerances(
    scene: AbstractScene, given: Mapping[str, Distribution] | None = None
) -> dict[str, UsualTolerance]:
    """Usual tolerances of the numbers of a scene by dotted path, as far as there are any.

    **Arguments:** `given`: distributions of a scene's fields (`jb.load_distributions`), which prevail.
    """
    if isinstance(scene, ShaftSystem):
        return _on_shaft(scene, given or {})
    tolerances = {}
    for path, value in _numbers(scene).items():
        own = (given or {}).get(path)
        if own is not None:
            tolerances[path] = UsualTolerance(0.5 * (own.highest - own.lowest), "as the scene says")
            continue
        usual = _standard_tolerance(scene, path, value) or _assumed(path, value)
        if usual is not None and math.isfinite(usual.size) and usual.size > 0.0:
            tolerances[path] = usual
    return tolerances


def _on_shaft(scene: ShaftSystem, distributions: Mapping[str, Distribution]) -> dict[str, UsualTolerance]:
    """Tolerances of a shaft, and of each of its bearings without the operating point of that bearing alone."""
    tolerances: dict[str, UsualTolerance] = {}
    for path, value in _numbers(scene).items():
        named = scene.path_in_file(path)
        usual = _assumed(named, value, ON_SHAFTS)
        if usual is not None and usual.size > 0.0:
            tolerances[named] = usual
    for word, entries in (("bearing", scene.bearings), ("set", scene.sets)):
        for entry in entries:
            above = f"{word}.{entry.name}"
            each = {above: entry.scene}
            if isinstance(entry.scene, tuple):
                each = {f"{above}.{NUMBERED}.{place + 1}": part for place, part in enumerate(entry.scene)}
            for name, bearing in each.items():
                inner = usual_tolerances(bearing) if isinstance(bearing, AbstractScene) else {}
                kept = {path: tolerance for path, tolerance in inner.items() if not path.startswith("operation.")}
                tolerances |= {f"{name}.{path}": tolerance for path, tolerance in kept.items()}
    tolerances |= {
        path: UsualTolerance(0.5 * (distribution.highest - distribution.lowest), "as the scene says")
        for path, distribution in distributions.items()
    }
    return tolerances


def _numbers(scene: AbstractScene) -> dict[str, float]:
    """The numbers of a scene by path."""
    leaves, _ = jax.tree_util.tree_flatten_with_path(scene)
    return {
        jax.tree_util.keystr(path, simple=True, separator="."): float(np.asarray(leaf))
        for path, leaf in leaves
        if eqx.is_array_like(leaf) and not isinstance(leaf, bool) and np.ndim(leaf) == 0
    }


def _assumed(path: str, value: float, among: tuple[Assumed, ...] = ASSUMED) -> UsualTolerance | None:
    """The first assumed tolerance that fits a path; `None` if none fits."""
    for rule in among:
        if any(fnmatch.fnmatchcase(path, pattern) for pattern in rule.paths):
            size = rule.size or rule.part * abs(value)
            reason = (
                f"{rule.reason}: {100.0 * rule.part:g} %" if rule.part and rule.reason == "assumed" else rule.reason
            )
            return UsualTolerance(size, reason)
    return None


def _standard_tolerance(scene: AbstractScene, path: str, value: float) -> UsualTolerance | None:
    """Tolerances that follow from a table, or from the size of the bearing."""
    rule = _STANDARDS.get(path)
    return None if rule is None or not isinstance(scene, AbstractBearing) else rule(scene, value)


def _half(limits: iso286.Limits) -> float:
    return 0.5 * float(limits.upper - limits.lower)


def _bore(scene: AbstractBearing, value: float) -> UsualTolerance:
    return UsualTolerance(_half(iso286.bore_limits(value)), "ISO 492, normal class")


def _outside(scene: AbstractBearing, value: float) -> UsualTolerance:
    return UsualTolerance(_half(iso286.outside_limits(value)), "ISO 492, normal class")


def _pitch(scene: AbstractBearing, value: float) -> UsualTolerance:
    return UsualTolerance(_half(iso286.shaft_limits("h6", value)), "assumed: IT6")


def _shaft_seat(scene: AbstractBearing, value: float) -> UsualTolerance | None:
    bore = scene.geometry.bore
    if bore is None:
        return None
    size = _half(iso286.shaft_limits("h6", bore)) + _half(iso286.bore_limits(bore))
    return UsualTolerance(size, "IT6 of the shaft and ISO 492 of the bore")


def _housing_seat(scene: AbstractBearing, value: float) -> UsualTolerance | None:
    outside = scene.geometry.outside_diameter
    if outside is None:
        return None
    size = _half(iso286.hole_limits("H7", outside)) + _half(iso286.outside_limits(outside))
    return UsualTolerance(size, "IT7 of the housing and ISO 492 of the outside diameter")


def _clearance(scene: AbstractBearing, value: float) -> UsualTolerance:
    """Half of the width of the normal clearance class."""
    geometry = scene.geometry
    bore = BORE_OVER_PITCH * geometry.pitch_diameter if geometry.bore is None else geometry.bore
    kind = "deep_groove" if scene.element == "ball" else "cylindrical"
    limits = clearance_limits(kind, "CN", 1e3 * float(bore))
    if limits is None:
        return UsualTolerance(NOT_IN_THE_TABLE * abs(value), f"assumed: {100.0 * NOT_IN_THE_TABLE:g} %")
    return UsualTolerance(0.5e-6 * (limits[1] - limits[0]), "ISO 5753-1, width of the normal class")


def _angle(scene: AbstractBearing, value: float) -> UsualTolerance:
    if scene.element == "ball":
        return UsualTolerance(math.radians(2.0), "assumed: 2 degrees")
    return UsualTolerance(math.radians(1.0 / 60.0), "assumed: a minute of arc")


def _drag(scene: AbstractBearing, value: float) -> UsualTolerance | None:
    """Standard deviation of the logarithm, which is to first order the relative deviation."""
    prior = priors.drag_prior(scene)
    if prior is None or prior.log_deviation is None:
        return None
    factor = math.exp(prior.log_deviation)
    return UsualTolerance(prior.log_deviation * value, f"known to a factor of {factor:.2g}: to first order")


_STANDARDS: dict[str, Callable[[AbstractBearing, float], UsualTolerance | None]] = {
    "geometry.bore": _bore,
    "geometry.outside_diameter": _outside,
    "geometry.pitch_diameter": _pitch,
    "geometry.diametral_clearance": _clearance,
    "geometry.contact_angle": _angle,
    "fits.shaft_interference": _shaft_seat,
    "fits.housing_interference": _housing_seat,
    priors.DRAG_FIELD: _drag,
}

"""From the scene on the drawing to the bearing that runs: one pure function, the same for all families.

Seats, temperatures and rotation make the raceways grow (`mounting`); a family says what that does to its dimensions
(`AbstractBearing.grown`). There is nothing to solve in it. Left out: temperature differences inside a part, shafts and
housings that are longer than the rings, shoulders and ribs of the rings, seats that are not round, the loss of
interference under load. Shoulders and the longer shaft are worth 5 % of what a fit does.
"""

import dataclasses
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import jax
import jax.numpy as jnp

from ..mounting import Annulus, Fit, Fits, FitState, PartTemperatures
from ..mounting.annulus import REFERENCE_TEMPERATURE
from ..numerics.checks import demand, numbers_or_none
from ..numerics.refusals import refusals_of, refuse_all
from .facts import Excess
from .growth import FitResult, Growth, Play
from .solution import FailureCause

if TYPE_CHECKING:
    from .bearing import AbstractBearing
else:
    AbstractBearing = Any

HIGHEST_STRESS = 127e6
"""Stress around the bore of the inner ring beyond which makers warn of bursting rings of through-hardened steel, Pa."""


class _Rings(NamedTuple):
    growth: Growth
    inner: Annulus
    on_shaft: FitState | None
    in_housing: FitState | None


def mounting_problems(scene: AbstractBearing) -> Iterator[str | ValueError]:
    """Yields a sentence for everything that a scene with seats lacks."""
    fits: Fits | None = scene.fits
    temperatures: PartTemperatures | None = scene.temperatures
    if fits is None:
        if temperatures is not None:
            yield "temperatures: they are those of a mounted bearing: the scene needs a [fits] table"
        return
    geometry = scene.geometry
    for name in ("bore", "outside_diameter"):
        if getattr(geometry, name) is None:
            yield f"geometry.{name}: found nothing, expected a length, which [fits] needs, e.g. '25 mm'"
    yield from refusals_of(fits.check_room, geometry.bore, geometry.outside_diameter)
    yield from refusals_of(check_walls, scene)
    if temperatures is None and scene.thermal is None:
        return
    materials: dict[str, Any] = {
        "materials.rings": scene.materials.rings,
        f"materials.{scene.element}s": getattr(scene.materials, f"{scene.element}s"),
        "fits.shaft_material": fits.shaft_material if fits.on_shaft else None,
        "fits.housing_material": fits.housing_material if fits.in_housing else None,
    }
    for name, material in materials.items():
        if material is not None and material.thermal_expansion is None:
            who = "[temperatures]" if scene.thermal is None else "[thermal]"
            needed = f"expected a number, which {who} needs, e.g. '12.5e-6 1/K'"
            yield f"{name}.thermal_expansion: found nothing, {needed}"


def check_walls(scene: AbstractBearing) -> None:
    """**Raises:** `ValueError` where a ring has no wall between its seat and its raceway."""
    geometry = scene.geometry
    sizes = numbers_or_none(*(leaf for leaf in jax.tree.leaves(geometry)), geometry.bore, geometry.outside_diameter)
    if sizes is None:
        return
    inner, outer = scene.raceway_diameters
    problems: list[ValueError] = []
    for name, word, of, raceway, fine in (
        ("bore", "less", "inner", inner, geometry.bore < inner),
        ("outside_diameter", "more", "outer", outer, geometry.outside_diameter > outer),
    ):
        text = f"geometry.{name} must be {word} than the diameter of the {of} raceway"
        said = lambda name=name, text=text, raceway=raceway: (
            f"{text}, {float(raceway):.6g} m, got {float(getattr(geometry, name)):.6g} m"
        )
        problems += refusals_of(demand, text, fine, said)
    refuse_all(problems)


def running_scene(scene: AbstractBearing) -> tuple[Any, FitResult | None, dict[str, FailureCause]]:
    """The bearing that runs: a scene of the same family without seats, whose dimensions are those of the mounted, warm
    and turning bearing.

    **Returns:** the scene, the state of its seats (`None` without them), and what of its dimensions may be impossible.
    """
    if scene.fits is None:
        return scene, None, {}
    cold = _rings(scene, warm=False, turning=False)
    warm = _rings(scene, warm=True, turning=False) if scene.temperatures is not None else cold
    found = _rings(scene, warm=True, turning=True)
    plays = [scene.play(growth) for growth in (_still(), cold.growth, warm.growth, found.growth)]
    drawn, fitted, heated, turning = (one.measure for one in plays)
    last, of = plays[-1], found
    radial = scene.play_is_clearance
    result = FitResult(
        clearance=last.measure if radial else None,
        contact_angle=last.contact_angle,
        axial_shift=last.axial_shift,
        drawn=drawn,
        by_fits=fitted - drawn,
        by_temperatures=heated - fitted,
        by_speed=turning - heated,
        growth_inner=of.growth.inner,
        growth_outer=of.growth.outer,
        interference_inner=None if of.on_shaft is None else of.on_shaft.interference,
        interference_outer=None if of.in_housing is None else of.in_housing.interference,
        pressure_inner=None if of.on_shaft is None else of.on_shaft.pressure,
        pressure_outer=None if of.in_housing is None else of.in_housing.pressure,
        loose_speed=None if of.on_shaft is None else of.on_shaft.loose_speed,
        hoop_stress=of.inner.hoop_stress_at_bore(0.0 if of.on_shaft is None else of.on_shaft.pressure),
    )
    unseated = dataclasses.replace(scene, fits=None, temperatures=None)
    return unseated.grown(found.growth), result, _impossible(last)


def _impossible(play: Play) -> dict[str, FailureCause]:
    """Maps a sentence to whether it applies: causes that leave the running bearing without contacts."""
    return {"fits and temperatures leave the rolling elements no contact": FailureCause(~play.possible, jnp.zeros(0))}


def running_play(scene: AbstractBearing) -> Play:
    """The play of a scene with seats, mounted, warm and turning at its speeds."""
    return scene.play(_rings(scene, warm=True, turning=True).growth)


def _still() -> Growth:
    zero = jnp.zeros(())
    return Growth(zero, zero, zero, zero, zero)


def _rings(scene: Any, warm: bool, turning: bool) -> _Rings:
    """Growth of the rings; cold or at rest where asked for."""
    fits, temperatures, operation = scene.fits, scene.temperatures, scene.operation
    geometry, rings = scene.geometry, scene.materials.rings
    elements = getattr(scene.materials, f"{scene.element}s")

    def body(material: Any, bore: Any, outside: Any, speed: Any, temperature: Any) -> Annulus:
        warming = temperature - REFERENCE_TEMPERATURE if warm and temperatures is not None else 0.0
        return Annulus(material, jnp.asarray(bore), jnp.asarray(outside), speed if turning else 0.0, warming)

    inner_raceway, outer_raceway = scene.raceway_diameters
    at = lambda name: None if temperatures is None else getattr(temperatures, name)
    bore, outside = geometry.bore, geometry.outside_diameter
    inner = body(rings, bore, inner_raceway, operation.inner_speed, at("inner_ring"))
    outer = body(rings, outer_raceway, outside, operation.outer_speed, at("outer_ring"))
    growth_inner, growth_outer = inner.free(inner_raceway), outer.free(outer_raceway)
    on_shaft = in_housing = None
    if fits.on_shaft:
        shaft = body(fits.shaft_material, fits.shaft_bore, bore, operation.inner_speed, at("of_shaft"))
        on_shaft = _fit(fits, "shaft", shaft, inner, bore)
        growth_inner = growth_inner + inner.pressed(inner_raceway, on_shaft.pressure, 0.0)
    if fits.in_housing:
        wall = fits.housing_diameter(outside)
        housing = body(fits.housing_material, outside, wall, operation.outer_speed, at("of_housing"))
        in_housing = _fit(fits, "housing", outer, housing, outside)
        growth_outer = growth_outer + outer.pressed(outer_raceway, 0.0, in_housing.pressure)
    element = body(elements, 0.0, 1.0, 0.0, at("of_elements"))
    growth = Growth(growth_inner, growth_outer, inner.strain, outer.strain, element.strain)
    return _Rings(growth, inner, on_shaft, in_housing)


def _fit(fits: Fits, seat: Any, inner: Annulus, outer: Annulus, diameter: Any) -> FitState:
    interference = fits.interference(seat, diameter)
    return Fit(inner, outer, interference, fits.smoothed(interference)).state()


def fit_excess(scene: AbstractBearing, fit: FitResult) -> Excess:
    """Maps each warning about the seats to a number that is positive where the warning applies."""
    operation, found = scene.operation, {}
    if fit.interference_inner is not None:
        turning = jnp.abs(jnp.asarray(operation.inner_speed)) > 0.0
        text = "the inner ring is loose on the shaft, where it will creep: a tighter fits.shaft_interference is needed"
        found[text] = jnp.where(turning, -fit.interference_inner, -1.0)
    if fit.interference_outer is not None:
        turning = jnp.abs(jnp.asarray(operation.outer_speed)) > 0.0
        text = "the outer ring is loose in the housing that turns: a tighter fits.housing_interference is needed"
        found[text] = jnp.where(turning, -fit.interference_outer, -1.0)
    found["stress around the bore of the inner ring beyond 127 MPa, where makers warn of bursting rings"] = (
        fit.hoop_stress - HIGHEST_STRESS
    )
    return found

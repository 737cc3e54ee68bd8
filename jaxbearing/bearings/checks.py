"""Range checks of all kinds of bearings: warnings if a result or an input lies outside the range of a law or of the
usual use of a bearing.

A steady solve provides its contacts (`Contacts`, one row per place: inner raceway, outer raceway, rib). Every check, of
this file or of the family (`RangeChecks` of its scene), maps a text to a number that is positive if the warning
applies. Checks of contacts are evaluated for each place separately, over its own loaded contacts, so that the
centrifugal load on the outer raceway does not decide which contacts count on the inner one. If a scene does not model
the quantity that a check needs, the check adds no entry.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from .._checks import Information
from .._types import Scalar
from ..contacts import Gupta
from ..contacts.laws import SPEED_SMOOTHING
from ..lubricants.ranges import FITTED_PRESSURE, FITTED_TEMPERATURES
from ..numerics import lapack
from ..numerics.safe import smooth_abs
from .cage import AbstractCage
from .facts import BUSY, Contacts, Excess, Facts, SolvedBearing
from .ring_shape import AbstractBendingRing
from .solution import CageState, RingDisplacement

if TYPE_CHECKING:
    from .bearing import AbstractBearing
else:
    AbstractBearing = Any

SKIDDING = 0.1
"""Ratio of sliding to rolling speed, both along the rolling direction, above which the laws for rolling are
extrapolated."""
EDGE_LOADED = 1.5
"""Load per length at a roller end over the mean, above which a warning is given."""
LARGEST_TILT = 10e-3
"""Largest tilt without a warning, rad. The second-order displacement, which linear equations neglect, is 5 um over
100 mm at this tilt."""
ROUGH, HEAVY = 0.01, 0.5e9
"""Load share of asperities, and Hertz pressure, Pa; if both are exceeded, the load share is known only to a factor
of 10."""
STARVED = 0.5
"""Film over flooded film below which a contact is strongly starved."""
THICK_RIM = 0.2
"""Thickness over radius of the centroid circle above which a ring is not thin: the curvature changes the stiffness by
about the square of this ratio, 4 %."""
MORE_THAN_WALL = 1.01
"""Thickness of a flexible ring over the wall between its raceway and its seat, above which a warning is given."""
LARGEST_INTERFERENCE, LARGEST_CLEARANCE = 1e-3, 1e-2
"""Largest interference and largest diametral clearance over the pitch diameter without a warning. Rings stretched by a
thousandth have a stress of 0.2 GPa; the widest clearance classes are about a thousandth."""
SLOWEST = 99.9 * 2.0 * np.pi / 60.0
"""Relative speed of the rings below which the lubricated models have no meaning, rad/s (just below 100 rpm)."""


def result_excess(
    scene: AbstractBearing, facts: Facts, ring: RingDisplacement, cage: CageState | None, held: bool = False
) -> Excess:
    """Excess of the results over the ranges of laws and bearings: text of a warning -> number that is positive if it
    applies.

    **Arguments:** `held`: True if the displacement of the ring is prescribed and the loads of the scene do not act."""
    result, excess = SolvedBearing(scene, facts, ring, cage, held), {}
    for check in (*scene.range_checks().results, *RESULT_CHECKS):
        excess |= check(result)
    return excess


def input_excess(scene: AbstractBearing, held: bool = False) -> Excess:
    """Like `result_excess`, but of the scene alone. These warnings also hold for failed solves and for transient
    runs."""
    own, excess = scene.range_checks(), {}
    for check in (*(() if held else own.loads), *own.inputs, *INPUT_CHECKS):
        excess |= check(scene)
    return excess


# -- contacts -------------------------------------------------------------------------------------------------------


def _yield(result: SolvedBearing) -> Excess:
    limit = result.scene.yield_pressure
    beyond = f"contact pressure beyond {1e-9 * limit:g} GPa on {{place}}"
    text = f"{beyond}: {result.elements} and races yield (static rating of ISO 76)"
    return result.said(text, lambda contacts: contacts.most(contacts.pressure) - limit)


def _skid(result: SolvedBearing) -> Excess:
    text = (
        f"{result.elements} with more than a tenth of the largest load skid on {{place}} (sliding above a tenth of "
        "rolling): film and rolling resistance are laws for rolling"
    )

    def skidding(contacts: Contacts) -> Array | None:
        if contacts.sliding is None or contacts.mean_speed is None or not result.scene.slips:
            return None
        slide = jnp.abs(contacts.sliding / smooth_abs(contacts.mean_speed, SPEED_SMOOTHING))
        return contacts.most(slide, BUSY) - SKIDDING

    return result.said(text, skidding)


def _hot(result: SolvedBearing) -> Excess:
    text = Information("oil in the contacts of {place} beyond 200 degC: the oil laws are extrapolated")

    def hot(contacts: Contacts) -> Array | None:
        return None if contacts.temperature is None else contacts.most(contacts.temperature) - FITTED_TEMPERATURES[1]

    return result.said(text, hot)


def _sheared(result: SolvedBearing) -> Excess:
    text = Information("mean contact pressure beyond 1.8 GPa on {place}: the traction rheology is extrapolated")

    def sheared(contacts: Contacts) -> Array | None:
        if contacts.laws is None or contacts.laws.traction is None:
            return None
        return contacts.mean_share * contacts.most(contacts.pressure) - FITTED_PRESSURE

    return result.said(text, sheared)


def _rough(result: SolvedBearing) -> Excess:
    text = Information(
        "asperities carry more than 1 % of a load on {place} at a pressure beyond 0.5 GPa: their share is known to a "
        "factor of 10 there, and so is the boundary friction"
    )

    def rough(contacts: Contacts) -> Array | None:
        if contacts.load_share is None:
            return None
        return contacts.most(jnp.where(contacts.pressure > HEAVY, contacts.load_share, 0.0)) - ROUGH

    return result.said(text, rough)


def _gupta(result: SolvedBearing) -> Excess:
    def fitted(contacts: Contacts) -> Excess:
        thermal, inlet = None if contacts.laws is None else contacts.laws.thermal, contacts.inlet
        if not isinstance(thermal, Gupta) or contacts.mean_speed is None or inlet is None:
            return {}
        loading = contacts.most(thermal.thermal_loading(contacts.mean_speed, inlet))
        text = Information("thermal loading beyond 20 on {place}: Gupta's factor is extrapolated")
        excess = contacts.said(text, loading - 20.0)
        if contacts.sliding is not None:
            slide = contacts.most(thermal.slide_ratio(contacts.mean_speed, contacts.sliding))
            text = Information("slide ratio of a loaded contact beyond 2 on {place}: Gupta's factor is extrapolated")
            excess |= contacts.said(text, slide - 2.0)
        return excess

    return result.each(fitted)


def _starved(result: SolvedBearing) -> Excess:
    thin = (
        "{place} is strongly starved: the film is less than half of the flooded one, and follows the supply, "
        "which is known to a factor of 3 at best"
    )
    inside = (
        "the meniscus of contact.supply.meniscus_distance lies inside the contact on {place}: nothing enters it, "
        "and film and rolling resistance have no meaning"
    )

    def starved(contacts: Contacts) -> Excess:
        supply = contacts.starved
        if supply is None:
            return {}
        excess = contacts.said(thin, contacts.most(STARVED - supply.film_factor))
        return excess if supply.reach is None else excess | contacts.said(inside, contacts.most(supply.reach - 1.0))

    return result.each(starved)


def _on_edge(result: SolvedBearing) -> Excess:
    text = (
        "rollers are loaded on an edge of {place}, with more than 1.5 times their mean load per length at an end: the "
        "peak of pressure at the edge is higher than these results have it, and the film thinner than at mid length"
    )

    def on_edge(contacts: Contacts) -> Array | None:
        laminae = contacts.laminae
        if laminae is None:
            return None
        busy = contacts.loaded(BUSY)
        mean = jnp.where(busy, contacts.load, 1.0) / laminae.shape[2]
        end = jnp.maximum(laminae[..., 0], laminae[..., -1]) / mean
        return contacts.most(end, BUSY) - EDGE_LOADED

    return result.said(text, on_edge)


def _cut_off(result: SolvedBearing) -> Excess:
    text = "contact ellipse cut off at {}: pressure and losses are too low"

    def cut_off(contacts: Contacts) -> Excess:
        if contacts.past_edge is None:
            return {}
        beyond = contacts.most(contacts.past_edge)
        return {text.format(edge): beyond[i] for i, edge in enumerate(contacts.edges) if edge is not None}

    return result.each(cut_off)


# -- the whole bearing ----------------------------------------------------------------------------------------------


def _cage_contact(result: SolvedBearing) -> Excess:
    text = "cage eccentricity beyond 0.98: the land nearly touches, its film law saturates"
    return {} if result.cage is None else {text: result.cage.eccentricity_ratio - 0.98}


def _tilted(result: SolvedBearing) -> Excess:
    roller = result.facts.roller_tilt
    if not result.held and not result.scene.operation.tilts and roller is None:
        return {}
    tilt = jnp.maximum(jnp.abs(result.ring.tilt), jnp.abs(result.ring.tilt_lateral))
    if roller is not None:
        tilt = jnp.maximum(tilt, jnp.max(jnp.abs(roller)))
    if not result.scene.line_contacts:
        text = "the inner ring tilts by more than 10 mrad: more than ball bearings are made for"
    else:
        text = (
            "the inner ring or a rolling element tilts by more than 10 mrad: far beyond what bearings of this kind "
            "bear (cylindrical rollers 1 to 2 mrad), and the equations are those of small tilts"
        )
    return {text: tilt - LARGEST_TILT}


def _unstable(result: SolvedBearing) -> Excess:
    stiffness = result.facts.stiffness
    if stiffness is None:
        return {}
    text = (
        "the equilibrium is unstable: the ring is free to tilt, and the least thrust or moment tips it into another "
        "one; give it a small axial load, or hold its tilt (leave out the moment)"
    )
    return {text: -lapack.lowest_eigenvalue(stiffness)}


RESULT_CHECKS: tuple[Callable[[SolvedBearing], Excess], ...] = (
    _yield,
    _skid,
    _cut_off,
    _tilted,
    _unstable,
    _on_edge,
    _hot,
    _sheared,
    _rough,
    _gupta,
    _starved,
    _cage_contact,
)
"""Checks of results for all bearings, in the order of the warnings. The checks of a family come before these."""

# -- the scene itself -----------------------------------------------------------------------------------------------


def _inlet(scene: AbstractBearing) -> Excess:
    if scene.contact is None:
        return {}
    temperature, (low, high) = jnp.asarray(scene.operation.oil_temperature), FITTED_TEMPERATURES
    return {
        Information("inlet oil beyond 200 degC: the oil laws are extrapolated"): temperature - high,
        Information("inlet oil below -20 degC: the oil laws are extrapolated"): low - temperature,
    }


def _slow(scene: AbstractBearing) -> Excess:
    if scene.contact is None or scene.contact.mixed is not None:
        return {}
    text = "rings turn against each other at less than 100 rpm: the films vanish, consider a dry scene"
    return {text: SLOWEST - jnp.abs(jnp.asarray(scene.operation.inner_speed) - scene.operation.outer_speed)}


def _wide_land(scene: AbstractBearing) -> Excess:
    cage: AbstractCage | None = getattr(scene, "cage", None)
    if cage is None or not scene.slips:
        return {}
    text = Information("land wider than a third of its radius: the short journal film overestimates")
    return {text: jnp.asarray(cage.land_width - cage.land_diameter(scene.geometry) / 6.0)}


def _clearance(scene: AbstractBearing) -> Excess:
    clearance: Scalar | None = getattr(scene.geometry, "diametral_clearance", None)
    if clearance is None:
        return {}
    text = (
        "clearance beyond what bearings have (interference, which is below 0, of more than a thousandth of the pitch "
        "diameter, or more than a hundredth of play): check sign and unit of geometry.diametral_clearance"
    )
    part = jnp.asarray(clearance) / scene.geometry.pitch_diameter
    return {text: jnp.maximum(-part - LARGEST_INTERFERENCE, part - LARGEST_CLEARANCE)}


def _thick_rim(scene: AbstractBearing) -> Excess:
    rings: list[AbstractBendingRing | None] = [getattr(scene, f"{side}_ring", None) for side in ("inner", "outer")]
    excess = {}
    for side, ring in enumerate(rings):
        if ring is None or not ring.harmonics:
            continue
        text = Information(
            f"the {('inner', 'outer')[side]} ring is thicker than a fifth of its radius: the bending of a thin ring is "
            "wrong by about the square of this ratio, 4 % and more"
        )
        raceway, thickness = 0.5 * scene.raceway_diameters[side], jnp.asarray(ring.thickness)
        excess[text] = thickness / ring.centroid_radius(raceway) - THICK_RIM
        seat = (scene.geometry.bore, scene.geometry.outside_diameter)[side]
        if seat is not None:
            text = Information(
                f"{ring.part}.thickness is more than the wall between raceway and seat: a section of this height bends "
                "less than the ring"
            )
            excess[text] = thickness - MORE_THAN_WALL * jnp.abs(0.5 * seat - raceway)
    return excess


INPUT_CHECKS: tuple[Callable[[AbstractBearing], Excess], ...] = (
    _inlet,
    _slow,
    _wide_land,
    _thick_rim,
    _clearance,
)
"""Checks of scenes for all bearings."""

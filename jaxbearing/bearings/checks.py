"""Range checks of every kind of bearing: where a result, or the scene itself, leaves what a law or a bearing is for.

A steady solve states its contacts (`Contacts`, one row per place: inner raceway, outer raceway, rib). Every check of
`RESULT_CHECKS` and `INPUT_CHECKS` maps a text to a number that is positive where the warning applies. Checks of
contacts are stated for each place by itself, over its own loaded contacts: the centrifugal load on the outer raceway
does not decide what counts on the inner one. A check adds nothing to a scene that does not model what it is about.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from ..contacts import Gupta
from ..contacts.laws import SPEED_SMOOTHING, ContactLaws
from ..contacts.point_laws import PointLaws
from ..lubricants import InletOil
from ..lubricants.ranges import FITTED_PRESSURE, FITTED_TEMPERATURES
from ..numerics.safe import safe_norm, smooth_abs
from .ball.scene import BallBearing
from .cylindrical.kinematics import roller_kinematics
from .cylindrical.scene import CylindricalRollerBearing
from .parts import azimuths
from .solution import CageState, RingDisplacement
from .tapered.scene import TaperedRollerBearing

MEAN_OF_POINT, MEAN_OF_LINE = 2.0 / 3.0, 0.25 * np.pi
"""Mean over peak of Hertz's pressure."""
BALL_PRESSURE, ROLLER_PRESSURE = 4.2e9, 4.0e9
"""Hertz pressure of the most loaded contact at the static rating, Pa (ISO 76, [M])."""
LOADED = 0.01
"""Part of the largest load at the same place from which on a contact counts."""
BUSY = 0.1
"""Part of the largest load at the same place from which on the distribution of a load along a roller counts, and from
which on a tapered roller keeps itself rolling; a cage takes the others along."""
SKIDDING = 0.1
"""Sliding along rolling over the rolling speed, from which on the laws made for rolling are extrapolated."""
EDGE_LOADED = 1.5
"""Load per length at an end over the mean."""
LARGEST_TILT = 10e-3
"""rad; the square of 10 mrad moves 100 mm by 5 um."""
LARGEST_INTERFERENCE = 1e-3
"""Largest interference over the pitch diameter: rings that are stretched so much carry 0.2 GPa."""
SLOWEST = 99.9 * 2.0 * np.pi / 60.0
"""Speed of the rings against each other below which the lubricated models have no meaning, rad/s (100 rpm)."""

Scene = BallBearing | CylindricalRollerBearing | TaperedRollerBearing
Excess = dict[str, Array]


class Contacts(NamedTuple):
    """Contacts of one kind, as the checks see them; what is not modelled, or has no limit, is `None`.

    - `places`: names of the rows; `load`, N; `pressure`, peak of Hertz's, Pa; `mean_share`: mean over peak.
    - `laws`: of the film and what shears it; `mean_speed` and `sliding` along rolling, m/s; `temperature` of the oil in
      the contact, K.
    - `laminae`: loads along the rollers, N.
    - `angle`: contact angle, rad.
    - `past_edge`: by how much a contact ellipse passes the end of what it rests on, positive where it is cut off, for
      the rows whose `edges` name such an end.
    """

    places: tuple[str, ...]
    load: Float[Array, "place element"]
    pressure: Float[Array, "place element"]
    mean_share: float
    laws: ContactLaws | PointLaws | None = None
    mean_speed: Float[Array, "place _"] | None = None
    sliding: Float[Array, "place element"] | None = None
    temperature: Float[Array, "place element"] | None = None
    laminae: Float[Array, "place element lamina"] | None = None
    angle: Float[Array, "place element"] | None = None
    past_edge: Float[Array, "place element"] | None = None
    edges: tuple[str | None, ...] = ()

    def loaded(self, part: float = LOADED) -> Bool[Array, "place element"]:
        """Contacts that count: with at least this part of the largest load at the same place."""
        return (self.load > 0) & (self.load >= part * jnp.max(self.load, axis=1, keepdims=True))

    def most(self, values: Array, part: float = LOADED) -> Float[Array, " place"]:
        """Largest of the values over the contacts that count; -inf where none does."""
        return jnp.max(jnp.where(self.loaded(part), values, -jnp.inf), axis=1)

    def said(self, text: str, excess: Float[Array, " place"]) -> Excess:
        """One entry for each place, which stands in the text as {place}."""
        return {text.format(place=place): excess[i] for i, place in enumerate(self.places)}


RACEWAYS = ("the inner raceway", "the outer raceway")


class Facts(NamedTuple):
    """Facts that a steady solve states for the checks.

    - `contacts`: kinds of contacts.
    - `inlet`: the oil that enters the bearing.
    - `traction_reserve`: of tapered rollers that roll by constraint, what the films could carry less what it takes, N.
    - `roller_tilt`: of rollers that may tilt, rad.
    - `stiffness`: tangent stiffness of a ring that is free to tilt, of its freedoms counted as lengths, N/m.
    """

    contacts: tuple[Contacts, ...]
    inlet: InletOil | None = None
    traction_reserve: Float[Array, "2 roller"] | None = None
    roller_tilt: Float[Array, " roller"] | None = None
    stiffness: Float[Array, "freedom freedom"] | None = None


class _Result(NamedTuple):
    """A solved bearing, as the checks of results see it."""

    scene: Scene
    facts: Facts
    ring: RingDisplacement
    cage: CageState | None
    held: bool

    @property
    def elements(self) -> str:
        return "balls" if isinstance(self.scene, BallBearing) else "rollers"


def result_excess(
    scene: Scene, facts: Facts, ring: RingDisplacement, cage: CageState | None, held: bool = False
) -> Excess:
    """Excess of the results over the ranges of laws and bearings: text -> number, positive where it applies.
    `held`: the ring is where it is told to be, whatever the loads of the scene."""
    result, found = _Result(scene, facts, ring, cage, held), {}
    for check in RESULT_CHECKS:
        found |= check(result)
    return found


def input_excess(scene: Scene, held: bool = False) -> Excess:
    """Like `result_excess`, of the scene itself: to be said of failed solves, and of runs in time, too."""
    found: Excess = {}
    for check in INPUT_CHECKS:
        if not (held and check in LOAD_CHECKS):
            found |= check(scene)
    return found


# -- contacts -------------------------------------------------------------------------------------------------------


def _yield(result: _Result) -> Excess:
    balls = isinstance(result.scene, BallBearing)
    limit = BALL_PRESSURE if balls else ROLLER_PRESSURE
    beyond = f"contact pressure beyond {1e-9 * limit:g} GPa on {{place}}"
    text = f"{beyond}: {result.elements} and races yield (static rating of ISO 76)"
    return _each(result, lambda contacts: contacts.said(text, contacts.most(contacts.pressure) - limit))


def _skid(result: _Result) -> Excess:
    text = (
        f"{result.elements} skid on {{place}} (sliding above a tenth of rolling): film and rolling resistance are laws "
        "for rolling"
    )

    def skidding(contacts: Contacts) -> Excess:
        if contacts.sliding is None or contacts.mean_speed is None or not result.scene.slips:
            return {}
        slide = jnp.abs(contacts.sliding / smooth_abs(contacts.mean_speed, SPEED_SMOOTHING))
        return contacts.said(text, contacts.most(slide) - SKIDDING)

    return _each(result, skidding)


def _hot(result: _Result) -> Excess:
    text = "oil in the contacts of {place} beyond 200 degC: the oil laws are extrapolated"

    def hot(contacts: Contacts) -> Excess:
        if contacts.temperature is None:
            return {}
        return contacts.said(text, contacts.most(contacts.temperature) - FITTED_TEMPERATURES[1])

    return _each(result, hot)


def _sheared(result: _Result) -> Excess:
    text = "mean contact pressure beyond 1.8 GPa on {place}: the traction rheology is extrapolated"

    def sheared(contacts: Contacts) -> Excess:
        if contacts.laws is None or contacts.laws.traction is None:
            return {}
        return contacts.said(text, contacts.mean_share * contacts.most(contacts.pressure) - FITTED_PRESSURE)

    return _each(result, sheared)


def _gupta(result: _Result) -> Excess:
    inlet = result.facts.inlet

    def fitted(contacts: Contacts) -> Excess:
        thermal = None if contacts.laws is None else contacts.laws.thermal
        if not isinstance(thermal, Gupta) or contacts.mean_speed is None or inlet is None:
            return {}
        loading = contacts.most(thermal.thermal_loading(contacts.mean_speed, inlet))
        found = contacts.said("thermal loading beyond 20 on {place}: Gupta's factor is extrapolated", loading - 20.0)
        if contacts.sliding is not None:
            slide = contacts.most(thermal.slide_ratio(contacts.mean_speed, contacts.sliding))
            text = "slide ratio of a loaded contact beyond 2 on {place}: Gupta's factor is extrapolated"
            found |= contacts.said(text, slide - 2.0)
        return found

    return _each(result, fitted)


def _on_edge(result: _Result) -> Excess:
    text = (
        "rollers are loaded on an edge of {place}, with more than 1.5 times their mean load per length at an end: the "
        "peak of pressure there is higher than that of laminae, and the film thinner than at mid length"
    )

    def on_edge(contacts: Contacts) -> Excess:
        laminae = contacts.laminae
        if laminae is None:
            return {}
        busy = contacts.loaded(BUSY)
        mean = jnp.where(busy, contacts.load, 1.0) / laminae.shape[2]
        end = jnp.maximum(laminae[..., 0], laminae[..., -1]) / mean
        return contacts.said(text, contacts.most(end, BUSY) - EDGE_LOADED)

    return _each(result, on_edge)


def _cut_off(result: _Result) -> Excess:
    text = "contact ellipse cut off at {}: pressure and losses are too low"

    def cut_off(contacts: Contacts) -> Excess:
        if contacts.past_edge is None:
            return {}
        beyond = contacts.most(contacts.past_edge)
        return {text.format(edge): beyond[i] for i, edge in enumerate(contacts.edges) if edge is not None}

    return _each(result, cut_off)


def _angles(result: _Result) -> Excess:
    scene = result.scene

    def leaning(contacts: Contacts) -> Excess:
        if contacts.angle is None or not isinstance(scene, BallBearing):
            return {}
        # the groove of the model is a full circle
        text = "a loaded ball touches the groove of {place} beyond 90°, where no groove is: it cannot run so"
        found = contacts.said(text, contacts.most(jnp.abs(contacts.angle)) - 0.5 * np.pi)
        if scene.geometry.contact_angle is not None:
            text = "a loaded ball leans on the other shoulder of {place}: an angular-contact bearing has none there"
            found |= contacts.said(text, contacts.most(-contacts.angle) - 1e-9)
        return found

    return _each(result, leaning)


def _each(result: _Result, check: Callable[[Contacts], Excess]) -> Excess:
    found: Excess = {}
    for contacts in result.facts.contacts:
        found |= check(contacts)
    return found


# -- the whole bearing ----------------------------------------------------------------------------------------------


def _cage_touches(result: _Result) -> Excess:
    text = "cage eccentricity beyond 0.98: the land nearly touches, its film law saturates"
    return {} if result.cage is None else {text: result.cage.eccentricity_ratio - 0.98}


def _would_skid(result: _Result) -> Excess:
    reserve = result.facts.traction_reserve
    if reserve is None:
        return {}
    # each of those that roll by themselves, and, since a cage hands on what others lack, all together
    own = result.facts.contacts[0].loaded(BUSY)[:1]
    least = jnp.minimum(jnp.min(jnp.where(own, reserve, jnp.inf)), jnp.min(jnp.sum(reserve, axis=1)))
    text = (
        "rollers would skid (to keep them rolling takes more traction than the raceway films have at 10 % sliding): "
        "speeds and losses are those of pure rolling"
    )
    return {text: -least}


def _tilted(result: _Result) -> Excess:
    roller = result.facts.roller_tilt
    if not result.held and not result.scene.operation.tilts and roller is None:
        return {}
    tilt = jnp.maximum(jnp.abs(result.ring.tilt), jnp.abs(result.ring.tilt_lateral))
    if roller is not None:
        tilt = jnp.maximum(tilt, jnp.max(jnp.abs(roller)))
    if isinstance(result.scene, BallBearing):
        text = "the inner ring tilts by more than 10 mrad: more than ball bearings are made for"
    else:
        text = (
            "the inner ring or a rolling element tilts by more than 10 mrad: far beyond what bearings of this kind "
            "bear (cylindrical rollers 1 to 2 mrad), and the equations are those of small tilts"
        )
    return {text: tilt - LARGEST_TILT}


def _unstable(result: _Result) -> Excess:
    stiffness = result.facts.stiffness
    if stiffness is None:
        return {}
    text = (
        "the equilibrium is unstable: the ring is free to tilt, and the least thrust or moment tips it into another "
        "one; give it a small axial load, or hold its tilt (leave out the moment)"
    )
    return {text: -jnp.linalg.eigvalsh(0.5 * (stiffness + stiffness.T))[0]}


def _squeezed(result: _Result) -> Excess:
    scene = result.scene
    if not isinstance(scene, CylindricalRollerBearing) or not scene.tilts or result.held:
        return {}
    load = result.facts.contacts[0].load
    azimuth = azimuths(scene.geometry, load.shape[1])
    outward = jnp.stack([jnp.cos(azimuth), jnp.sin(azimuth)])
    resultant = outward @ load[0]
    opposite = resultant @ outward < -0.5 * safe_norm(resultant[0], resultant[1])
    behind = jnp.max(jnp.where(opposite, load[0], 0.0))
    loose = jnp.asarray(scene.geometry.diametral_clearance) > 0
    text = "the tilt takes up the whole clearance: rollers opposite the load are squeezed"
    return {text: jnp.where(loose, behind - LOADED * jnp.max(load), -1.0)}


RESULT_CHECKS: tuple[Callable[[_Result], Excess], ...] = (
    _yield,
    _skid,
    _would_skid,
    _angles,
    _cut_off,
    _tilted,
    _unstable,
    _on_edge,
    _squeezed,
    _hot,
    _sheared,
    _gupta,
    _cage_touches,
)
"""All checks of results, in the order of the warnings."""

# -- the scene itself -----------------------------------------------------------------------------------------------


def _interference(scene: Scene) -> Excess:
    clearance = getattr(scene.geometry, "diametral_clearance", None)
    if clearance is None or isinstance(scene, BallBearing):  # a ball bearing has none below 0
        return {}
    text = (
        "interference (a clearance below 0) beyond a thousandth of the pitch diameter: no fit makes so much; check "
        "sign and unit of geometry.diametral_clearance"
    )
    return {text: -jnp.asarray(clearance) - LARGEST_INTERFERENCE * scene.geometry.pitch_diameter}


def missing_thrust(scene: BallBearing) -> Float[Array, ""]:
    r"""$1.22F_r\tan\alpha - F_a$, N, of an angular contact bearing: positive where fewer than half of its balls are
    loaded (Harris, *Rolling Bearing Analysis*)."""
    operation, angle = scene.operation, jnp.asarray(scene.geometry.contact_angle)
    axial = jnp.asarray(0.0 if operation.axial_load is None else operation.axial_load)
    return 1.22 * operation.radial_size * jnp.tan(angle) - jnp.abs(axial)


def _thrust(scene: Scene) -> Excess:
    if not isinstance(scene, BallBearing):
        return {}
    operation = scene.operation
    across = operation.radial_load is not None or operation.radial_load_lateral is not None
    if scene.geometry.contact_angle is None or operation.displaced or not across:
        return {}
    text = (
        "axial load below 1.22 F_r tan(contact angle): fewer than half of the balls of this angular contact bearing "
        "carry load; it needs an axial load or a second bearing that preloads it"
    )
    return {text: missing_thrust(scene)}


def _inlet(scene: Scene) -> Excess:
    if scene.contact is None:
        return {}
    temperature, (low, high) = jnp.asarray(scene.operation.oil_temperature), FITTED_TEMPERATURES
    return {
        "inlet oil beyond 200 degC: the oil laws are extrapolated": temperature - high,
        "inlet oil below -20 degC: the oil laws are extrapolated": low - temperature,
    }


def _slow(scene: Scene) -> Excess:
    if scene.contact is None:
        return {}
    text = "rings turn against each other at less than 100 rpm: the films vanish, consider a dry scene"
    return {text: SLOWEST - jnp.abs(jnp.asarray(scene.operation.inner_speed) - scene.operation.outer_speed)}


def _standing_cage(scene: Scene) -> Excess:
    if scene.contact is None or not isinstance(scene, CylindricalRollerBearing):
        return {}
    motion = roller_kinematics(scene.geometry, scene.operation)
    text = "rolling without slip would nearly hold the cage still: its slip has no meaning"
    return {text: 0.01 * motion.orbit_unit - jnp.abs(motion.free_orbit)}


def _wide_land(scene: Scene) -> Excess:
    cage: Any = getattr(scene, "cage", None)
    if cage is None or not scene.slips:
        return {}
    diameter = cage.bore(scene.geometry) if cage.guidance == "inner_ring" else cage.outside(scene.geometry)
    text = "land wider than a third of its radius: the short journal film overestimates"
    return {text: jnp.asarray(cage.land_width - diameter / 6.0)}


def _at_apex(scene: Scene) -> Excess:
    if not isinstance(scene, TaperedRollerBearing):
        return {}
    if scene.operation.load("tilt") is None and scene.operation.load("tilt_lateral") is None:
        return {}
    text = (
        "operation.load_position is 0: radial load and moment act at the common apex of the cones, not at the "
        "bearing's middle"
    )
    return {text: jnp.where(jnp.asarray(scene.operation.load_position) == 0.0, 1.0, -1.0)}


INPUT_CHECKS: tuple[Callable[[Scene], Excess], ...] = (
    _interference,
    _thrust,
    _inlet,
    _slow,
    _standing_cage,
    _wide_land,
    _at_apex,
)
"""All checks of scenes, in the order of the warnings."""
LOAD_CHECKS = (_thrust, _at_apex)
"""Checks of the operating point's loads: they say nothing about a held ring."""

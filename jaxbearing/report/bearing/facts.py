"""Facts about a solution besides losses and loads, as text for the screen and the page."""

import dataclasses
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ...bearings.flanks import on_heavier_flanks
from ...bearings.minimum_films import thinnest_film
from ...bearings.ring_deflection import AbstractRingDeflection
from ...bearings.solution import RING_FREEDOMS, Solution, force_units, stiffness_units
from ...materials import BALL_PRESSURE, ROLLER_PRESSURE
from ..display import digits, with_unit
from .fit_facts import fit_facts
from .life_facts import life_facts
from .thermal_facts import thermal_facts


def not_modelled(solution: Solution) -> str:
    """The parts that the scene does not model, as text: losses, and the gyroscopic couple if it matters."""
    names = ", ".join(name.replace("_", " ") for name in solution.not_modelled)
    losses = f"all power losses ({names})" if solution.power_loss.total is None else names
    return "; ".join(text for text in (losses, left_out_couple(solution)) if text)


def left_out_couple(solution: Solution) -> str:
    """The gyroscopic couple of the balls that the scene neglects, as text; "" if friction carries it easily."""
    elements = on_heavier_flanks(solution.elements)
    limit = getattr(elements, "gyroscopic_limit", None)
    if limit is None:
        return ""
    couple, most = np.abs(np.asarray(elements.gyroscopic_couple)), float(np.sum(np.asarray(limit)))
    share = float(np.sum(couple)) / most if most > 0.0 else 0.0
    if not share > LEFT_OUT:
        return ""
    size = f"up to {with_unit(float(np.max(couple)), 'N m', 3)} a ball"
    return f"gyroscopic couple ({size}, {digits(100.0 * share, 3)} % of what the contacts' friction can carry)"


def overload(solution: Solution) -> str:
    """The raceways whose pressure is above the yield limit, and a static load above the static rating, as text; "" for
    a bearing that carries its load. For several stacked states the worst values are used."""
    limit = BALL_PRESSURE if solution.element_name == "ball" else ROLLER_PRESSURE
    elements, life = on_heavier_flanks(solution.elements), solution.life
    texts = []
    for side in ("inner", "outer"):
        largest = float(np.nanmax(np.asarray(getattr(elements, f"pressure_{side}")), initial=0.0))
        if largest > limit:
            texts.append(f"{with_unit(largest, 'Pa')} on the {side} raceway ({1e-9 * limit:g} GPa is the limit)")
    if life is not None and life.static_safety is not None and np.any(np.asarray(life.static_safety) < 1.0):
        texts.append(f"static load {with_unit(float(np.max(np.asarray(life.static_load))), 'N')} beyond C0")
    return ", ".join(texts)


def facts(solution: Solution) -> Iterator[tuple[str, str]]:
    """Name and text of each fact that an engineer wants to know besides losses and loads."""
    yields = overload(solution)
    if yields:
        yield OVERLOAD, f"{solution.element_name}s and races yield: {yields}. Every result is that of elastic bodies"
    if solution.cage is not None:
        cage = solution.cage
        slip = f"slip {digits(100.0 * float(cage.slip), 3)} %"
        place = f"eccentricity ratio {digits(float(cage.eccentricity_ratio), 3)}"
        angle = f"attitude angle {with_unit(float(cage.attitude_angle), 'rad', 3)}"
        yield "Cage", f"{with_unit(float(cage.speed), 'rad/s')}, {slip}, {place}, {angle}"
        yield from _sliding_facts(solution)
    rolling = solution.rolling_by_race
    if rolling is not None:
        parts = f"inner {digits(float(rolling.inner))} W, outer {digits(float(rolling.outer))} W"
        yield "Rolling by race", f"{parts} ({rolling.law})"
    yield from _mixed_facts(solution)
    if solution.fit is not None:
        yield from fit_facts(solution.fit, float(solution.operation.outer_speed))
    if solution.thermal is not None:
        yield from thermal_facts(solution.thermal)
    inner, ring = solution.inner_ring, solution.outer_ring
    yield "Inner ring", ", ".join([*_ring(solution), *([] if inner is None else [bending(inner)])])
    if ring is not None:
        yield "Outer ring", bending(ring)
    held = ", ".join(_held(solution))
    if held:
        yield "Held by", held
    yield from _ball_facts(solution)
    yield from _tapered_facts(solution)
    yield "Stiffness", ", ".join(_stiffness(solution))
    for title, name, pick in (
        ("Thinnest film", thinnest_film(solution.elements), np.nanargmin),
        ("Highest pressure", "pressure", np.argmax),
    ):
        text = ", ".join(extremes(solution.elements, name, pick))
        if text:
            yield title, text
    yield from _supply(solution)
    yield from _frequencies(solution)
    for name, text in life_facts(solution) if solution.life is not None else ():
        yield name, f"{NO_LIFE}: {text}" if yields and name == "Life" else text


def bending(ring: AbstractRingDeflection) -> str:
    """The smallest and the largest deflection of a ring, as text."""
    deflection = np.asarray(ring.deflection)
    least, most = (with_unit(float(value), "m") for value in (np.min(deflection), np.max(deflection)))
    return f"bends outwards by {least} to {most}"


def _sliding_facts(solution: Solution) -> Iterator[tuple[str, str]]:
    """The fastest sliding of the elements along the rolling direction, on each race."""
    elements, texts = on_heavier_flanks(solution.elements), []
    for side in ("inner", "outer"):
        sliding = getattr(elements, f"sliding_{side}", None)
        if sliding is not None and np.all(np.isfinite(sliding)):
            most = int(np.argmax(np.abs(sliding)))
            place = with_unit(float(elements.azimuth[most]), "rad", 3)
            texts.append(f"{side} race {with_unit(float(sliding[most]), 'm/s', 3)} (at {place})")
    if texts:
        yield "Fastest sliding", ", ".join(texts)


def _mixed_facts(solution: Solution) -> Iterator[tuple[str, str]]:
    """Boundary friction as part of the losses; smallest film ratio and largest asperity load share of each contact
    side."""
    power = solution.boundary_power
    if power is None:
        return
    total, rubbed = float(np.asarray(solution.power_loss.total)), float(np.asarray(power.total))
    part = f" ({digits(100.0 * rubbed / total, 3)} % of the losses)" if total else ""
    yield "Mixed friction", f"boundary friction {digits(rubbed)} W{part}"
    elements = on_heavier_flanks(solution.elements)
    for side, place in (("inner", "inner raceway"), ("outer", "outer raceway"), ("flange", "rib")):
        ratio = getattr(elements, f"film_ratio_{side}", None)
        if ratio is None or np.all(np.isnan(ratio)):
            continue
        share = 100.0 * float(np.nanmax(getattr(elements, f"load_share_{side}")))
        text = f"film ratio from {digits(float(np.nanmin(ratio)), 3)}, asperities carry up to {digits(share, 3)} %"
        flash = getattr(elements, f"flash_{side}", None)
        if flash is not None:
            text += f", flash temperature up to {digits(float(np.nanmax(flash)), 3)} K"
        yield "", f"{place}: {text}"


def _frequencies(solution: Solution) -> Iterator[tuple[str, str]]:
    """Defect frequencies, from the computed motion and from the textbook formulas."""
    if solution.textbook_frequencies is None:
        return
    names = {
        "cage": "cage (FTF)",
        "outer_pass": "outer ring (BPFO)",
        "inner_pass": "inner ring (BPFI)",
        "element_spin": "element's spin (BSF)",
    }
    for title, frequencies in (("Frequencies", solution.frequencies), ("Textbook's", solution.textbook_frequencies)):
        texts = (f"{words} {digits(float(np.asarray(getattr(frequencies, name))))}" for name, words in names.items())
        yield title, f"{', '.join(texts)} Hz"


def _supply(solution: Solution) -> Iterator[tuple[str, str]]:
    """The oil supply, and its effect on film and rolling friction of the most loaded contacts."""
    supply = solution.supply
    if supply is None:
        return
    yield "Oil supply", supply.stated
    if supply.film_factor_inner is None:
        return
    for side in ("inner", "outer"):
        of = lambda name, side=side: digits(float(getattr(supply, f"{name}_{side}")), 3)
        factors = f"film factor {of('film_factor')}, rolling factor {of('rolling_factor')}"
        yield "", f"{side} race {factors}, inlet gap {of('gap_over_central')} times the central film"


def _ball_facts(solution: Solution) -> Iterator[tuple[str, str]]:
    """Contact angles, attitude angle and spin of the most loaded ball, contacts of the loaded balls, and raceway
    losses."""
    elements = on_heavier_flanks(solution.elements)
    if getattr(elements, "attitude_angle", None) is None:
        return
    j = int(np.argmax(np.asarray(elements.load_inner)))
    of = lambda name: float(np.asarray(getattr(elements, name))[j])
    degrees = lambda name: f"{np.degrees(of(name)):.2f} deg"
    yield "Contact angles", f"inner {degrees('contact_angle_inner')}, outer {degrees('contact_angle_outer')}"
    if elements.loaded_contacts is not None:
        counts = np.asarray(elements.loaded_contacts)
        least, most = int(np.min(counts[counts > 0], initial=4)), int(np.max(counts))
        yield "Contacts", f"{most if least >= most else f'{least} to {most}'} of each loaded ball"
    control = ""
    if elements.raceway_control is not None:
        control = f", raceway control {of('raceway_control'):.1f} % (100: outer, 0: inner)"
    yield "Ball's spin", f"{with_unit(of('spin_speed'), 'rad/s')} at {degrees('attitude_angle')}{control}"
    ratios = f"inner {digits(of('spin_to_roll_inner'), 3)}, outer {digits(of('spin_to_roll_outer'), 3)}"
    yield "Spin to roll", ratios
    power = solution.raceway_power
    if power is not None:
        parts = {
            kind: sum(float(getattr(power, f"{side}_{kind}")) for side in ("inner", "outer"))
            for kind in _KINDS
            if getattr(power, f"inner_{kind}") is not None
        }
        yield "Raceways", ", ".join(f"{digits(watts)} W {_KINDS[kind]}" for kind, watts in parts.items())


def _tapered_facts(solution: Solution) -> Iterator[tuple[str, str]]:
    """Load, pressure, film, sliding and traction of the most loaded contact of a roller end with the rib."""
    elements = solution.elements
    if getattr(elements, "load_flange", None) is None:
        return
    load, pressure = (np.asarray(getattr(elements, f"{name}_flange")) for name in ("load", "pressure"))
    j = int(np.argmax(load))
    at = f"(at {np.degrees(float(np.asarray(elements.azimuth)[j])):.0f} deg)"
    yield "Rib", f"largest load {digits(float(load[j]))} N, pressure {with_unit(float(pressure[j]), 'Pa')} {at}"
    if elements.film_flange is None or load[j] <= 0.0:
        return
    of = lambda name: np.asarray(getattr(elements, name))[j]
    texts = [
        f"film {with_unit(float(of('film_flange')), 'm')}",
        f"sliding {with_unit(float(of('sliding_flange')), 'm/s')}",
    ]
    if elements.traction_flange is not None:
        texts.append(f"traction {digits(float(of('traction_flange')), 3)} N")
    yield "", ", ".join(texts)


_KINDS = {
    "spin": "of spin",
    "rolling": "of sliding along rolling",
    "transverse": "of sliding across",
    "curvature": "of Heathcote slip",
}


LEFT_OUT = 0.01
"""Ratio of the gyroscopic couple to the couple that friction can carry, summed over all balls, above which a neglected
couple is reported."""
OVERLOAD = "Overload"
"""Name of the fact which says that contacts yield."""
NO_LIFE = "none, because it yields; the formulas, which do not hold here, give"
_LOADS = {
    "axial": "axial load",
    "radial": "radial load",
    "lateral": "lateral load",
    "tilt": "moment",
    "tilt_lateral": "moment about the load line",
}


def _ring(solution: Solution) -> Iterator[str]:
    for field in dataclasses.fields(solution.ring):
        if field.name in solution.ring_freedom:
            value = float(getattr(solution.ring, field.name))
            yield f"{field.metadata['description']} {with_unit(value, field.metadata['unit'])}"


def _held(solution: Solution) -> Iterator[str]:
    """The loads that hold the fixed degrees of freedom, except those that are 0."""
    for name, unit, value in zip(RING_FREEDOMS, force_units(), np.asarray(solution.force), strict=True):
        if name in solution.held_freedom and value != 0.0:
            about = _point_of_moments(solution) if name.startswith("tilt") else ""
            yield f"{_LOADS[name]} {with_unit(float(value), unit)}{about}"


def _point_of_moments(solution: Solution) -> str:
    """The point on the axis of a tapered bearing about which moments are taken, as text; "" for other bearings."""
    position = getattr(solution.operation, "load_position", None)
    if position is None:
        return ""
    place = float(np.asarray(position))
    if place == 0.0:
        return " about the apex (operation.load_position = 0)"
    return f" about the load position, {1e3 * place:.4g} mm from the apex (operation.load_position)"


def _stiffness(solution: Solution) -> Iterator[str]:
    """The diagonal entries of the stiffness: for each modelled degree of freedom, with the others fixed."""
    matrix, units = np.asarray(solution.stiffness), stiffness_units()
    for i, name in enumerate(RING_FREEDOMS):
        if name in solution.freedoms_of_stiffness:
            yield f"{name.replace('_', ' ')} {with_unit(float(matrix[i, i]), units[i][i])}"
    others = [name.replace("_", " ") for name in RING_FREEDOMS if name not in solution.freedoms_of_stiffness]
    if others:
        yield f"not modelled: {', '.join(others)}"


def extremes(elements: Any, name: str, pick: Callable[[np.ndarray], np.intp]) -> Iterator[str]:
    """The value that `pick` selects on each race, and its azimuth, as text."""
    elements = on_heavier_flanks(elements)
    for field in dataclasses.fields(elements):
        values = getattr(elements, field.name)
        touches = values is not None and not np.all(np.isnan(np.asarray(values)))
        if touches and field.name in (f"{name}_inner", f"{name}_outer"):
            j = int(pick(np.asarray(values)))
            side = field.name.removeprefix(f"{name}_")
            at = f"{np.degrees(float(np.asarray(elements.azimuth)[j])):.0f} deg"
            yield f"{side} race {with_unit(float(np.asarray(values)[j]), field.metadata['unit'])} (at {at})"

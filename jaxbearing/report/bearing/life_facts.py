"""Facts about the life of a bearing, in words: lives, ratings and loads, static safety, least load, lubrication."""

from collections.abc import Iterator

import numpy as np

from ...bearings.solution import Solution
from ...life.basic import MINIMUM_LOADS
from ..display import digits

TITLES = ("Life", "Rating", "Load", "Static safety", "Least load", "Lubrication")
"""Titles of these facts."""
SAID = ("life.L10m", "life.L10mh", "life.static_safety", "life.minimum_load")
"""Results that follow from others and stand in these facts."""
_LIVES = (
    ("Lnmr", "Lnmr_hours", "modified life Lnmr"),
    ("L10r", "L10r_hours", "basic reference life L10r"),
    ("L10m", "L10mh", "ISO 281 modified L10m"),
    ("L10", "L10h", "ISO 281 L10"),
)


def life_facts(solution: Solution) -> Iterator[tuple[str, str]]:
    """Name and text of each fact about the life of a solution that has one."""
    life = solution.life
    assert life is not None
    of = lambda name: float(np.asarray(getattr(life, name)))
    # what the catalogues' formulas do not give is NaN
    there = lambda name: getattr(life, name) is not None and not np.isnan(of(name))
    kilonewton = lambda name: f"{digits(1e-3 * of(name))} kN"
    lasting = lambda name, hours: f"{digits(of(hours))} h ({digits(of(name))} million revolutions)"
    known = [f"{words} {lasting(name, hours)}" for name, hours, words in _LIVES if there(name)]
    yield "Life", "; ".join(known)
    yield "Rating", f"C {kilonewton('dynamic_capacity')}, C0 {kilonewton('static_capacity')}"
    said = [f"equivalent to the contacts' loads {kilonewton('equivalent_load')}"]
    if there("catalogue_load"):
        said += [f"by ISO 281 P {kilonewton('catalogue_load')}", f"by ISO 76 P0 {kilonewton('static_load')}"]
    yield "Load", ", ".join(said)
    said = [] if not there("static_safety") else [f"C0/P0 {digits(of('static_safety'), 3)}"]
    if life.contact_static_safety is not None:
        said.append(f"of the most loaded contact {digits(of('contact_static_safety'), 3)} (Hertz's pressure)")
    if said:
        yield "Static safety", ", ".join(said)
    yield "Least load", _least_load(solution, of("minimum_load"))
    said = [] if life.viscosity_ratio is None else [f"kappa {digits(of('viscosity_ratio'), 3)}"]
    if life.film_ratio_inner is not None:
        ratios = [np.asarray(getattr(life, f"film_ratio_{side}")) for side in ("inner", "outer")]
        thinnest = float(np.nanmin(ratios))  # NaN: a roller that touches nothing
        said.append(f"smallest lambda ratio {digits(thinnest, 3)}")
    if life.Lnmr is not None:
        said.append(f"a_ISO {digits(of('modification_factor'), 3)} with e_C {digits(of('contamination_factor'), 3)}")
    elif life.viscosity_ratio is not None:
        said.append("no a_ISO without rating.cleanliness or rating.contamination_factor")
    if said:
        yield "Lubrication", ", ".join(said)


def _least_load(solution: Solution, least: float) -> str:
    """A maker's rule of thumb beside the load, and the slip of the cage where it is modelled."""
    life = solution.life
    assert life is not None
    load = float(np.asarray(life.equivalent_load))
    below = ", which is less" if load < least else ""
    rule = f"{digits(1e-3 * least)} kN by a maker's rule of thumb, {MINIMUM_LOADS[life.family]:g} C"
    text = f"{rule}; the contacts' load is {digits(load / least, 3)} times that{below}"
    if solution.cage is None:
        return f"{text}; cage slip is not modelled"
    return f"{text}; cage slip by the model {digits(100.0 * float(np.asarray(solution.cage.slip)), 3)} %"

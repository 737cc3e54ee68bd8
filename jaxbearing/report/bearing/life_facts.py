"""Facts about the life of a bearing, as text: lives, ratings and loads, static safety, minimum load, lubrication."""

import math
from collections.abc import Iterator

import numpy as np

from ...bearings.solution import Solution
from ...life.basic import MINIMUM_LOADS
from ...life.result import AtReliability, CatalogueLife
from ..display import digits

TITLES = ("Life", "Rating", "Load", "Static safety", "Least load", "Lubrication")
"""Titles of these facts."""
AT_NINETY = {
    "L10r": ("L10r_hours", "basic reference life L10r"),
    "L10m": ("L10mh", "ISO 281 modified L10m"),
    "L10": ("L10h", "ISO 281 L10"),
}
"""Name of a life at 90 % reliability in revolutions -> name of the same life in hours, and its words."""
_MODIFIED = {"Lnmr": ("Lnmr_hours", "modified life Lnmr")}
AT_RELIABILITY = {
    "Lnr": ("Lnr_hours", "basic reference life Lnr"),
    "Lnm": ("Lnmh", "ISO 281 modified Lnm"),
    "Ln": ("Lnh", "ISO 281 Ln"),
}
"""Lives at the reliability of the rating, in the form of `AT_NINETY`; at 90 % they are the same lives."""
_FIRST = ("Lnmr", "Lnr", "L10r", "L10")
"""Lives shown at the top of a page."""
SAID = (
    *(f"life.{name}" for revolutions, (hours, _) in AT_RELIABILITY.items() for name in (revolutions, hours)),
    *("life.L10m", "life.L10mh", "life.static_safety", "life.minimum_load"),
)
"""Derived results that these facts already contain."""


def percent(reliability: float) -> str:
    return f"{100.0 * reliability:g} %"


def known_lives(life: AtReliability) -> dict[float, dict[str, tuple[str, str]]]:
    """Known lives of a bearing, a system or a load spectrum. For each reliability, that of the rating first: name of
    the life in revolutions -> name of the same life in hours, and its words. Lives that the catalogue formulas do not
    give are NaN and are left out."""
    there = lambda name: (value := getattr(life, name)) is not None and not np.isnan(float(np.asarray(value)))
    kinds = {life.reliability: _MODIFIED | AT_RELIABILITY, 0.90: AT_NINETY}
    if life.reliability == 0.90:
        kinds = {0.90: _MODIFIED | AT_NINETY}
    return {share: {name: of for name, of in names.items() if there(name)} for share, names in kinds.items()}


def repeated_lives(life: AtReliability | None) -> set[str]:
    """Names of the lives at the reliability of the rating that repeat those at 90 %; empty for other reliabilities."""
    if life is None or life.reliability != 0.90:
        return set()
    return {name for revolutions, (hours, _) in AT_RELIABILITY.items() for name in (revolutions, hours)}


def lives_in_words(life: AtReliability) -> Iterator[str]:
    """One text for each reliability at which lives are known, with hours before revolutions."""
    for share, names in known_lives(life).items():
        texts = [f"{words} {_lasting(life, hours, name)}" for name, (hours, words) in names.items()]
        yield f"at {percent(share)} reliability: {'; '.join(texts)}"


def _lasting(life: AtReliability | CatalogueLife, hours: str, name: str) -> str:
    """A life in hours and revolutions as text: without hours for a bearing at rest, "unlimited" if the life is
    infinite."""
    time, turns = (float(np.asarray(getattr(life, field))) for field in (hours, name))
    if not math.isfinite(turns):
        return "unlimited"
    counted = f"{digits(turns)} million revolutions"
    return f"{digits(time)} h ({counted})" if math.isfinite(time) else counted


def life_headlines(life: AtReliability) -> Iterator[tuple[str, str]]:
    """Name and text of the lives shown at the top of a page, in hours, each with its reliability."""
    for share, names in known_lives(life).items():
        for name, hours in ((name, names[name][0]) for name in _FIRST if name in names):
            time = float(np.asarray(getattr(life, hours)))
            yield (
                f"life {name}, {percent(share)}",
                f"{digits(time)} h" if math.isfinite(time) else _lasting(life, hours, name),
            )


def catalogue_fact(life: CatalogueLife) -> tuple[str, str]:
    """Name and text of the catalogue life, for loads without an equilibrium."""
    load, capacity = (f"{digits(1e-3 * float(newtons))} kN" for newtons in (life.catalogue_load, life.dynamic_capacity))
    lasting = _lasting(life, "L10h", "L10")
    return "Catalogue life", f"needs no equilibrium: ISO 281 L10 {lasting} at 90 % reliability, P {load}, C {capacity}"


def life_facts(solution: Solution) -> Iterator[tuple[str, str]]:
    """Name and text of each fact about the life of a solution whose life is computed."""
    life = solution.life
    assert life is not None
    of = lambda name: float(np.asarray(getattr(life, name)))
    # values that the catalogue formulas do not give are NaN
    there = lambda name: getattr(life, name) is not None and not np.isnan(of(name))
    kilonewton = lambda name: f"{digits(1e-3 * of(name))} kN"
    for text in lives_in_words(life):
        yield "Life", text
    yield "Rating", f"C {kilonewton('dynamic_capacity')}, C0 {kilonewton('static_capacity')}"
    texts = [f"equivalent to the contacts' loads {kilonewton('equivalent_load')}"]
    if there("catalogue_load"):
        texts += [f"by ISO 281 P {kilonewton('catalogue_load')}", f"by ISO 76 P0 {kilonewton('static_load')}"]
    yield "Load", ", ".join(texts)
    texts = [] if not there("static_safety") else [f"C0/P0 {digits(of('static_safety'), 3)}"]
    if life.contact_static_safety is not None:
        texts.append(f"of the most loaded contact {digits(of('contact_static_safety'), 3)} (Hertz's pressure)")
    if texts:
        yield "Static safety", ", ".join(texts)
    yield "Least load", _least_load(solution, of("minimum_load"))
    texts = [] if life.viscosity_ratio is None else [f"kappa {digits(of('viscosity_ratio'), 3)}"]
    if life.film_ratio_inner is not None:
        ratios = [np.asarray(getattr(life, f"film_ratio_{side}")) for side in ("inner", "outer")]
        thinnest = float(np.nanmin(ratios))  # NaN: a rolling element without contact
        texts.append(f"smallest lambda ratio {digits(thinnest, 3)}")
    if life.Lnmr is not None:
        texts.append(f"a_ISO {digits(of('modification_factor'), 3)} with e_C {digits(of('contamination_factor'), 3)}")
    elif life.viscosity_ratio is not None:
        texts.append("no a_ISO without rating.cleanliness or rating.contamination_factor")
    if texts:
        yield "Lubrication", ", ".join(texts)


def _least_load(solution: Solution, least: float) -> str:
    """A maker's rule of thumb for the minimum load, compared with the equivalent load, and the cage slip if it is
    modelled."""
    life = solution.life
    assert life is not None
    load = float(np.asarray(life.equivalent_load))
    below = ", which is less" if load < least else ""
    rule = f"{digits(1e-3 * least)} kN by a maker's rule of thumb, {MINIMUM_LOADS[life.family]:g} C"
    text = f"{rule}; the contacts' load is {digits(load / least, 3)} times that{below}"
    if solution.cage is None:
        return f"{text}; cage slip is not modelled"
    return f"{text}; cage slip by the model {digits(100.0 * float(np.asarray(solution.cage.slip)), 3)} %"

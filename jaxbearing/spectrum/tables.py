"""A load spectrum on the screen, as JSON and as a table of a page."""

from collections.abc import Iterator, Mapping
from typing import Any, SupportsFloat

import numpy as np
from rich.console import Console

from ..bearings.solution import Solution
from ..numerics.status import Status
from ..report.backends.json import finite, plain
from ..report.backends.screen import counted, headline, print_columns, print_line, print_rule, print_warnings
from ..report.bearing.facts import NO_LIFE, OVERLOAD, overload
from ..report.bearing.life_facts import lives_in_words, percent
from ..report.display import digits, with_unit
from ..report.json_report import solution_to_dict
from ..report.labels import labelled
from ..report.page_content import Listing
from .result import Spectrum

TITLE = "Load spectrum"


def print_spectrum(
    found: Spectrum,
    changes: Mapping[str, Mapping[str, str]],
    label: str,
    seconds: float,
    console: Console,
    full: bool = False,
) -> None:
    """The table by state, then the life; without it where a state failed.

    **Arguments:** `changes`: of each state, as they were typed; `full`: with all columns of the table.
    """
    failures = found.failures
    failed = f"{len(failures)} {'STATE' if len(failures) == 1 else 'STATES'} FAILED"
    status, style = (failed, "bold red") if failures else ("CONVERGED", "bold green")
    headline(label, status, style, f"{counted(len(found.names), 'state')}, {seconds:.1f} s", console)
    print_rule("States", console)
    for name, given in changes.items():
        print_line(name, ", ".join(f"{path} = {text}" for path, text in given.items()) or "no change", console)
    headings, rows = spectrum_rows(found)
    columns = {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}
    first = {"state": columns.pop("state")}
    print_columns(first, columns, console, full, named="state")
    for name, text in spectrum_facts(found):
        print_line(name, text, console)
    print_warnings([*(f"{name}: {text}" for name, text in failures.items()), *_warnings(found)], console, full)


def _warnings(found: Spectrum) -> list[str]:
    return [] if found.failures else found.warnings


def spectrum_rows(found: Spectrum) -> tuple[list[str], list[list[str]]]:
    """Headings, their units on a second line, and a row of texts for each state; "-" for what it does not have."""
    life = found.life
    all_modified = life.Lnmr is not None
    words = f"Lnmr\nh, {percent(life.reliability)}" if all_modified else "L10r\nh, 90 %"
    name_of_life = "Lnmr_hours" if all_modified else "L10r_hours"
    columns: dict[str, list[str]] = {
        "state": list(found.names),
        "time\n%": [_percent(one) for one in np.asarray(found.shares)],
        "turns\n%": [_percent(one) for one in np.asarray(life.revolutions)],
        "damage\n%": [_percent(one) for one in np.asarray(life.damage)],
        words: [_number(getattr(one.life, name_of_life)) for one in found.solutions],
        "loss\nW": [_number(one.power_loss.total) for one in found.solutions],
        "pressure\nGPa": [digits(1e-9 * _pressure(one)) for one in found.solutions],
        "kappa": [_number(one.life.viscosity_ratio, 3) for one in found.solutions],
        "safety\nC0/P0": [_number(one.life.static_safety, 3) for one in found.solutions],
        "safety\ncontact": [_number(one.life.contact_static_safety, 3) for one in found.solutions],
    }
    kept = {heading: texts for heading, texts in columns.items() if heading == "state" or set(texts) != {"-"}}
    return list(kept), [list(row) for row in zip(*kept.values(), strict=True)]


def overloads(found: Spectrum) -> str:
    """The states in which elements and races yield, in words; "" where none does."""
    by_state = zip(found.names, map(overload, found.solutions), strict=True)
    return "; ".join(f"{name}: {text}" for name, text in by_state if text)


def spectrum_facts(found: Spectrum) -> Iterator[tuple[str, str]]:
    """Name and text of what is known of the whole spectrum; nothing but the failed states where one failed."""
    life = found.life
    if found.failures:
        yield "Life", f"none: {', '.join(found.failures)} failed, and its damage is not known"
        return
    yields = overloads(found)
    if yields:
        yield OVERLOAD, f"elements and races yield, so that there is no life: {yields}"
    for text in lives_in_words(life):
        yield "Life", f"{NO_LIFE}: {text}" if yields else text
    said = [f"equivalent to the contacts' loads {with_unit(float(life.equivalent_load), 'N')}"]
    if _there(life.catalogue_load):
        said.append(f"by ISO 281 P {with_unit(float(np.asarray(life.catalogue_load)), 'N')}")
    yield "Constant load", f"{', '.join(said)}, at {with_unit(float(life.mean_speed), 'rad/s')}"
    if found.governing is not None:
        most = float(np.max(np.asarray(life.damage)))
        yield "Governed by", f"{found.governing}: {_percent(most)} % of the damage"


def spectrum_listing(found: Spectrum) -> Listing:
    """The table of a page, with the life below it."""
    headings, rows = spectrum_rows(found)
    headings = [heading.replace("\n", ", ") for heading in headings]
    remarks = [f"{name}: {text}." for name, text in spectrum_facts(found)]
    remarks += [f"State {name} failed: {text}" for name, text in found.failures.items()]
    remarks.append(
        "Damages of the states are added (Palmgren and Miner). Safety is static: C0/P0, and of the most loaded contact."
    )
    return Listing(TITLE, headings, rows, remarks)


def spectrum_to_dict(found: Spectrum, changes: Mapping[str, Mapping[str, str]] | None = None) -> dict[str, Any]:
    """All numbers in SI units; those that are not finite are `None`. `life` is `None` where a state failed.

    **Arguments:** `changes`: of each state, as they were typed; left out: they are not in the object.
    """
    failures = found.failures
    life = found.life
    statuses = [Status(int(one.status)) for one in found.solutions]
    first = next((one for one in statuses if one != Status.CONVERGED), Status.CONVERGED)
    per_state = {"revolutions", "damage", "reference_damage"}
    numbers = {path: plain(value) for path, value, _ in labelled(life) if path not in per_state}
    states = []
    for place, (name, solution) in enumerate(zip(found.names, found.solutions, strict=True)):
        said: dict[str, Any] = {"name": name, "share": float(found.shares[place])}
        said |= {path: finite(float(getattr(life, path)[place])) for path in sorted(per_state)}
        if changes is not None:
            said["changes"] = dict(changes[name])
        states.append(said | {"failure": failures.get(name), "solution": solution_to_dict(solution)})
    return {
        "converged": not failures,
        "status": first.name.lower(),
        "warnings": _warnings(found),
        "states": states,
        "life": None if failures else numbers,
        "governing_state": found.governing,
    }


def _pressure(solution: Solution) -> float:
    elements = solution.elements
    return float(np.max(np.maximum(np.asarray(elements.pressure_inner), np.asarray(elements.pressure_outer))))


def _there(value: object) -> bool:
    """True for a number; what the catalogues' formulas do not give is `None` or NaN."""
    return value is not None and not np.isnan(float(np.asarray(value)))


def _percent(share: SupportsFloat) -> str:
    return digits(100.0 * float(share), 3)


def _number(value: object, significant: int = 4) -> str:
    return "-" if value is None else digits(float(np.asarray(value)), significant)

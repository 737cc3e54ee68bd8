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
    spectrum: Spectrum,
    changes: Mapping[str, Mapping[str, str]],
    label: str,
    seconds: float,
    console: Console,
    full: bool = False,
) -> None:
    """The table by state, then the life; without it where a state failed.

    **Arguments:** `changes`: of each state, as they were typed; `full`: with all columns of the table.
    """
    failures = spectrum.failures
    failed = f"{len(failures)} {'STATE' if len(failures) == 1 else 'STATES'} FAILED"
    status, style = (failed, "bold red") if failures else ("CONVERGED", "bold green")
    headline(label, status, style, f"{counted(len(spectrum.names), 'state')}, {seconds:.1f} s", console)
    print_rule("States", console)
    for name, texts in changes.items():
        print_line(name, ", ".join(f"{path} = {text}" for path, text in texts.items()) or "no change", console)
    headings, rows = spectrum_rows(spectrum)
    columns = {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}
    first = {"state": columns.pop("state")}
    print_columns(first, columns, console, full, named="state")
    for name, text in spectrum_facts(spectrum):
        print_line(name, text, console)
    print_warnings([*(f"{name}: {text}" for name, text in failures.items()), *_warnings(spectrum)], console, full)


def _warnings(spectrum: Spectrum) -> list[str]:
    return [] if spectrum.failures else spectrum.warnings


def spectrum_rows(spectrum: Spectrum) -> tuple[list[str], list[list[str]]]:
    """Headings, their units on a second line, and a row of texts for each state; "-" for what it does not have."""
    life = spectrum.life
    all_modified = life.Lnmr is not None
    words = f"Lnmr\nh, {percent(life.reliability)}" if all_modified else "L10r\nh, 90 %"
    name_of_life = "Lnmr_hours" if all_modified else "L10r_hours"
    columns: dict[str, list[str]] = {
        "state": list(spectrum.names),
        "time\n%": [_percent(share) for share in np.asarray(spectrum.shares)],
        "turns\n%": [_percent(share) for share in np.asarray(life.revolutions)],
        "damage\n%": [_percent(share) for share in np.asarray(life.damage)],
        words: [_number(getattr(solution.life, name_of_life)) for solution in spectrum.solutions],
        "loss\nW": [_number(solution.power_loss.total) for solution in spectrum.solutions],
        "pressure\nGPa": [digits(1e-9 * _pressure(solution)) for solution in spectrum.solutions],
        "kappa": [_number(solution.life.viscosity_ratio, 3) for solution in spectrum.solutions],
        "safety\nC0/P0": [_number(solution.life.static_safety, 3) for solution in spectrum.solutions],
        "safety\ncontact": [_number(solution.life.contact_static_safety, 3) for solution in spectrum.solutions],
    }
    kept = {heading: texts for heading, texts in columns.items() if heading == "state" or set(texts) != {"-"}}
    return list(kept), [list(row) for row in zip(*kept.values(), strict=True)]


def overloads(spectrum: Spectrum) -> str:
    """The states in which elements and races yield, in words; "" where none does."""
    by_state = zip(spectrum.names, map(overload, spectrum.solutions), strict=True)
    return "; ".join(f"{name}: {text}" for name, text in by_state if text)


def spectrum_facts(spectrum: Spectrum) -> Iterator[tuple[str, str]]:
    """Name and text of what is known of the whole spectrum; nothing but the failed states where one failed."""
    life = spectrum.life
    if spectrum.failures:
        yield "Life", f"none: {', '.join(spectrum.failures)} failed, and its damage is not known"
        return
    yields = overloads(spectrum)
    if yields:
        yield OVERLOAD, f"elements and races yield, so that there is no life: {yields}"
    for text in lives_in_words(life):
        yield "Life", f"{NO_LIFE}: {text}" if yields else text
    loads = [f"equivalent to the contacts' loads {with_unit(float(life.equivalent_load), 'N')}"]
    if _there(life.catalogue_load):
        loads.append(f"by ISO 281 P {with_unit(float(np.asarray(life.catalogue_load)), 'N')}")
    yield "Constant load", f"{', '.join(loads)}, at {with_unit(float(life.mean_speed), 'rad/s')}"
    if spectrum.governing is not None:
        most = float(np.max(np.asarray(life.damage)))
        yield "Governed by", f"{spectrum.governing}: {_percent(most)} % of the damage"


def spectrum_listing(spectrum: Spectrum) -> Listing:
    """The table of a page, with the life below it."""
    headings, rows = spectrum_rows(spectrum)
    headings = [heading.replace("\n", ", ") for heading in headings]
    remarks = [f"{name}: {text}." for name, text in spectrum_facts(spectrum)]
    remarks += [f"State {name} failed: {text}" for name, text in spectrum.failures.items()]
    remarks.append(
        "Damages of the states are added (Palmgren and Miner). Safety is static: C0/P0, and of the most loaded contact."
    )
    return Listing(TITLE, headings, rows, remarks)


def spectrum_to_dict(spectrum: Spectrum, changes: Mapping[str, Mapping[str, str]] | None = None) -> dict[str, Any]:
    """All numbers in SI units; those that are not finite are `None`. `life` is `None` where a state failed.

    **Arguments:** `changes`: of each state, as they were typed; left out: they are not in the object.
    """
    failures = spectrum.failures
    life = spectrum.life
    statuses = [Status(int(state.status)) for state in spectrum.solutions]
    first = next((status for status in statuses if status != Status.CONVERGED), Status.CONVERGED)
    per_state = {"revolutions", "damage", "reference_damage"}
    numbers = {path: plain(value) for path, value, _ in labelled(life) if path not in per_state}
    states = []
    for place, (name, solution) in enumerate(zip(spectrum.names, spectrum.solutions, strict=True)):
        entry: dict[str, Any] = {"name": name, "share": float(spectrum.shares[place])}
        entry |= {path: finite(float(getattr(life, path)[place])) for path in sorted(per_state)}
        if changes is not None:
            entry["changes"] = dict(changes[name])
        states.append(entry | {"failure": failures.get(name), "solution": solution_to_dict(solution)})
    return {
        "converged": not failures,
        "status": first.name.lower(),
        "warnings": _warnings(spectrum),
        "states": states,
        "life": None if failures else numbers,
        "governing_state": spectrum.governing,
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

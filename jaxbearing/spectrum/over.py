"""Life under a load spectrum against one field of the scene, on the screen and as JSON."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import Console

from ..life.duty import IN_HOURS
from ..report.backends.screen import counted, headline, print_columns, print_rule, print_warnings
from ..report.bearing.life_facts import percent
from ..report.display import digits, display_unit, number, with_unit
from .result import Spectrum
from .tables import overloads, spectrum_to_dict


def print_over(
    path: str,
    unit: str,
    values: Sequence[float],
    found: Sequence[Spectrum],
    label: str,
    seconds: float,
    console: Console,
    full: bool,
) -> None:
    """A row for each value; one whose states did not all converge has no life.

    **Arguments:** `path`: of the field; `unit`: its SI unit, "" for a plain number; `values`, in SI, and the spectrum
    of each; `label`: of the scene; `seconds`: that it took; `full`: with all columns of the table.
    """
    failed = sum(bool(one.failures) for one in found)
    status, style = (f"{failed} FAILED", "bold red") if failed else ("CONVERGED", "bold green")
    words = f"{counted(len(found), 'value')} of {path}, {counted(len(found[0].names), 'state')} each, {seconds:.1f} s"
    headline(label, status, style, words, console)
    print_rule("Life under the load spectrum", console)
    columns = over_columns(path, unit, values, found)
    own = next(iter(columns))
    print_columns({own: columns.pop(own)}, columns, console, full, named=_GOVERNS)
    said = [
        f"{with_unit(value, unit)}, {name}: {text}"
        for value, one in zip(values, found, strict=True)
        for name, text in one.failures.items()
    ]
    print_warnings(said or list(dict.fromkeys(text for one in found for text in one.warnings)), console)


_GOVERNS = "governed by"


def over_columns(path: str, unit: str, values: Sequence[float], found: Sequence[Spectrum]) -> dict[str, list[str]]:
    """Heading, with the unit on a second line -> texts, one a value; lives that no value has are left out.

    A spectrum with a state that yields has no life."""
    own = path.rpartition(".")[2].replace("_", " ")
    largest = max(map(abs, values))
    columns = {f"{own}\n{display_unit(unit, largest)}": [number(value, unit, largest=largest) for value in values]}
    kinds = {"Lnmr": found[0].life.reliability, "L10r": 0.90, "L10m": 0.90, "L10": 0.90}
    endings = ["-" if one.failures else "yields" if overloads(one) else "" for one in found]
    for kind, reliability in kinds.items():
        lives = [getattr(one.life, IN_HOURS[kind]) for one in found]
        texts = ["-" if life is None else why or _text(life) for why, life in zip(endings, lives, strict=True)]
        if set(texts) != {"-"}:
            columns[f"{kind}\nh, {percent(reliability)}"] = texts
    loads = ["-" if one.failures else _text(1e-3 * np.asarray(one.life.equivalent_load)) for one in found]
    safety = [_text(_least(one), 3) for one in found]
    most = [f"{one.governing}, {_most(one)} %" if one.governing is not None else "-" for one in found]
    return columns | {"load\nkN": loads, "least\nC0/P0": safety, _GOVERNS: most}


def over_to_dict(path: str, unit: str, values: Sequence[float], found: Sequence[Spectrum]) -> dict[str, Any]:
    """The field, its values in SI, and the object of each spectrum; arguments as those of `print_over`."""
    spectra = [spectrum_to_dict(one) for one in found]
    return {
        "converged": all(one["converged"] for one in spectra),
        "over": path,
        "unit": unit,
        "values": [float(value) for value in values],
        "spectra": spectra,
    }


def _least(found: Spectrum) -> float:
    """The least static safety of all states; NaN where the catalogue's formula is not for one of them."""
    known = [one.life.static_safety for one in found.solutions]
    return float("nan") if any(one is None for one in known) else float(np.min([np.asarray(one) for one in known]))


def _most(found: Spectrum) -> str:
    return digits(100.0 * float(np.max(np.asarray(found.life.damage))), 3)


def _text(value: object, significant: int = 4) -> str:
    return "-" if value is None else digits(float(np.asarray(value)), significant)

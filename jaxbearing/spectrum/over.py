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
    spectra: Sequence[Spectrum],
    label: str,
    seconds: float,
    console: Console,
    full: bool,
) -> None:
    """A row for each value; one whose states did not all converge has no life.

    **Arguments:** `path`: of the field; `unit`: its SI unit, "" for a plain number; `values`, in SI, and the spectrum
    of each; `label`: of the scene; `seconds`: that it took; `full`: with all columns of the table.
    """
    failed = sum(bool(spectrum.failures) for spectrum in spectra)
    status, style = (f"{failed} FAILED", "bold red") if failed else ("CONVERGED", "bold green")
    words = (
        f"{counted(len(spectra), 'value')} of {path}, {counted(len(spectra[0].names), 'state')} each, {seconds:.1f} s"
    )
    headline(label, status, style, words, console)
    print_rule("Life under the load spectrum", console)
    columns = over_columns(path, unit, values, spectra)
    own = next(iter(columns))
    print_columns({own: columns.pop(own)}, columns, console, full, named=_GOVERNS)
    failures = [
        f"{with_unit(value, unit)}, {name}: {text}"
        for value, spectrum in zip(values, spectra, strict=True)
        for name, text in spectrum.failures.items()
    ]
    print_warnings(failures or list(dict.fromkeys(text for spectrum in spectra for text in spectrum.warnings)), console)


_GOVERNS = "governed by"


def over_columns(path: str, unit: str, values: Sequence[float], spectra: Sequence[Spectrum]) -> dict[str, list[str]]:
    """Heading, with the unit on a second line -> texts, one a value; lives that no value has are left out.

    A spectrum with a state that yields has no life."""
    own = path.rpartition(".")[2].replace("_", " ")
    largest = max(map(abs, values))
    columns = {f"{own}\n{display_unit(unit, largest)}": [number(value, unit, largest=largest) for value in values]}
    kinds = {"Lnmr": spectra[0].life.reliability, "L10r": 0.90, "L10m": 0.90, "L10": 0.90}
    endings = ["-" if spectrum.failures else "yields" if overloads(spectrum) else "" for spectrum in spectra]
    for kind, reliability in kinds.items():
        lives = [getattr(spectrum.life, IN_HOURS[kind]) for spectrum in spectra]
        texts = ["-" if life is None else why or _text(life) for why, life in zip(endings, lives, strict=True)]
        if set(texts) != {"-"}:
            columns[f"{kind}\nh, {percent(reliability)}"] = texts
    loads = [
        "-" if spectrum.failures else _text(1e-3 * np.asarray(spectrum.life.equivalent_load)) for spectrum in spectra
    ]
    safety = [_text(_least(spectrum), 3) for spectrum in spectra]
    most = [
        f"{spectrum.governing}, {_most(spectrum)} %" if spectrum.governing is not None else "-" for spectrum in spectra
    ]
    return columns | {"load\nkN": loads, "least\nC0/P0": safety, _GOVERNS: most}


def over_to_dict(path: str, unit: str, values: Sequence[float], spectra: Sequence[Spectrum]) -> dict[str, Any]:
    """The field, its values in SI, and the object of each spectrum; arguments as those of `print_over`."""
    entries = [spectrum_to_dict(spectrum) for spectrum in spectra]
    return {
        "converged": all(entry["converged"] for entry in entries),
        "over": path,
        "unit": unit,
        "values": [float(value) for value in values],
        "spectra": entries,
    }


def _least(spectrum: Spectrum) -> float:
    """The least static safety of all states; NaN where the catalogue's formula is not for one of them."""
    known = [solution.life.static_safety for solution in spectrum.solutions]
    return (
        float("nan")
        if any(safety is None for safety in known)
        else float(np.min([np.asarray(safety) for safety in known]))
    )


def _most(spectrum: Spectrum) -> str:
    return digits(100.0 * float(np.max(np.asarray(spectrum.life.damage))), 3)


def _text(value: object, significant: int = 4) -> str:
    return "-" if value is None else digits(float(np.asarray(value)), significant)

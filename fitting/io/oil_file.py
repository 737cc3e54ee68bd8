"""The fitted oil as a file that scenes can name: `[oil] file = "fitted_oil.toml"`."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path

from jaxbearing import __version__
from jaxbearing.report.backends.screen import counted
from jaxbearing.report.files import write_whole
from jaxbearing.scenes.oil.files import Origin
from jaxbearing.scenes.oil.writer import oil_text

from ..result import FitResult, Parameter
from .words import SYMBOL, conditions, held, parameter_text, percent


def write_oil(
    result: FitResult, path: str | Path, data: str, scene: str, origins: Mapping[str, Origin] | None = None
) -> None:
    """Write the fitted oil in the format of the catalogue's data files; the file is written completely or not at all.

    Reading the file gives `result.oil` to the last digit. Where the data did not determine a parameter, the rheology
    carries a note, which solutions with the oil repeat.

    **Arguments:**
    - `data`, `scene`: names of the curve file and of the scene.
    - `origins`: where the other laws come from, see `jaxbearing.scenes.reader.oil_origins`.

    **Raises:** `ValueError` for a fit that failed; `OSError` where the place cannot be written.
    """
    text = fitted_oil_text(result, Path(path).stem, data, scene, origins)
    write_whole(path, text)


def fitted_oil_text(
    result: FitResult, name: str, data: str, scene: str, origins: Mapping[str, Origin] | None = None
) -> str:
    """The text of the file. **Arguments:** `name`: of the oil; the others as for `write_oil`.

    **Raises:** `ValueError` for a fit that failed (a fit whose data determine no parameter did not fail).
    """
    if not (result.converged or result.undetermined):
        raise ValueError(f"a fit that failed has no results: {result.failure()}")
    origins = {} if origins is None else origins
    known = {**origins, "rheology": Origin(_sources(result, data, scene), _note(result, data))}
    # the note on the previous rheology does not apply to the fitted one
    replaced = origins["rheology"].note if "rheology" in origins else ""
    oil = dataclasses.replace(result.oil, notes=tuple(note for note in result.oil.notes if note != replaced))
    described = f"rheology fitted to {data}" if result.fitted else f"rheology not told by {data}"
    described += f", the other laws as in {scene}"
    return oil_text(oil, name, described, _header(result, data, scene), known)


def _header(result: FitResult, data: str, scene: str) -> list[str]:
    rheology = result.oil.rheology
    exponent = "" if rheology is None or rheology.exponent is None else f" with the exponent {rheology.exponent:g}"
    where = ", ".join(f"{name} {text}" for name, text in conditions(result).items())
    agreeing, total = result.starts
    return [
        "An oil whose rheology was fitted to measured traction curves."
        if result.fitted
        else "An oil with the first values of a fit: the measured traction curves cannot tell its rheology.",
        f"Data: {data}, {counted(len(result.predicted), 'point')} in {counted(len(result.curves), 'curve')}; {where}.",
        f"Scene: {scene}; all laws but the rheology are those of its oil.",
        f"Model: viscous function {result.model}{exponent}; {result.method}, {result.options.loss} loss, {agreeing} of "
        f"{total} starts.",
        f"rms of the differences: {result.rms:.3g} in traction coefficient.",
        *result.notes,
        f'Written by jaxbearing {__version__}. In a scene: [oil] file = "...", or --set oil.file=...',
    ]


def _sources(result: FitResult, data: str, scene: str) -> dict[str, str]:
    # held values come from the law of the scene's oil, or from its tangent exponential law
    values = f"the tangent of the law of {scene}" if result.first_values else scene
    fitted = {name: _source(name, parameter, result, data, values) for name, parameter in result.parameters.items()}
    form = dict.fromkeys(("viscous_function", "exponent"), "chosen for the fit")
    reference = f"the middle of {data}" if result.first_values else f"as in {scene}"
    return {**form, "reference_temperature": reference, **fitted}


def _source(name: str, parameter: Parameter, result: FitResult, data: str, scene: str) -> str:
    if parameter.fixed:
        return held(parameter, scene)
    text = parameter_text(name, parameter)
    if not text.interval:
        return f"fitted to {data}; {held(parameter)}"
    interval = f"{percent(result.level)} interval {text.interval} {text.unit}"
    return f"fitted to {data}, standard error {text.error} {text.unit}, {interval}"


def _note(result: FitResult, data: str) -> str:
    if not result.unidentifiable:
        return ""
    symbols = ", ".join(SYMBOL[name] for name in result.unidentifiable)
    ranges = conditions(result)
    return (
        f"the rheology was fitted to {data} at {ranges['Hertz pressure']} and {ranges['temperature']}, which does not "
        f"determine {symbols}: elsewhere it is a guess"
    )

"""Exit codes, and the one message on stderr that goes with each."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NoReturn

import typer

if TYPE_CHECKING:
    from ..scenes.errors import SceneError

NO_OUTPUT, BAD_INPUT, NOT_CONVERGED, UNDETERMINED, INTERRUPTED = 1, 2, 3, 4, 130


def say(message: str, code: int) -> int:
    """One line on stderr; returns the code."""
    from ..scenes.errors import printable

    typer.echo(f"error: {printable(' '.join(message.split()))}", err=True)
    return code


@contextmanager
def bad_input(notes: list[str] | None = None) -> Iterator[None]:
    """Context that turns errors of the input into one message and exit code 2. The files that are read in it are known
    as inputs to `output_files.check_files`.

    **Arguments:** `notes`: list that gets notes on the input; left out: they are printed on stderr.
    """
    from ..scenes.errors import MeanUsedWarning, PresetUsedWarning, SceneError, StatesUnusedWarning
    from ..scenes.input_files import remembered_inputs

    notable = (MeanUsedWarning, PresetUsedWarning, StatesUnusedWarning)
    texts: list[str] = []
    try:
        with warnings.catch_warnings(record=True) as caught, remembered_inputs():
            for category in notable:
                warnings.simplefilter("always", category)
            yield
        for warning in caught:
            if not issubclass(warning.category, notable):
                warnings.warn_explicit(warning.message, warning.category, warning.filename, warning.lineno)
            elif str(warning.message) not in texts:
                texts.append(_note(warning))
    except SceneError as error:
        refuse(str(error) + _new_hint(error))
    for text in texts if notes is None else ():
        typer.echo(f"note: {text}", err=True)
    if notes is not None:
        notes += texts


def _note(warning: warnings.WarningMessage) -> str:
    """The text of a warning as a note, in the group that it has."""
    from ..scenes.errors import PresetUsedWarning

    if issubclass(warning.category, PresetUsedWarning):
        return str(warning.message)
    from .._checks import Information  # brings JAX, which `jaxbearing new` does without

    return Information(warning.message)


def _new_hint(error: "SceneError") -> str:
    """The command that writes a scene, if what should be a file is the designation of a standard bearing."""
    from ..scenes.errors import SceneError

    if error.found != "no such file":
        return ""
    from ..catalogue.designation import parse

    try:
        bearing = parse(error.file)
    except SceneError:
        return ""
    return f" 'jaxbearing new {bearing.text}' writes a scene of this {bearing.in_words}."


def refuse(message: str) -> NoReturn:
    typer.echo(f"error: {message}", err=True)
    raise typer.Exit(BAD_INPUT)

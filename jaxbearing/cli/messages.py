"""Exit codes, and the one message on stderr that goes with each."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn

import typer

NO_OUTPUT, BAD_INPUT, NOT_CONVERGED, INTERRUPTED = 1, 2, 3, 130


def say(message: str, code: int) -> int:
    """One line on stderr; returns the code."""
    from ..scenes.errors import printable

    typer.echo(f"error: {printable(' '.join(message.split()))}", err=True)
    return code


@contextmanager
def bad_input() -> Iterator[None]:
    """Context that turns errors of the input into one message and exit code 2."""
    from ..scenes.errors import SceneError

    try:
        yield
    except SceneError as error:
        refuse(str(error))


def refuse(message: str) -> NoReturn:
    typer.echo(f"error: {message}", err=True)
    raise typer.Exit(BAD_INPUT)

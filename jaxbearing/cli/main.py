"""The command `jaxbearing`. What a verb needs is imported when it runs: the usage of a command does not wait for the
scene reader, nor the list of scenes for the solver.

Exit codes: 0 solved; 1 the output cannot be written; 2 bad input, one message on stderr; 3 not converged;
130 interrupted.
"""

import io
import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

NO_OUTPUT, BAD_INPUT, NOT_CONVERGED, INTERRUPTED = 1, 2, 3, 130

_EPILOG = """\b
Exit codes: 0 solved; 1 the output cannot be written; 2 bad input;
  3 not converged; 130 interrupted.
Environment: JAXBEARING_CACHE is the folder where compiled programs are kept
  between runs, or off; without it they are kept in the user's cache folder."""

_UsageError: Any = typer.BadParameter.__mro__[1]
"""What the parser raises for a wrong command line; typer exports only this one kind of it."""

app = typer.Typer(
    name="jaxbearing",
    help="Lubricated rolling bearings: loads, films, speeds and power loss.",
    epilog=_EPILOG,
    no_args_is_help=True,
    rich_markup_mode=None,
    add_completion=False,
    pretty_exceptions_enable=False,
)

SceneArgument = Annotated[
    str, typer.Argument(metavar="SCENE", help="A scene file (TOML), or the name of a built-in scene.")
]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Change a field of the scene, e.g. --set operation.inner_speed='12000 rpm'; the value none takes an "
        "optional table or field out. May be repeated.",
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object in SI units, and nothing else.")]


def main() -> None:
    """Entry point of the console script."""
    sys.exit(_run())


def _run() -> int:
    if sys.stdout is None:
        return _say("the output cannot be written: standard output is closed", NO_OUTPUT)
    if isinstance(sys.stdout, io.TextIOWrapper):
        # a terminal without these characters shows others
        sys.stdout.reconfigure(errors="replace")
    try:
        code = app(standalone_mode=False)
        sys.stdout.flush()
    except _UsageError as error:
        return _usage(error)
    except KeyboardInterrupt:
        return INTERRUPTED
    except SystemExit as ended:
        # the command line's and rich's way to say that the reader of a pipe has gone
        sys.stdout = None
        return ended.code if isinstance(ended.code, int) else NO_OUTPUT
    except OSError as error:
        if error.filename is not None:
            raise
        # nor is anything to be flushed at exit
        sys.stdout = None
        # the reader (head, less) has gone: nothing is left to say
        gone = isinstance(error, BrokenPipeError)
        return NO_OUTPUT if gone else _say(f"the output cannot be written: {error.strerror}", NO_OUTPUT)
    return code if isinstance(code, int) else 0


def _usage(error: Any) -> int:
    """A wrong command line in one line; no command at all asks for the help."""
    context = error.ctx
    if context is not None and error.format_message().strip() in ("", context.get_help().strip()):
        typer.echo(context.get_help(), err=True)
        return BAD_INPUT
    hint = f" See '{context.command_path} --help'." if context is not None else ""
    return _say(error.format_message() + hint, BAD_INPUT)


def _say(message: str, code: int) -> int:
    from ..scenes.errors import printable

    typer.echo(f"error: {printable(' '.join(message.split()))}", err=True)
    return code


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import PackageNotFoundError, version

        try:
            typer.echo(f"jaxbearing {version('jaxbearing')}")
        except PackageNotFoundError:
            typer.echo("jaxbearing (not installed)")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version.", is_eager=True, callback=_version)
    ] = False,
) -> None:
    pass


@app.command()
def scenes(
    copy: Annotated[
        str | None, typer.Option("--copy", metavar="NAME", help="Write a built-in scene as a file.")
    ] = None,
    to: Annotated[
        Path | None, typer.Option("--to", metavar="FILE", help="File to write; NAME.toml in this folder if not given.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing file.")] = False,
) -> None:
    """List the built-in scenes, or write one out as a file to edit."""
    with _bad_input():
        if copy is not None:
            _copy(copy, to, force)
        elif to is not None or force:
            _refuse("--to and --force belong to --copy NAME: found no --copy; expected the name of a built-in scene.")
        else:
            _list()


@app.command()
def solve(
    scene: SceneArgument,
    changes: SetOption = None,
    as_json: JsonOption = False,
) -> None:
    """Steady state: power loss, loads, films, pressures, speeds."""
    with _bad_input():
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene

        model = load_scene(scene, split_assignments(changes or []))

    from .cache import enable_compilation_cache
    from .interrupt import prompt_interrupt
    from .quiet import without_false_alarms

    enable_compilation_cache()
    with prompt_interrupt(), without_false_alarms():
        failure = _solve_and_print(model, _label(scene, changes), as_json)
    if failure:
        if as_json:
            typer.echo(f"not converged: {_label(scene, changes)}: {failure}", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _solve_and_print(model: Any, label: str, as_json: bool) -> str:
    """Empty where the solve converged, otherwise what failed."""
    from ..solve import solve as solve_scene

    solution = solve_scene(model, throw=False)
    if as_json:
        from ..report.json_report import solution_to_dict

        typer.echo(json.dumps(solution_to_dict(solution), allow_nan=False))
    else:
        from rich.console import Console

        from ..report.summary import print_summary

        # a pipe has no width: 100 columns hold every table
        print_summary(solution, label, Console(highlight=False, width=None if sys.stdout.isatty() else 100))
    return "" if bool(solution.converged) else solution.failure()


def _label(scene: str, changes: list[str] | None) -> str:
    return " ".join([scene, *(f"--set {change}" for change in changes or [])])


def _list() -> None:
    from rich.console import Console
    from rich.table import Table

    from ..scenes.data_files import builtin_names, builtin_summary

    table = Table.grid(padding=(0, 2, 0, 0))
    table.add_column(no_wrap=True, style="bold")
    table.add_column()
    for name in builtin_names():
        table.add_row(name, builtin_summary(name))
    Console(highlight=False, width=None if sys.stdout.isatty() else 100).print(table)


def _copy(name: str, to: Path | None, force: bool) -> None:
    from ..scenes.data_files import builtin_names, builtin_text
    from ..scenes.errors import SceneError, nearest, one_of

    if name not in builtin_names():
        near = nearest(name, builtin_names())
        raise SceneError("--copy", "", f"'{name}'", f"a built-in scene: {one_of(builtin_names())}", near)
    target = Path(f"{name}.toml") if to is None else to
    try:
        if target.is_dir():
            target = target / f"{name}.toml"
        with open(target, "w" if force else "x", encoding="utf-8") as file:
            file.write(builtin_text(name))
    except FileExistsError:
        found, expected = "a file that exists already", "a new file (--to FILE), or --force to overwrite it"
        raise SceneError(str(target), "", found, expected) from None
    except (OSError, ValueError) as error:
        # ValueError: a path with a null byte
        found = f"a place that cannot be written: {getattr(error, 'strerror', None) or error}"
        raise SceneError(str(target), "", found, "a file in an existing folder") from None
    typer.echo(f"wrote {target}")


@contextmanager
def _bad_input() -> Iterator[None]:
    """Turns what is wrong with the input into one message and exit code 2."""
    from ..scenes.errors import SceneError

    try:
        yield
    except SceneError as error:
        _refuse(str(error))


def _refuse(message: str) -> NoReturn:
    typer.echo(f"error: {message}", err=True)
    raise typer.Exit(BAD_INPUT)

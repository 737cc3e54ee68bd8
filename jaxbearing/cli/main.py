"""The command `jaxbearing`. What a verb needs is imported when it runs: the usage of a command does not wait for the
scene reader, nor the list of scenes for the solver.

Exit codes: 0 solved; 1 the output cannot be written; 2 bad input, one message on stderr; 3 not converged; 4 the
measurements cannot tell anything that is fitted; 130 interrupted.
"""

import io
import sys
from itertools import takewhile
from typing import Annotated, Any

import typer

from .. import load_verbs
from ..numerics.garbage import rare_garbage_collection
from .calibrate_verb import calibrate
from .compare_verb import compare
from .fields_verb import fields
from .fit_verb import fit
from .interrupt import ALL, if_interrupted, prompt_interrupt, tell
from .leaving import leave
from .messages import BAD_INPUT, INTERRUPTED, NO_OUTPUT, say
from .new_verb import new
from .quiet import only_news
from .report_verb import report
from .scenes_verb import scenes
from .simulate_verb import simulate
from .solve_verb import solve
from .spectrum_verb import spectrum
from .stiffness_verb import stiffness
from .study_verb import study
from .sweep_verb import sweep
from .tolerances_verb import tolerances

_EPILOG = """\b
Exit codes: 0 solved; 1 the output cannot be written; 2 bad input;
  3 not converged; 4 measurements that tell nothing of what is fitted;
  130 interrupted.
Environment: JAXBEARING_CACHE is the folder where compiled programs are kept
  between runs, or off; without it they are kept in the user's cache folder."""

_UsageError: Any = typer.BadParameter.__mro__[1]
"""Error of the parser for a wrong command line; typer exports only this one kind."""

app = typer.Typer(
    name="jaxbearing",
    help="Lubricated rolling bearings: loads, films, speeds and power loss.",
    epilog=_EPILOG,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


def main() -> None:
    """Entry point of the console script."""
    with prompt_interrupt():
        code = _run()
        if code == 0:
            if_interrupted(ALL)
    leave(code)


def _run() -> int:
    if sys.stdout is None:
        return say("the output cannot be written: standard output is closed", NO_OUTPUT)
    if isinstance(sys.stdout, io.TextIOWrapper):
        # a terminal without these characters shows others
        sys.stdout.reconfigure(errors="replace")
    only_news()
    try:
        with rare_garbage_collection():
            code = app(standalone_mode=False, prog_name="jaxbearing")
        sys.stdout.flush()
        if code == INTERRUPTED:
            # Ctrl-C that was deferred comes as an exception, of which the parser makes a code
            tell()
    except _UsageError as error:
        return _usage(error)
    except KeyboardInterrupt:
        tell()
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
        return NO_OUTPUT if gone else say(f"the output cannot be written: {error.strerror}", NO_OUTPUT)
    return code if isinstance(code, int) else 0


def _usage(error: Any) -> int:
    """A wrong command line in one line; no command at all asks for the help."""
    context = error.ctx
    if context is not None and error.format_message().strip() in ("", context.get_help().strip()):
        typer.echo(context.get_help(), err=True)
        return BAD_INPUT
    hint = f" See '{context.command_path} --help'." if context is not None else ""
    message = error.format_message()
    return say(f"{message.removesuffix('.')}.{hint}{_new_hint() if 'extra argument' in message else ''}", BAD_INPUT)


def _new_hint() -> str:
    """The command that writes a scene, if a verb got a designation such as NU 2210 in place of a scene."""
    from ..catalogue.designation import parse
    from ..scenes.errors import SceneError

    words = list(takewhile(lambda word: not word.startswith("-"), sys.argv[2:]))
    if len(words) < 2:
        return ""
    try:
        bearing = parse(" ".join(words))
    except SceneError:
        return ""
    return f" 'jaxbearing new {bearing.text}' writes a scene of this {bearing.in_words}."


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import PackageNotFoundError, version

        try:
            typer.echo(f"jaxbearing {version('jaxbearing')}")
        except PackageNotFoundError:
            typer.echo("jaxbearing (not installed)")
        raise typer.Exit


_WITHOUT_SOLVES = ("new",)
"""Verbs that solve nothing and make no scene."""


@app.callback()
def _options(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", help="Print the version.", is_eager=True, callback=_version)
    ] = False,
) -> None:
    if context.invoked_subcommand not in _WITHOUT_SOLVES:
        load_verbs()


_VERBS = (
    *(new, scenes, fields, solve, spectrum, report, sweep, tolerances),
    *(compare, study, simulate, stiffness, fit, calibrate),
)
for _verb in _VERBS:
    app.command()(_verb)

"""`jaxbearing spectrum`: life of a bearing under the load spectrum of its scene file."""

import json
import time
from typing import TYPE_CHECKING

import typer

from .messages import NOT_CONVERGED, bad_input, refuse
from .options import JsonOption, SceneArgument, SetOption, labelled
from .output_files import deliver
from .terminal import console

if TYPE_CHECKING:
    from ..spectrum import Spectrum


def spectrum(scene: SceneArgument, changes: SetOption = None, as_json: JsonOption = False) -> None:
    """Life under the load spectrum of a scene file: its [[state]] tables, each with a name, a share of the time and
    changes of the scene, solved with one program. The damages of all states are added (Palmgren and Miner). Prints
    share, life, loss, pressure and static safety by state, then the life, the equivalent load and the state that
    governs."""
    begin = time.monotonic()
    with bad_input():
        from ..scenes.overrides import split_assignments
        from ..scenes.states import load_states
        from ..spectrum.states import require_rated

        states = load_states(scene, split_assignments(changes or []))
        scenes = {one.name: one.scene for one in states}
        try:
            require_rated(scenes)
        except (TypeError, ValueError) as error:
            refuse(f"{scene}: {error}")

    from .cache import enable_compilation_cache
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    with without_false_alarms():
        from ..spectrum.verb import solve_states

        found = solve_states(scenes, [one.share for one in states])
        texts = {one.name: one.changes for one in states}
        seconds = time.monotonic() - begin
        deliver(lambda: _print(found, texts, label, seconds, as_json))
    failures = found.failures
    if failures:
        if as_json:
            said = "; ".join(f"state '{name}': {text}" for name, text in failures.items())
            typer.echo(f"not converged: {label}: {said}", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _print(found: "Spectrum", changes: dict[str, dict[str, str]], label: str, seconds: float, as_json: bool) -> None:
    from ..spectrum.tables import print_spectrum, spectrum_to_dict

    if as_json:
        typer.echo(json.dumps(spectrum_to_dict(found, changes), allow_nan=False))
    else:
        print_spectrum(found, changes, label, seconds, console())

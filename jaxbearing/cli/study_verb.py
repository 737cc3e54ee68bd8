"""`jaxbearing study`: the power-loss study of a bearing, compared with the statements of the source."""

import json
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .completion import scene_names
from .messages import NOT_CONVERGED, bad_input, refuse
from .options import SCENE_HELP, JsonOption, SetOption, labelled
from .output_files import PICTURES, Output, check_files, deliver
from .terminal import console

if TYPE_CHECKING:
    from ..studies.claims import Claim
    from ..studies.power_loss import PowerLossStudy

SceneArgument = Annotated[str, typer.Argument(metavar="[SCENE]", help=SCENE_HELP, autocompletion=scene_names)]
OutOption = Annotated[
    Path | None, typer.Option("--out", metavar="FILE.nc", help="Write all results, one NetCDF group a figure.")
]
PlotOption = Annotated[
    Path | None, typer.Option("--plot", metavar="FILE", help="Draw all figures on one page; .png, .svg or .pdf.")
]


def study(
    scene: SceneArgument = "turbine_roller",
    changes: SetOption = None,
    as_json: JsonOption = False,
    plot: PlotOption = None,
    out: OutOption = None,
) -> None:
    """Power loss of a roller or ball bearing against operating conditions and internal geometry (the source's Figures
    36 to 40), and which of the source's statements hold."""
    begin = time.monotonic()
    with bad_input():
        from ..bearings.ball.scene import BallBearing
        from ..bearings.cylindrical.scene import CylindricalRollerBearing
        from ..scenes.overrides import split_assignments
        from ..scenes.reader import load_scene

        model = load_scene(scene, split_assignments(changes or []))
        if not isinstance(model, BallBearing | CylindricalRollerBearing):
            refuse(f"SCENE: found '{scene}', a {type(model).__name__}; expected a cylindrical roller or ball bearing")
        if not model.slips:
            refuse(
                f"SCENE: found '{scene}' without power loss; expected a bearing with contact.traction (and a cage, if "
                "it is of rollers)"
            )
        check_files((("--plot", plot, PICTURES), ("--out", out, (".nc",))))

    from .cache import enable_compilation_cache
    from .devices import cores, use_cores
    from .quiet import without_false_alarms

    label = labelled(scene, changes)
    enable_compilation_cache()
    use_cores(cores())
    with without_false_alarms():
        from ..studies import claims_of, power_loss_study

        try:
            result = power_loss_study(model)
        except ValueError as error:
            refuse(str(error))
        failed = result.failed == result.cases
        claims = [] if failed else claims_of(result)
        seconds = time.monotonic() - begin
        outputs = (
            Output(out, lambda path: _write_data(result, path)),
            Output(plot, lambda path: _write_plot(result, label, path), long=True),
        )
        deliver(lambda: _print(result, claims, label, seconds, as_json), () if failed else outputs, as_json=as_json)
    if failed:
        left_out = [str(path) for path in (plot, out) if path is not None]
        if left_out:
            typer.echo(f"not written: {', '.join(left_out)}", err=True)
        typer.echo(f"not converged: {label}: none of {result.cases} cases", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _write_data(result: "PowerLossStudy", out: Path) -> None:
    from ..report.dataset import write_netcdf

    write_netcdf(result.tree(), out)


def _write_plot(result: "PowerLossStudy", label: str, plot: Path) -> None:
    from ..report.plots import save_plot
    from ..studies.pictures import study_page

    save_plot(study_page(result, label), plot)


def _print(result: "PowerLossStudy", claims: "Sequence[Claim]", label: str, seconds: float, as_json: bool) -> None:
    from ..studies.tables import print_study, study_to_dict

    if as_json:
        typer.echo(json.dumps(study_to_dict(result, claims), allow_nan=False))
    elif result.failed < result.cases:
        print_study(result, claims, label, seconds, console())

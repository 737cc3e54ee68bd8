"""The picture of a sweep: against one field the losses stacked (or a result without losses), over two fields a map."""

from pathlib import Path
from typing import TYPE_CHECKING

from .messages import refuse
from .output_files import PICTURES, check_files

if TYPE_CHECKING:
    from .._scene import AbstractScene
    from ..sweeps.cases import Cases

MAIN = ("power_loss_total", "film_central", "ring_radial", "ring_axial")
"""Results in order of preference: the first one that a sweep has is drawn."""


def check_plot(plot: Path | None, cases: "Cases", scene: "AbstractScene") -> None:
    """Refuses a picture that cannot be drawn or written before anything is computed."""
    if plot is None:
        return
    from ..machines import TwoDisk

    check_files((("--plot", plot, PICTURES),))
    if cases.kind != "grid":
        refuse("--plot: found cases that are no grid; expected --over with START:STOP:COUNT, of one or two fields")
    if isinstance(scene, TwoDisk):
        refuse("--plot: found a two-disk machine, whose results are curves; expected a bearing or a line contact")
    several = sum(size > 1 for size in cases.shape)
    if several not in (1, 2):
        refuse(f"--plot: found {several} fields with several values; expected one or two")


def write_plot(plot: Path, target: Path, label: str) -> None:
    """Draw the file of a sweep."""
    import xarray as xr

    from ..plots import map_of, power_loss_against, result_against
    from ..plots.sweeps import swept
    from ..report.plots import save_plot

    opened = xr.open_zarr(target) if target.suffix.lower() == ".zarr" else xr.open_dataset(target)
    with opened as whole:
        found = whole.squeeze()
        # dry scenes have a loss, which is zero
        there = [name for name in MAIN if name in found]
        main = next((name for name in there if bool((found[name] != 0.0).any())), there[0])
        if len(swept(found)) == 2:
            figure = map_of(found, main)
        else:
            figure = power_loss_against(found) if main == MAIN[0] else result_against(found, main)
    figure.suptitle(label, fontsize=10, parse_math=False)
    save_plot(figure, plot)

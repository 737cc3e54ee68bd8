"""The picture of a sweep: against one field the losses stacked or another main result, over two fields a map."""

from pathlib import Path
from typing import TYPE_CHECKING

from .messages import refuse
from .output_files import PICTURES, check_files

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    import matplotlib.figure
    import xarray as xr

    from .._scene import AbstractScene
    from ..sweeps.cases import Cases
    from ..sweeps.fields import SceneSource

MAIN = (
    "power_loss_total",
    "life_Lnmr_hours",
    "life_L10r_hours",
    "stiffness_radial",
    "stiffness_axial",
    "film_central",
    "ring_radial",
    "ring_axial",
)
"""Results in order of preference: the first one that a sweep has is drawn. Of a dry bearing it is the life, or the
stiffness of a bearing without ratings."""
_WIDTH, _HEIGHT, _HEAD = 9.6, 6.4, 0.85
"""Size of the page and height of its head, inches."""


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


def own_values(source: "SceneSource", fields: "Collection[str]") -> dict[str, float]:
    """The scene's own values of swept fields, SI; none where the scene cannot be read without the swept values, or has
    no such number."""
    from ..scenes.errors import SceneError
    from ..scenes.reader import scene_from_tables
    from ..studies.panels import own

    try:
        scene = scene_from_tables(source.tables, source.label, source.overrides)
    except (SceneError, ValueError):
        return {}
    return {path: value for path in fields if (value := own(scene, path)) is not None}


def write_plot(plot: Path, target: Path, label: str, point: "Mapping[str, float]") -> None:
    """Draw the file of a sweep. **Arguments:** `point`: SI values of swept fields at the scene's operating point."""
    from ..report.plots import save_plot
    from ..report.stores import opened

    with opened(target) as whole:
        save_plot(_page(with_stiffness(whole.squeeze()), label, point), plot)


def _page(dataset: "xr.Dataset", label: str, point: "Mapping[str, float]") -> "matplotlib.figure.Figure":
    """The page: head, and one chart."""
    from ..plots import map_of, power_loss_against, result_against
    from ..plots.sweeps import failed_note, name_of, swept
    from ..report.backends.matplotlib.page import Page
    from ..report.backends.matplotlib.sheet import foot, head, title_of

    # dry scenes have a loss, which is zero
    there = [name for name in MAIN if name in dataset]
    main = next((name for name in there if bool((dataset[name] != 0.0).any())), there[0])
    page = Page(_WIDTH, _HEIGHT)
    head(page, label, _operation(dataset))
    lines = foot(page, filter(None, [failed_note(dataset, "Gaps, or hatched").strip()]))
    below = 0.1 + 0.16 * lines
    page.set_layout_engine("constrained", rect=(0.015, below / _HEIGHT, 0.97, 1.0 - (below + _HEAD) / _HEIGHT))
    axes = page.add_subplot()
    if len(swept(dataset)) == 2:
        map_of(dataset, main, axes=axes, operating_point=point)
    elif main == MAIN[0]:
        power_loss_against(dataset, axes=axes, operating_point=point)
    else:
        result_against(dataset, main, axes=axes, operating_point=point)
    name = "power loss by location" if main == MAIN[0] and len(swept(dataset)) == 1 else name_of(dataset, main)
    title_of(axes, f"{name[:1].upper()}{name[1:]}")
    return page


def with_stiffness(dataset: "xr.Dataset") -> "xr.Dataset":
    """The data set with the diagonal of the stiffness, of degrees of freedom that the model has, as results of their
    own."""
    if "stiffness" not in dataset:
        return dataset
    for freedom in ("radial", "axial"):
        stiffness = dataset["stiffness"].sel(freedom=freedom, freedom_displaced=freedom)
        if bool(dataset["freedom_modelled"].sel(freedom=freedom)):
            stiffness.attrs = {"units": str(stiffness["stiffness_units"].values), "long_name": f"{freedom} stiffness"}
            dataset = dataset.assign({f"stiffness_{freedom}": stiffness.reset_coords(drop=True)})
    return dataset


def _operation(dataset: "xr.Dataset") -> str:
    """The caption of all cases in common: the numbers of the operating point that were not swept."""
    from ..plots.style import axis_name, shown

    texts = []
    for name, coordinate in dataset.coords.items():
        if (
            str(name).startswith("operation_")
            and coordinate.ndim == 0
            and str(coordinate.attrs.get("units", "1")) != "1"
        ):
            value, unit = shown(coordinate)
            if float(coordinate) != 0.0:
                texts.append(f"{axis_name(coordinate, '')} {float(value):.6g} {unit}")
    return "   ·   ".join(texts)

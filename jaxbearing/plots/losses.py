"""Power loss by location, stacked, and single results against a swept field."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.sheet import FAINT, INK, grid_lines, title_of
from .frame import axis_for, drawing
from .swept import TOTAL, axis_of, count_failed, held, is_logarithmic, losses_of, over_fields, words_of

if TYPE_CHECKING:
    import matplotlib.figure
    import xarray as xr

# Okabe and Ito's colours, which all kinds of colour vision tell apart; a location has one in all figures
COLOURS = {
    "inner_raceway": "#0072B2",
    "outer_raceway": "#D55E00",
    "drag": "#56B4E9",
    "cage_pilot": "#009E73",
    "pocket": "#E69F00",
    "flange": "#CC79A7",
    "element_ends": "#F0E442",
    "rolling_resistance": FAINT,
}


def power_loss_against(sweep_dataset: "xr.Dataset", field: str, axes: Any = None) -> "matplotlib.figure.Figure":
    """Power loss by location, stacked, against a field of a sweep; the black line is the total.

        found = jb.sweep(scene, {"operation.inner_speed": jnp.linspace(200.0, 2000.0, 20)})
        jb.plots.power_loss_against(found, "operation.inner_speed")

    **Arguments:**
    - `sweep_dataset`: from `jb.sweep` or the file of `jaxbearing sweep`. Failed cases are gaps.
    - `field`: dotted path of the field on the axis, of a grid, or the only one of a list or of samples.
    - `axes`: matplotlib axes to draw into; a figure of its own, with a caption, if not given.

    **Raises:** `ValueError` for a field that was not swept, where another field varies too (one value of it must be
    selected), where no case converged, and for a scene without power loss.
    """
    dataset, (name,) = over_fields(sweep_dataset, [field])
    losses, total = losses_of(dataset), dataset[TOTAL]
    failed, cases = count_failed(dataset)
    if failed == cases:
        raise ValueError(f"none of the {cases} cases converged: no power loss to draw")
    along, loss = dataset[name], axis_for("W", total.values)
    caption = f"Power loss by location, stacked, against the {words_of(along)}; black line and points: total. " + _rest(
        dataset, failed, cases
    )
    figure, axes = drawing(axes, caption)
    across = axis_of(along)
    x, below = across.of(along.values), np.zeros(along.size)
    for place, watts in losses.items():
        above = below + loss.of(watts.values)
        label = place.replace("_", " ")
        axes.fill_between(x, below, above, color=COLOURS.get(place, INK), linewidth=0, label=label)
        below = above
    axes.plot(x, loss.of(total.values), color=INK, marker="o", markersize=3.0, linewidth=1.2, label="total")
    axes.set_ylim(bottom=min(0.0, float(np.nanmin(loss.of(total.values)))))
    _abscissa(axes, along)
    axes.set_ylabel(loss.named("power loss"), fontsize=9)
    title_of(axes, "Power loss by location")
    grid_lines(axes)
    handles, names = axes.get_legend_handles_labels()
    # as they lie on each other: the uppermost first
    axes.legend(handles[::-1], names[::-1], fontsize=8.5, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def line_against(sweep_dataset: "xr.Dataset", result: str, field: str, axes: Any = None) -> "matplotlib.figure.Figure":
    """One result against a field of a sweep; failed cases are gaps.

    **Arguments:** `result`: name of a variable with one value a case; others as for `power_loss_against`.

    **Raises:** `ValueError` as `power_loss_against`, and for a result that is not there or has several values a case.
    """
    dataset, (name,) = over_fields(sweep_dataset, [field])
    values = result_of(dataset, result, [name])
    failed, cases = count_failed(dataset)
    if failed == cases:
        raise ValueError(f"none of the {cases} cases converged: nothing to draw")
    along, up = dataset[name], axis_of(values)
    what = words_of(values)
    caption = f"{what[:1].upper()}{what[1:]} against the {words_of(along)}. " + _rest(dataset, failed, cases)
    figure, axes = drawing(axes, caption)
    x = axis_of(along).of(along.values)
    axes.plot(x, up.of(values.values), color=COLOURS["inner_raceway"], marker="o", markersize=3.0, linewidth=1.4)
    _abscissa(axes, along)
    axes.set_ylabel(up.named(what), fontsize=9)
    title_of(axes, what[:1].upper() + what[1:])
    grid_lines(axes)
    return figure


def result_of(dataset: "xr.Dataset", result: Any, names: list[str]) -> "xr.DataArray":
    """The variable, with these dimensions in this order.

    **Raises:** `ValueError` for one that is not there or has other dimensions.
    """
    if isinstance(result, str):
        if result not in dataset:
            raise ValueError(f"result {result}: not in the data set, which has {_scalars(dataset, names)}")
        result = dataset[result]
    over = [str(name) for name in result.dims if name not in names]
    if over:
        raise ValueError(
            f"result {result.name}: one value a case is needed, found the dimension {', '.join(over)} too; expected "
            f'e.g. dataset["{result.name}"].max("{over[0]}") or .isel({over[0]}=0)'
        )
    if set(result.dims) != set(names):
        raise ValueError(f"result {result.name}: does not vary with {', '.join(names)}")
    return result.transpose(*names)


def _scalars(dataset: "xr.Dataset", names: list[str]) -> str:
    found = [str(name) for name, values in dataset.data_vars.items() if set(values.dims) == set(names)]
    return ", ".join(name for name in found if dataset[name].dtype.kind == "f")


def _rest(dataset: "xr.Dataset", failed: int, cases: int) -> str:
    """Last sentences of a caption: operating point, failed cases."""
    there = held(dataset)
    gaps = f" {failed} of {cases} cases failed: gaps." if failed else ""
    return (f"At {there}." if there else "") + gaps


def _abscissa(axes: Any, along: "xr.DataArray") -> None:
    across = axis_of(along)
    x = across.of(along.values)
    if is_logarithmic(along.values):
        axes.set_xscale("log")
    if x.min() < x.max():
        axes.set_xlim(x.min(), x.max())
    axes.set_xlabel(across.named(words_of(along)), fontsize=9)

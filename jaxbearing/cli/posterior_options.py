"""Options of the verbs that sample a posterior."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .messages import refuse

if TYPE_CHECKING:
    from fitting.posterior import Posterior, Sampling
    from fitting.predictive import Predictive

PosteriorOption = Annotated[
    bool, typer.Option("--posterior", help="Sample the distribution of what is fitted (No-U-Turn sampler).")
]
SamplesOption = Annotated[int, typer.Option("--samples", metavar="COUNT", help="Samples of each of four chains.")]
PlotPosteriorOption = Annotated[
    Path | None,
    typer.Option(
        "--plot-posterior", metavar="FILE", help="Draw the samples and what they predict; .png, .svg or .pdf."
    ),
]


def sampling_of(wanted: bool, samples: int, plot: Path | None) -> "Sampling | None":
    """The sampling that is asked for, or `None`; refuses what cannot be."""
    from fitting.posterior import MISSING, Sampling, available

    if not wanted:
        if plot is not None:
            refuse("--plot-posterior: found no --posterior; expected both")
        return None
    sampling = Sampling(samples=samples)
    try:
        sampling.check()
    except ValueError as error:
        refuse(f"--{error}")
    if not available():
        refuse(f"--posterior: {MISSING}")
    return sampling


def write_posterior(
    drawn: "Posterior", again: "Predictive | None", units: Mapping[str, str], label: str, path: Path
) -> None:
    """Draws the samples and what they predict into a file."""
    from ..plots import posterior as draw
    from ..report.plots import save_plot

    save_plot(draw(drawn, units, title=label, predictive=again), path)

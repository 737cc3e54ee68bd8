"""A posterior of an oil on the screen."""

from rich import box
from rich.console import Console
from rich.padding import Padding
from rich.table import Table

from jaxbearing.report.backends.screen import print_line, print_rule, print_warnings

from ..posterior import Posterior
from ..predictive import Predictive
from ..result import Parameter
from .words import SYMBOL, parameter_text


def print_posterior(posterior: Posterior, console: Console, again: Predictive | None = None) -> None:
    """Print median, interval, R-hat and effective samples of each parameter, how the samples were drawn, and the
    prediction of a repeated measurement."""
    print_rule(f"Posterior, {100.0 * posterior.level:g} % intervals", console)
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1), header_style="")
    table.add_column("Symbol", no_wrap=True)
    for title in ("median", "", "deviation", "interval", "R-hat", "effective samples"):
        table.add_column(title, justify="right", no_wrap=True)
    for name, parameter in posterior.parameters.items():
        text = parameter_text(
            name, Parameter(parameter.median, parameter.deviation, parameter.lower, parameter.upper, False)
        )
        quality = (f"{parameter.r_hat:.4f}", f"{parameter.effective:.0f}")
        table.add_row(SYMBOL[name], text.value, text.unit, text.error, text.interval, *quality)
    console.print(Padding(table, (0, 1)))
    print_line("sampler", posterior.in_words(), console)
    if again is not None:
        print_line("predictive", again.in_words(), console)
    print_warnings(list(posterior.warnings), console)

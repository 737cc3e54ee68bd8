"""Scatter of the results of a scene whose fields have tolerances: derivatives of one solve, and samples beside them."""

from .outcome import Sampled as Sampled
from .outcome import Samples as Samples
from .outcome import Spread as Spread
from .outcome import Tolerances as Tolerances

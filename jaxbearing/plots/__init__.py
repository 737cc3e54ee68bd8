"""Figures, one function each: of a solution, a history, a sweep, and of the property laws. Matplotlib is imported when
something is drawn, not before. Each takes `axes=` to draw into, returns the figure, and says in `figure.caption` what
is shown."""

from .sweeps import map_of as map_of
from .sweeps import power_loss_against as power_loss_against
from .sweeps import raceway_control_map as raceway_control_map
from .sweeps import result_against as result_against

"""Figures, one function each: of a solution, a history, a sweep, and (`plots.properties`) of the property laws.

Matplotlib is imported when something is drawn, not before. Each takes `axes=` to draw into and returns the figure; a
figure of its own has its caption under it.
"""

from . import properties as properties
from .calibration import calibration as calibration
from .posterior import posterior as posterior
from .solutions import cage_orbit as cage_orbit
from .solutions import films as films
from .solutions import load_distribution as load_distribution
from .solutions import power_loss as power_loss
from .solutions import pressures as pressures
from .solutions import sliding as sliding
from .solutions import traction_curves as traction_curves
from .stribeck import stribeck as stribeck
from .sweeps import map_of as map_of
from .sweeps import power_loss_against as power_loss_against
from .sweeps import raceway_control_map as raceway_control_map
from .sweeps import result_against as result_against
from .tolerances import tolerances as tolerances

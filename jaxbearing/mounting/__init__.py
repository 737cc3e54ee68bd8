"""Bearings on their seats: what fits, speeds and temperatures make of the dimensions on the drawing."""

from .annulus import Annulus as Annulus
from .fit import Fit as Fit
from .fit import FitState as FitState
from .iso286 import hole_limits as hole_limits
from .iso286 import shaft_limits as shaft_limits
from .seats import Fits as Fits
from .seats import PartTemperatures as PartTemperatures

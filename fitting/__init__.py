"""Rheology of an oil from two-disk traction curves, with the very traction model of the bearings."""

from .comparison import ModelRow as ModelRow
from .comparison import compare as compare
from .fit import fit as fit
from .fit import fit_models as fit_models
from .io import CurveError as CurveError
from .io import read_curves as read_curves
from .loss import Errors as Errors
from .measurements import MeasurementError as MeasurementError
from .measurements import Measurements as Measurements
from .options import FitOptions as FitOptions
from .result import FitResult as FitResult
from .result import Parameter as Parameter

"""Calibration: fields of scenes from measurements at many operating points, with what these cannot tell."""

from .data import Data as Data
from .result import Calibration as Calibration
from .search import Options as Options
from .verb import calibrate as calibrate

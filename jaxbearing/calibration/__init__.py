"""Calibration: fields of scenes from measurements at many operating points, with what these cannot tell."""

from .data import Data as Data
from .next_point import Candidate as Candidate
from .next_point import next_points as next_points
from .posterior import posterior_of as posterior_of
from .posterior import predictive as predictive
from .prediction import distributions_of as distributions_of
from .prediction import joint_of as joint_of
from .prediction import predict as predict
from .repetitions import repeated as repeated
from .result import Calibration as Calibration
from .search import Options as Options
from .verb import calibrate as calibrate

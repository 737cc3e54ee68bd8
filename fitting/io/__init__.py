"""Measured traction curves from files: the edge of `fitting`, where units and files are read and nothing else."""

from .errors import CurveError
from .reader import read_curves
from .table import CurveTable

__all__ = ["CurveError", "CurveTable", "read_curves"]

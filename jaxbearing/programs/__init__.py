"""Compiled programs that are kept between processes."""

from .folder import VARIABLE as VARIABLE
from .folder import cache_folder as cache_folder
from .kept import KeptProgram as KeptProgram

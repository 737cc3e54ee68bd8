"""Sweeps at the edge: which cases, files that survive a kill, other processes, the labelled result."""

from .cases import Cases as Cases
from .cases import grid as grid
from .cases import latin_hypercube as latin_hypercube
from .cases import listed as listed
from .cases import random as random
from .chunks import run_chunk as run_chunk

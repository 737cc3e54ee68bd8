"""Load spectra: one bearing in several states, each with a share of the time, and the life under all of them."""

from .result import Spectrum as Spectrum
from .states import State as State

"""Makers' friction formulas, beside the physics of the package and never inside its results.

Formulas of catalogues are fits to many bearings of usual sizes, loads, speeds and oils. They say what a maker would
expect; the differences between them are a factor of two to three on the same bearing.
"""

from .catalogue import Catalogue as Catalogue
from .comparison import Comparison as Comparison
from .comparison import Law as Law
from .comparison import Physical as Physical
from .comparison import compared as compared

"""One lubricated line contact: Hertz and Palmgren, film thickness, thermal factors, traction."""

from .film import AbstractLineFilm as AbstractLineFilm
from .film import DowsonHigginson as DowsonHigginson
from .film import MartinBlend as MartinBlend
from .film import Moes as Moes
from .line import LineContact as LineContact
from .thermal import AbstractThermalFactor as AbstractThermalFactor
from .thermal import Gupta as Gupta
from .thermal import NoThermalReduction as NoThermalReduction
from .thermal import inlet_temperature_rise as inlet_temperature_rise
from .traction import AbstractTraction as AbstractTraction
from .traction import MaxwellEyring as MaxwellEyring

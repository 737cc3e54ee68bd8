"""The source's property figures (Figures 20 to 34 and 41), computed from the library's laws."""

from .coefficients import alpha_of_models as alpha_of_models
from .coefficients import alpha_of_oils as alpha_of_oils
from .coefficients import film_of_models as film_of_models
from .spin import spin_friction as spin_friction
from .thermal import thermal_factor as thermal_factor
from .traction import traction_models as traction_models
from .traction import traction_shear_modulus as traction_shear_modulus
from .traction import traction_stress as traction_stress
from .viscosities import viscosity_models as viscosity_models
from .viscosities import viscosity_pressure as viscosity_pressure
from .viscosities import viscosity_temperature as viscosity_temperature

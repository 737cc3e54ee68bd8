"""Lubricants: viscosity, pressure-viscosity coefficient, rheology, density, conductivity, heat capacity."""

from .lubricant import InletOil as InletOil
from .lubricant import Lubricant as Lubricant
from .pressure_viscosity import AbstractPressureViscosity as AbstractPressureViscosity
from .pressure_viscosity import ConstantPressureViscosity as ConstantPressureViscosity
from .pressure_viscosity import FittedPressureViscosity as FittedPressureViscosity
from .pressure_viscosity import IntegratedPressureViscosity as IntegratedPressureViscosity
from .pressure_viscosity import NoPressureViscosity as NoPressureViscosity
from .rheology import VISCOUS_FUNCTIONS as VISCOUS_FUNCTIONS
from .rheology import ExponentialRheology as ExponentialRheology
from .simple_viscosity import Barus as Barus
from .simple_viscosity import ConstantViscosity as ConstantViscosity
from .simple_viscosity import Roelands as Roelands
from .thermal import ESTER_HEAT_CAPACITY as ESTER_HEAT_CAPACITY
from .thermal import MINERAL_HEAT_CAPACITY as MINERAL_HEAT_CAPACITY
from .thermal import LinearConductivity as LinearConductivity
from .thermal import LinearDensity as LinearDensity
from .thermal import LinearHeatCapacity as LinearHeatCapacity
from .two_viscosities import WaltherRoelands as WaltherRoelands
from .two_viscosities import wooster_pressure_viscosity as wooster_pressure_viscosity
from .viscosity import AbstractViscosity as AbstractViscosity
from .viscosity import ModifiedWLF as ModifiedWLF

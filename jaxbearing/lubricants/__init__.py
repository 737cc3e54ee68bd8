"""Lubricants: viscosity, pressure-viscosity coefficient, rheology, density, conductivity."""

from .lubricant import InletOil as InletOil
from .lubricant import Lubricant as Lubricant
from .pressure_viscosity import AbstractPressureViscosity as AbstractPressureViscosity
from .pressure_viscosity import ConstantPressureViscosity as ConstantPressureViscosity
from .pressure_viscosity import FittedPressureViscosity as FittedPressureViscosity
from .pressure_viscosity import IntegratedPressureViscosity as IntegratedPressureViscosity
from .rheology import ExponentialRheology as ExponentialRheology
from .thermal import LinearConductivity as LinearConductivity
from .thermal import LinearDensity as LinearDensity
from .viscosity import AbstractViscosity as AbstractViscosity
from .viscosity import ModifiedWLF as ModifiedWLF

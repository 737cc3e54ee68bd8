"""The source's oils built directly, without the scene reader: law parameters from its tables 5, 8, 10, 11 and 12."""

from jaxbearing.lubricants import (
    ExponentialRheology,
    FittedPressureViscosity,
    IntegratedPressureViscosity,
    LinearConductivity,
    LinearDensity,
    Lubricant,
    ModifiedWLF,
)


def mobil_jet_ii() -> Lubricant:
    """Table 5 with the glass viscosity decided as 1e12 Pa s; own fit of alpha*; table 8; eqs. (90)-(91)."""
    return Lubricant(
        viscosity=ModifiedWLF(
            glass_viscosity=1e12,
            glass_temperature=165.75,
            glass_shift=171.96,
            glass_shift_rate=0.4294e-9,
            expansion_factor=0.1961,
            expansion_rate=17.434e-9,
            c1=16.342,
            c2=29.406,
        ),
        pressure_viscosity=FittedPressureViscosity(
            offset=0.0,
            a00=-2348.772e-9,
            a01=403871.5e-9,
            pole_temperature=136.344,
            a10=3320.064e-9,
            a11=-14648.747e-9,
        ),
        rheology=ExponentialRheology(
            reference_temperature=300.0,
            shear_modulus=4.82e4,
            shear_modulus_pressure=6.11e-9,
            shear_modulus_temperature=2450.0,
            stress=1.56e5,
            stress_pressure=2.41e-9,
            stress_temperature=-786.0,
            viscous_function="ree_eyring",
        ),
        density=LinearDensity(value=1013.4, slope=-0.752, reference_temperature=273.15),
        conductivity=LinearConductivity(value=0.148676, slope=-2.22753e-4, reference_temperature=366.67),
    )


ASSUMED_CONDUCTIVITY = LinearConductivity(value=0.14, slope=0.0, reference_temperature=300.0)
"""Placeholder of the three oils for which the source gives none."""


def pennzane_x2000() -> Lubricant:
    """Table 10; alpha* by the integral; table 12 (fitted with the Elsharkawy-Hamrock law); density of table 9."""
    viscosity = ModifiedWLF(1e7, 185.691, 69.8093, 1.67903e-9, 0.212452, 11.8028e-9, 11.8362, 60.5908)
    return Lubricant(
        viscosity=viscosity,
        pressure_viscosity=IntegratedPressureViscosity(viscosity),
        rheology=ExponentialRheology(
            *(303.15, 0.565138e6, 3.41106e-9, 1426.14, 16.0444e6, 1.08853e-9, -977.746),
            viscous_function="elsharkawy_hamrock",
            exponent=2.0,
        ),
        density=LinearDensity(value=850.0, slope=0.0, reference_temperature=288.75),
        conductivity=ASSUMED_CONDUCTIVITY,
    )


def nye_186a() -> Lubricant:
    """Table 10; alpha* by the integral; the source gives neither rheology nor density."""
    viscosity = ModifiedWLF(1e7, 188.04, 53.9262, 2.26829e-9, 0.223438, 12.4888e-9, 11.5171, 53.979)
    coefficient = IntegratedPressureViscosity(viscosity)
    return Lubricant(viscosity=viscosity, pressure_viscosity=coefficient, conductivity=ASSUMED_CONDUCTIVITY)


def fomblin_z25() -> Lubricant:
    """Table 10; alpha* by the integral; density of table 9; the source gives no rheology."""
    viscosity = ModifiedWLF(1e7, 152.455, 48.3241, 2.96467e-9, 0.224572, 23.8537e-9, 10.0745, 54.4713)
    return Lubricant(
        viscosity=viscosity,
        pressure_viscosity=IntegratedPressureViscosity(viscosity),
        density=LinearDensity(value=1850.0, slope=0.0, reference_temperature=288.75),
        conductivity=ASSUMED_CONDUCTIVITY,
    )


FITTED_COEFFICIENTS = {
    "pennzane_x2000": FittedPressureViscosity(0.0, -54.677e-9, 8.4243e5 * 1e-9, 125.1002, 1.4264e-6, 1.3876e-5),
    "nye_186a": FittedPressureViscosity(0.0, -1.7295e-6, 4.9567e5 * 1e-9, 134.061, 3.2079e-6, -1.97e-5),
    "fomblin_z25": FittedPressureViscosity(0.0, -1.3222e-6, 7.3974e5 * 1e-9, 97.948, 4.0438e-6, -1.3132e-4),
}
"""Eq. (93) with table 11."""

OILS = {oil.__name__: oil() for oil in (mobil_jet_ii, pennzane_x2000, nye_186a, fomblin_z25)}

"""A lubricant, and its state at a contact inlet."""

import dataclasses
from collections.abc import Mapping
from typing import Any

import equinox as eqx
import jax.numpy as jnp

from .._types import Values
from ..numerics.arguments import require_temperature
from .pressure_viscosity import AbstractPressureViscosity, IntegratedPressureViscosity
from .rheology import AbstractRheology
from .thermal import LinearConductivity, LinearDensity, LinearHeatCapacity
from .viscosity import AbstractViscosity


class InletOil(eqx.Module):
    """Oil properties for film formulas, evaluated once at inlet temperature and ambient pressure."""

    temperature: Values
    viscosity: Values
    pressure_viscosity: Values
    log_slope: Values
    density: Values | None = None
    conductivity: Values | None = None
    flow: Values | None = None


InletOil.__init__.__doc__ = """**Arguments:**
- `temperature`: K, > 0.
- `viscosity`: Pa s, > 0.
- `pressure_viscosity`: reciprocal isoviscous pressure, 1/Pa, > 0; 0 for an isoviscous fluid.
- `log_slope`: d ln(viscosity)/dT, 1/K, < 0; 0 for a viscosity that is constant.
- `density`: kg/m^3, > 0, or None where the lubricant has none.
- `conductivity`: W/(m K), > 0, or None where the lubricant has none.
- `flow`: of the oil past the contacts, m^3/s, >= 0, or None where no law asks for it.
"""


class Lubricant(eqx.Module):
    """The laws of one lubricant. A law that is not known is None; a model that needs it reports it as missing."""

    viscosity: AbstractViscosity
    pressure_viscosity: AbstractPressureViscosity
    rheology: AbstractRheology | None = None
    density: LinearDensity | None = None
    conductivity: LinearConductivity | None = None
    heat_capacity: LinearHeatCapacity | None = None
    notes: tuple[str, ...] = eqx.field(static=True, default=())

    def tied(self, changes: Mapping[str, object]) -> dict[str, Any]:
        """Changes of fields, together with the changes that follow from them.

        A viscosity law that holds the density takes a new density. A pressure-viscosity coefficient that is the
        integral of the viscosity law is integrated from a new law of the same class. A law that is among the changes
        stays as given.

        **Arguments:** `changes`: field -> new value.
        """
        new = dict(changes)
        law: Any = new.get("viscosity", self.viscosity)
        density = new.get("density")
        if density is not None and "viscosity" not in new and isinstance(getattr(law, "density", None), LinearDensity):
            new["viscosity"] = law = dataclasses.replace(law, density=density)
        integral = self.pressure_viscosity
        follows = isinstance(integral, IntegratedPressureViscosity) and type(integral.viscosity) is type(self.viscosity)
        if "viscosity" in new and "pressure_viscosity" not in new and follows and type(law) is type(self.viscosity):
            new["pressure_viscosity"] = IntegratedPressureViscosity(law)
        return new

    def at(self, temperature: Values) -> InletOil:
        """Properties of the oil at a contact inlet. **Arguments:** `temperature`, K, > 0."""
        require_temperature(temperature)
        temperature = jnp.asarray(temperature, dtype=float)
        return InletOil(
            temperature=temperature,
            viscosity=self.viscosity.viscosity(0.0, temperature),
            pressure_viscosity=self.pressure_viscosity.coefficient(temperature),
            log_slope=self.viscosity.log_slope(temperature),
            density=None if self.density is None else self.density.density(temperature),
            conductivity=None if self.conductivity is None else self.conductivity.conductivity(temperature),
        )


Lubricant.__init__.__doc__ = """**Arguments:**
- `viscosity`: law of viscosity in pressure and temperature.
- `pressure_viscosity`: law of the coefficient for film formulas.
- `rheology`: shear modulus and stress; a traction law needs it.
- `density`: needed by drag and by flow rates in mass.
- `conductivity`: needed by thermal film reduction.
- `heat_capacity`: needed by thermal networks.
- `notes`: what whoever uses the oil should know of its data (estimated, assumed), a sentence each; a scene that is
  solved repeats them among its warnings.
"""

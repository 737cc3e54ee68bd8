"""Density, thermal conductivity and heat capacity of a lubricant at ambient pressure."""

from typing import ClassVar

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_temperature
from ..numerics.checks import Checked, bounded
from ..numerics.safe import softplus_floor

CONDUCTIVITY_FLOOR = 0.05
"""Smallest conductivity, W/(m K): a linear fit crosses zero far above its range (1034 K for Mobil Jet II)."""
CONDUCTIVITY_WIDTH = 2.5e-3
"""Smoothing width of that floor, W/(m K): at 0.125 W/(m K) (473 K) the value is exact to 1e-15."""


class LinearDensity(Checked):
    r"""Linear density $\rho = \rho_r + s (T - T_r)$.

    **Validity:** the range of the fit; compressibility is left out.
    **Reference:** source eq. (91) for Mobil Jet II (printed in g/ml, a wrong unit: it is kg/m^3).
    """

    part: ClassVar[str] = "oil.density"

    value: Scalar = bounded("> 0", unit="kg/m^3")
    slope: Scalar = bounded("finite", unit="kg/(m^3 K)")
    reference_temperature: Scalar = bounded("> 0", unit="K")

    def density(self, temperature: Values) -> Batch:
        """Density, kg/m^3. **Arguments:** `temperature`, K."""
        require_temperature(temperature)
        return jnp.asarray(self.value + self.slope * jnp.subtract(temperature, self.reference_temperature))


LinearDensity.__init__.__doc__ = """**Arguments:**
- `value`: density at the reference temperature, kg/m^3, > 0.
- `slope`: kg/(m^3 K), usually negative.
- `reference_temperature`: K.
"""


class LinearConductivity(Checked):
    r"""Linear conductivity $k = k_r + s (T - T_r)$, never below 0.05 W/(m K).

    **Validity:** the range of the fit. The floor is smooth (width 2.5e-3 W/(m K)) and changes nothing above
    0.13 W/(m K).
    **Reference:** source eq. (90) for Mobil Jet II (printed in N/s/K, meaning W/(m K)).
    """

    part: ClassVar[str] = "oil.conductivity"

    value: Scalar = bounded("> 0", unit="W/(m K)")
    slope: Scalar = bounded("finite", unit="W/(m K^2)")
    reference_temperature: Scalar = bounded("> 0", unit="K")

    def conductivity(self, temperature: Values) -> Batch:
        """Thermal conductivity, W/(m K). **Arguments:** `temperature`, K."""
        require_temperature(temperature)
        plain = self.value + self.slope * jnp.subtract(temperature, self.reference_temperature)
        return softplus_floor(plain, CONDUCTIVITY_FLOOR, CONDUCTIVITY_WIDTH)


LinearConductivity.__init__.__doc__ = """**Arguments:**
- `value`: conductivity at the reference temperature, W/(m K), > 0.
- `slope`: W/(m K^2), usually negative.
- `reference_temperature`: K.
"""


class LinearHeatCapacity(Checked):
    r"""Linear heat capacity $c_p = c_r + s (T - T_r)$; constant for a slope of 0.

    **Validity:** 1670 + 4.3 (T - 273 K) J/(kg K) for mineral oils and 2150 J/(kg K) for ester oils near 120 degC are
    from memory, good to about 5 %. The influence of pressure is left out.
    """

    part: ClassVar[str] = "oil.heat_capacity"

    value: Scalar = bounded("> 0", unit="J/(kg K)")
    slope: Scalar = bounded("finite", unit="J/(kg K^2)")
    reference_temperature: Scalar = bounded("> 0", unit="K")

    def heat_capacity(self, temperature: Values) -> Batch:
        """Specific heat capacity, J/(kg K). **Arguments:** `temperature`, K."""
        require_temperature(temperature)
        return jnp.asarray(self.value + self.slope * jnp.subtract(temperature, self.reference_temperature))


LinearHeatCapacity.__init__.__doc__ = """**Arguments:**
- `value`: specific heat capacity at the reference temperature, J/(kg K), > 0.
- `slope`: J/(kg K^2); 0 for a constant.
- `reference_temperature`: K.
"""

MINERAL_HEAT_CAPACITY = LinearHeatCapacity(1670.0, 4.3, 273.0)
"""Heat capacity of mineral oils, within about 5 %, from memory."""
ESTER_HEAT_CAPACITY = LinearHeatCapacity(2150.0, 0.0, 393.15)
"""Heat capacity of ester oils near 120 degC, within about 5 %, from memory."""

"""Oil-air drag on rolling elements: equivalent density, drag coefficients and forces."""

from typing import Literal

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_numbers, require_temperature
from ..numerics.checks import Checked, bounded
from ..numerics.safe import regular_power, smooth_abs, softplus_floor
from ..numerics.structure import choice

PARKER_CONSTANT = 1e5
"""Parker's constant for the oil content as a fraction, with flow in cm^3/min, speed in rpm, diameter in mm."""
CM3_PER_MINUTE = 6e7
"""Conversion factor from m^3/s to cm^3/min."""
FLOW_WIDTH = 0.1 * 1e3 / 60.0
"""Flow below which Q^0.37 is linear, cm^3/min: 0.1 litre per hour. The slope of the law is infinite at Q = 0; an
optimiser that starts there needs a finite one, here that of the secant from 0 to 0.1 l/h."""
SPEED_FLOOR = 100.0
"""Smallest shaft speed in the oil fraction, rpm."""
SPEED_FLOOR_WIDTH = 10.0
"""Smoothing width of `SPEED_FLOOR`, rpm: raises the speed by 6.9 % at 100 rpm, by less than 1e-12 above 370 rpm."""
SPEED_WIDTH = 1e-3
"""Smoothing of |speed|, rpm."""
REYNOLDS_FLOOR = 1e-6
"""Smoothing of |Re|: relative error 5e-9 at Re = 0.01."""
SPHERE_REYNOLDS_LIMIT = 3e5
CYLINDER_REYNOLDS_LIMIT = 2e5
MOLAR_MASS_AIR = 0.029
"""Molar mass of air, kg/mol."""
GAS_CONSTANT = 8.314
"""Gas constant, J/(mol K)."""


def parker_oil_fraction(
    oil_flow: Values, shaft_speed: Values, pitch_diameter: Values, through_flow_fraction: Values = 1.0
) -> Batch:
    r"""Volume fraction of oil in the bearing cavity by Parker's law, which may exceed 1.

    $X = 10^5\,Q^{0.37}/(N d_m^{1.7})$ with Q in cm^3/min, N in rpm, d_m in mm (converted here).

    **Limits:** 0 without flow; there Q^0.37 has the finite slope w^(-0.63), w = 0.1 l/h (see `regular_power`). X is
    lower than the law by 0.158 (w/Q)^4, relatively, at larger flows: 10 % at 0.1 l/h, 1.6e-5 at 1 l/h, 1.6e-9 at
    10 l/h. Below w it is linear, (Q/w)^0.63 times the law: 23 % of it at 0.01 l/h, far below the flows that Parker
    measured. The law diverges at rest: |N| is floored smoothly at 100 rpm. Use `saturated_oil_fraction` for a density.
    **Validity:** measured at high speed, with fractions of a few per cent.
    **Reference:** Parker (1982), NASA TP-1982; source eq. (89), whose printed exponents are scrambled. For X in per
    cent the constant is 1e7 (3.78 % at 150 l/h, 10500 rpm, 142 mm).

    **Arguments:** `oil_flow`, m^3/s, >= 0; `shaft_speed`, rad/s; `pitch_diameter`, m;
    `through_flow_fraction`: share of the flow that crosses the bearing, 0 to 1.
    """
    require_numbers(">= 0", oil_flow=oil_flow)
    require_numbers("finite", shaft_speed=shaft_speed)
    require_numbers("> 0", pitch_diameter=pitch_diameter)
    require_numbers("between 0 and 1", through_flow_fraction=through_flow_fraction)
    flow = oil_flow * through_flow_fraction * CM3_PER_MINUTE
    rpm = smooth_abs(shaft_speed * (30.0 / jnp.pi), SPEED_WIDTH)
    rpm = softplus_floor(rpm, SPEED_FLOOR, SPEED_FLOOR_WIDTH)
    diameter = pitch_diameter * 1e3
    return PARKER_CONSTANT * regular_power(flow, 0.37, FLOW_WIDTH, order=4) / (rpm * diameter**1.7)


def saturated_oil_fraction(
    oil_flow: Values, shaft_speed: Values, pitch_diameter: Values, through_flow_fraction: Values = 1.0
) -> Batch:
    """Oil fraction kept below 1, X (1 + X^4)^(-1/4) with X of `parker_oil_fraction`.

    The relative error is X^4/4 (1e-6 at 4.5 %).

    **Arguments:** as in `parker_oil_fraction`.
    """
    x = parker_oil_fraction(oil_flow, shaft_speed, pitch_diameter, through_flow_fraction)
    return x * (1.0 + x**4) ** -0.25


def air_density(temperature: Values, pressure: Values = 101325.0) -> Batch:
    """Density of air as an ideal gas, kg/m^3. **Arguments:** `temperature`, K, > 0; `pressure`, Pa."""
    require_temperature(temperature)
    require_numbers(">= 0", pressure=pressure)
    return pressure * MOLAR_MASS_AIR / (GAS_CONSTANT * jnp.asarray(temperature))


def mixture_density(oil_fraction: Values, oil_density: Values, gas_density: Values) -> Batch:
    """Density of the oil-air mixture, X rho_oil + (1 - X) rho_air, kg/m^3 (source eq. (88))."""
    require_numbers(">= 0", oil_fraction=oil_fraction, oil_density=oil_density, gas_density=gas_density)
    return jnp.asarray(oil_fraction) * oil_density + (1.0 - oil_fraction) * gas_density


def sphere_drag_coefficient(reynolds: Values) -> Batch:
    r"""Cd of a sphere: $24/Re\,(1+0.15Re^{0.687}) + 0.42/(1+42500Re^{-1.16})$, constant above Re = 3e5.

    **Limits:** Stokes' 24/Re at small Re; Re is smoothed to sqrt(Re^2 + 1e-12), so Cd is finite at rest.
    **Validity:** Re < 3e5 (the drag crisis beyond is left out, by decision).
    **Reference:** Clift and Gauvin (1970); Clift, Grace and Weber (1978), *Bubbles, Drops and Particles*.
    """
    require_numbers("finite", reynolds=reynolds)
    re = jnp.minimum(smooth_abs(reynolds, REYNOLDS_FLOOR), SPHERE_REYNOLDS_LIMIT)
    return 24.0 / re * (1.0 + 0.15 * re**0.687) + 0.42 / (1.0 + 42500.0 * re**-1.16)


def cylinder_drag_coefficient(reynolds: Values) -> Batch:
    r"""Cd of a single cylinder across the stream, constant above Re = 2e5.

    $C_d = 1.18 + 6.8Re^{-0.89} + 1.96Re^{-0.5} - 4\cdot10^{-4}Re/(1+3.64\cdot10^{-7}Re^2)$.

    **Limits:** Re is smoothed to sqrt(Re^2 + 1e-12), so Cd is finite at rest.
    **Validity:** 1e-4 < Re < 2e5; below, Cd Re falls as Re^0.11, within 12 % of Lamb's solution down to Re = 1e-6.
    **Reference:** Sucker and Brauer (1975), Waerme- und Stoffuebertragung 8, 149.
    """
    require_numbers("finite", reynolds=reynolds)
    re = jnp.minimum(smooth_abs(reynolds, REYNOLDS_FLOOR), CYLINDER_REYNOLDS_LIMIT)
    return 1.18 + 6.8 * re**-0.89 + 1.96 * re**-0.5 - 4e-4 * re / (1.0 + 3.64e-7 * jnp.square(re))


def ball_frontal_area(diameter: Values, cage_thickness: Values) -> Batch:
    r"""Frontal area of a ball that the cage leaves free, $\pi D^2/4 - L_cD$, m^2, not below 0.

    **Arguments:** `diameter` D, m; `cage_thickness` L_c, m.
    """
    require_numbers("> 0", diameter=diameter)
    require_numbers(">= 0", cage_thickness=cage_thickness)
    return jnp.maximum(diameter * (0.25 * jnp.pi * jnp.asarray(diameter) - cage_thickness), 0.0)


class ReynoldsDrag(Checked):
    r"""Drag of one rolling element, with the coefficient of an isolated sphere or cylinder at its Reynolds number.

    $F = \tfrac12\rho C_d(Re)SV|V|$, $Re = \rho|V|D/\mu$, computed as $\tfrac12 S(\mu/D)V\,(Re\,C_d)$. The density is
    that of the oil-air mixture, the viscosity that of the oil.

    **Limits:** 0 at rest with a finite slope: Stokes' $12S\mu/D$ for a sphere.
    **Validity:** as `sphere_drag_coefficient` and `cylinder_drag_coefficient`; the mutual shielding of neighbours in a
    row is left out.
    **Reference:** source eq. (88).
    """

    diameter: Scalar = bounded("> 0")
    area: Scalar = bounded(">= 0")
    shape: Literal["sphere", "cylinder"] = choice("shape", ("sphere", "cylinder"), "sphere")

    def force(self, speed: Values, density: Values, viscosity: Values) -> Batch:
        """Drag force, N, with the sign of the speed; it acts *against* the motion.

        **Arguments:** `speed`, orbital, m/s, signed; `density` of the mixture, kg/m^3, > 0; `viscosity`, Pa s, > 0.
        """
        law = sphere_drag_coefficient if self.shape == "sphere" else cylinder_drag_coefficient
        reynolds = density * jnp.asarray(speed) * self.diameter / viscosity
        scaled = smooth_abs(reynolds, REYNOLDS_FLOOR) * law(reynolds)
        return 0.5 * self.area * viscosity / self.diameter * speed * scaled

    def power(self, speed: Values, density: Values, viscosity: Values) -> Batch:
        """Drag power, force times speed, W, >= 0."""
        return self.force(speed, density, viscosity) * speed


ReynoldsDrag.__init__.__doc__ = """**Arguments:**
- `diameter`: D of the rolling element, m, > 0.
- `area`: S across the stream, m^2, >= 0.
- `shape`: "sphere" or "cylinder".
"""


class RollerDrag(Checked):
    """Drag of one rolling element in the oil-air mixture: 1/2 rho Cd S V|V| (source eq. (88)).

    The force has the sign of the speed; it acts *against* the orbital motion. Value and gradient are exact at rest,
    where V|V| has slope 0. The source gives no Cd for rollers: 1.2 holds for an isolated cylinder, but neighbours in a
    row shield each other.

    **Arguments:**
    - `coefficient`: Cd of one rolling element in its row, a number >= 0.
    - `area`: S across the stream, m^2, >= 0.
    """

    coefficient: Scalar = bounded(">= 0")
    area: Scalar = bounded(">= 0")

    def force(self, speed: Values, density: Values) -> Batch:
        """Drag force, N. **Arguments:** `speed`, orbital, m/s, signed; `density` of the mixture, kg/m^3."""
        speed = jnp.asarray(speed)
        return 0.5 * density * (self.coefficient * self.area) * speed * jnp.abs(speed)

    def power(self, speed: Values, density: Values) -> Batch:
        """Drag power, force times speed, W, >= 0."""
        return self.force(speed, density) * speed

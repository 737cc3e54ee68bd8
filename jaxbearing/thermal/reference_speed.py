r"""Reference speed of ISO 15312, and the thermally safe speed in other conditions.

At the reference speed, friction heats the outer ring of a bearing to 70 degC at an ambient of 20 degC. The load is
light, the oil has 12 mm^2/s (24 mm^2/s for thrust roller bearings), and the heat leaves through the seats.
"""

import math
from collections.abc import Callable
from typing import TypeVar

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_numbers
from ..numerics.roots import Root, monotone_root

Given = TypeVar("Given")
LARGE_AREA = 0.05
"""Seat area above which the reference heat flow falls, m^2."""
REFERENCE_RISE = 50.0
"""Temperature of the outer ring over the ambient in the reference conditions, K."""
RADIAL_FLOW, THRUST_FLOW = 16e3, 20e3
"""Reference heat flow of radial and thrust bearings with seats up to `LARGE_AREA`, W/m^2."""
RADIAL_FALL, THRUST_FALL = -0.34, -0.16
"""Exponents of the seat area in the reference heat flow above `LARGE_AREA`."""
RADIAL_VISCOSITY, THRUST_VISCOSITY = 12e-6, 24e-6
"""Kinematic viscosity of the oil in the reference conditions, m^2/s."""
RADIAL_LOAD, THRUST_LOAD = 0.05, 0.02
"""Load in the reference conditions as a part of the static capacity."""
RPM = math.pi / 30.0
"""One revolution per minute, rad/s."""
SLOW = 160.0
"""Least value of (nu n)^(2/3) in the friction law, nu in mm^2/s and n in rpm. It applies below nu n = 2024; a switch to
it at nu n = 2000 would be a jump of 0.8 %."""
TORQUE = 0.1
"""Factor 10^-7 N mm/mm^3 of the friction law in N m/m^3."""
OIL_HEAT = 1.716e6
"""Heat capacity of oil per volume, J/(m^3 K): 0.0286 kW min/(l K) in catalogues."""


def radial_seat_area(bore: Values, outside_diameter: Values, width: Values) -> Batch:
    """Seat area of a radial bearing, m^2. **Arguments:** in m; `width`: T for tapered roller bearings."""
    return jnp.asarray(math.pi * width * (outside_diameter + bore))


def thrust_seat_area(bore: Values, outside_diameter: Values) -> Batch:
    """Seat area of a thrust cylindrical roller bearing, m^2. **Arguments:** in m."""
    return jnp.asarray(0.5 * math.pi * (jnp.square(outside_diameter) - jnp.square(bore)))


def spherical_thrust_seat_area(
    bore: Values, outside_diameter: Values, shaft_washer: Values, housing_washer: Values
) -> Batch:
    """Seat area of a spherical roller thrust bearing, $(\\pi/4)(D^2 + d_1^2 - D_1^2 - d^2)$, m^2.

    **Arguments:** in m; `shaft_washer`: outside diameter d_1 of the shaft washer; `housing_washer`: inside diameter
    D_1 of the housing washer.
    """
    square = jnp.square
    area = square(outside_diameter) + square(shaft_washer) - square(housing_washer) - square(bore)
    return jnp.asarray(0.25 * math.pi * area)


def reference_heat_flow(area: Values, thrust: bool = False) -> Batch:
    """Reference heat flow through the seats, W/m^2.

    It is 16 kW/m^2 for radial and 20 kW/m^2 for thrust bearings. Above an area of 0.05 m^2 it is multiplied by
    (area/0.05 m^2)^-0.34 or (area/0.05 m^2)^-0.16.

    **Reference:** ISO 15312, as makers' catalogues print it.

    **Arguments:** `area` of the seats, m^2, > 0; `thrust`: a thrust bearing.
    """
    require_numbers("> 0", area=area)
    flow, fall = (THRUST_FLOW, THRUST_FALL) if thrust else (RADIAL_FLOW, RADIAL_FALL)
    return jnp.asarray(flow * jnp.power(jnp.maximum(jnp.asarray(area) / LARGE_AREA, 1.0), fall))


def reference_conductance(area: Values, thrust: bool = False) -> Batch:
    """Conductance to the ambient that gives the reference heat flow at a temperature rise of 50 K, W/K."""
    return reference_heat_flow(area, thrust) * area / REFERENCE_RISE


def palmgren_torque(speed: Values, viscosity: Values, load: Values, diameter: Values, f0: Values, f1: Values) -> Batch:
    r"""Friction moment of ISO 15312, $10^{-7} f_0 (\nu n)^{2/3} d_m^3 + f_1 P_1 d_m$ in N mm, here N m.

    Below about nu n = 2000 the first term is $160\cdot10^{-7} f_0 d_m^3$.

    **Arguments:** `speed`: rad/s, > 0; `viscosity`: kinematic, m^2/s, > 0; `load`: P_1, N, >= 0; `diameter`: mean of
    bore and outside, m, > 0; `f0`, `f1`: factors of the bearing (numbers).
    """
    product = 1e6 * viscosity * jnp.asarray(speed) / RPM
    fast = jnp.maximum(jnp.exp(2.0 / 3.0 * jnp.log(product)), SLOW)
    return jnp.asarray(TORQUE * f0 * fast * jnp.power(diameter, 3.0) + f1 * load * diameter)


def reference_speed(
    heat: Values, viscosity: Values, load: Values, diameter: Values, f0: Values, f1: Values
) -> Float[Array, "..."]:
    """Thermal reference speed of ISO 15312, rad/s: the friction power equals the heat that leaves.

    The power rises with the speed, so there is one root. It is searched between 1e-3 and 1e6 rad/s, in the logarithm.

    **Arguments:** `heat`: heat through the seats, W, > 0 (`reference_heat_flow` times the area); others as for
    `palmgren_torque`. In the reference conditions the viscosity is 12 mm^2/s (24 mm^2/s thrust rollers) and the load
    0.05 (thrust 0.02) of the static capacity.
    """
    require_numbers("> 0", heat=heat, viscosity=viscosity, diameter=diameter)
    require_numbers(">= 0", load=load, f0=f0, f1=f1)
    args = [jnp.asarray(value, dtype=float) for value in (heat, viscosity, load, diameter, f0, f1)]
    power = lambda speed, inputs: palmgren_torque(speed, *inputs[1:]) * speed
    root = _root_in_logarithm(power, args, args[0], jnp.asarray(1e-3), jnp.asarray(1e6))
    return jnp.exp(root.value)


def speed_of_heat(
    losses: Callable[[Array, Given], Array], args: Given, heat: Scalar, lower: Scalar, upper: Scalar
) -> Root:
    """The speed at which the losses equal the heat that may leave. With a bearing's own losses, at 70 degC in the
    contacts and 12 mm^2/s, it is the reference speed by the model instead of the standard's formula.

    The losses must rise with the speed. The root is in rad/s; its `residual` is the difference of the logarithms of
    losses and heat.

    **Arguments:** `losses(speed, args)`: total, W, > 0; `args`: pytree of all that it depends on; `heat`: W, > 0;
    `lower`, `upper`: speeds, rad/s, > 0.
    """
    root = _root_in_logarithm(losses, args, jnp.asarray(heat, dtype=float), jnp.asarray(lower), jnp.asarray(upper))
    return Root(jnp.exp(root.value), root.residual)


def _root_in_logarithm(
    power: Callable[[Array, Given], Array], args: Given, heat: Array, lower: Array, upper: Array
) -> Root:
    """Root of ln(power) - ln(heat) in ln(speed)."""
    shape = jnp.broadcast_shapes(heat.shape, *(jnp.shape(leaf) for leaf in jax.tree.leaves(args)))
    ends = [jnp.full(shape, jnp.log(end)) for end in (lower, upper)]
    middle = 0.5 * (ends[0] + ends[1])

    def excess(log_speed: Array, inputs: tuple[Given, Array]) -> Array:
        own, target = inputs
        return jnp.log(power(jnp.exp(log_speed), own)) - jnp.log(target)

    return monotone_root(excess, (args, heat), ends[0], ends[1], middle)


def safe_speed_ratio(lubricant_parameter: Values, load_parameter: Values) -> Float[Array, "..."]:
    r"""Ratio f of the thermally safe speed to the reference speed: the root of $k_L f^{5/3} + k_P f = 1$.

    **Reference:** ISO 15312 as makers' catalogues print it; their explicit fit of this root is up to 6 % off.

    **Arguments:** `lubricant_parameter` k_L, `load_parameter` k_P: numbers >= 0, one of them > 0 (`safe_speed`).
    """
    require_numbers(">= 0", lubricant_parameter=lubricant_parameter, load_parameter=load_parameter)
    viscous, load = (jnp.asarray(value, dtype=float) for value in (lubricant_parameter, load_parameter))
    shape = jnp.broadcast_shapes(viscous.shape, load.shape)

    def excess(log_ratio: Array, inputs: tuple[Array, Array]) -> Array:
        first, second = inputs
        return jnp.log(first * jnp.exp(2.0 / 3.0 * log_ratio) + second) + log_ratio

    ends = jnp.full(shape, math.log(1e-6)), jnp.full(shape, math.log(1e6))
    return jnp.exp(monotone_root(excess, (viscous, load), *ends, jnp.zeros(shape)).value)


def safe_speed(
    reference: Values, heat: Values, viscosity: Values, load: Values, diameter: Values, f0: Values, f1: Values
) -> Float[Array, "..."]:
    r"""Thermally safe speed of ISO 15312 in conditions other than the reference conditions, rad/s.

    $k_L = \omega_\theta 10^{-7} f_0(\nu n_\theta)^{2/3}d_m^3/\Phi$, $k_P = \omega_\theta f_1 P_1 d_m/\Phi$, and
    `safe_speed_ratio` of them.

    **Arguments:** `reference`: reference speed, rad/s, > 0; `heat`: heat that may leave through the seats, with the oil
    (`oil_flow_heat`) and otherwise, W, > 0; the others as for `palmgren_torque`, in these conditions.
    """
    require_numbers("> 0", reference=reference, heat=heat, viscosity=viscosity, diameter=diameter)
    require_numbers(">= 0", load=load, f0=f0, f1=f1)
    log_product = jnp.log(1e6 * viscosity * jnp.asarray(reference) / RPM)
    viscous = TORQUE * f0 * jnp.exp(2.0 / 3.0 * log_product) * jnp.power(diameter, 3.0)
    return reference * safe_speed_ratio(reference * viscous / heat, reference * f1 * load * diameter / heat)


def oil_flow_heat(flow: Values, rise: Values) -> Batch:
    """Heat that an oil flow carries away, W. **Arguments:** `flow`: m^3/s; `rise`: temperature rise of the oil, K."""
    return jnp.asarray(OIL_HEAT * jnp.asarray(flow) * rise)

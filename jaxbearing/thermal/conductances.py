"""Conductances of a bearing's thermal network, W/K, and heat capacities of its nodes, J/K.

Lengths are in m, speeds in m/s, temperatures in K. When a network is made, given values may replace these.
"""

import math
from typing import ClassVar, NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_numbers
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float
from ..numerics.safe import smooth_abs

BAND = 4.0 / (3.0 * math.sqrt(math.pi))
"""Mean rise of the surface temperature under a uniform moving band source, in units of q sqrt(2 a/u)/sqrt(k rho c)
(0.75225)."""
ELLIPSE = BAND * 2.0 / math.pi * math.gamma(0.5) * math.gamma(1.75) / math.gamma(2.25)
"""The same for an elliptical source, cut into strips along the motion (0.68855)."""
PLATE = 0.332
"""Factor of the laminar heat transfer of a flat plate."""
STILL_SPEED = 1e-3
"""Speed of the oil below which its heat transfer is smoothed, m/s."""
CAGE_PART = 1.0 / 3.0
"""Ratio of the speed of the oil at rings and elements to the speed of the cage."""
FILLING = 0.05
"""Conductance of the oil beside one contact, in units of the element's conductivity times its radius."""
SEAT_TRANSFER = 5000.0
"""Heat transfer coefficient of a tight seat, W/(m^2 K)."""
LEAST_OIL_CAPACITY = 5.0
"""Smallest heat capacity of the oil in a bearing, J/K."""
GRAVITY = 9.81
"""Acceleration of gravity, m/s^2."""
STEFAN_BOLTZMANN = 5.670374419e-8
"""Stefan-Boltzmann constant, W/(m^2 K^4)."""
CALM = 1e-3
"""Temperature difference below which natural convection is smoothed, K."""


class Solid(NamedTuple):
    """A body for the heat flow out of a contact: `conductivity`, W/(m K), `density`, kg/m^3, `heat_capacity`,
    J/(kg K); all > 0."""

    conductivity: Values
    density: Values
    heat_capacity: Values


class ContactHeat(NamedTuple):
    """Heat flow of contacts. `conductance`: from body 1 to body 2, W/K; `share`: part of the heat made in the middle of
    the film that goes into body 1. Both have the shape of the contacts."""

    conductance: Batch
    share: Batch


def ellipse_contact_heat(
    semi_axis_rolling: Values,
    semi_axis_transverse: Values,
    film_thickness: Values,
    oil_conductivity: Values,
    bodies: tuple[Solid, Solid],
    speeds: tuple[Values, Values],
) -> ContactHeat:
    r"""Heat flow of elliptical contacts, from the middle of the film into the bulk of either body.

    $$A R_k = \frac{h}{2 k_{oil}} + \frac{\pi\sqrt{ac}}{4 k_k}
      \left(1 + \frac{\pi^2 (k\rho c)_k |u_k| c}{32\,k_k^2 F^2}\right)^{-1/2}$$

    Half of the film is in series with the body. The conductance of the body, $\sqrt{g_{fast}^2 + g_{still}^2}$, joins a
    moving uniform source (F = 0.68855, strips along the motion) and a source at rest, $4 k\sqrt{ac}$. The area is
    $A = \pi ac$. The conductance of the contact is $A/(A R_1 + A R_2)$ and the share of body 1 is $R_2/(R_1 + R_2)$,
    which eliminates the node of the film exactly.

    **Limits:** an unloaded contact (an axis of 0) conducts nothing and shares equally, with derivatives of 0.
    **Validity:** the effect of pressure on the conductivity of the oil (a factor of 2 at 1 GPa) is neglected.

    **Arguments:**
    - `semi_axis_rolling`, `semi_axis_transverse`: a along and c across the motion, m, >= 0.
    - `film_thickness`: h, m, > 0 where there is load; `oil_conductivity`: W/(m K), > 0, at the film's temperature.
    - `bodies`: both bodies; `speeds`: their surface speeds relative to the contact, m/s, of either sign.
    """
    loaded = (jnp.asarray(semi_axis_rolling) > 0.0) & (jnp.asarray(semi_axis_transverse) > 0.0)
    a, c, film = (
        jnp.where(loaded, value, other)
        for value, other in ((semi_axis_rolling, 1.0), (semi_axis_transverse, 1.0), (film_thickness, 1.0))
    )
    still = lambda body: 0.25 * math.pi * jnp.sqrt(a * c) / body.conductivity
    motion = lambda body: math.pi**2 * c / (32.0 * ELLIPSE**2) * _effusivity(body) / jnp.square(body.conductivity)
    resistances = [
        0.5 * film / oil_conductivity + still(body) / jnp.sqrt(1.0 + motion(body) * jnp.abs(jnp.asarray(speed)))
        for body, speed in zip(bodies, speeds, strict=True)
    ]
    return _contact(loaded, math.pi * a * c, resistances)


def line_contact_heat(
    half_width: Values,
    length: Values,
    film_thickness: Values,
    oil_conductivity: Values,
    bodies: tuple[Solid, Solid],
    speeds: tuple[Values, Values],
) -> ContactHeat:
    r"""Heat flow of line contacts, as `ellipse_contact_heat` for a band: $A = 2al$, F = 0.75225, and for the source at
    rest the rough estimate $\pi k l/\ln(4l/a)$.

    $$A R_k = \frac{h}{2 k_{oil}} + r_k\left(1 + \frac{(k\rho c)_k |u_k|}{2aF^2}\,r_k^2\right)^{-1/2},\qquad
      r_k = \frac{2a\ln(4l/a)}{\pi k_k}$$

    **Arguments:** `half_width`: a, m, from 0 to below the length; `length`: l, m, > 0; others as for
    `ellipse_contact_heat`.
    """
    loaded = jnp.asarray(half_width) > 0.0
    a = jnp.where(loaded, half_width, length)
    film = jnp.where(loaded, film_thickness, 1.0)
    scale = 2.0 * a * jnp.log(4.0 * length / a) / math.pi
    still = lambda body: scale / body.conductivity
    motion = lambda body: _effusivity(body) / (2.0 * a * BAND**2) * jnp.square(still(body))
    resistances = [
        0.5 * film / oil_conductivity + still(body) / jnp.sqrt(1.0 + motion(body) * jnp.abs(jnp.asarray(speed)))
        for body, speed in zip(bodies, speeds, strict=True)
    ]
    return _contact(loaded, 2.0 * a * length, resistances)


def _effusivity(body: Solid) -> Values:
    """Square of the effusivity, k rho c, W^2 s/(m^4 K^2)."""
    return body.conductivity * body.density * body.heat_capacity


def _contact(loaded: Array, area: Array, resistances: list[Array]) -> ContactHeat:
    first, second = resistances
    both = first + second
    return ContactHeat(jnp.where(loaded, area / both, 0.0), jnp.where(loaded, second / both, 0.5))


def oil_filling_conductance(conductivity: Values, diameter: Values, count: Values | int) -> Batch:
    """Conductance of the oil that fills the gaps beside the contacts of one race, W/K: 0.05 k D/2 per element.

    **Reference:** the radial conductance of bearings in the library Thermca, which cites Jungnickel (2010; not
    checked). It is an order of magnitude.

    **Arguments:** `conductivity`: of the elements, W/(m K), > 0; `diameter`: of an element, m, > 0; `count`: number of
    elements.
    """
    return jnp.asarray(FILLING * conductivity * 0.5 * diameter * count)


def oil_heat_transfer(
    cage_speed: Values,
    pitch_diameter: Values,
    oil_conductivity: Values,
    prandtl: Values,
    kinematic_viscosity: Values,
    factor: Values = 1.0,
) -> Batch:
    r"""Heat transfer coefficient between the oil and rings or elements, W/(m^2 K), that of a flat plate.

    $h = 0.332\,k\,Pr^{1/3}\sqrt{u_s/(\nu x)}$. $u_s$ is a third of the cage's surface speed at the pitch circle, and x
    is the pitch diameter. $u_s$ is smoothed to $\sqrt{u_s^2 + (1\,\mathrm{mm/s})^2}$.

    **Validity:** an estimate; measured ring temperatures correspond to one to three times this value. Books print 0.332
    and 0.0332; the measurements support 0.332.

    **Arguments:**
    - `cage_speed`: surface speed of the cage at the pitch circle, m/s, of either sign; `pitch_diameter`: m, > 0.
    - `oil_conductivity`: k, W/(m K), > 0; `prandtl`: Pr, a number > 0; `kinematic_viscosity`: nu, m^2/s, > 0.
    - `factor`: a number from 1 to 3.
    """
    speed = smooth_abs(CAGE_PART * cage_speed, STILL_SPEED)
    rate = speed / (kinematic_viscosity * pitch_diameter)
    return jnp.asarray(factor * PLATE * oil_conductivity * jnp.cbrt(prandtl) * jnp.sqrt(rate))


def ring_surface(groove_diameter: Values, width: Values) -> Batch:
    """Surface of a ring in contact with oil, m^2.

    **Arguments:** `groove_diameter`: diameter of the groove bottom (raceway), m; `width`: m.
    """
    return jnp.asarray(math.pi * groove_diameter * width)


def elements_surface(diameter: Values, count: Values | int, length: Values | None = None) -> Batch:
    """Surface of all elements, m^2.

    **Arguments:** `diameter`: m; `count`: number of elements; `length`: length of rollers, m, `None` for balls.
    """
    surface = jnp.square(diameter) if length is None else diameter * length + 0.5 * jnp.square(diameter)
    return jnp.asarray(count * math.pi * surface)


def seat_conductance(
    diameter: Values,
    width: Values,
    gap: Values = 0.0,
    gap_conductivity: Values = 0.13,
    transfer: Values = SEAT_TRANSFER,
) -> Batch:
    r"""Conductance of a ring's seat, W/K: $\pi d B\,/\,(1/h_c + s/(2 k))$, a tight seat in series with its gap.

    A loose seat never conducts better than a tight one, and the conductance is continuous where the seat becomes loose.

    **Arguments:**
    - `diameter`, `width`: of the seat, m, > 0; `gap`: diametral gap s, m; that of a tight fit, below 0, counts as 0.
    - `gap_conductivity`: k of the filling of the gap, W/(m K), > 0; `transfer`: h_c of a tight seat, W/(m^2 K), > 0
      (from memory: a gap of air and oil of 1 to 2 um; small compared with the other resistances).
    """
    open_gap = jnp.maximum(jnp.asarray(gap), 0.0)
    return jnp.asarray(math.pi * diameter * width / (1.0 / transfer + 0.5 * open_gap / gap_conductivity))


def air_convection(temperature: Values, ambient: Values, diameter: Values) -> Batch:
    r"""Heat transfer coefficient of natural convection from a horizontal cylinder in air, W/(m^2 K).

    $Nu = \{0.60 + 0.387\,Ra^{1/6}/[1 + (0.559/Pr)^{9/16}]^{8/27}\}^2$; $Ra = g|\Delta T|D^3/(T_f\nu a)$ with air at the
    film temperature $T_f$, the mean: k = 0.0263 (T_f/300)^0.85, nu = 1.59e-5 (T_f/300)^1.73, a = 2.25e-5
    (T_f/300)^1.75. The temperature difference is smoothed below 1 mK.

    **Reference:** Churchill and Chu (1975), Int. J. Heat Mass Transfer 18, 1049.

    **Arguments:** `temperature` of the surface and `ambient`, K, > 0; `diameter`, m, > 0.
    """
    film = 0.5 * (temperature + ambient)
    relative = film / 300.0
    conductivity, viscosity = 0.0263 * relative**0.85, 1.59e-5 * relative**1.73
    diffusivity = 2.25e-5 * relative**1.75
    rise = smooth_abs(temperature - ambient, CALM)
    rayleigh = GRAVITY * rise * jnp.power(diameter, 3.0) / (film * viscosity * diffusivity)
    prandtl_part = jnp.power(1.0 + jnp.power(0.559 * diffusivity / viscosity, 9.0 / 16.0), 8.0 / 27.0)
    nusselt = jnp.square(0.60 + 0.387 * jnp.power(rayleigh, 1.0 / 6.0) / prandtl_part)
    return jnp.asarray(nusselt * conductivity / diameter)


def radiation(temperature: Values, ambient: Values, emissivity: Values = 0.9) -> Batch:
    r"""Heat transfer coefficient of the radiation of a surface, $\epsilon\sigma(T^2 + T_a^2)(T + T_a)$, W/(m^2 K).

    **Arguments:** `temperature` of the surface and `ambient`, K, > 0; `emissivity`: a number from 0 to 1.
    """
    squares = jnp.square(temperature) + jnp.square(ambient)
    return jnp.asarray(emissivity * STEFAN_BOLTZMANN * squares * (temperature + ambient))


class CylindricalHousing(Checked):
    """A housing as a cylinder in still air, with natural convection and radiation. Its conductance to the ambient
    depends on its temperature. It is used as an entry of `to_ambient` of a network."""

    part: ClassVar[str] = "thermal.housing"

    diameter: Scalar = bounded("> 0", unit="m", converter=as_float)
    area: Scalar = bounded("> 0", unit="m^2", converter=as_float)
    ambient: Scalar = bounded("> 0", unit="K", converter=as_float)
    emissivity: Scalar = bounded("between 0 and 1", unit="1", converter=as_float, default=0.9)

    def __call__(self, temperature: Scalar) -> Float[Array, ""]:
        """Conductance, W/K. **Arguments:** `temperature` of the housing, K."""
        convection = air_convection(temperature, self.ambient, self.diameter)
        return self.area * (convection + radiation(temperature, self.ambient, self.emissivity))


CylindricalHousing.__init__.__doc__ = """**Arguments:**
- `diameter`: outside, m, > 0.
- `area`: of the surface that gives heat off, m^2, > 0.
- `ambient`: temperature of the air and of the surroundings, K, > 0.
- `emissivity`: of the surface, a number from 0 to 1.
"""


def ring_capacity(
    inside_diameter: Values, outside_diameter: Values, width: Values, density: Values, heat_capacity: Values
) -> Batch:
    """Heat capacity of a ring, J/K, from the bore to the groove bottom or from the groove bottom to the outside.

    **Arguments:** diameters and `width`, m, > 0; `density`, kg/m^3, > 0; `heat_capacity`, J/(kg K), > 0.
    """
    area = 0.25 * math.pi * (jnp.square(outside_diameter) - jnp.square(inside_diameter))
    return jnp.asarray(density * heat_capacity * area * width)


def oil_capacity(fraction: Values, free_volume: Values, density: Values, heat_capacity: Values) -> Batch:
    """Heat capacity of the oil in a bearing, J/K, at least 5 J/K. Only transient runs and growth rates depend on it.

    **Arguments:** `fraction`: part of the free volume that is oil, a number from 0 to 1; `free_volume`: m^3;
    `density`: kg/m^3; `heat_capacity`: J/(kg K).
    """
    require_numbers("between 0 and 1", fraction=fraction)
    return jnp.maximum(jnp.asarray(fraction * free_volume * density * heat_capacity), LEAST_OIL_CAPACITY)

"""Reynolds' equation of a line contact on a mesh: film shape, face fluxes, residual. No unknown is eliminated here."""

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..lubricants.compression import dowson_higginson_ratio
from ..lubricants.viscosity import AbstractViscosity
from .mesh import Mesh

LARGEST_LOG_RATIO = 600.0
"""Upper limit of ln(eta/eta_0): exp(-600) is still a normal number, and the flow vanishes long before."""


class Fluid(eqx.Module):
    """The oil of one contact, as functions of the pressure over the Hertz pressure.

    **Arguments:** `viscosity`: the law; `temperature`, K; `hertz_pressure`, Pa; `compressible`: whether the density
    follows Dowson and Higginson or is constant.
    """

    viscosity: AbstractViscosity
    temperature: Scalar
    hertz_pressure: Scalar
    compressible: bool = eqx.field(static=True)

    def log_ratio(self, pressure: Float[Array, " node"]) -> Float[Array, " node"]:
        """Logarithm of viscosity over viscosity at ambient pressure; negative pressures count as 0."""
        pressure = self._pascal(pressure)
        ambient = self.viscosity.log_viscosity(0.0, self.temperature)
        ratio = self.viscosity.log_viscosity(pressure, self.temperature) - ambient
        return jnp.minimum(ratio, LARGEST_LOG_RATIO)

    def density_ratio(self, pressure: Float[Array, " node"]) -> Float[Array, " node"]:
        """Density over density at ambient pressure; 1 where the pressure is negative."""
        if not self.compressible:
            return jnp.ones_like(pressure)
        return dowson_higginson_ratio(self._pascal(pressure))

    def _pascal(self, pressure: Float[Array, " node"]) -> Float[Array, " node"]:
        # the outer edge of the contact: no derivative below 0, where an iterate may probe
        return self.hertz_pressure * jnp.where(pressure > 0, pressure, 0.0)


class Equations(eqx.Module):
    r"""Parameters of Reynolds' equation in one solve, all dimensionless except those of the fluid.

    X = x/a, P = p/p_h, H = h R'/a^2, time t u_0/a; $\varepsilon = \bar\rho H^3 e^{-\ln(\eta/\eta_0)}/\lambda$,
    $m = \bar\rho H$, $\lambda = 12\eta_0 u_0 R'^2/(a^3 p_h)$, u_0 a fixed reference speed:

    $\partial_X(\varepsilon\,\partial_X P) - \partial_X(\bar u m) - \partial_t m = 0$.

    **Arguments:** `fluid`; `wedge`: $\lambda$; `speed`: $\bar u = u_m/u_0$, any sign; the time derivative of m is
    `rate` * m + `past` (0 and 0: steady).
    """

    fluid: Fluid
    wedge: Scalar
    speed: Scalar
    rate: Scalar
    past: Float[Array, " node"]


class Point(eqx.Module):
    """The unknowns: pressure at all nodes (0 at both ends) and the film's constant H00."""

    pressure: Float[Array, " node"]
    offset: Float[Array, ""]


def film_shape(point: Point, mesh: Mesh) -> Float[Array, " node"]:
    """H: offset, parabola and deflection at every node."""
    parabola = jnp.asarray(0.5 * mesh.x**2)
    return point.offset + parabola + jnp.asarray(mesh.kernel) @ point.pressure[1:-1]


def mass(fluid: Fluid, pressure: Float[Array, " node"], film: Float[Array, " node"]) -> Float[Array, " node"]:
    """The mass m: density ratio times film."""
    return fluid.density_ratio(pressure) * film


def face_fluxes(
    equations: Equations, pressure: Float[Array, " node"], film: Float[Array, " node"], mesh: Mesh
) -> Float[Array, " face"]:
    r"""$\varepsilon\,\partial_X P - \bar u m^*$ at the n - 1 faces between nodes: the mass flow in -X.

    $\varepsilon$ is the mean of both neighbours; $m^*$ follows from upwind differences of second order,
    $m_i + \frac{h_i}{2h_{i-1}}(m_i - m_{i-1})$ for flow in +X and mirrored for flow in -X, of first order at the first
    face. (A central difference decouples odd from even nodes where $\varepsilon \to 0$.) Both upwind terms
    vanish at $\bar u = 0$, so the switch between them makes no jump.
    """
    fluid, step = equations.fluid, jnp.asarray(mesh.step)
    m = mass(fluid, pressure, film)
    epsilon = m * jnp.square(film) * jnp.exp(-fluid.log_ratio(pressure)) / equations.wedge
    driven = 0.5 * (epsilon[1:] + epsilon[:-1]) * (pressure[1:] - pressure[:-1]) / step
    rise = m[1:] - m[:-1]
    ahead, behind = jnp.asarray(0.5 * mesh.step[1:] / mesh.step[:-1]), jnp.asarray(0.5 * mesh.step[:-1] / mesh.step[1:])
    nothing = jnp.zeros(1)
    along = m[:-1] + jnp.concatenate([nothing, ahead * rise[:-1]])
    against = m[1:] - jnp.concatenate([behind * rise[1:], nothing])
    speed = jnp.asarray(equations.speed)
    return driven - jnp.maximum(speed, 0.0) * along - jnp.minimum(speed, 0.0) * against


def reynolds_residual(
    equations: Equations, pressure: Float[Array, " node"], film: Float[Array, " node"], mesh: Mesh
) -> Float[Array, " inner"]:
    """Left side of Reynolds' equation at the inner nodes, by finite volumes: 0 in the film, < 0 where it cavitates.
    Node i sees pressure and film of the nodes i - 2 to i + 2 only."""
    flux = face_fluxes(equations, pressure, film, mesh)
    m = mass(equations.fluid, pressure, film)
    change = equations.rate * m + equations.past
    return (flux[1:] - flux[:-1]) / jnp.asarray(mesh.cell) - change[1:-1]


def steady_equations(fluid: Fluid, wedge: Scalar, speed: Scalar, nodes: int) -> Equations:
    """The steady equations, which have no time derivative."""
    return Equations(fluid, wedge, speed, jnp.zeros(()), jnp.zeros(nodes))


def held(equations: Equations) -> Equations:
    """The same equations, treated as constants in differentiation."""
    return jax.lax.stop_gradient(equations)

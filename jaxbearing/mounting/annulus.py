r"""Growth of a ring, a shaft or a housing under pressure, rotation and warming: plane stress, uniform temperature.

$$u_p = \frac{r}{E}\left[(1-\nu)\frac{p_a q - p_b}{1-q} + (1+\nu)\frac{a^2}{r^2}\frac{p_a - p_b}{1-q}\right],\quad
q = a^2/b^2$$
$$u_\omega = \rho\omega^2r\frac{(3+\nu)(1-\nu)}{8E}\left[a^2 + b^2 + \frac{1+\nu}{1-\nu}\frac{a^2b^2}{r^2}
- \frac{1+\nu}{3+\nu}r^2\right],\quad u_T = \alpha_T\,\Delta T\,r$$

Lamé's thick ring and the rotating disc of uniform thickness (Timoshenko and Goodier, Theory of Elasticity). A solid
body has $a = 0$: nothing is divided by $a$.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..materials import Material

REFERENCE_TEMPERATURE = 293.15
"""Temperature at which dimensions hold, K."""


class Annulus(eqx.Module):
    """A body between two circles, at one temperature, that turns about its axis.

    **Arguments:**
    - `material`: with its `thermal_expansion`, unless `warming` is 0.
    - `bore`, `outside`: diameters, m; a solid body has the bore 0.
    - `speed`: rad/s, of either sign.
    - `warming`: temperature above `REFERENCE_TEMPERATURE`, K.
    """

    material: Material
    bore: Scalar
    outside: Scalar
    speed: Scalar = 0.0
    warming: Scalar = 0.0

    def pressed(self, diameter: Scalar, inside: Scalar, outside: Scalar) -> Float[Array, ""]:
        """Growth of a diameter by pressures on bore and outside, Pa; m."""
        nu, modulus = self.material.poisson_ratio, self.material.youngs_modulus
        ratio = jnp.square(self.bore / self.outside)
        uniform = (1.0 - nu) * (inside * ratio - outside)
        around = (1.0 + nu) * jnp.square(self.bore / diameter) * (inside - outside)
        return jnp.asarray(diameter) * (uniform + around) / (modulus * (1.0 - ratio))

    def spun(self, diameter: Scalar) -> Float[Array, ""]:
        """Growth of a diameter by rotation, m."""
        nu, a, b, r = self.material.poisson_ratio, 0.5 * self.bore, 0.5 * self.outside, 0.5 * diameter
        squares = jnp.square(a) + jnp.square(b) + (1.0 + nu) / (1.0 - nu) * jnp.square(a * b / r)
        squares = squares - (1.0 + nu) / (3.0 + nu) * jnp.square(r)
        stiffness = 8.0 * self.material.youngs_modulus / ((3.0 + nu) * (1.0 - nu))
        return diameter * self.material.density * jnp.square(self.speed) * squares / stiffness

    def warmed(self, diameter: Scalar) -> Float[Array, ""]:
        """Growth of a diameter by the temperature, m; 0 of a material without an expansion."""
        return jnp.asarray(diameter * self.strain)

    @property
    def strain(self) -> Float[Array, ""]:
        """Growth by the temperature, relative to any length of the body."""
        expansion = self.material.thermal_expansion
        return jnp.zeros(()) if expansion is None else jnp.asarray(expansion * self.warming)

    def free(self, diameter: Scalar) -> Float[Array, ""]:
        """Growth of a diameter by rotation and temperature, m."""
        return self.spun(diameter) + self.warmed(diameter)

    def hoop_stress_at_bore(self, inside: Scalar) -> Float[Array, ""]:
        """Stress around the bore by the pressure in it, Pa, and by rotation; Pa."""
        nu, a2, b2 = self.material.poisson_ratio, jnp.square(self.bore), jnp.square(self.outside)
        spin = self.material.density * jnp.square(self.speed) * ((3.0 + nu) * b2 + (1.0 - nu) * a2) / 16.0
        return inside * (b2 + a2) / (b2 - a2) + spin

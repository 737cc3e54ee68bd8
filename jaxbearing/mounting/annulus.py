r"""Growth of a ring, a shaft or a housing by pressure, rotation and temperature, in plane stress.

$$u_p = \frac{r}{E(b^2-a^2)}\left[(1-\nu)(p_a a^2 - p_b b^2) + (1+\nu)\frac{a^2b^2}{r^2}(p_a - p_b)\right]$$
$$u_\omega = \rho\omega^2r\frac{(3+\nu)(1-\nu)}{8E}\left[a^2 + b^2 + \frac{1+\nu}{1-\nu}\frac{a^2b^2}{r^2}
- \frac{1+\nu}{3+\nu}r^2\right],\quad u_T = \alpha_T\,\Delta T\,r$$

The radial displacements u at the radius r are those of Lamé's thick ring and of the rotating disc of uniform thickness
(Timoshenko and Goodier, Theory of Elasticity), at uniform temperature. A solid body has $a = 0$: nothing is divided by
$a$.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..materials import Material

Numbers = Scalar | Float[Array, "..."]
"""A number, or an array of numbers of many bodies or states."""
REFERENCE_TEMPERATURE = 293.15
"""Temperature to which the given dimensions refer, K."""


class Annulus(eqx.Module):
    """A ring or disc at uniform temperature that turns about its axis; or many of them, as arrays of numbers.

    **Arguments:**
    - `material`: with its `thermal_expansion`, unless `warming` is 0.
    - `bore`, `outside`: diameters, m; a solid body has the bore 0.
    - `speed`: rad/s, of either sign.
    - `warming`: temperature above `REFERENCE_TEMPERATURE`, K.
    """

    material: Material
    bore: Numbers
    outside: Numbers
    speed: Numbers = 0.0
    warming: Numbers = 0.0

    def pressed(self, diameter: Numbers, inside: Numbers, outside: Numbers) -> Float[Array, "..."]:
        """Growth of a diameter by pressure, m.

        **Arguments:** `diameter`, m; `inside`, `outside`: pressures on bore and outside, Pa.
        """
        nu, modulus = self.material.poisson_ratio, self.material.youngs_modulus
        a2, b2 = jnp.square(self.bore), jnp.square(self.outside)
        uniform = (1.0 - nu) * (inside * a2 - outside * b2)
        around = (1.0 + nu) * jnp.square(self.bore * self.outside / diameter) * (inside - outside)
        return jnp.asarray(diameter) * (uniform + around) / (modulus * (b2 - a2))

    def spun(self, diameter: Numbers) -> Float[Array, "..."]:
        """Growth of a diameter by rotation, m."""
        return self.spun_by_square(diameter) * jnp.square(self.speed)

    def spun_by_square(self, diameter: Numbers) -> Float[Array, "..."]:
        """Growth of a diameter by rotation, divided by the square of the speed, m s^2."""
        nu, a, b, r = self.material.poisson_ratio, 0.5 * self.bore, 0.5 * self.outside, 0.5 * diameter
        # few divisions: each one takes time to compile
        squares = (1.0 - nu) * (jnp.square(a) + jnp.square(b)) + (1.0 + nu) * jnp.square(a * b / r)
        squares = (3.0 + nu) * squares - (1.0 + nu) * (1.0 - nu) * jnp.square(r)
        return diameter * self.material.density * squares / (8.0 * self.material.youngs_modulus)

    def warmed(self, diameter: Numbers) -> Float[Array, "..."]:
        """Growth of a diameter by temperature, m; 0 for a material without `thermal_expansion`."""
        return jnp.asarray(diameter * self.strain)

    @property
    def strain(self) -> Float[Array, "..."]:
        """Thermal strain, relative to the length; 0 for a material without `thermal_expansion`."""
        expansion = self.material.thermal_expansion
        return jnp.zeros(()) if expansion is None else jnp.asarray(expansion * self.warming)

    def free(self, diameter: Numbers) -> Float[Array, "..."]:
        """Growth of a diameter by rotation and temperature, m."""
        return self.spun(diameter) + self.warmed(diameter)

    def hoop_stress_at_bore(self, inside: Numbers) -> Float[Array, "..."]:
        """Hoop stress at the bore, Pa, by rotation and by the pressure `inside` the bore, Pa."""
        nu, a2, b2 = self.material.poisson_ratio, jnp.square(self.bore), jnp.square(self.outside)
        spin = self.material.density * jnp.square(self.speed) * ((3.0 + nu) * b2 + (1.0 - nu) * a2) / 16.0
        return inside * (b2 + a2) / (b2 - a2) + spin

r"""Mean and scatter of what only its positive part counts of: $E[\max(x, 0)]$ of a normal variable, exact.

With $z = m/s$: $E = m\Phi(z) + s\varphi(z)$, $\mathrm{Var} = (m^2+s^2)\Phi(z) + ms\varphi(z) - E^2$. The interference
of a fit is of that kind: a gap does not press the rings.
"""

import jax.numpy as jnp
from jax.scipy.stats import norm
from jaxtyping import Array, Float

from .._types import Scalar


def rectified_normal(mean: Scalar, deviation: Scalar) -> tuple[Float[Array, ""], Float[Array, ""]]:
    """Mean and variance of max(x, 0), x normal; `deviation` > 0, of any unit."""
    z = jnp.asarray(mean) / deviation
    below, density = norm.cdf(z), norm.pdf(z)
    expected = mean * below + deviation * density
    square = (jnp.square(mean) + jnp.square(deviation)) * below + mean * deviation * density
    return expected, square - jnp.square(expected)

"""Load shares of asperities: what part of a contact's load the roughness carries when the film is thin."""

import abc
import math
from typing import ClassVar

import jax.numpy as jnp
import numpy as np
from jax.scipy.special import erfc, logsumexp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float
from ..numerics.safe import log_add, smooth_abs

RATIO_FLOOR = 1e-4
"""Film ratio below which Zhou and Hoeprich's share is linear in it: relative error 6e-10 at a film ratio of 0.5."""
HEIGHT_INTEGRAL = 2.0**0.75 * math.gamma(1.75) / math.sqrt(2.0 * math.pi)
r"""$F_{5/2}(0)$ = 0.6166342, the integral of the asperity heights at no film."""
_STEP, _POINTS = 0.1, 32
_NODES = _STEP * np.arange(1.0, _POINTS + 1.0)
_LOG_WEIGHTS = np.log(2.0 * _STEP / np.sqrt(2.0 * np.pi)) + 6.0 * np.log(_NODES) - 0.5 * _NODES**4


class AbstractLoadShare(Checked):
    r"""The part $\varphi(\Lambda)$ of a contact's load that asperities carry, from 1 without a film to 0."""

    part: ClassVar[str] = "contact.mixed"

    @abc.abstractmethod
    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        r"""$\varphi$, between 0 and 1.

        **Arguments:** `film_ratio` $\Lambda$, film over roughness, >= 0; `mean_pressure` of the contact, Pa, > 0;
        `reduced_modulus` E', Pa.
        """


class ZhouHoeprich(AbstractLoadShare):
    r"""$\varphi = \exp(-B\Lambda^C)$.

    **Limits:** 1 at no film, with a finite slope: $\Lambda^C$ is $\Lambda(\Lambda^2 + 10^{-8})^{(C-1)/2}$. It
    underflows to 0 at thick films, with gradient 0.
    **Validity:** fitted with the central film. The pressure of the contact is not in it: the share is uncertain by a
    factor of 10 at raceway pressures.
    **Reference:** Zhou and Hoeprich (1991), ASME J. Tribology 113, 590, with the constants that a friction study of the
    tapered bearing 32216 gives: B = 2.32, C = 0.97 for raceways, 1.90 and 0.99 for the rib (32208: 2.10, 0.85).

    **Arguments:** `coefficient`: B; `exponent`: C.
    """

    coefficient: Scalar = bounded("> 0", unit="1", converter=as_float, default=2.32)
    exponent: Scalar = bounded("> 0", unit="1", converter=as_float, default=0.97)

    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        log_ratio = jnp.log(smooth_abs(film_ratio, RATIO_FLOOR))
        return jnp.exp(-self.coefficient * film_ratio * jnp.exp((self.exponent - 1.0) * log_ratio))


class GreenwoodTripp(AbstractLoadShare):
    r"""$\varphi = F_{5/2}(\Lambda)/F_{5/2}(0)$, the pressure of Gaussian asperities over that without a film.

    **Limits:** 1 at no film; it falls as $e^{-\Lambda^2/2}$ at thick films and underflows to 0.
    **Validity:** Gaussian heights. The pressure of the contact is not in it: the share is uncertain by a factor of 10
    at raceway pressures, and this normalised form is the cautious one.
    **Reference:** Greenwood and Tripp (1970), Proc. Instn. Mech. Engrs. 185, 625.
    """

    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        return jnp.exp(log_height_integral(film_ratio) - np.log(HEIGHT_INTEGRAL))


class GreenwoodTrippPressure(AbstractLoadShare):
    r"""$\varphi = x/(1 + x^4)^{1/4}$, $x = p_a/\bar p$: the asperities' pressure over the mean pressure of the contact.

    $p_a = \frac{16\sqrt2\pi}{15}(\eta\beta\sigma)^2\sqrt{\sigma/\beta}\,\frac{E'}2F_{5/2}(\Lambda)$.

    **Limits:** 1 as the load of the contact goes to 0; $p_a/\bar p$ where that is small, which makes it 0.7 % at 0.5
    GPa and a film ratio of 1, where the normalised forms give 10 to 13 %.
    **Validity:** elastic asperities; their constants are seldom measured.
    **Reference:** Greenwood and Tripp (1970), Proc. Instn. Mech. Engrs. 185, 625; the join to 1 is ours.

    **Arguments:**
    - `asperity_product`: density of the summits times their radius times the roughness, about 0.03 to 0.05.
    - `asperity_slope`: roughness over the radius of the summits, about 1e-4 to 1e-2.
    """

    asperity_product: Scalar = bounded("> 0", unit="1", converter=as_float, default=0.05)
    asperity_slope: Scalar = bounded("> 0", unit="1", converter=as_float, default=1e-3)

    def log_pressure(self, film_ratio: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        """ln of the asperities' pressure, Pa. **Arguments:** as for `share`."""
        constant = np.log(8.0 * np.sqrt(2.0) * np.pi / 15.0)
        shape = 2.0 * jnp.log(self.asperity_product) + 0.5 * jnp.log(self.asperity_slope)
        return constant + shape + jnp.log(reduced_modulus) + log_height_integral(film_ratio)

    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        log_ratio = self.log_pressure(film_ratio, reduced_modulus) - jnp.log(mean_pressure)
        return jnp.exp(-0.25 * log_add(0.0, -4.0 * log_ratio))


class ErrorFunctionShare(AbstractLoadShare):
    r"""$\varphi = 1 - \mathrm{erf}(\Lambda)$.

    **Limits:** 1 at no film; 0.157 at a film ratio of 1, where the other normalised forms have 0.10 to 0.13.
    **Validity:** a fit without the pressure of the contact: the share is uncertain by a factor of 10 at raceway
    pressures.
    **Reference:** used by programs for tapered roller bearings; read second-hand.
    """

    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        return erfc(jnp.asarray(film_ratio, dtype=float))


def log_height_integral(film_ratio: Values) -> Float[Array, "..."]:
    r"""$\ln F_{5/2}(t)$, $F_n(t) = \int_t^\infty(s - t)^ne^{-s^2/2}ds/\sqrt{2\pi}$, for Gaussian heights.

    With $s = t + y^2$ the integrand is even and analytic in y: the trapezoidal rule with 32 points is exact to 1e-13 up
    to t = 10, and to 1e-8 at t = 50, where the integral is 1e-549.

    **Arguments:** `film_ratio` t, >= 0.
    """
    ratio = jnp.asarray(film_ratio, dtype=float)[..., None]
    return logsumexp(_LOG_WEIGHTS - ratio * jnp.square(_NODES), axis=-1) - 0.5 * jnp.square(ratio[..., 0])

"""Load share of asperities: the part of a contact's load that asperities carry when the film is thin."""

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
r"""Film ratio below which $\Lambda^C$ in Zhou and Hoeprich's law is made linear; at a film ratio of 0.5 the relative
error is 6e-10."""
HEIGHT_INTEGRAL = 2.0**0.75 * math.gamma(1.75) / math.sqrt(2.0 * math.pi)
r"""$F_{5/2}(0)$ = 0.6166342, the integral over the asperity heights without a film."""
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

    **Limits:** 1 without a film, with a finite slope, because $\Lambda^C$ is computed as
    $\Lambda(\Lambda^2 + 10^{-8})^{(C-1)/2}$. For thick films it underflows to 0, with gradient 0.
    **Validity:** fitted with the central film thickness. The law does not contain the contact pressure: at raceway
    pressures the share is uncertain by a factor of 10.
    **Reference:** Zhou and Hoeprich (1991), ASME J. Tribology 113, 590. The constants are from a friction study of the
    tapered bearing 32216: B = 2.32, C = 0.97 for raceways, 1.90 and 0.99 for the rib (32208: 2.10, 0.85).

    **Arguments:** `coefficient`: B; `exponent`: C.
    """

    coefficient: Scalar = bounded("> 0", unit="1", converter=as_float, default=2.32)
    exponent: Scalar = bounded("> 0", unit="1", converter=as_float, default=0.97)

    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        log_ratio = jnp.log(smooth_abs(film_ratio, RATIO_FLOOR))
        return jnp.exp(-self.coefficient * film_ratio * jnp.exp((self.exponent - 1.0) * log_ratio))


class GreenwoodTripp(AbstractLoadShare):
    r"""$\varphi = F_{5/2}(\Lambda)/F_{5/2}(0)$, the asperity pressure over the asperity pressure without a film.

    **Limits:** 1 without a film; for thick films it falls as $e^{-\Lambda^2/2}$ and underflows to 0.
    **Validity:** Gaussian asperity heights. The law does not contain the contact pressure: at raceway pressures the
    share is uncertain by a factor of 10, and larger than that of `GreenwoodTrippPressure`, hence cautious.
    **Reference:** Greenwood and Tripp (1970), Proc. Instn. Mech. Engrs. 185, 625.
    """

    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        return jnp.exp(log_height_integral(film_ratio) - np.log(HEIGHT_INTEGRAL))


class GreenwoodTrippPressure(AbstractLoadShare):
    r"""$\varphi = x/(1 + x^4)^{1/4}$, $x = p_a/\bar p$: the asperities' pressure over the mean pressure of the contact.

    $p_a = \frac{16\sqrt2\pi}{15}(\eta\beta\sigma)^2\sqrt{\sigma/\beta}\,\frac{E'}2F_{5/2}(\Lambda)$.

    **Limits:** 1 as the load of the contact goes to 0; $p_a/\bar p$ where this ratio is small. At 0.5 GPa and a film
    ratio of 1 the share is 0.7 %, while the normalised forms give 10 to 13 %.
    **Validity:** elastic asperities. Their constants are seldom measured.
    **Reference:** Greenwood and Tripp (1970), Proc. Instn. Mech. Engrs. 185, 625; the smooth limit at 1 is ours.

    **Arguments:**
    - `asperity_product`: density of the summits times their radius times the roughness, about 0.03 to 0.05.
    - `asperity_slope`: roughness over the radius of the summits, about 1e-4 to 1e-2.
    """

    asperity_product: Scalar = bounded("> 0", unit="1", converter=as_float, default=0.05)
    asperity_slope: Scalar = bounded("> 0", unit="1", converter=as_float, default=1e-3)

    def log_pressure(self, film_ratio: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        """Natural logarithm of the asperity pressure in Pa. **Arguments:** as for `share`."""
        constant = np.log(8.0 * np.sqrt(2.0) * np.pi / 15.0)
        shape = 2.0 * jnp.log(self.asperity_product) + 0.5 * jnp.log(self.asperity_slope)
        return constant + shape + jnp.log(reduced_modulus) + log_height_integral(film_ratio)

    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        log_ratio = self.log_pressure(film_ratio, reduced_modulus) - jnp.log(mean_pressure)
        return jnp.exp(-0.25 * log_add(0.0, -4.0 * log_ratio))


class ErrorFunctionShare(AbstractLoadShare):
    r"""$\varphi = 1 - \mathrm{erf}(\Lambda)$.

    **Limits:** 1 without a film; 0.157 at a film ratio of 1, where the other normalised forms give 0.10 to 0.13.
    **Validity:** a fit that does not contain the contact pressure: at raceway pressures the share is uncertain by a
    factor of 10.
    **Reference:** used by programs for tapered roller bearings; quoted from a secondary source.
    """

    def share(self, film_ratio: Values, mean_pressure: Values, reduced_modulus: Values) -> Float[Array, "..."]:
        return erfc(jnp.asarray(film_ratio, dtype=float))


def log_height_integral(film_ratio: Values) -> Float[Array, "..."]:
    r"""$\ln F_{5/2}(t)$, $F_n(t) = \int_t^\infty(s - t)^ne^{-s^2/2}ds/\sqrt{2\pi}$, for Gaussian heights.

    With $s = t + y^2$ the integrand is even and analytic in y. The trapezoidal rule with 32 points then has an error of
    1e-13 up to t = 10, and of 1e-8 at t = 50, where the integral is 1e-549.

    **Arguments:** `film_ratio` t, >= 0.
    """
    ratio = jnp.asarray(film_ratio, dtype=float)[..., None]
    return logsumexp(_LOG_WEIGHTS - ratio * jnp.square(_NODES), axis=-1) - 0.5 * jnp.square(ratio[..., 0])

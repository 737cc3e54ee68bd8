"""Viscous functions: how the shear rate of an oil grows with its shear stress, beyond Newton's law."""

import abc
from typing import ClassVar

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..lubricants import AbstractRheology, Lubricant
from ..numerics.arguments import require_choice
from ..numerics.checks import Checked, bounded
from .relaxation import Slopes, limiting_root, sinh_root

LOG_SATURATED = 230.0
"""Value of ln|q| beyond which q is frozen at 1e100; every limiting stress is reached long before."""
LOG_SCALE_CAP = 600.0
SMALLEST_RATE = 1e-100
"""Smallest q at which slopes are evaluated."""


class AbstractViscousFunction(Checked):
    r"""Viscous function $q = F(s)$, odd and increasing with F'(0) = 1.

    Here s is the stress over the oil's characteristic stress, q the shear rate times viscosity over that stress.
    """

    part: ClassVar[str] = "contact.traction"
    name: ClassVar[str]

    @abc.abstractmethod
    def rate_ratio(self, s: Values) -> Float[Array, "..."]:
        """Rate q = F(s). **Arguments:** `s`, dimensionless; |s| < 1 if there is a limiting stress."""

    @abc.abstractmethod
    def stress_ratio(self, q: Values) -> Float[Array, "..."]:
        """Stress s, the inverse of F: odd, with slope 1 at 0; value and gradient are finite at every finite q."""

    @abc.abstractmethod
    def stress_ratio_of_scaled(self, log_scale: Values, x: Values) -> Float[Array, "..."]:
        """Stress s at q = exp(log_scale) x without overflow, for log_scale up to 600 and any finite x."""

    @abc.abstractmethod
    def relaxed_stress_ratio(self, trial: Values, relaxation: Values) -> Float[Array, "..."]:
        r"""Root s >= 0 of $s + \kappa F(s) = \rho$: the stress that an implicit step leaves of an elastic trial stress.

        At $\kappa$ = 0 it is the smaller of $\rho$ and the limiting stress.

        **Arguments:** `trial` $\rho$ >= 0, in units of the characteristic stress; `relaxation` $\kappa$ >= 0, time step
        times shear modulus over viscosity; elementwise.
        """


class AbstractLimitingFunction(AbstractViscousFunction):
    """Viscous function with a limiting stress, |s| < 1, and the slopes and corner that `limiting_root` needs."""

    @abc.abstractmethod
    def stress_slopes(self, q: Array) -> Slopes:
        """Values of s, ds/dq > 0 and d2s/dq2 <= 0 at q >= 0, exact to round-off up to q = 1e100."""

    @abc.abstractmethod
    def corner(self, slope: Array) -> tuple[Array, Array]:
        """Rate q and stress s at which ds/dq = `slope`, in (0, 1]."""

    def relaxed_stress_ratio(self, trial: Values, relaxation: Values) -> Float[Array, "..."]:
        return self.stress_ratio(limiting_root(self, *_same_shape(trial, relaxation)))


class ReeEyring(AbstractViscousFunction):
    r"""Ree and Eyring's $F(s) = \sinh s$; the characteristic stress is the Eyring stress.

    **Limits:** $s\approx\ln 2q$ at large q; no limiting stress.
    **Reference:** Ree and Eyring (1955), J. Appl. Phys. 26, 793; source eqs. (66)-(67).
    """

    name: ClassVar[str] = "ree_eyring"

    def rate_ratio(self, s: Values) -> Float[Array, "..."]:
        return jnp.sinh(s)

    def stress_ratio(self, q: Values) -> Float[Array, "..."]:
        return jnp.arcsinh(q)

    def stress_ratio_of_scaled(self, log_scale: Values, x: Values) -> Float[Array, "..."]:
        return asinh_of_scaled(log_scale, x)

    def relaxed_stress_ratio(self, trial: Values, relaxation: Values) -> Float[Array, "..."]:
        return sinh_root(*_same_shape(trial, relaxation))


class BairWiner(AbstractLimitingFunction):
    r"""Bair and Winer's $F(s) = -\ln(1 - s)$ for s >= 0, odd; the characteristic stress is the limiting stress.

    **Limits:** s < 1; at s = 0 only the first derivative is continuous.
    **Reference:** Bair and Winer (1979), ASME J. Lubr. Technol. 101, 258; the source prints a garbled factor.
    """

    name: ClassVar[str] = "bair_winer"

    def rate_ratio(self, s: Values) -> Float[Array, "..."]:
        sign, size = _sign_and_size(s)
        return -sign * jnp.log1p(-size)

    def stress_ratio(self, q: Values) -> Float[Array, "..."]:
        sign, size = _sign_and_size(q)
        return -sign * jnp.expm1(-size)

    def stress_ratio_of_scaled(self, log_scale: Values, x: Values) -> Float[Array, "..."]:
        return self.stress_ratio(_saturated_product(log_scale, x))

    def stress_slopes(self, q: Array) -> Slopes:
        left = jnp.exp(-q)
        return Slopes(-jnp.expm1(-q), left, -left)

    def corner(self, slope: Array) -> tuple[Array, Array]:
        return -jnp.log(slope), 1.0 - slope


class GecimWiner(AbstractLimitingFunction):
    r"""Gecim and Winer's $F(s) = \mathrm{artanh}\,s$; the characteristic stress is the limiting stress.

    **Limits:** s < 1.
    **Reference:** Gecim and Winer (1980), ASME J. Lubr. Technol. 102, 213.
    """

    name: ClassVar[str] = "gecim_winer"

    def rate_ratio(self, s: Values) -> Float[Array, "..."]:
        return jnp.arctanh(s)

    def stress_ratio(self, q: Values) -> Float[Array, "..."]:
        return jnp.tanh(q)

    def stress_ratio_of_scaled(self, log_scale: Values, x: Values) -> Float[Array, "..."]:
        return self.stress_ratio(_saturated_product(log_scale, x))

    def stress_slopes(self, q: Array) -> Slopes:
        left = jnp.exp(-2.0 * q)
        share = 1.0 / (1.0 + left)
        stress, slope = -jnp.expm1(-2.0 * q) * share, 4.0 * left * jnp.square(share)
        return Slopes(stress, slope, -2.0 * stress * slope)

    def corner(self, slope: Array) -> tuple[Array, Array]:
        stress = jnp.sqrt(1.0 - slope)
        return jnp.log1p(stress) - 0.5 * jnp.log(slope), stress


class ElsharkawyHamrock(AbstractLimitingFunction):
    r"""Elsharkawy and Hamrock's $F(s) = s(1 - s^n)^{-1/n}$ for s >= 0, odd.

    The characteristic stress is the limiting stress.

    **Limits:** s < 1; $n\to\infty$ is Newton's law up to the limiting stress.
    **Reference:** Elsharkawy and Hamrock (1991), ASME J. Tribology 113, 645; the source prints the exponent 1/n
    without its sign.
    """

    exponent: Scalar = bounded("> 0", default=2.0)
    name: ClassVar[str] = "elsharkawy_hamrock"

    def rate_ratio(self, s: Values) -> Float[Array, "..."]:
        _, size = _sign_and_size(s)
        return s * (1.0 - _power(size, self.exponent)) ** (-1.0 / self.exponent)

    def stress_ratio(self, q: Values) -> Float[Array, "..."]:
        sign, size = _sign_and_size(q)
        large = size > 1.0
        # q (1 + q^n)^(-1/n) = (1 + q^-n)^(-1/n): the base never overflows
        small_of = jnp.where(large, 1.0 / jnp.where(large, size, 1.0), size)
        return sign * jnp.where(large, 1.0, size) * (1.0 + _power(small_of, self.exponent)) ** (-1.0 / self.exponent)

    def stress_ratio_of_scaled(self, log_scale: Values, x: Values) -> Float[Array, "..."]:
        return self.stress_ratio(_saturated_product(log_scale, x))

    def stress_slopes(self, q: Array) -> Slopes:
        q = jnp.maximum(q, SMALLEST_RATE)
        large = q > 1.0
        power = jnp.exp(self.exponent * jnp.where(large, -1.0, 1.0) * jnp.log(q))  # q^n or q^-n, never above 1
        share = 1.0 / (1.0 + power)
        stress = jnp.where(large, 1.0, q) * jnp.exp(-jnp.log(1.0 + power) / self.exponent)
        # q^n/(1 + q^n) and 1/(1 + q^n)
        flowing, solid = jnp.where(large, share, power * share), jnp.where(large, power * share, share)
        slope = solid * stress / q
        return Slopes(stress, slope, -(self.exponent + 1.0) * slope * flowing / q)

    def corner(self, slope: Array) -> tuple[Array, Array]:
        log_slope, more = jnp.log(slope), self.exponent + 1.0
        stress = jnp.exp(jnp.log1p(-jnp.exp(self.exponent / more * log_slope)) / self.exponent)
        return stress * jnp.exp(-log_slope / more), stress


ElsharkawyHamrock.__init__.__doc__ = """**Arguments:**
- `exponent`: n, a number > 0.
"""


VISCOUS_LAWS: dict[str, type[AbstractViscousFunction]] = {
    law.name: law for law in (ReeEyring, BairWiner, GecimWiner, ElsharkawyHamrock)
}
"""Viscous functions by name."""
ASSUMED = ReeEyring
"""Viscous function assumed for a rheology that does not name the one it was fitted with."""


def viscous_function(name: str, rheology: AbstractRheology | None) -> AbstractViscousFunction:
    """Viscous function by name; Elsharkawy and Hamrock's has the exponent of the oil's rheology, or 2 by default."""
    require_choice("name", name, VISCOUS_LAWS)
    if name != ElsharkawyHamrock.name or rheology is None or rheology.exponent is None:
        return VISCOUS_LAWS[name]()
    return ElsharkawyHamrock(rheology.exponent)


def viscous_function_for(given: AbstractViscousFunction | None, lubricant: Lubricant) -> AbstractViscousFunction:
    """The given viscous function, or that which the oil's rheology was fitted with (`ASSUMED` if not known)."""
    if given is not None:
        return given
    fitted = None if lubricant.rheology is None else lubricant.rheology.viscous_function
    return ASSUMED() if fitted is None else viscous_function(fitted, lubricant.rheology)


def viscous_notes(given: AbstractViscousFunction | None, lubricant: Lubricant) -> tuple[str, ...]:
    """Notes for the user, one sentence each, where the rheology of the oil was fitted with another viscous function, or
    does not name the one it was fitted with.

    **Arguments:** `given`: viscous function of the traction law; `None`: that of the oil's rheology.
    """
    if lubricant.rheology is None:
        return ()
    if given is not None:
        return lubricant.rheology.misfit(given.name, getattr(given, "exponent", None))
    if lubricant.rheology.viscous_function is not None:
        return ()
    return (f"oil.rheology does not name the viscous function that it was fitted with: {ASSUMED.name} is assumed",)


def _same_shape(trial: Values, relaxation: Values) -> tuple[Array, Array]:
    first, second = jnp.broadcast_arrays(jnp.asarray(trial, dtype=float), jnp.asarray(relaxation, dtype=float))
    return first, second


def _sign_and_size(x: Values) -> tuple[Array, Array]:
    """Sign and modulus of x; at x = 0 the slope of the modulus is 1, as for x > 0, not 0 as in jnp."""
    x = jnp.asarray(x, dtype=float)
    return jnp.where(x >= 0, 1.0, -1.0), jnp.where(x >= 0, x, -x)


def _power(base: Array, exponent: Values) -> Array:
    """Power base**exponent for base >= 0, exponent > 0; all derivatives are 0 at base 0."""
    positive = base > 0
    return jnp.where(positive, jnp.where(positive, base, 1.0) ** exponent, 0.0)


def _saturated_product(log_scale: Values, x: Values) -> Array:
    """Product exp(log_scale) x, frozen beyond +-1e100."""
    log_scale, x = jnp.broadcast_arrays(jnp.asarray(log_scale, dtype=float), jnp.asarray(x, dtype=float))
    size = jnp.abs(x)
    far = log_scale + jnp.log(jnp.where(size > 0, size, 1.0)) > jnp.where(size > 0, LOG_SATURATED, jnp.inf)
    product = jnp.where(far, 0.0, x) * jnp.exp(jnp.where(far, 0.0, jnp.minimum(log_scale, LOG_SCALE_CAP)))
    return jnp.where(far, jnp.sign(x) * 1e100, product)


def asinh_of_scaled(log_scale: Values, x: Values) -> Float[Array, "..."]:
    r"""Function asinh(exp(log_scale) x): odd in x, slope exp(log_scale) at x = 0, no overflow for log_scale up to 600.

    Its modulus is $\ln(1 + w + w^2/(1 + r))$, $r = \sqrt{1 + w^2}$, for w = e^log_scale |x| <= 1; for larger ones it is
    $-\ln w + \ln(1 + r)$ with the inverse, w = 1/(e^log_scale |x|). The slope is exact except at log_scale > 600 and
    |x| < e^-600.
    """
    log_scale, x = jnp.broadcast_arrays(jnp.asarray(log_scale, dtype=float), jnp.asarray(x, dtype=float))
    sign, size = _sign_and_size(x)
    log_size = log_scale + jnp.log(jnp.where(size > 0, size, 1.0))
    large = (size > 0) & (log_size > 0)
    exponent = jnp.where(large, -log_size, jnp.minimum(log_scale, LOG_SCALE_CAP))
    w = jnp.where(large, 1.0, size) * jnp.exp(exponent)
    root = jnp.sqrt(1.0 + w * w)
    rest = jnp.log1p(jnp.where(large, root, w + w * w / (1.0 + root)))
    return sign * (jnp.where(large, log_size, 0.0) + rest)

"""Tangential compliance of the bodies, which acts in series with the compliance of the film."""

import abc
from typing import ClassVar

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.arguments import require_numbers
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float
from .patch import ContactPatch


class AbstractTangentialCompliance(Checked):
    """Elastic tangential displacement of the surfaces per local shear stress, as if each point had its own spring."""

    part: ClassVar[str] = "contact.compliance"

    @abc.abstractmethod
    def compliance(self, patch: ContactPatch) -> Float[Array, "..."]:
        """Compliance L1 of both bodies together, m/Pa."""


class GivenCompliance(AbstractTangentialCompliance):
    """Given compliance, the same in all contacts. **Arguments:** `value`: L1, m/Pa, >= 0."""

    value: Scalar = bounded(">= 0", converter=as_float)

    def compliance(self, patch: ContactPatch) -> Float[Array, "..."]:
        return jnp.asarray(self.value) * jnp.ones_like(jnp.asarray(patch.half_width, dtype=float))


class HalfSpaceCompliance(AbstractTangentialCompliance):
    r"""Compliance for which the traction at small sliding equals that of elastic half-spaces.

    Line contact: $L_1 = 8a/(\pi E')$. Ellipse: $L_1 = 8a/(3G_sC_{11})$ with Kalker's creep coefficient
    $C_{11}(a/c, \nu)$. Both bodies have the shear modulus $G_s = E'(1 - \nu)/2$ and the Poisson's ratio $\nu$.

    **Limits:** 0 for rigid bodies.
    **Validity:** 0.1 <= a/c <= 1; outside this range the value at its nearer end is used. $C_{11}$ is interpolated
    quadratically in nu and linearly in ln(a/c) between a/c = 0.1, 0.5 and 1.
    **Reference:** Carter (1926); Kalker (1967), thesis, TU Delft, and simplified theory (1982), Vehicle System Dynamics
    11, 1; the coefficients are from memory, not verified against print.

    **Arguments:**
    - `reduced_modulus`: E', Pa.
    - `poisson_ratio`: Poisson's ratio of both bodies; used for an ellipse only.
    """

    reduced_modulus: Values
    poisson_ratio: Scalar = bounded("between 0 and 0.5", converter=as_float, default=0.3)

    def __check_init__(self):
        super().__check_init__()
        require_numbers("> 0 or infinite", reduced_modulus=self.reduced_modulus)

    def compliance(self, patch: ContactPatch) -> Float[Array, "..."]:
        if patch.line:
            return jnp.asarray(8.0 * patch.half_width / (jnp.pi * self.reduced_modulus))
        shear_modulus = 0.5 * self.reduced_modulus * (1.0 - self.poisson_ratio)
        creep = creep_coefficient(patch.half_width / patch.half_length, self.poisson_ratio)
        return jnp.asarray(8.0 * patch.half_width / (3.0 * shear_modulus * creep))


_RATIOS = (0.1, 0.5, 1.0)
_POISSON = (0.0, 0.25, 0.5)
_C11 = ((2.51, 3.31, 4.85), (2.88, 3.62, 4.83), (3.40, 4.12, 5.20))


def creep_coefficient(ratio: Values, poisson_ratio: Values) -> Float[Array, "..."]:
    """Kalker's creep coefficient C11. **Arguments:** `ratio`: a/c, semi-axis along rolling over semi-axis across it;
    `poisson_ratio`: of both bodies."""
    require_numbers("> 0", ratio=ratio)
    require_numbers("between 0 and 0.5", poisson_ratio=poisson_ratio)
    quadratic = [
        jnp.prod(jnp.stack([(poisson_ratio - n) / (m - n) for n in _POISSON if n != m]), axis=0) for m in _POISSON
    ]
    rows = jnp.stack([sum(c * w for c, w in zip(row, quadratic, strict=True)) for row in _C11])
    return jnp.interp(jnp.log(ratio), jnp.log(jnp.asarray(_RATIOS)), rows)

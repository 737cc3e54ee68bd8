"""Area of a Hertz contact, cut into strips along the rolling direction."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.arguments import require_numbers
from ..numerics.quadrature import gauss_legendre
from ..numerics.structure import switch
from .line import LineContact
from .point import PointContact


class Strips(NamedTuple):
    """Quadrature strips along rolling; the last axis runs over the strips.

    In the strip at the distance y from the middle the pressure is that of a line contact, $p_s\\sqrt{1 - x^2/a_s^2}$.

    - `scale`: $p_s/p_0 = a_s/a$.
    - `offset`: y, m.
    - `width`: width dy of the strip, which is its weight in integrals over y, m.
    """

    scale: Float[Array, "*#batch strip"]
    offset: Float[Array, "*batch strip"]
    width: Float[Array, "*batch strip"]


class ContactPatch(eqx.Module):
    """Contact area of two bodies: Hertz pressure over an ellipse or a rectangle. Fields broadcast against each other.

    **Arguments:**
    - `pressure`: Hertz (peak) pressure, Pa, > 0.
    - `half_width`: semi-axis a along rolling, m, > 0.
    - `half_length`: transverse semi-axis c of the ellipse, or half the length of the line contact, m, > 0.
    - `line`: True for a line contact, False for an ellipse.
    """

    pressure: Values
    half_width: Values
    half_length: Values
    line: bool = switch("line", False)

    def __check_init__(self):
        require_numbers("> 0", pressure=self.pressure, half_width=self.half_width, half_length=self.half_length)

    @property
    def load(self) -> Float[Array, "..."]:
        """Integral of the pressure, N."""
        share = jnp.pi if self.line else 2.0 / 3.0 * jnp.pi
        return jnp.asarray(share * self.pressure * self.half_width * self.half_length)

    @property
    def mean_pressure(self) -> Float[Array, "..."]:
        """Load over area, Pa."""
        return jnp.asarray((0.25 * jnp.pi if self.line else 2.0 / 3.0) * self.pressure)

    @property
    def area(self) -> Float[Array, "..."]:
        """Area of the contact, m^2."""
        return jnp.asarray((4.0 if self.line else jnp.pi) * self.half_width * self.half_length)

    def strips(self, count: int, symmetric: bool, middle: bool = False) -> Strips:
        """Gauss-Legendre strips. In an ellipse the variable is the angle phi of y = c sin(phi), in which pressure and
        half-width are smooth; in a line contact it is y.

        **Arguments:**
        - `count`: number of strips over the whole contact.
        - `symmetric`: True if the integrands are even in y. Then only one half gets strips; a line contact gets one.
        - `middle`: True to make y = 0 the first strip of this half. If `count` is even, this strip has the weight 0.
        """
        half_length = jnp.asarray(self.half_length, dtype=float)[..., None]
        if self.line and symmetric:
            one = jnp.ones_like(half_length)
            return Strips(one, 0.0 * one, 2.0 * half_length)
        nodes, weights = gauss_legendre(count)
        nodes, weights = 2.0 * nodes - 1.0, 2.0 * weights
        if symmetric:
            half = nodes > -1e-12
            weights = np.where(np.abs(nodes) < 1e-12, 1.0, 2.0)[half] * weights[half]
            nodes = nodes[half]
            if middle and count % 2 == 0:
                nodes, weights = np.append(0.0, nodes), np.append(0.0, weights)
        scale, offset, width = np.ones_like(nodes), nodes, weights
        if not self.line:
            scale, offset = np.cos(0.5 * np.pi * nodes), np.sin(0.5 * np.pi * nodes)
            width = 0.5 * np.pi * weights * scale
        rows = (jnp.asarray(row.reshape((1,) * (half_length.ndim - 1) + (-1,))) for row in (scale, offset, width))
        scale, offset, width = rows
        return Strips(scale, half_length * offset, half_length * width)


def contact_patch(contact: LineContact | PointContact, load: Values) -> ContactPatch:
    """Hertz contact area and pressure of a contact. **Arguments:** `load`, N, >= 0."""
    if isinstance(contact, LineContact):
        return ContactPatch(contact.hertz_pressure(load), contact.half_width(load), 0.5 * contact.length, line=True)
    ellipse = contact.ellipse(load)
    return ContactPatch(ellipse.pressure, ellipse.rolling, ellipse.transverse)

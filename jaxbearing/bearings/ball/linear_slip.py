r"""Motion of balls with the least sliding and spin, for any number of contacts and without a race control hypothesis.

Three or more contacts cannot all roll without sliding and spin (`docs/theory/four_point.md`). With tractions
proportional to pressure and sliding speed, $\tau\propto p\,\Delta u$, the ball is in equilibrium at the minimum of

$$\sum_kQ_k[u_{tk}^2 + \tfrac15\omega_{sk}^2(a_k^2 + c_k^2)]$$

over the orbital speed $\omega_m$ and the components of the spin $\omega_x = \omega_R\cos\beta$,
$\omega_z = \omega_R\sin\beta$ (semi-axes a, c of the ellipse; the mean of $x^2 + y^2$ weighted by Hertz's pressure is
$(a^2 + c^2)/5$). Sliding and spin are linear in these speeds:

- $u_{ti} = \frac12D(\omega_x\cos\alpha + \omega_z\sin\alpha) - \frac12d_m(\omega_i - \omega_m)(1 - \gamma'\cos\alpha)$,
  $u_{to} = \frac12d_m(\omega_m - \omega_o)(1 + \gamma'\cos\alpha) - \frac12D(\omega_x\cos\alpha + \omega_z\sin\alpha)$;
- $\omega_{si} = (\omega_i - \omega_m)\sin\alpha + (\omega_x\sin\alpha - \omega_z\cos\alpha)$,
  $\omega_{so} = (\omega_m - \omega_o)\sin\alpha - (\omega_x\sin\alpha - \omega_z\cos\alpha)$.

The minimum is the solution of three linear equations, which changes smoothly where contacts open. With two contacts the
ball rolls practically without sliding, and the spins on the two races are in inverse proportion to their
$Q_k(a_k^2 + c_k^2)$.
"""

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ...numerics.safe import safe_norm
from ...numerics.small_linear import solve_blocks
from .arcs import Arcs
from .kinematics import BallKinematics, BallMotion

DRIVEN = 1e-2
"""Weight of the sliding on a ring that does not load a ball, over the load of the other ring."""


def slip_weights(load: Float[Array, "contact ball"], arcs: Arcs, floor: float) -> Float[Array, "contact ball"]:
    r"""Weights of the sliding at each contact, N: $Q_k + \sigma[\sigma/(\sigma + \sum Q)]^5$ with the sum over the
    contacts on the same ring, and $\sigma = \varepsilon + 0.01\sum Q$ with the sum over those on the other ring.

    Without the added term, a ball that touches both arcs of the outer ring only would stop, because nothing drives it.
    With it, the ball also rolls on the unloaded ring, as if a cage drove it. Between loaded rings the added term is
    1e-12 of the load.

    **Arguments:** `floor`: $\varepsilon$, N.
    """
    on_ring = (arcs.on_inner(load), arcs.on_outer(load))
    least = [floor + DRIVEN * other for other in on_ring[::-1]]
    added = [sigma * (sigma / (sigma + there)) ** 5 for sigma, there in zip(least, on_ring, strict=True)]
    return jnp.stack([load[k] + added[race] for k, race in enumerate(arcs.races)])


def linear_slip(
    kinematics: BallKinematics,
    angle: Float[Array, "contact ball"],
    weight: Float[Array, "contact ball"],
    spread: Float[Array, "2"],
    races: tuple[int, ...],
) -> BallMotion:
    """The motion that minimises the sum in the docstring of the module.

    **Arguments:** `angle`: contact angles, rad; `weight`: weights of the sliding, N, > 0; `spread`: size of the contact
    ellipses, $(a^2 + c^2)/Q^{2/3}$, on the inner and the outer race, m^2/N^(2/3); `races`: race of each contact, 0
    inner, 1 outer.
    """
    race = np.asarray(races)
    sense = np.where(race == 0, 1.0, -1.0)[:, None]
    ratio, half = kinematics.ratio, 0.5 * kinematics.pitch_diameter
    sine, cosine = jnp.sin(angle), jnp.cos(angle)
    ring = jnp.stack([kinematics.inner_speed, kinematics.outer_speed])[race][:, None]
    # u_t and omega_s up to their signs, over half the pitch diameter; unknowns omega_m, ratio omega_x, ratio omega_z
    lever = 1.0 - sense * ratio * cosine
    slide = jnp.stack([lever, sense * cosine, sense * sine])
    spin = jnp.stack([sine, -sine / ratio, cosine / ratio])
    of_spin = weight * 0.2 * spread[race][:, None] * jnp.cbrt(jnp.square(weight)) / jnp.square(half)
    matrix = jnp.einsum("ikn,jkn,kn->ijn", slide, slide, weight) + jnp.einsum("ikn,jkn,kn->ijn", spin, spin, of_spin)
    right = jnp.sum((weight * lever * ring)[None] * slide + (of_spin * sine * ring)[None] * spin, axis=1)
    orbit, axial, radial = solve_blocks(matrix, right[:, None])[:, 0]
    axial, radial = axial / ratio, radial / ratio
    way = jnp.where(kinematics.inner_speed < kinematics.outer_speed, -1.0, 1.0)
    still = (axial == 0) & (radial == 0)
    attitude = jnp.arctan2(way * jnp.where(still, 0.0, radial), way * jnp.where(still, way, axial))
    return BallMotion(orbit, way * safe_norm(axial, radial), attitude, jnp.zeros_like(orbit))

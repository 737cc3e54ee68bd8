r"""Effect of growth (by fits, temperatures and speed) on a tapered roller bearing: constant changes of the approaches
of its contacts.

The raceways move by $u_k = \Delta G_k/2$ at mid length. The rollers grow by the strain $\varepsilon$ about the centre
of their big end, which moves each of their faces by a constant distance. Angles do not change. The approaches become:

- $f_i \mathrel{+}= u_i\cos\alpha_i + g$, $f_o \mathrel{+}= -u_o\cos\alpha_o + g$,
  $g = \varepsilon\frac{D_w}{2}\cos\epsilon$;
- $\delta_f \mathrel{+}= -u_i\sin\alpha_f + g_f$, $g_f = \varepsilon R_s(1 - \cos\lambda\cos\theta)$.

The axial displacement of the cone that brings the contacts back to first touch is
$\Delta x = (u_o - u_i)\cot\alpha_o - (X\sin\alpha_o + Y\cos\alpha_o + g)/\sin\alpha_o$ with
$X = (g\sin\alpha_f + g_f\cos\alpha_i)/\cos(\alpha_i - \alpha_f)$,
$Y = (g\cos\alpha_f - g_f\sin\alpha_i)/\cos(\alpha_i - \alpha_f)$.
"""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..growth import Growth, Play
from .geometry import TaperedGeometry


def raceway_diameters(geometry: TaperedGeometry) -> tuple[Float[Array, ""], Float[Array, ""]]:
    """Diameters of both raceways at mid length, m."""
    reach = geometry.apex_distance - 0.5 * geometry.roller_length
    return 2.0 * reach * jnp.sin(geometry.cone_angle), 2.0 * reach * jnp.sin(jnp.asarray(geometry.contact_angle))


def _of_rollers(geometry: TaperedGeometry, growth: Growth) -> tuple[Array, Array]:
    """Displacements g and g_f of the faces of a roller by its growth, m."""
    race = 0.5 * geometry.roller_diameter * jnp.cos(jnp.asarray(geometry.roller_half_angle))
    end = geometry.sphere_radius - geometry.end_height * jnp.cos(geometry.flange_tilt)
    return growth.element_strain * race, growth.element_strain * end


def closing(geometry: TaperedGeometry, growth: Growth) -> Float[Array, "3"]:
    """Changes of the approaches of inner race, outer race and rib by growth, m."""
    race, end = _of_rollers(geometry, growth)
    inner, outer = 0.5 * growth.inner, 0.5 * growth.outer
    return jnp.stack(
        [
            inner * jnp.cos(geometry.cone_angle) + race,
            race - outer * jnp.cos(jnp.asarray(geometry.contact_angle)),
            end - inner * jnp.sin(jnp.asarray(geometry.rib_angle)),
        ]
    )


def running_play(geometry: TaperedGeometry, growth: Growth) -> Play:
    """Play after growth: the axial displacement of the cone that brings the contacts back to first touch."""
    (race, end), cone = _of_rollers(geometry, growth), geometry.cone_angle
    cup, rib = jnp.asarray(geometry.contact_angle), jnp.asarray(geometry.rib_angle)
    along = (race * jnp.sin(rib) + end * jnp.cos(cone)) / jnp.cos(cone - rib)
    across = (race * jnp.cos(rib) - end * jnp.sin(cone)) / jnp.cos(cone - rib)
    shift = 0.5 * (growth.outer - growth.inner) / jnp.tan(cup)
    shift = shift - (along * jnp.sin(cup) + across * jnp.cos(cup) + race) / jnp.sin(cup)
    return Play(shift, None, shift, jnp.asarray(True))

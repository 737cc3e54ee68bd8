"""Sizes and loads of a ball bearing from which its life is computed."""

from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..rated import RatedContacts, sizes_of_loads

if TYPE_CHECKING:
    from .scene import BallBearing
    from .solution import BallResults
else:
    BallBearing = Any


def rated_contacts(
    scene: BallBearing, elements: "BallResults | None", force: Float[Array, " freedom"] | None = None
) -> RatedContacts:
    """Sizes and loads of the raceway contacts of a bearing.

    **Arguments:** `elements`: `BallResults` of a solution, `None` for an unloaded bearing; `force`: force on the inner
    ring in the same solution (`Solution.force`).
    """
    geometry = scene.geometry
    inner = outer = jnp.zeros(scene.n_elements)
    second = (None, None)
    if elements is not None:
        inner, outer = elements.load_inner, elements.load_outer
        second = elements.load_inner_second, elements.load_outer_second
    radial, axial = sizes_of_loads(scene.operation, force)
    return RatedContacts(
        n_elements=geometry.n_balls,
        diameter=geometry.ball_diameter,
        pitch_diameter=geometry.pitch_diameter,
        contact_angle=geometry.nominal_angle,
        rings=scene.materials.rings,
        inner_ring=scene.materials.inner_ring,
        elements=scene.materials.balls,
        inner=inner,
        outer=outer,
        conformities=(geometry.conformity_inner, geometry.conformity_outer),
        second=second,
        radial_load=radial,
        axial_load=axial,
    )

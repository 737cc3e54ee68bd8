"""Sizes and loads of a ball bearing from which its life is computed."""

from typing import TYPE_CHECKING

import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.newton import NewtonOptions, newton_solve
from ..mounted import running_scene
from ..rated import RatedContacts, sizes_of_loads
from .build import build_core
from .scene import BallBearing

if TYPE_CHECKING:
    from .solution import BallResults


def linear_tilt_loads(scene: BallBearing, options: NewtonOptions | None = None) -> Float[Array, "contact ball"]:
    r"""Loads on the contacts (`arcs`; first those on the inner race), N, where a tilt moves the inner grooves to first
    order, along the axis by $R_i\theta\cos\psi$.

    This is what ISO 16281 and software built on it compute with; the motion $R_i(1 - \cos\theta)\cos^2\psi$ towards
    the axis is left out. Films and friction are left out too; centrifugal forces are those of the scene. NaN where the
    solve fails.
    """
    core, _ = build_core(scene, exact=False).started()
    system, result = newton_solve(core, NewtonOptions() if options is None else options)
    load = system.at(result.point).load
    return jnp.where(result.converged, load, jnp.nan)


def _by_flank(
    scene: BallBearing, load: Float[Array, "contact ball"]
) -> tuple[Array, Array, tuple[Array | None, Array | None]]:
    """Loads on the first flanks of both races, and on the second ones."""
    arcs = scene.geometry.arcs
    second = (None if arcs.inner is None else load[1], None if arcs.outer is None else load[-1])
    return load[0], load[arcs.first_outer], second


def rated_contacts(
    scene: BallBearing, elements: "BallResults | None", force: Float[Array, " freedom"] | None = None
) -> RatedContacts:
    """**Arguments:** `elements`: `BallResults` of a solution, `None` of an unloaded bearing; `force`: its `force`."""
    geometry = scene.geometry
    inner = outer = jnp.zeros(scene.n_elements)
    second = (None, None)
    if elements is not None:
        inner, outer = elements.load_inner, elements.load_outer
        second = elements.load_inner_second, elements.load_outer_second
    if elements is not None and scene.rated_to_first_order:
        inner, outer, second = _by_flank(scene, linear_tilt_loads(running_scene(scene)[0]))
    radial, axial = sizes_of_loads(scene.operation, force)
    return RatedContacts(
        n_elements=geometry.n_balls,
        diameter=geometry.ball_diameter,
        pitch_diameter=geometry.pitch_diameter,
        contact_angle=geometry.nominal_angle,
        rings=scene.materials.rings,
        elements=scene.materials.balls,
        inner=inner,
        outer=outer,
        conformities=(geometry.conformity_inner, geometry.conformity_outer),
        second=second,
        radial_load=radial,
        axial_load=axial,
    )

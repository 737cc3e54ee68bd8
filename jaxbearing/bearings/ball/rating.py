"""Loads for the rating of a ball bearing in the form of ISO 16281, with the first-order motion of a tilted ring."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.newton import NewtonOptions, newton_solve
from .build import build_core
from .scene import BallBearing


def linear_tilt_loads(scene: BallBearing, options: NewtonOptions | None = None) -> Float[Array, "2 ball"]:
    r"""Loads on the inner and outer race, N, where a tilt moves the inner grooves along the axis only, by
    $R_i\theta\cos\psi$.

    This is what ISO 16281 and software built on it compute with; the motion $R_i(1 - \cos\theta)\cos^2\psi$ towards
    the axis is left out. Films and friction are left out too; centrifugal forces are those of the scene. NaN where the
    solve fails.
    """
    core, _ = build_core(scene, exact=False).started()
    system, result = newton_solve(core, NewtonOptions() if options is None else options)
    load = system.at(result.point).load
    return jnp.where(result.converged, load, jnp.nan)

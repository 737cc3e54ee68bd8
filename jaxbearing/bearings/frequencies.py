r"""Kinematic frequencies: how often the cage turns, elements spin, and elements pass a point of a ring.

A damage on one part is heard at these frequencies: on a ring each time that a rolling element passes it, on an element
each time that it meets a ring, twice in a turn.
"""

from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..numerics.checks import label

TURN = 2.0 * np.pi
NO_LOAD = 1e-30
"""Added to every load, N, so that elements without load count alike where none is loaded."""
_Frequency = Float[Array, ""]


class KinematicFrequencies(eqx.Module):
    """Frequencies of the parts of a bearing, Hz, all counted positive."""

    cage: _Frequency = eqx.field(metadata=label("Hz", "turns of the cage, or of the elements without one (FTF)"))
    outer_pass: _Frequency = eqx.field(metadata=label("Hz", "elements that pass a point of the outer raceway (BPFO)"))
    inner_pass: _Frequency = eqx.field(metadata=label("Hz", "elements that pass a point of the inner raceway (BPFI)"))
    element_spin: _Frequency = eqx.field(
        metadata=label("Hz", "turns of an element in its pocket (BSF); a damaged element meets a raceway twice a turn")
    )


def frequencies_of_motion(scene: Any, elements: Any, cage: Any) -> KinematicFrequencies:
    r"""Frequencies of the motion that was solved: with its contact angles and its slip.

    $f_c = |\omega_c|/2\pi$, $f_o = Z|\omega_c - \omega_o|/2\pi$, $f_i = Z|\omega_i - \omega_c|/2\pi$,
    $f_s = |s|/2\pi$. Without a cage $\omega_c$ is the mean orbital speed. It and the spin s, which counts relative to
    the orbit, are means over the elements, each weighted by its loads on both raceways: what is heard comes from
    loaded elements.

    **Arguments:** `elements`, `cage`: results of the scene; `cage` is `None` where it has none.
    """
    load = elements.load_inner + elements.load_outer + NO_LOAD
    mean = lambda speed: jnp.sum(load * speed) / jnp.sum(load)
    turning = mean(elements.orbital_speed) if cage is None else cage.speed
    return _frequencies(scene, turning, mean(elements.spin_speed))


def textbook_frequencies(scene: Any) -> KinematicFrequencies:
    r"""Frequencies of elements that roll without slip at the contact angle of the drawing.

    With $\gamma = D\cos\alpha/d_m$: $\omega_c = [\omega_i(1 - \gamma) + \omega_o(1 + \gamma)]/2$,
    $s = (\omega_i - \omega_o)(1 - \gamma^2)\,d_m/(2D)$; the rest as in `frequencies_of_motion`. $\alpha$ is 0 for ball
    bearings that are given by their clearance and for cylindrical rollers, and the angle of the cup for tapered ones,
    whose D is that of the middle of the roller.

    **Reference:** Harris and Kotzalas, Rolling bearing analysis, chapter on kinematics.

    **Arguments:** `scene`: an `AbstractBearing`.
    """
    operation = scene.operation
    inner, outer = jnp.asarray(operation.inner_speed), jnp.asarray(operation.outer_speed)
    pitch = jnp.asarray(scene.geometry.pitch_diameter)
    ratio = scene.mean_diameter * jnp.cos(scene.drawing_angle) / pitch
    turning = 0.5 * (inner * (1.0 - ratio) + outer * (1.0 + ratio))
    spin = 0.5 * (inner - outer) * (1.0 - jnp.square(ratio)) * pitch / scene.mean_diameter
    return _frequencies(scene, turning, spin)


def _frequencies(scene: Any, turning: Array, spin: Array) -> KinematicFrequencies:
    """**Arguments:** `turning`: speed of the cage; `spin`: of the elements relative to it, rad/s."""
    operation, often = scene.operation, lambda speed: jnp.abs(speed) / TURN
    return KinematicFrequencies(
        cage=often(turning),
        outer_pass=scene.n_elements * often(turning - operation.outer_speed),
        inner_pass=scene.n_elements * often(operation.inner_speed - turning),
        element_spin=often(spin),
    )

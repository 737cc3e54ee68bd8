r"""Kinematic frequencies of a bearing: rotation of the cage, spin of the elements, passage of elements past a point.

Damage on a part excites vibration at these frequencies: damage on a ring each time a rolling element passes it, damage
on an element each time it meets a ring, twice per turn.
"""

from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._derived import known_numbers
from .._types import Values
from ..numerics.checks import array_module, label

if TYPE_CHECKING:
    from .bearing import AbstractBearing
    from .operation import AbstractOperation
    from .solution import CageState
else:
    AbstractBearing = Any

TURN = 2.0 * np.pi
NO_LOAD = 1e-30
"""Load added to every element, N, so that all elements have the same weight if none is loaded."""
_Frequency = Float[Array | np.ndarray, "*batch"]
"""Frequency or batch of frequencies; a numpy array if the numbers are known."""


class KinematicFrequencies(eqx.Module):
    """Kinematic frequencies of the parts of a bearing, Hz, all positive."""

    cage: _Frequency = eqx.field(metadata=label("Hz", "turns of the cage, or of the elements without one (FTF)"))
    outer_pass: _Frequency = eqx.field(metadata=label("Hz", "elements that pass a point of the outer raceway (BPFO)"))
    inner_pass: _Frequency = eqx.field(metadata=label("Hz", "elements that pass a point of the inner raceway (BPFI)"))
    element_spin: _Frequency = eqx.field(
        metadata=label("Hz", "turns of an element in its pocket (BSF); a damaged element meets a raceway twice a turn")
    )


def frequencies_of_motion(
    operation: "AbstractOperation", elements: Any, cage: "CageState | None"
) -> KinematicFrequencies:
    r"""Frequencies of the motion of a solution, with its contact angles and its slip.

    $f_c = |\omega_c|/2\pi$, $f_o = Z|\omega_c - \omega_o|/2\pi$, $f_i = Z|\omega_i - \omega_c|/2\pi$,
    $f_s = |s|/2\pi$. Without a cage $\omega_c$ is the mean orbital speed. The mean orbital
    speed and the mean spin s, relative to the orbit, are weighted by the load of each element on the inner raceway:
    damage is noticed at elements that carry load, while centrifugal forces press all elements against the outer ring.

    **Arguments:** `operation`, `elements`, `cage`: fields of a solution or of a batch of solutions; `cage` is `None` if
    the scene has no cage.
    """
    second = getattr(elements, "load_inner_second", None)
    motion = (elements.load_inner, elements.orbital_speed, elements.spin_speed)
    speeds = (operation.inner_speed, operation.outer_speed)
    (load, orbit, spin), rings, cage_speed, second = known_numbers(
        (motion, speeds, None if cage is None else cage.speed, second)
    )
    load = load + NO_LOAD if second is None else load + second + NO_LOAD
    mean = lambda speed: (load * speed).sum(axis=-1) / load.sum(axis=-1)
    with np.errstate(all="ignore"):  # results of a failed solve are NaN
        turning = mean(orbit) if cage_speed is None else cage_speed
        return _frequencies(rings, load.shape[-1], turning, mean(spin))


def textbook_frequencies(scene: AbstractBearing) -> KinematicFrequencies:
    r"""Frequencies of elements that roll without slip at the contact angle of the drawing.

    With $\gamma = D\cos\alpha/d_m$: $\omega_c = [\omega_i(1 - \gamma) + \omega_o(1 + \gamma)]/2$,
    $s = (\omega_i - \omega_o)(1 - \gamma^2)\,d_m/(2D)$; the rest as in `frequencies_of_motion`. $\alpha$ is 0 for
    cylindrical rollers and for ball bearings defined by their clearance. For tapered rollers $\alpha$ is the angle of
    the cup, and D the diameter at the middle of the roller.

    **Reference:** Harris and Kotzalas, Rolling bearing analysis, chapter on kinematics.

    **Arguments:** `scene`: an `AbstractBearing`.
    """
    operation = scene.operation
    inner, outer = jnp.asarray(operation.inner_speed), jnp.asarray(operation.outer_speed)
    pitch = jnp.asarray(scene.geometry.pitch_diameter)
    ratio = scene.element_diameter * jnp.cos(scene.drawing_angle) / pitch
    turning = 0.5 * (inner * (1.0 - ratio) + outer * (1.0 + ratio))
    spin = 0.5 * (inner - outer) * (1.0 - jnp.square(ratio)) * pitch / scene.element_diameter
    return _frequencies((inner, outer), scene.n_elements, turning, spin)


def _frequencies(rings: tuple[Values, Values], count: int, turning: Values, spin: Values) -> KinematicFrequencies:
    """Frequencies from the speeds of the parts.

    **Arguments:** `rings`: speeds of both rings, rad/s; `count`: number of elements; `turning`: speed of the cage,
    rad/s; `spin`: spin of the elements relative to it, rad/s."""
    inner, outer = rings
    module = array_module(inner, outer, turning, spin)
    often = lambda speed, times: module.asarray(times * abs(speed) / TURN)
    return KinematicFrequencies(
        cage=often(turning, 1),
        outer_pass=often(turning - outer, count),
        inner_pass=often(inner - turning, count),
        element_spin=often(spin, 1),
    )

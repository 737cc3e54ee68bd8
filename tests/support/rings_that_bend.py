"""What tests of flexible rings, or that are not round, have in common."""

from collections.abc import Callable

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

import jaxbearing as jb
from jaxbearing.bearings.bearing import AbstractBearing
from jaxbearing.bearings.tapered.scene import TaperedRollerBearing


def lobes(kind, order, height, angle=0.0):
    return kind(lobe_order=[float(order)], lobe_height=[height], lobe_angle=[angle])


def pressing(scene: AbstractBearing, solution: jb.Solution, side: str) -> np.ndarray:
    """Radial force by which each rolling element presses a ring away, N."""
    elements = solution.elements
    names = ["", *(["_second"] if getattr(elements, f"load_{side}_second", None) is not None else [])]
    force = sum(
        np.asarray(getattr(elements, f"load_{side}{name}"))
        * np.cos(np.asarray(getattr(elements, f"contact_angle_{side}{name}", 0.0)))
        for name in names
    )
    if side == "inner" and isinstance(scene, TaperedRollerBearing):
        force = force - np.asarray(elements.load_flange) * np.sin(float(scene.geometry.rib_angle))
    return force


def unbalance(scene: AbstractBearing, solution: jb.Solution, side: str = "outer") -> float:
    """See `unbalance_of`. **Arguments:** `side`: "outer" or "inner"."""
    force, azimuth = pressing(scene, solution, side), np.asarray(solution.elements.azimuth)
    return unbalance_of(scene, getattr(solution, f"{side}_ring"), azimuth, force, side)


def unbalance_of(scene: AbstractBearing, found, azimuth: np.ndarray, force: np.ndarray, side: str = "outer") -> float:
    """Largest force on an amplitude of the ring that is not balanced, over the load of all elements: written again from
    the results. **Arguments:** `found`: deflected shape of the ring; `force`: see `pressing`, N."""
    sense = {"outer": 1.0, "inner": -1.0}[side]
    part, order = getattr(scene, f"{side}_ring"), np.asarray(found.order)[:, None]
    raceway = scene.raceway_diameters[("inner", "outer").index(side)]
    radius = 0.5 * float(raceway) + sense * 0.5 * part.thickness
    modulus = float(scene.materials.rings.youngs_modulus)
    bending, axial = modulus * part.width * part.thickness**3 / 12.0, modulus * part.width * part.thickness
    each = bending / radius**4 / (1.0 + bending / (axial * radius**2)) * (order**2 - 1.0) ** 2
    bed = part.housing_stiffness if side == "outer" else part.shaft_stiffness
    each = np.where(order == 0, axial / radius**2, each) + bed
    stiffness = (np.pi * radius * each * np.where(order == 0, 2.0, 1.0))[:, 0]
    rows = [
        stiffness * np.asarray(amplitude) - sense * shape(order * azimuth) @ force
        for amplitude, shape in ((found.cosines, np.cos), (found.sines, np.sin))
    ]
    return float(np.max(np.abs(rows)) / np.sum(force))


def check_derivatives(result: Callable[..., Array], at: tuple[float, ...], rtol: float = 1e-6, forward: bool = True):
    """Derivatives in reverse mode agree with central differences, and those in forward mode with these.

    **Arguments:** `result`: a number, of as many arguments as `at` has; `rtol`: of differences; `forward`: whether that
    mode is checked.
    """
    numbers, every = tuple(map(jnp.asarray, at)), tuple(range(len(at)))
    backward = jax.jit(jax.grad(result, argnums=every))(*numbers)
    for place, (slope, step) in enumerate(zip(backward, 1e-4 * np.asarray(at), strict=True)):
        moved = (numbers[place] + step, numbers[place] - step)
        high, low = (result(*numbers[:place], one, *numbers[place + 1 :]) for one in moved)
        np.testing.assert_allclose(slope, (high - low) / (2.0 * step), rtol=rtol)
    if forward:
        np.testing.assert_allclose(jax.jit(jax.jacfwd(result, argnums=every))(*numbers), backward, rtol=1e-9)

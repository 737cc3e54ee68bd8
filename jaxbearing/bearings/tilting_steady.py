"""Steady state of a cylindrical roller bearing with tilting, profiled rollers: dry, frictionless."""

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..contacts import LineContact, palmgren_stiffness
from ..materials import reduced_modulus
from ..numerics.arrow import ArrowPoint, linearize, schur_complement
from ..numerics.newton import NewtonOptions, newton_solve
from .cylindrical_roller import CylindricalRollerBearing
from .kinematics import RollerKinematics
from .roller_loads import LENGTH_UNIT
from .roller_profile import RollerProfile
from .solution import CageState, LaminaLoads, PowerLoss, RingDisplacement, RollerResults, Solution
from .steady import assemble
from .tilting_roller import TiltingRollers, TiltingState

FREEDOMS = ("radial", "lateral", "tilt", "tilt_lateral")
"""Of the inner ring, those that the model has: nothing holds it axially."""


def build_tilting(scene: CylindricalRollerBearing, freedoms: tuple[str, ...] | None = None) -> TiltingRollers:
    """The equations of a scene with its ring freedoms, or with others."""
    geometry, operation = scene.geometry, scene.operation
    names = (*scene.ring_freedom, *(() if operation.moment is None else ("tilt",))) if freedoms is None else freedoms
    azimuth = jnp.asarray(2.0 * np.pi * np.arange(geometry.n_rollers) / geometry.n_rollers)
    length = jnp.asarray(geometry.loaded_length)
    columns = _columns(azimuth, length)
    number = lambda value: jnp.asarray(0.0 if value is None else value)
    tilt = number(operation.misalignment) if operation.moment is None else jnp.zeros(())
    radial = jnp.where(jnp.asarray(operation.radial_load) > 0, operation.radial_load, jnp.nan)
    loads = {"radial": radial, "tilt": number(operation.moment) / length}
    stiffness = palmgren_stiffness(length, reduced_modulus(scene.materials.rings, scene.materials.rollers))
    motion = _motion(scene)
    mass = scene.materials.rollers.density * jnp.pi * motion.roller_radius**2 * geometry.roller_length
    profile = RollerProfile() if scene.profile is None else scene.profile
    return TiltingRollers(
        line=profile.line(stiffness, length),
        azimuth=azimuth,
        columns=jnp.stack([columns[name] for name in names]),
        held=tilt * length * columns["tilt"],
        ring_load=jnp.stack([loads.get(name, jnp.zeros(())) for name in names]),
        radial_clearance=jnp.asarray(geometry.diametral_clearance) / 2.0,
        centrifugal=mass * motion.pitch_radius * jnp.square(motion.free_orbit),
        guess=None,
        freedoms=names,
    )


def _columns(azimuth: Float[Array, " roller"], lever: Array) -> dict[str, Float[Array, "2 roller"]]:
    """(towards the roller, slope of the inner race) for a unit of each freedom; tilts times `lever` are lengths."""
    zero, cosine, sine = jnp.zeros_like(azimuth), jnp.cos(azimuth), jnp.sin(azimuth)
    return {
        "radial": jnp.stack([cosine, zero]),
        "lateral": jnp.stack([sine, zero]),
        "tilt": jnp.stack([zero, -cosine / lever]),
        "tilt_lateral": jnp.stack([zero, -sine / lever]),
    }


def _motion(scene: CylindricalRollerBearing) -> RollerKinematics:
    geometry, operation = scene.geometry, scene.operation
    sizes = (operation.inner_speed, operation.outer_speed, geometry.pitch_radius, geometry.roller_radius)
    return RollerKinematics(*(jnp.asarray(value) for value in sizes))


def solve_tilting(scene: CylindricalRollerBearing, options: NewtonOptions) -> Solution:
    """Steady state: pure, jit-able, vmap-able, differentiable; never raises for a failed solve."""
    started, minimum = build_tilting(scene).started()
    system, result = newton_solve(started, options)
    length = scene.geometry.loaded_length
    ring = {name: result.point.globals[i] * LENGTH_UNIT for i, name in enumerate(system.freedoms)}
    held = scene.operation.moment is None and scene.operation.misalignment is not None
    if held:
        ring["tilt"] = jnp.asarray(scene.operation.misalignment) * length
    place = lambda name: ring.get(name, jnp.zeros(()))
    displacement = RingDisplacement(
        axial=jnp.zeros(()),
        radial=place("radial"),
        lateral=place("lateral"),
        tilt=place("tilt") / length,
        tilt_lateral=jnp.zeros(()),
    )
    return assemble(
        scene,
        result,
        _results(scene, system, system.at(result.point)),
        displacement,
        _stiffness(scene, system, result.point),
        iterations=minimum.steps + result.iterations,
        ring_freedom=(*system.freedoms, "tilt") if held else system.freedoms,
        stiffness_freedom=FREEDOMS,
        equation_names=system.equation_names(),
    )


class _Results(NamedTuple):
    """Results before masking."""

    cage: CageState | None
    elements: RollerResults
    power_loss: PowerLoss
    drive_power: Array
    inner_torque: Array
    outer_torque: Array
    laminae: LaminaLoads
    range_excess: dict[str, Array]


def _results(scene: CylindricalRollerBearing, system: TiltingRollers, state: TiltingState) -> _Results:
    motion, zero, ones = _motion(scene), jnp.zeros(()), jnp.ones_like(system.azimuth)
    count = RollerProfile().n_laminae if scene.profile is None else scene.profile.n_laminae
    inner, outer = (system.line.laminae(state.approach[side], state.slope[side], count) for side in (0, 1))
    modulus = reduced_modulus(scene.materials.rings, scene.materials.rollers)
    curvatures = (1.0 / motion.inner_radius, -1.0 / motion.outer_radius)
    peaks = []
    for laminae, curvature in zip((inner, outer), curvatures, strict=True):
        contact = LineContact(1.0 / (1.0 / motion.roller_radius + curvature), system.line.length / count, modulus)
        largest = jnp.max(laminae, axis=1)
        peaks.append(jnp.where(largest > 0, contact.hertz_pressure(largest), 0.0))
    elements = RollerResults(
        azimuth=system.azimuth,
        load_inner=state.load[0],
        load_outer=state.load[1],
        pressure_inner=peaks[0],
        pressure_outer=peaks[1],
        orbital_speed=motion.free_orbit * ones,
        spin_speed=motion.free_spin * ones,
    )
    profiled = scene.profile is not None and scene.profile.shape is not None
    return _Results(None, elements, PowerLoss(total=zero), zero, zero, zero, LaminaLoads(inner, outer, profiled), {})


def _stiffness(scene: CylindricalRollerBearing, system: TiltingRollers, point: ArrowPoint) -> Float[Array, "4 4"]:
    """d load / d displacement of all freedoms, rollers in equilibrium, N/m."""
    full = build_tilting(scene, FREEDOMS)
    place = dict(zip(system.freedoms, point.globals, strict=True))
    ring = jnp.stack([place.get(name, jnp.zeros(())) for name in FREEDOMS])
    schur = schur_complement(linearize(full, ArrowPoint(point.elements, ring))[1])
    length = jnp.asarray(scene.geometry.loaded_length)
    arm = jnp.stack([jnp.ones(()), jnp.ones(()), length, length])
    return schur * (full.load_scale() / LENGTH_UNIT) * arm[:, None] * arm[None, :]

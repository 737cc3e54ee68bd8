r"""Steady state of a cylindrical roller bearing with tilting, profiled rollers.

The load distribution is dry and frictionless. With an oil and contact laws films and rolling resistance follow from it
for rolling without sliding: laminae are short line contacts side by side, each with its own load per length. The
tractions that rolling without sliding needs balance each roller; ring torques are assembled from them.
"""

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..contacts import LineContact, palmgren_stiffness
from ..contacts.laws import ContactState
from ..materials import reduced_modulus
from ..numerics.arrow import ArrowPoint, linearize, schur_complement
from ..numerics.newton import NewtonOptions, newton_solve
from ..numerics.status import Status
from .cylindrical_roller import CylindricalRollerBearing
from .kinematics import RollerKinematics, roller_kinematics
from .range_checks import MEAN_OF_LINE, RACEWAYS, Contacts, Facts
from .rating import rated_laminae
from .roller_forces import rolling_alone
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
    motion = roller_kinematics(scene.geometry, scene.operation)
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


def solve_tilting(scene: CylindricalRollerBearing, options: NewtonOptions) -> Solution:
    """Steady state: pure, jit-able, vmap-able, differentiable; never raises for a failed solve."""
    started, minimum = build_tilting(scene).started()
    system, result = newton_solve(started, options)
    none = ~result.converged & minimum.outside
    result = result._replace(status=jnp.where(none, int(Status.NO_EQUILIBRIUM), result.status))
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
    """Results before masking; `facts`: what the range checks look at."""

    cage: CageState | None
    elements: RollerResults
    power_loss: PowerLoss
    drive_power: Array | None
    inner_torque: Array | None
    outer_torque: Array | None
    laminae: LaminaLoads
    facts: Facts


def _results(scene: CylindricalRollerBearing, system: TiltingRollers, state: TiltingState) -> _Results:
    motion, zero, ones = (
        roller_kinematics(scene.geometry, scene.operation),
        jnp.zeros(()),
        jnp.ones_like(system.azimuth),
    )
    count = RollerProfile().n_laminae if scene.profile is None else scene.profile.n_laminae
    cut = lambda number: jnp.stack(
        [system.line.laminae(state.approach[side], state.slope[side], number) for side in (0, 1)]
    )
    laminae = cut(count)
    rated = rated_laminae(scene.rating, count)
    inner_laminae, outer_laminae = laminae if rated == count else cut(rated)
    curvatures = jnp.stack([1.0 / motion.inner_radius, -1.0 / motion.outer_radius])
    contact = LineContact(
        (1.0 / (1.0 / motion.roller_radius + curvatures))[:, None],
        jnp.asarray(system.line.length),
        reduced_modulus(scene.materials.rings, scene.materials.rollers),
    )
    most = jnp.max(laminae, axis=2)
    peaks = jnp.where(most > 0, contact.hertz_pressure(jnp.where(most > 0, most, 1.0) * count), 0.0)
    more, rolling = _films(scene, contact, motion, laminae)
    elements = RollerResults(
        azimuth=system.azimuth,
        load_inner=state.load[0],
        load_outer=state.load[1],
        pressure_inner=peaks[0],
        pressure_outer=peaks[1],
        orbital_speed=motion.free_orbit * ones,
        spin_speed=motion.free_spin * ones,
        **more,
    )
    profiled = scene.profile is not None and scene.profile.shape is not None
    costs = rolling_alone(contact, motion, rolling)
    contacts = Contacts(RACEWAYS, state.load, peaks, MEAN_OF_LINE, laminae=laminae)
    facts = Facts((contacts,))
    if scene.contact is not None and scene.oil is not None:
        rises = [more[name] for name in ("temperature_rise_inner", "temperature_rise_outer") if name in more]
        inlet = scene.oil.at(scene.operation.oil_temperature)
        speed = motion.surface_speeds(zero, zero)[0][:, None]
        temperature = inlet.temperature + jnp.stack(rises) if rises else None
        contacts = contacts._replace(laws=scene.contact, mean_speed=speed, temperature=temperature)
        facts = facts._replace(contacts=(contacts,), inlet=inlet)
    return _Results(
        None,
        elements,
        *costs,
        LaminaLoads(inner_laminae, outer_laminae, profiled),
        facts,
    )


def _films(
    scene: CylindricalRollerBearing,
    contact: LineContact,
    motion: RollerKinematics,
    laminae: Float[Array, "2 roller lamina"],
) -> tuple[dict[str, Array], Float[Array, "2 roller"] | None]:
    """Films, NaN where nothing is loaded, and the rolling resistance of each contact, N.

    `film_*`: of the whole contact, its load spread evenly over the length; `film_least_*`: the thinnest of the laminae.
    """
    laws, oil = scene.contact, scene.oil
    if laws is None or oil is None:
        return {}, None
    inlet = oil.at(scene.operation.oil_temperature)
    speed = motion.surface_speeds(jnp.zeros(()), jnp.zeros(()))[0][:, None]

    def loaded(one: LineContact, load: Array, speed: Array) -> tuple[Array, ContactState]:
        carries = load > 0
        safe = jnp.where(carries, load, 1.0)
        return carries, laws.evaluate(one, safe, speed + 0.0 * safe, 0.0 * safe, oil, inlet)

    carries, whole = loaded(contact, jnp.sum(laminae, axis=2), speed)
    each = LineContact(contact.reduced_radius[..., None], contact.length / laminae.shape[2], contact.reduced_modulus)
    carried, parts = loaded(each, laminae, speed[..., None])
    blank = lambda values: jnp.where(carries, values, jnp.nan)
    film = blank(whole.film)
    least = blank(jnp.min(jnp.where(carried, parts.film, jnp.inf), axis=2))
    more = {"film_inner": film[0], "film_outer": film[1], "film_least_inner": least[0], "film_least_outer": least[1]}
    if whole.temperature_rise is not None:
        rise = blank(whole.temperature_rise)
        more |= {"temperature_rise_inner": rise[0], "temperature_rise_outer": rise[1]}
    if parts.rolling_force is None:
        return more, None
    return more, jnp.sum(jnp.where(carried, parts.rolling_force, 0.0), axis=2)


def _stiffness(scene: CylindricalRollerBearing, system: TiltingRollers, point: ArrowPoint) -> Float[Array, "4 4"]:
    """d load / d displacement of all freedoms, rollers in equilibrium, N/m."""
    full = build_tilting(scene, FREEDOMS)
    place = dict(zip(system.freedoms, point.globals, strict=True))
    ring = jnp.stack([place.get(name, jnp.zeros(())) for name in FREEDOMS])
    schur = schur_complement(linearize(full, ArrowPoint(point.elements, ring))[1])
    length = jnp.asarray(scene.geometry.loaded_length)
    arm = jnp.stack([jnp.ones(()), jnp.ones(()), length, length])
    return schur * (full.load_scale() / LENGTH_UNIT) * arm[:, None] * arm[None, :]

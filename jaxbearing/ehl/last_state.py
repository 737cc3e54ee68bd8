"""State of a line contact's transient run, in SI units, from which another run continues."""

from typing import ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from .._identity import Identity, identity_of, require_same
from .._scene import label
from .equations import Point, film_shape, mass
from .line_contact import EHLLineContact, Scales
from .mesh import Mesh, MeshKey, mesh
from .stepping import Motion

ALIKE = 1e-6
"""Relative difference of load or film up to which a state fits its scene."""
_SAME_PLACE = 1e-9
"""Distance up to which two nodes count as the same place, half widths."""


class FilmState(eqx.Module):
    """State from which another run can continue: `LineContactHistory.last_state`, or read from a file.

    **Arguments:** `x`: places of the nodes, m; values at the last three times, newest first: `pressure`, Pa, `offset`
    of the film, m, and `mass`, density over that at ambient pressure times film, m; `steps` between these times, s;
    `known`: number of these times that are known; `proposal`: the step to try next, s; `identity`: which
    contact it is (`None`: not known, as in files of earlier versions).
    """

    of: ClassVar[str] = "line contact"
    """Kind of scene that has this state, for messages."""

    x: Float[Array | np.ndarray, " node"] = eqx.field(metadata=label("m", "place of the node along rolling"))
    time: Float[Array | np.ndarray, ""] = eqx.field(metadata=label("s", "time from which a run can go on"))
    pressure: Float[Array | np.ndarray, "last_time=3 node"] = eqx.field(
        metadata=label("Pa", "pressure at the last three times")
    )
    offset: Float[Array | np.ndarray, "last_time=3"] = eqx.field(
        metadata=label("m", "constant of the film at these times")
    )
    mass: Float[Array | np.ndarray, "last_time=3 node"] = eqx.field(
        metadata=label("m", "density over that at ambient pressure times film, at these times")
    )
    steps: Float[Array | np.ndarray, "last_step=2"] = eqx.field(metadata=label("s", "steps between these times"))
    known: Int[Array | np.ndarray, ""] = eqx.field(metadata=label("1", "how many of these times there are"))
    proposal: Float[Array | np.ndarray, ""] = eqx.field(metadata=label("s", "step to try next"))
    identity: Identity | None = None


MAY_CHANGE = ("operation", "oil", "simulation", "contact.film_limit")
"""Parts of a scene that may differ from those of the run that is continued; the load is compared with the state
itself."""
UNKNOWN = (
    "restart: the state does not say of which contact it is (an earlier version wrote it); only its mesh, its load and "
    "its film have been compared"
)
"""Note of a run that continues from a state without identity."""


def state_of(motion: Motion, scales: Scales, key: MeshKey, scene: EHLLineContact) -> FilmState:
    """The state, in SI units, of a dimensionless motion."""
    unit = scales.half_width / scales.reference_speed
    return FilmState(
        x=jnp.asarray(mesh(key).x) * scales.half_width,
        time=motion.time * unit,
        pressure=motion.points.pressure * scales.hertz_pressure,
        offset=motion.points.offset * scales.film,
        mass=motion.masses * scales.film,
        steps=motion.steps * unit,
        known=motion.known,
        proposal=motion.proposal * unit,
        identity=identity_of(scene, MAY_CHANGE),
    )


def motion_of(state: FilmState, scales: Scales) -> Motion:
    """The dimensionless motion of a state in SI units; the reference speed, and so the unit of time, may differ."""
    unit = scales.half_width / scales.reference_speed
    return Motion(
        jnp.asarray(state.time) / unit,
        jax.vmap(Point)(jnp.asarray(state.pressure) / scales.hertz_pressure, jnp.asarray(state.offset) / scales.film),
        jnp.asarray(state.mass) / scales.film,
        jnp.asarray(state.steps) / unit,
        jnp.asarray(state.known, dtype=int),
        jnp.asarray(state.proposal) / unit,
    )


def mesh_of_state(scene: EHLLineContact, state: FilmState, backwards: bool) -> MeshKey:
    """The mesh of a state that fits the scene. **Arguments:** `backwards`: whether oil is to enter from +x too.

    **Raises:** `ValueError` where the state is not one of this contact, or has no inlet where one is needed.
    """
    finite = (state.x, state.time, state.pressure, state.offset, state.mass, state.steps, state.proposal)
    if not all(np.all(np.isfinite(values)) for values in finite):
        raise ValueError("restart: a state with numbers that are not finite")
    if not (1 <= int(state.known) <= 3 and np.all(np.asarray(state.steps) > 0) and float(state.proposal) > 0):
        raise ValueError("restart: a state whose steps are not > 0 s")
    if state.identity is not None:
        require_same(state.identity, identity_of(scene, MAY_CHANGE), "contact")
    nodes, scales = np.size(state.x), scene.scales()
    if nodes != scene.contact.nodes:
        raise ValueError(f"restart: a state on another mesh: {nodes} nodes, for contact.nodes = {scene.contact.nodes}")
    places = np.asarray(state.x) / float(scales.half_width)
    keys = (scene.run_mesh(False), scene.run_mesh(True))
    key = next((key for key in keys if np.abs(places - mesh(key).x).max() <= _SAME_PLACE), None)
    if key is None:
        raise ValueError("restart: a state on another mesh: contact.inlet or the Hertz half width differ")
    if backwards and key.inlet != key.outlet:
        raise ValueError("restart: a state on another mesh: the speed turns negative, and it has no inlet on that side")
    _check_contact(scene, scales, motion_of(state, scales), mesh(key))
    return key


def _check_contact(scene: EHLLineContact, scales: Scales, motion: Motion, grid: Mesh) -> None:
    """Checks that the newest point has the load and the film of the scene."""
    point = Point(motion.points.pressure[0], motion.points.offset[0])
    carried = float(jnp.sum(jnp.asarray(grid.weight) * point.pressure[1:-1])) / (0.5 * np.pi)
    if abs(carried - 1.0) > ALIKE:
        raise ValueError(f"restart: a state of another contact: it carries {carried:.6g} times the load of the scene")
    m = mass(scene.fluid(scales), point.pressure, film_shape(point, grid))
    if float(jnp.max(jnp.abs(motion.masses[0] / m - 1.0))) > ALIKE:
        raise ValueError("restart: a state of another contact: contact.compressible, radius or materials differ")

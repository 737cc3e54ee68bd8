"""Batches of the bearings of a system. Bearings of the same family and structure form one stack of scenes, which one
program solves.

Linear bearings have a batch class of their own. Speeds and loads of the scenes' operating points are replaced: the
inner rings turn with the shaft, and the shaft prescribes their displacements.
"""

import abc
import dataclasses
from collections.abc import Sequence
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..bearings.bearing import AbstractBearing
from ..bearings.flanks import on_heavier_flanks
from ..bearings.mounted import running_scene
from ..bearings.operation import HeldDisplacement
from ..bearings.ring import held_ring
from ..bearings.row import AbstractRow, HeldRow, RowState
from ..bearings.solution import RING_FREEDOMS, Solution
from ..numerics.newton import NewtonOptions
from ..numerics.once import once
from ..numerics.safe import largest
from .mounting import LinearBearing
from .scene import Place

_LOADS = ("axial_load", "radial_load", "radial_load_lateral", "moment", "moment_lateral")
_TILTS = ("misalignment", "misalignment_lateral")


def on_shaft(scene: AbstractBearing, speed: Array) -> AbstractBearing:
    """The scene with the speed of the shaft, and with prescribed displacements in place of loads.

    Its ring tilts to first order, with the lever that `rating.tilt` chooses. Settings of a transient run are removed.
    """
    axial = "axial" in scene.modelled_freedoms
    held = HeldDisplacement(axial=0.0 if axial else None, radial=0.0, lateral=0.0)
    changes: dict[str, Any] = {f"operation.{name}": None for name in (*_LOADS, *_TILTS)}
    changes |= {"operation.displacement": held, "operation.inner_speed": speed, "simulation": None}
    return scene.replace(changes)


class AbstractBatch(eqx.Module):
    """Bearings of a system that one program solves. **Arguments:** `places`: their indices in the system."""

    places: eqx.AbstractVar[tuple[int, ...]]

    @property
    def index(self) -> np.ndarray:
        return np.asarray(self.places)

    @abc.abstractmethod
    def rows(self, expansion: Float[Array, " bearing"], at_rest: bool = False) -> AbstractRow | None:
        """Models of the bearings without friction, for the search: the argument of `initial`, `hold` and `force_at`.

        **Arguments:** `expansion`: of all bearings of the system, m; `at_rest`: True to set all speeds to 0.
        """

    @abc.abstractmethod
    def initial(self, rows: AbstractRow | None, displacement: Float[Array, "own 5"]) -> RowState:
        """First guess of the states of the rows."""

    @abc.abstractmethod
    def hold(self, rows: AbstractRow | None, displacement: Float[Array, "own 5"], state: RowState) -> HeldRow:
        """Energy, force and stiffness of each bearing."""

    @abc.abstractmethod
    def force_at(
        self, rows: AbstractRow | None, displacement: Float[Array, "own 5"], state: RowState | None
    ) -> Float[Array, "own 5"]:
        """The forces of `hold` with first derivatives. **Arguments:** `state`: `None` for bearings without elements."""


def spread(batches: tuple[AbstractBatch, ...], parts: list[Array], count: int) -> Array:
    """Joins the arrays of the batches to one array in the order of the bearings, with zeros for those in no batch.

    **Arguments:** `count`: number of all bearings of the system.
    """
    together = jnp.concatenate(parts)
    order = [place for batch in batches for place in batch.places]
    if len(order) < count:
        together = jnp.concatenate([together, jnp.zeros_like(together[:1])])
        order += [place for place in range(count) if place not in order]
    last = together.shape[0] - 1
    return together[jnp.asarray([min(order.index(place), last) for place in range(count)])]


class RollingBatch(AbstractBatch):
    """Bearings with rolling elements: `scene` is a stack of scenes."""

    scene: AbstractBearing
    places: tuple[int, ...] = eqx.field(static=True)

    def rows(self, expansion, at_rest=False):
        scene = self.scene
        if at_rest:
            speeds = lambda bearing: (bearing.operation.inner_speed, bearing.operation.outer_speed)
            scene = eqx.tree_at(speeds, scene, tuple(0.0 * jnp.asarray(speed) for speed in speeds(scene)))

        def row(scene: AbstractBearing, expansion: Array) -> AbstractRow:
            running = running_scene(scene)[0] if scene.thermal is None else dataclasses.replace(scene, thermal=None)
            return running.row(expansion)

        return jax.vmap(row)(scene, expansion[self.index])

    def initial(self, rows, displacement):
        return jax.vmap(lambda row, q: row.initial(q))(rows, displacement)

    def hold(self, rows, displacement, state):
        return jax.vmap(lambda row, q, own: row.hold(q, own))(rows, displacement, state)

    def force_at(self, rows, displacement, state):
        return jax.vmap(lambda row, q, own: row.force_at(q, own))(rows, displacement, state)


class LinearBatch(AbstractBatch):
    """Bearings that are given by their stiffness."""

    stiffness: Float[Array, "own 5 5"]
    places: tuple[int, ...] = eqx.field(static=True)

    def rows(self, expansion, at_rest=False):
        return None

    def initial(self, rows, displacement):
        return RowState(jnp.zeros((len(self.places), 0, 0)))

    def hold(self, rows, displacement, state):
        """Energy, force and stiffness of the symmetric part of the stiffness; the other part has no energy."""
        even = 0.5 * (self.stiffness + jnp.swapaxes(self.stiffness, 1, 2))
        force = jnp.einsum("bij,bj->bi", even, displacement)
        return HeldRow(0.5 * jnp.sum(force * displacement, axis=1), force, even, state)

    def force_at(self, rows, displacement, state):
        return jnp.einsum("bij,bj->bi", self.stiffness, displacement)


@once
def solutions(
    scene: AbstractBearing,
    displacement: Float[Array, "own 5"],
    expansion: Float[Array, " own"],
    options: NewtonOptions,
) -> Solution:
    """Solutions of a stack of bearings at prescribed displacements of their ports.

    A tilt moves the grooves to first order.
    """

    def solution_of(scene: AbstractBearing, displacement: Array, expansion: Array) -> Solution:
        def of_running(running: AbstractBearing) -> Solution:
            zero = jnp.zeros(())
            ring = held_ring(displacement, running.ring_lever, scene.port_distance, zero, expansion)
            return running.solve_ring(options, ring, False)

        return scene.solved_running(of_running)

    return jax.vmap(solution_of)(scene, displacement, expansion)


def batches_of(places: Sequence[Place], speed: Array) -> tuple[AbstractBatch, ...]:
    """Batches of all bearings of a system; bearings of the same structure share a batch."""
    groups: dict[tuple[Any, ...], list[tuple[int, AbstractBearing | LinearBearing]]] = {}
    for index, place in enumerate(places):
        scene = place.scene
        scene = scene if isinstance(scene, LinearBearing) else on_shaft(scene, speed)
        shapes = tuple(np.shape(leaf) for leaf in jax.tree.leaves(scene))
        groups.setdefault((jax.tree.structure(scene), shapes), []).append((index, scene))
    batches: list[AbstractBatch] = []
    for members in groups.values():
        numbers = tuple(index for index, _ in members)
        stacked = jax.tree.map(
            lambda *leaves: jnp.stack([jnp.asarray(leaf) for leaf in leaves]), *(s for _, s in members)
        )
        if isinstance(stacked, LinearBearing):
            batches.append(LinearBatch(stiffness=jnp.asarray(stacked.stiffness), places=numbers))
        else:
            batches.append(RollingBatch(scene=stacked, places=numbers))
    return tuple(batches)


def pressure_centre(scene: AbstractBearing) -> Float[Array, ""]:
    r"""Position of the point where the contact normals of the unloaded bearing meet the axis, measured from the port
    along $e_x$, m: $-\frac{d_m}2 \tan\alpha$, with the contact angle of the drawing. For tapered roller bearings it is
    the normal of the cup through the middles of the rollers. The normal at the middle of the cup's line meets the axis
    farther out, by 2.4 % in the built-in `tapered_example`."""
    return -0.5 * jnp.asarray(scene.geometry.pitch_diameter) * jnp.tan(scene.one_way_angle)


def largest_load(solution: Solution) -> Float[Array, ""]:
    """Largest load on the inner raceway, N."""
    return largest(on_heavier_flanks(solution.elements).load_inner)


FREEDOM_WORDS = dict(zip(RING_FREEDOMS, ("X", "Y", "Z", "the tilt", "the lateral tilt"), strict=True))
"""Freedom -> words for it in the frame of the shaft."""

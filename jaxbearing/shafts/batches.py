"""Batches of the bearings of a system. Bearings of the same family and structure form one stack of scenes, which one
program solves.

Linear bearings have a batch class of their own. Speeds and loads of the scenes' operating points are replaced: the
inner rings turn with the shaft, and the shaft prescribes their displacements.
"""

import abc
import dataclasses
from collections.abc import Sequence
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from ..bearings.bearing import AbstractBearing
from ..bearings.flanks import on_heavier_flanks
from ..bearings.mounted import running_scene
from ..bearings.operation import HeldDisplacement
from ..bearings.ring import ANCHOR, held_ring
from ..bearings.row import AbstractRow, HeldRow, RowState
from ..bearings.solution import RING_FREEDOMS, LaminaLoads, Solution
from ..numerics.newton import NewtonOptions
from ..numerics.once import once
from ..numerics.small_linear import solve_dense
from .mounting import LinearBearing
from .scene import Place

_LOADS = ("axial_load", "radial_load", "radial_load_lateral", "moment", "moment_lateral")
_TILTS = ("misalignment", "misalignment_lateral")
LOAD_STEPS, LOAD_STEP = 4, 1e-5
"""Number of Newton steps of `evenly_loaded` and the longest one, m: the force of line contacts is nearly linear in the
approach."""


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
    """Bearings with rolling elements: `scene` is a stack of scenes.

    The model of rollers that slide has no tilt. `dry` is a stack of the same bearings with dry rollers, whose model has
    one; it gives the effect of the tilt (`acting`). It is `None` if the scenes of the batch have a tilt themselves.
    """

    scene: AbstractBearing
    dry: AbstractBearing | None
    places: tuple[int, ...] = eqx.field(static=True)

    @property
    def ports(self) -> AbstractBearing:
        """The scenes whose model has a tilt."""
        return self.scene if self.dry is None else self.dry

    def rows(self, expansion, at_rest=False):
        scene = self.ports
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
        if not scene.may_tilt:
            displacement = displacement.at[3:].set(0.0)

        def of_running(running: AbstractBearing) -> Solution:
            zero = jnp.zeros(())
            ring = held_ring(displacement, running.ring_lever, scene.port_distance, zero, expansion)
            return running.solve_ring(options, ring, False)

        return scene.solved_running(of_running)

    return jax.vmap(solution_of)(scene, displacement, expansion)


class Acting(NamedTuple):
    """Forces and stiffness of a batch, as in `Port`, and the solutions behind them.

    - `own`: solutions of the scenes of the batch.
    - `tilted`, `even`: solutions of the dry scenes with and without the tilt of the ring; `None` without dry scenes.
    """

    force: Float[Array, "own 5"]
    stiffness: Float[Array, "own 5 5"]
    own: Solution
    tilted: Solution | None
    even: Solution | None

    @property
    def converged(self) -> Bool[Array, ""]:
        """True if all solutions converged."""
        parts = [self.own, self.tilted, self.even]
        return jnp.all(jnp.stack([part.converged for part in parts if part is not None]))


def acting(
    batch: RollingBatch,
    displacement: Float[Array, "own 5"],
    expansion: Float[Array, " own"],
    load: Float[Array, ""],
    options: NewtonOptions,
    when: Bool[Array, ""] | None = None,
) -> Acting:
    r"""Forces and stiffness of a batch at prescribed displacements.

    The model of rollers that slide has no tilt $\tau$. The effect of the tilt is taken from dry rollers whose inner
    raceways are enlarged by the films h: $F = P(q) + T(q, \tau, h) - T(q, 0, h)$, with the force P of the sliding
    rollers and the force T of the dry rollers. Without tilt the force is P. The films are those at a typical `load` of
    a bearing, N; they are not unknowns.
    """
    own = solutions(batch.scene, displacement, expansion, options, when=when)
    if batch.dry is None:
        return Acting(own.force, own.stiffness, own, None, None)
    grown = expansion + jax.vmap(lambda scene: scene.film_growth(load))(batch.scene)
    tilted = solutions(batch.dry, displacement, grown, options, when=when)
    even = solutions(batch.dry, displacement.at[:, 3:].set(0.0), grown, options, when=when)
    return Acting(
        own.force + tilted.force - even.force,
        own.stiffness + tilted.stiffness - even.stiffness.at[:, :, 3:].set(0.0),
        own,
        tilted,
        even,
    )


def evenly_loaded(
    batch: RollingBatch,
    held: Acting,
    displacement: Float[Array, "own 5"],
    expansion: Float[Array, " own"],
    options: NewtonOptions,
    when: Bool[Array, ""],
) -> Solution:
    """Solutions of rollers that slide and carry the radial and lateral force of `acting` evenly along their length.
    Films, cage and losses are those of this load. Newton's iteration finds the radial and lateral displacement; without
    tilt its steps are 0."""

    def better(state: tuple[Array, Solution], _: None) -> tuple[tuple[Array, Solution], None]:
        place, solution = state
        missing = (held.force - solution.force)[:, 1:3]
        stiffness = solution.stiffness[:, 1:3, 1:3] + ANCHOR * jnp.eye(2)[None]
        step = jax.vmap(solve_dense)(stiffness, missing)
        place = place.at[:, 1:3].add(jnp.clip(step, -LOAD_STEP, LOAD_STEP))
        return (place, solutions(batch.scene, place, expansion, options, when=when)), None

    # the body of a loop is compiled once, unrolled steps are compiled one by one
    return jax.lax.scan(better, (displacement, held.own), None, length=LOAD_STEPS)[0][1]


def with_carried_loads(scene: AbstractBearing, held: Acting, solution: Solution) -> Solution:
    """The solution of a bearing with sliding rollers, with the loads that they carry under the tilted ring. The life is
    computed from these loads: the loads of its own model plus the change of the lamina loads of dry rollers by the
    tilt."""
    tilted, even, own = held.tilted, held.even, held.own
    assert tilted is not None
    assert even is not None
    assert tilted.laminae is not None
    parts, count = [], tilted.laminae.inner.shape[-1]
    for side in ("inner", "outer"):
        films = getattr(own.elements, f"load_{side}") - getattr(even.elements, f"load_{side}")
        parts.append(jnp.maximum(getattr(tilted.laminae, side) + films[:, None] / count, 0.0))
    lines = scene.race_lines(solution.elements)
    assert lines is not None
    inner, outer = parts
    most = jnp.stack([jnp.max(part, axis=1) for part in parts]) * count
    pressure = jnp.where(most > 0, lines.hertz_pressure(jnp.where(most > 0, most, 1.0)), 0.0)
    elements = dataclasses.replace(
        solution.elements,
        load_inner=jnp.sum(inner, axis=1),
        load_outer=jnp.sum(outer, axis=1),
        pressure_inner=pressure[0],
        pressure_outer=pressure[1],
    )
    laminae = LaminaLoads(inner, outer, tilted.laminae.profiled)
    return dataclasses.replace(solution, elements=elements, laminae=laminae, force=held.force)


def _dry(scene: AbstractBearing) -> AbstractBearing:
    """A bearing with sliding rollers without contact laws, cage, drag, flange and oil: its dry rollers can tilt."""
    names = [name for name in ("contact", "cage", "drag", "flange", "oil") if getattr(scene, name, None) is not None]
    return dataclasses.replace(scene, **dict.fromkeys(names))


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
            dry = None if stacked.may_tilt else _dry(stacked)
            batches.append(RollingBatch(scene=stacked, dry=dry, places=numbers))
    return tuple(batches)


def pressure_centre(scene: AbstractBearing) -> Float[Array, ""]:
    r"""Position of the point where the contact normals of the unloaded bearing meet the axis, measured from the port
    along $e_x$, m: $-\frac{d_m}2 \tan\alpha$, with the contact angle of the drawing. For tapered roller bearings it is
    the normal of the cup through the middles of the rollers. The normal at the middle of the cup's line meets the axis
    farther out, by 2.4 % in the built-in `tapered_example`."""
    return -0.5 * jnp.asarray(scene.geometry.pitch_diameter) * jnp.tan(scene.one_way_angle)


def largest_load(solution: Solution) -> Float[Array, ""]:
    """Largest load on the inner raceway, N."""
    return jnp.max(on_heavier_flanks(solution.elements).load_inner)


FREEDOM_WORDS = dict(zip(RING_FREEDOMS, ("X", "Y", "Z", "the tilt", "the lateral tilt"), strict=True))
"""Freedom -> words for it in the frame of the shaft."""

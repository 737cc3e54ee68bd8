"""The inner ring of bearings whose elements follow it in all freedoms.

Five freedoms, the loads on those that are unknown, the displacements of the others, and the port: what the ring needs
where it is.

Frame and signs: $e_x$ along the axis, azimuths from the load line towards 90 degrees. `tilt` moves azimuth 0,
`tilt_lateral` azimuth 90 degrees along $+e_x$. Loads are conjugate to displacements: force times displacement, or
moment times tilt, is the work on the ring. Inside the equations every freedom is a length: a tilt is multiplied by a
lever of the family, and a moment divided by it.
"""

import dataclasses
from collections.abc import Callable
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar
from ..numerics.arrow import ArrowJacobian, condensed, schur_complement
from ..numerics.safe import NORM_FLOOR
from .operation import AbstractOperation
from .solution import RING_FREEDOMS, TILTS, RingDisplacement

LENGTH_UNIT = 1e-5
"""Scale of displacements, m."""

ANCHOR = 1e-4
"""Spring that holds what nothing touches, a roller or a ring, where it is, N/m: 1e-12 of a loaded contact's stiffness
in derivatives (a hundred times as much spoils those of rollers that hardly touch by 6e-6), nothing in balances."""


class Port(NamedTuple):
    """Reaction of the inner ring at its place: `force`, the loads on its five freedoms, N and N m; `stiffness`, their
    derivatives by the displacements, everything else in equilibrium, N/m, N/rad, N m/m, N m/rad. Nothing in it is made
    symmetric: with centrifugal forces, couples or friction it is not."""

    force: Float[Array, "5"]
    stiffness: Float[Array, "5 5"]
    free: tuple[str, ...]
    """Freedoms that are unknowns of the solve, under given loads."""


class InnerRing(eqx.Module):
    """Loads and given displacements of the inner ring, as lengths.

    **Arguments:**
    - `load`: on the freedoms that are unknown, N.
    - `held`: displacements of all five, m; 0 where they are unknown.
    - `lever`: length that a tilt is multiplied by, m.
    - `freedoms`: names of the unknown ones, in the order of `RING_FREEDOMS`.
    - `expansion`: growth of the inner raceway's radius less that of the outer one, m; `None`: none.
    - `distance`: of the point of the ring whose displacements these are, from the one that is shown, along $+e_x$, m;
      `None`: it is the same point.
    - `closure`: part of the axial displacement that is not shown, m; `None`: none.
    - `held_load`: size of the load that the given displacements ask for, N, about: a scale; `None`: not needed.
    - `asks`: whether the loads leave open what the given displacements ask for.
    """

    load: Float[Array, " freedom"]
    held: Float[Array, "5"]
    lever: Float[Array, ""]
    freedoms: tuple[str, ...] = eqx.field(static=True)
    expansion: Float[Array, ""] | None = None
    distance: Float[Array, ""] | None = None
    closure: Float[Array, ""] | None = None
    held_load: Float[Array, ""] | None = None
    asks: bool = eqx.field(static=True, default=False)

    @property
    def places(self) -> np.ndarray:
        """Places of the unknown freedoms among `RING_FREEDOMS`."""
        return np.asarray([RING_FREEDOMS.index(name) for name in self.freedoms], int)

    @property
    def units(self) -> Float[Array, "5"]:
        """Displacement in m or rad for 1 m of each length."""
        return 1.0 / _levers(self.lever)

    def moved(self, shift: Float[Array, "freedom ..."]) -> Float[Array, "5 ..."]:
        """All five displacements as lengths, m, from the unknown ones in units of `LENGTH_UNIT`."""
        held = self.held.reshape((5,) + (1,) * (shift.ndim - 1))
        return jnp.broadcast_to(held, (5, *shift.shape[1:])).at[self.places].set(LENGTH_UNIT * shift)

    def of_unknown(self, every: Float[Array, "5 ..."]) -> Float[Array, "freedom ..."]:
        """The rows of the unknown freedoms."""
        return every[self.places]

    def of_each(self, value: Callable[[str], Scalar]) -> Float[Array, " freedom"]:
        """A number for each unknown freedom, by its name."""
        numbers = [jnp.asarray(value(name), dtype=float) for name in self.freedoms]
        return jnp.stack(numbers) if numbers else jnp.zeros(0)

    def across(self) -> Float[Array, " freedom"]:
        """Direction of the load across the axis, in the unknown freedoms; 0 where there is none."""
        load = jnp.where(np.asarray([name in ("radial", "lateral") for name in self.freedoms], bool), self.load, 0.0)
        square = jnp.sum(jnp.square(load))
        return load / jnp.sqrt(jnp.where(square > 0, square, 1.0))

    def displacement(self, globals_: Float[Array, " g"]) -> RingDisplacement:
        """The displacement that is shown, m and rad, from the global unknowns, whose first ones are those of the
        ring."""
        every = self.moved(globals_[: len(self.freedoms)]) * self.units
        if self.closure is not None:
            every = every.at[0].add(-self.closure)
        if self.distance is not None:
            every = shift_matrix(-self.distance) @ every
        return RingDisplacement(**dict(zip(RING_FREEDOMS, every, strict=True)))

    def under(self, load: Float[Array, " freedom"]) -> "InnerRing":
        """The same ring under another load, N."""
        return dataclasses.replace(self, load=load)

    def asking(self, load: Float[Array, ""]) -> "InnerRing":
        """The same ring, whose given displacements ask for about this load, N."""
        return dataclasses.replace(self, held_load=jax.lax.stop_gradient(load))

    def size(self) -> Float[Array, ""]:
        """The size of the load on the ring, given or made by what it is held at, N."""
        if len(self.freedoms) == 1:
            size = jnp.abs(self.load[0])
        else:
            size = jnp.sqrt(jnp.sum(jnp.square(self.load)) + NORM_FLOOR**2)
        return size if self.held_load is None else size + self.held_load

    def equation_names(self) -> tuple[str, ...]:
        return tuple(f"{name} load balance of the ring" for name in self.freedoms)

    def released(self, size: Float[Array, ""]) -> "InnerRing":
        """The ring with all five freedoms unknown, under a load of this size, N, which scales the equations."""
        load, held = jnp.full(5, size / jnp.sqrt(5.0)), jnp.zeros(5)
        return dataclasses.replace(self, load=load, held=held, freedoms=RING_FREEDOMS, held_load=None, asks=False)

    def released_unknowns(self, globals_: Float[Array, " g"]) -> Float[Array, " g5"]:
        """The global unknowns of the `released` ring where this one has `globals_`."""
        count = len(self.freedoms)
        return jnp.concatenate([self.moved(globals_[:count]) / LENGTH_UNIT, globals_[count:]])

    def port(
        self, jacobian: ArrowJacobian, force: Float[Array, "5"], scale: Float[Array, ""], free: tuple[str, ...]
    ) -> Port:
        """The port of a `released` ring, at the point that is shown.

        **Arguments:** `jacobian`: with the ring's freedoms first among the globals, of residuals that are forces over
        `scale`, N; `force`: what the elements ask of every freedom, N; `free`: of `Port`.
        """
        arm = _levers(self.lever)
        stiffness = condensed(schur_complement(jacobian), 5) * (scale / LENGTH_UNIT) * arm[:, None] * arm[None, :]
        force = force * arm
        if self.distance is not None:
            shift = shift_matrix(self.distance)
            force, stiffness = shift.T @ force, shift.T @ stiffness @ shift
        return Port(force, stiffness, free)


def _levers(lever: Float[Array, ""]) -> Float[Array, "5"]:
    """Factors that make each of `RING_FREEDOMS` a length."""
    return jnp.stack([lever if name in TILTS else jnp.ones(()) for name in RING_FREEDOMS])


def shift_matrix(distance: Array) -> Float[Array, "5 5"]:
    r"""T(s) with $q(s) = T(s)q(0)$: the displacements of the point of the ring that lies `distance` s further along
    $+e_x$, m. The axis has the slopes -tilt and -tilt_lateral. Loads go back by the transpose, $f(0) = T^Tf(s)$."""
    return jnp.eye(5).at[jnp.asarray([1, 2]), jnp.asarray([3, 4])].set(-distance)


def held_ring(
    displacement: Float[Array, "5"], lever: Array, distance: Array, closure: Array, expansion: Array
) -> InnerRing:
    """A ring that is held in all freedoms.

    **Arguments:** `displacement`, m and rad, of the point that is shown; the others are those of `InnerRing`.
    """
    lever = jnp.asarray(lever)
    held = (shift_matrix(distance) @ displacement).at[0].add(closure) * _levers(lever)
    return InnerRing(jnp.zeros(0), held, lever, (), expansion, distance, closure, asks=True)


def inner_ring(operation: AbstractOperation, freedoms: tuple[str, ...], lever: Array) -> InnerRing:
    """The ring of an operating point: held where a displacement is given, and at 0 where neither is.

    **Arguments:** `operation`: of any family; `freedoms`: those that are unknown; `lever`: of `InnerRing`, m.
    """
    lever = jnp.asarray(lever)
    number = lambda value: jnp.zeros(()) if value is None else jnp.asarray(value)
    levers: dict[str, Array] = dict(zip(RING_FREEDOMS, _levers(lever), strict=True))
    load = [number(operation.load(name)) / levers[name] for name in freedoms]
    held = jnp.zeros(5)
    for place, name in enumerate(RING_FREEDOMS):
        given = operation.held_at(name)
        if given is not None:
            held = held.at[place].set(given * levers[name])
    asks = operation.displaced or not freedoms
    return InnerRing(jnp.stack(load) if load else jnp.zeros(0), held, lever, freedoms, asks=asks)

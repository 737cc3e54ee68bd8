"""The inner ring as every family sees it: five freedoms, the loads on those that are unknown, the displacements of the
others, and what the ring needs where it is (its reaction and stiffness).

Frame and signs ([arrangements, section 1]): $e_x$ along the axis, azimuths from the load line towards $e_t$ at 90
degrees. `tilt` moves azimuth 0, `tilt_lateral` azimuth 90 degrees along $+e_x$. Loads are conjugate to displacements:
force times displacement, or moment times tilt, is the work on the ring. Inside the equations every freedom is a length:
a tilt is multiplied by a lever of the family, and a moment divided by it.
"""

import dataclasses
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..numerics.arrow import ArrowJacobian, condensed, schur_complement
from .solution import RING_FREEDOMS, RingDisplacement

LENGTH_UNIT = 1e-5
"""Scale of displacements, m."""
TILTS = ("tilt", "tilt_lateral")
"""Those of `RING_FREEDOMS` that are angles."""
_LOADS = {
    "axial": "axial_load",
    "radial": "radial_load",
    "lateral": "radial_load_lateral",
    "tilt": "moment",
    "tilt_lateral": "moment_lateral",
}
"""Freedom -> the field of an operating point that holds its load."""
_TILT_FIELDS = {"tilt": "misalignment", "tilt_lateral": "misalignment_lateral"}
"""Freedom -> the field of an operating point that holds its given value."""


class Port(NamedTuple):
    """What the inner ring needs where it is: `force`, the loads on its five freedoms, N and N m; `stiffness`, their
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
    - `held_load`: size of the load that the given displacements ask for, N, about: a scale; `None`: not needed.
    """

    load: Float[Array, " freedom"]
    held: Float[Array, "5"]
    lever: Float[Array, ""]
    freedoms: tuple[str, ...] = eqx.field(static=True)
    expansion: Float[Array, ""] | None = None
    held_load: Float[Array, ""] | None = None

    @property
    def places(self) -> tuple[int, ...]:
        """Places of the unknown freedoms among `RING_FREEDOMS`."""
        return tuple(RING_FREEDOMS.index(name) for name in self.freedoms)

    @property
    def units(self) -> Float[Array, "5"]:
        """Displacement in m or rad for 1 m of each length."""
        tilt = 1.0 / self.lever
        return jnp.stack([tilt if name in TILTS else jnp.ones(()) for name in RING_FREEDOMS])

    def moved(self, shift: Float[Array, "freedom ..."]) -> Float[Array, "5 ..."]:
        """All five displacements as lengths, m, from the unknown ones in units of `LENGTH_UNIT`."""
        held = self.held.reshape((5,) + (1,) * (shift.ndim - 1))
        return jnp.broadcast_to(held, (5, *shift.shape[1:])).at[np.asarray(self.places, int)].set(LENGTH_UNIT * shift)

    def of_unknown(self, every: Float[Array, "5 ..."]) -> Float[Array, "freedom ..."]:
        """The rows of the unknown freedoms."""
        return every[np.asarray(self.places, int)]

    def displacement(self, globals_: Float[Array, " g"]) -> RingDisplacement:
        """The displacement of the ring, m and rad, from the global unknowns, whose first ones are those of the ring."""
        every = self.moved(globals_[: len(self.freedoms)]) * self.units
        return RingDisplacement(**dict(zip(RING_FREEDOMS, every, strict=True)))

    def of_each(self, value: Callable[[str], Any]) -> Float[Array, " freedom"]:
        """A number for each unknown freedom, by its name."""
        numbers = [jnp.asarray(value(name), dtype=float) for name in self.freedoms]
        return jnp.stack(numbers) if numbers else jnp.zeros(0)

    def asking(self, load: Float[Array, ""]) -> "InnerRing":
        """The same ring, whose given displacements ask for about this load, N."""
        return dataclasses.replace(self, held_load=jax.lax.stop_gradient(load))

    def under(self, load: Float[Array, " freedom"]) -> "InnerRing":
        """The same ring under another load, N."""
        return dataclasses.replace(self, load=load)

    def size(self) -> Float[Array, ""]:
        """The size of the load on the ring, given or made by what it is held at, N."""
        size = jnp.sqrt(jnp.sum(jnp.square(self.load)))
        return size if self.held_load is None else size + self.held_load

    def equation_names(self) -> tuple[str, ...]:
        return tuple(f"{name} load balance of the ring" for name in self.freedoms)

    def released(self, size: Float[Array, ""]) -> "InnerRing":
        """The ring with all five freedoms unknown, under a load of this size, N, which scales the equations."""
        load, held = jnp.full(5, size / jnp.sqrt(5.0)), jnp.zeros(5)
        return InnerRing(load, held, self.lever, RING_FREEDOMS, self.expansion)

    def port(
        self, jacobian: ArrowJacobian, force: Float[Array, "5"], scale: Float[Array, ""], free: tuple[str, ...]
    ) -> "Port":
        """The port of a `released` ring.

        **Arguments:** `jacobian`: with the ring's freedoms first among the globals, of residuals that are forces over
        `scale`, N; `force`: what the elements ask of every freedom, N; `free`: of `Port`.
        """
        stiffness = condensed(schur_complement(jacobian), 5)
        arm = 1.0 / self.units
        return Port(force * arm, stiffness * (scale / LENGTH_UNIT) * arm[:, None] * arm[None, :], free)

    def released_unknowns(self, globals_: Float[Array, " g"]) -> Float[Array, " g5"]:
        """The global unknowns of the `released` ring where this one has `globals_`."""
        count = len(self.freedoms)
        return jnp.concatenate([self.moved(globals_[:count]) / LENGTH_UNIT, globals_[count:]])


def held_ring(displacement: Float[Array, "5"], lever: Array, expansion: Array | None = None) -> InnerRing:
    """A ring that is held in all freedoms; `displacement`, m and rad."""
    unit = jnp.stack([lever if name in TILTS else jnp.ones(()) for name in RING_FREEDOMS])
    return InnerRing(jnp.zeros(0), displacement * unit, jnp.asarray(lever), (), expansion)


def shift_matrix(distance: Array) -> Float[Array, "5 5"]:
    r"""T(s) with $q(s) = T(s)q(0)$: the displacements of the point of the ring that lies `distance` s further along
    $+e_x$, m. Loads go back by the transpose, $f(0) = T^Tf(s)$ ([arrangements, section 1])."""
    return jnp.eye(5).at[jnp.asarray([1, 2]), jnp.asarray([3, 4])].set(-distance)


def inner_ring(operation: Any, freedoms: tuple[str, ...], lever: Array) -> InnerRing:
    """The ring of an operating point.

    **Arguments:** `operation`: of any family; `freedoms`: those that are unknown; `lever`: see `InnerRing`, m.
    """
    unit = {name: lever if name in TILTS else jnp.ones(()) for name in RING_FREEDOMS}
    load = [_number(getattr(operation, _LOADS[name], None)) / unit[name] for name in freedoms]
    held = [
        jnp.zeros(()) if name in freedoms else given_displacement(operation, name) * unit[name]
        for name in RING_FREEDOMS
    ]
    return InnerRing(jnp.stack(load) if load else jnp.zeros(0), jnp.stack(held), jnp.asarray(lever), freedoms)


def given_displacement(operation: Any, name: str) -> Array:
    """The displacement at which an operating point holds a freedom that is not unknown, m or rad; 0: not said."""
    if name in TILTS:
        return _number(getattr(operation, _TILT_FIELDS[name], None))
    given = getattr(operation, "displacement", None)
    return _number(None if given is None else getattr(given, name))


def _number(value: Any) -> Array:
    return jnp.asarray(0.0 if value is None else value)

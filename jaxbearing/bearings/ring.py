"""The inner ring of a bearing: its five degrees of freedom (in code: freedoms), its given loads and displacements, and
its port.

Each unknown degree of freedom has a load, 0 if none is given. Each other degree of freedom is *held* at a displacement,
0 if none is given; a ring is held if all its degrees of freedom are held. The *port* is the point of the ring at which
loads and displacements are exchanged with a shaft. A *family* is a kind of bearing: ball, cylindrical roller, tapered
roller. The *reference point* is the point whose displacements the results show: the port if a shaft holds the ring,
otherwise the point for which the family writes its equations. The class `Port` holds the load that keeps the ring at a
displacement, and the derivatives of that load. This load acts at the reference point. It is equal and opposite to the
force of the rolling elements on the ring.

Frame and signs: $e_x$ points along the axis. Azimuth 0 is the load line (radial direction), and azimuth 90 degrees is
the lateral direction; axis, radial and lateral direction form a right-handed frame. A positive `tilt` moves the ring
along $+e_x$ at azimuth 0, a positive `tilt_lateral` at azimuth 90 degrees. Loads are conjugate to displacements: force
times displacement, or moment times tilt, is the work on the ring. Inside the equations every displacement is a length:
a tilt is multiplied by a reference length of the family, the lever, and a moment is divided by it.
"""

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

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

if TYPE_CHECKING:
    from .bearing import AbstractBearing
else:
    AbstractBearing = Any

LENGTH_UNIT = 1e-5
"""Scale of displacements, m."""

ANCHOR = 1e-4
"""Artificial stiffness of a roller or a ring without contact, N/m. It appears only in derivatives, never in balances.
The systems of the families add it (`convex.anchored`). It is 1e-12 of the stiffness of a loaded contact; 100 times as
much would change derivatives of barely loaded rollers by 6e-6 of their value."""

LOAD_FLOOR = 1e-3
"""Smallest scale of the loads, N, added in squares."""


class Port(NamedTuple):
    """The load that keeps the inner ring at a displacement, and its derivatives. It acts at the reference point of the
    results (see the module), which is the port only if a shaft holds the ring.

    - `force`: loads on its five degrees of freedom that balance the forces of the rolling elements, N and N m.
    - `stiffness`: derivatives of `force` with respect to the displacements, with all else in equilibrium, N/m, N/rad,
      N m/m and N m/rad. Centrifugal forces, gyroscopic couples and friction make it unsymmetric.
    """

    force: Float[Array, "5"]
    stiffness: Float[Array, "5 5"]
    free: tuple[str, ...]
    """Names of the degrees of freedom that are unknowns of the solve, under given loads; none if the ring is held."""


class InnerRing(eqx.Module):
    """Loads and given displacements of the inner ring. Tilts are kept as lengths, moments as forces.

    **Arguments:**
    - `load`: loads on the unknown degrees of freedom, N.
    - `held`: displacements of all five degrees of freedom, m; 0 for the unknown ones.
    - `lever`: length by which a tilt is multiplied, m.
    - `freedoms`: names of the unknown degrees of freedom, in the order of `RING_FREEDOMS`.
    - `expansion`: expansion of the inner raceway's radius less that of the outer one, m; `None` if there is none.
    - `distance`: axial distance from the reference point of the results to the point whose displacements are used here,
      m; `None` if they are the same point.
    - `closure`: axial displacement that mounting has given the ring, m, of a bearing that is preloaded or adjusted. The
      contacts feel it, and the results leave it out. `None` if there is none.
    - `held_load`: estimate of the load that the given displacements cause, N. It only scales the equations. `None` if
      it is not needed.
    - `needs_held_load`: True if `held_load` is needed, because the given displacements cause loads whose size cannot be
      estimated from the given loads.
    """

    load: Float[Array, " freedom"]
    held: Float[Array, "5"]
    lever: Float[Array, ""]
    freedoms: tuple[str, ...] = eqx.field(static=True)
    expansion: Float[Array, ""] | None = None
    distance: Float[Array, ""] | None = None
    closure: Float[Array, ""] | None = None
    held_load: Float[Array, ""] | None = None
    needs_held_load: bool = eqx.field(static=True, default=False)

    @property
    def places(self) -> np.ndarray:
        """Indices of the unknown degrees of freedom in `RING_FREEDOMS`."""
        return np.asarray([RING_FREEDOMS.index(name) for name in self.freedoms], int)

    @property
    def units(self) -> Float[Array, "5"]:
        """Factors that convert the five lengths to m and rad."""
        return 1.0 / levers(self.lever)

    def moved(self, shift: Float[Array, "freedom ..."]) -> Float[Array, "5 ..."]:
        """The five displacements as lengths, m; `shift` holds the unknown ones in units of `LENGTH_UNIT`."""
        held = self.held.reshape((5,) + (1,) * (shift.ndim - 1))
        return jnp.broadcast_to(held, (5, *shift.shape[1:])).at[self.places].set(LENGTH_UNIT * shift)

    def of_unknown(self, every: Float[Array, "5 ..."]) -> Float[Array, "freedom ..."]:
        """Selects the rows of the unknown degrees of freedom from an array with a row for each of the five."""
        return every if self.freedoms == RING_FREEDOMS else every[self.places]

    def of_each(self, value: Callable[[str], Scalar]) -> Float[Array, " freedom"]:
        """Evaluates `value(name)` for each unknown degree of freedom."""
        numbers = [jnp.asarray(value(name), dtype=float) for name in self.freedoms]
        return jnp.stack(numbers) if numbers else jnp.zeros(0)

    def across(self) -> Float[Array, " freedom"]:
        """Unit vector of the load perpendicular to the axis, with a component for each unknown degree of freedom; 0 if
        there is no such load."""
        load = jnp.where(np.asarray([name in ("radial", "lateral") for name in self.freedoms], bool), self.load, 0.0)
        square = jnp.sum(jnp.square(load))
        return load / jnp.sqrt(jnp.where(square > 0, square, 1.0))

    def displacement(self, globals_: Float[Array, " g"]) -> RingDisplacement:
        """Displacement of the ring for the results, m and rad.

        **Arguments:** `globals_`: the unknowns that belong to no single rolling element; those of the ring come first.
        """
        every = self.moved(globals_[: len(self.freedoms)]) * self.units
        if self.closure is not None:
            every = every.at[0].add(-self.closure)
        if self.distance is not None:
            every = shift_matrix(-self.distance) @ every
        return RingDisplacement(**dict(zip(RING_FREEDOMS, every, strict=True)))

    def under(self, load: Float[Array, " freedom"]) -> "InnerRing":
        """The same ring under another load, N."""
        return dataclasses.replace(self, load=load)

    def with_held_load(self, load: Float[Array, ""]) -> "InnerRing":
        """The same ring with an estimate of the load that its given displacements cause, N. No derivatives pass through
        this estimate."""
        return dataclasses.replace(self, held_load=jax.lax.stop_gradient(load))

    def size(self) -> Float[Array, ""]:
        """Magnitude of the load on the ring, N: that of the given loads plus the estimate `held_load` for the given
        displacements."""
        if len(self.freedoms) == 1:
            size = jnp.abs(self.load[0])
        else:
            size = jnp.sqrt(jnp.sum(jnp.square(self.load)) + NORM_FLOOR**2)
        return size if self.held_load is None else size + self.held_load

    def scale(self) -> Float[Array, ""]:
        """Scale of the ring's balances, N: `size`, but not 0 without load."""
        return jnp.sqrt(jnp.square(self.size()) + LOAD_FLOOR**2)

    def equation_names(self) -> tuple[str, ...]:
        """Names of the equations of the unknown degrees of freedom, for messages."""
        return tuple(f"{name} load balance of the ring" for name in self.freedoms)

    def released(self, size: Float[Array, ""]) -> "InnerRing":
        """The ring with all five degrees of freedom unknown, under a load of this size, N, which only scales the
        equations."""
        load, held = jnp.full(5, size / jnp.sqrt(5.0)), jnp.zeros(5)
        return dataclasses.replace(
            self, load=load, held=held, freedoms=RING_FREEDOMS, held_load=None, needs_held_load=False
        )

    def released_unknowns(self, globals_: Float[Array, " g"]) -> Float[Array, " g5"]:
        """The global unknowns of the `released` ring for the unknowns `globals_` of this one."""
        count = len(self.freedoms)
        return jnp.concatenate([self.moved(globals_[:count]) / LENGTH_UNIT, globals_[count:]])

    def port(
        self, jacobian: ArrowJacobian, force: Float[Array, "5"], scale: Float[Array, ""], free: tuple[str, ...]
    ) -> Port:
        """Load and stiffness of a `released` ring, at the reference point of the results.

        **Arguments:**
        - `jacobian`: Jacobian of residuals that are forces over `scale`; the ring's degrees of freedom are the first
          globals.
        - `force`: loads on the five degrees of freedom that balance the rolling elements, N.
        - `scale`: force by which the residuals were divided, N.
        - `free`: see `Port`.
        """
        arm = levers(self.lever)
        stiffness = condensed(schur_complement(jacobian), 5) * (scale / LENGTH_UNIT) * arm[:, None] * arm[None, :]
        force = force * arm
        if self.distance is not None:
            shift = shift_matrix(self.distance)
            force, stiffness = shift.T @ force, shift.T @ stiffness @ shift
        return Port(force, stiffness, free)


def levers(lever: Float[Array, ""]) -> Float[Array, "5"]:
    """Factors that turn each of `RING_FREEDOMS` into a length."""
    return jnp.stack([lever if name in TILTS else jnp.ones(()) for name in RING_FREEDOMS])


def shift_matrix(distance: Array) -> Float[Array, "5 5"]:
    r"""Matrix T(s) in $q(s) = T(s)q(0)$, with s = `distance`, m. q(s) are the displacements of the point of the ring at
    the distance s along $+e_x$. A tilt moves this point by -s times the tilt in the radial direction; `tilt_lateral`
    does the same in the lateral direction. Loads transform with the transpose, $f(0) = T^Tf(s)$."""
    return jnp.eye(5).at[jnp.asarray([1, 2]), jnp.asarray([3, 4])].set(-distance)


def held_ring(
    displacement: Float[Array, "5"], lever: Array, distance: Array, closure: Array, expansion: Array
) -> InnerRing:
    """A ring that is held in all degrees of freedom.

    **Arguments:** `displacement`: displacements of the port, m and rad. For the other arguments see `InnerRing`.
    """
    lever = jnp.asarray(lever)
    held = (shift_matrix(distance) @ displacement).at[0].add(closure) * levers(lever)
    return InnerRing(jnp.zeros(0), held, lever, (), expansion, distance, closure, needs_held_load=True)


def inner_ring(scene: AbstractBearing, lever: Array, freedoms: tuple[str, ...] | None = None) -> InnerRing:
    """The ring of a scene, under the loads of its operating point. An unknown degree of freedom without a given load
    has the load 0. Each other one is held at its given displacement, by default 0.

    **Arguments:** `lever`: see `InnerRing`, m; `freedoms`: unknown degrees of freedom, by default those of the scene.
    """
    operation: AbstractOperation = scene.operation
    freedoms, lever = scene.unknown_freedoms if freedoms is None else freedoms, jnp.asarray(lever)
    number = lambda value: jnp.zeros(()) if value is None else jnp.asarray(value)
    by_name: dict[str, Array] = dict(zip(RING_FREEDOMS, levers(lever), strict=True))
    load = [number(operation.load(name)) / by_name[name] for name in freedoms]
    held = jnp.zeros(5)
    for place, name in enumerate(RING_FREEDOMS):
        displacement = operation.held_at(name)
        if displacement is not None:
            held = held.at[place].set(displacement * by_name[name])
    needs = operation.displaced or not freedoms
    return InnerRing(jnp.stack(load) if load else jnp.zeros(0), held, lever, freedoms, needs_held_load=needs)

r"""Equations of equilibrium of a shaft, its outer rings and its springs.

The unknowns z are

- the displacement $u_0$ of the shaft's point x = 0,
- the forces s of the bearings on the shaft,
- the displacements o of the outer rings, if their supports are elastic,
- the displacement y of the outer rings that a spring presses, for each spring.

The displacement of the shaft is $w = Tu_0 + Cs + w_e$, with its `compliance` C and its bending $w_e$ under given loads
and weight. The displacement of an inner ring relative to its outer ring is $q = Az + a$ in the frame of the bearing.
With the mirror R and the closure c it is $q_b = R_b(w_b - o_b) + (c_b + y)e_x$. The loads f that hold the inner rings
obey

$$\sum T^TRf = F_0,\quad s + Rf = 0,\quad Ho - Rf = 0,\quad ky + \sum f_x = F_s.$$

If the second row is multiplied by C, the rows are the gradient of $\Pi = \frac12s^TCs + \frac12o^THo + \frac12ky^2 -
F_sy - F_0u_0 + \sum W_b(q_b)$. It is convex if every bearing has a convex energy W. C may be singular, so rigid shafts,
bearings at the same position and bearings at x = 0 need no special treatment.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax.scipy.linalg import block_diag
from jaxtyping import Array, Float

from ..numerics import lapack
from ..numerics.once import once
from .beam import Beam, beam_of, gravity_along, shifts
from .forces import AbstractForce, ActingForce
from .mounting import Support
from .scene import Place, ShaftSystem

SOFTENING = 1e8
"""Stiffness by which unknown forces are divided to become lengths, N/m. It only scales the linear algebra."""


class Balance(eqx.Module):
    """Matrices of the equations of the module.

    - `attach`, `offset`: A and a of the displacements $q = Az + a$, m and rad.
    - `linear`, `left`, `load`: the residual is `linear` z + `left` f - `load`, N and N m.
    """

    attach: Float[Array, "port unknown"]
    offset: Float[Array, " port"]
    left: Float[Array, "unknown port"]
    linear: Float[Array, "unknown unknown"]
    load: Float[Array, " unknown"]
    energy: Float[Array, "unknown unknown"]
    """Matrix that turns the residual into the gradient of the potential: C in the rows of s, else the identity."""
    span: Float[Array, ""]
    """Length by which tilts are multiplied, m."""
    force_scale: Float[Array, ""]
    """Norm of the given loads, the weight and the spring forces, N; at least 1 N."""
    springs: int = eqx.field(static=True)
    supported: bool = eqx.field(static=True)

    @property
    def count(self) -> int:
        """Number of bearings."""
        return self.offset.shape[0] // 5

    def displacements(self, unknowns: Float[Array, " unknown"]) -> Float[Array, "bearing 5"]:
        """Displacement of each inner ring relative to its outer ring at the port, closure included, m and rad."""
        return (self.attach @ unknowns + self.offset).reshape(self.count, 5)

    def residual(self, unknowns: Float[Array, " unknown"], force: Float[Array, "bearing 5"]) -> Array:
        """Loads that are not balanced, N and N m."""
        return self.linear @ unknowns - self.load + self.left @ force.ravel()

    def potential(self, unknowns: Float[Array, " unknown"], energies: Float[Array, " bearing"]) -> Array:
        """Potential energy, J. **Arguments:** `energies`: energy of each bearing, J."""
        own = self.energy @ (0.5 * self.linear @ unknowns - self.load)
        return unknowns @ own + jnp.sum(energies)

    def slope(self, step: Float[Array, " unknown"], residual: Float[Array, " unknown"]) -> Array:
        """Derivative of the potential along a step."""
        return step @ (self.energy @ residual)

    def inverse(self, stiffness: Float[Array, "bearing 5 5"]) -> Float[Array, "unknown unknown"]:
        """Inverse of the Jacobian of the residual. **Arguments:** `stiffness`: of each bearing in its own frame."""
        return _inverse(self, stiffness)

    def lengths(self) -> Float[Array, "5"]:
        """Factors that turn the five degrees of freedom into lengths."""
        return jnp.stack([jnp.ones(()), jnp.ones(()), jnp.ones(()), self.span, self.span])

    def row_units(self) -> Float[Array, " unknown"]:
        """Factors that turn the residuals into forces."""
        sets = (len(self.load) - self.springs) // 5
        return jnp.concatenate([jnp.tile(1.0 / self.lengths(), sets), jnp.ones(self.springs)])

    def column_units(self) -> Float[Array, " unknown"]:
        """Factors that turn the scaled unknowns, which are lengths, into the unknowns."""
        length, more = self.lengths(), self.count if self.supported else 0
        parts = [1.0 / length, jnp.tile(SOFTENING * length, self.count), jnp.tile(1.0 / length, more)]
        return jnp.concatenate([*parts, jnp.ones(self.springs)])

    def parts(self, unknowns: Float[Array, " unknown"]) -> "Parts":
        """The unknowns, split by their meaning."""
        n = self.count
        outer = unknowns[5 + 5 * n : 5 + 10 * n].reshape(n, 5) if self.supported else jnp.zeros((n, 5))
        end = len(unknowns) - self.springs
        return Parts(unknowns[:5], unknowns[5 : 5 + 5 * n].reshape(n, 5), outer, unknowns[end:])


@once
def _inverse(balance: Balance, stiffness: Array) -> Array:
    rows, columns = balance.row_units(), balance.column_units()
    coupled = jnp.einsum("bij,bjz->biz", stiffness, balance.attach.reshape(balance.count, 5, -1))
    matrix = balance.linear + balance.left @ coupled.reshape(5 * balance.count, -1)
    scaled = lapack.inverse(matrix * rows[:, None] * columns[None, :])
    return columns[:, None] * scaled * rows[None, :]


class Parts(NamedTuple):
    """Unknowns of the equations, in the frame of the shaft.

    - `origin`: displacement of the shaft's point x = 0, m and rad.
    - `forces`: forces of the bearings on the shaft, N and N m.
    - `outer`: displacements of the outer rings, m and rad.
    - `springs`: displacements of the rings that springs press, m; closing is positive.
    """

    origin: Float[Array, "5"]
    forces: Float[Array, "bearing 5"]
    outer: Float[Array, "bearing 5"]
    springs: Float[Array, " spring"]


class Spring(NamedTuple):
    """Springs that press outer rings.

    **Arguments:** `stiffness`: N/m; `force`: force without displacement, N; `places`: indices of the bearings whose
    outer rings are pressed.
    """

    stiffness: Array
    force: Array
    places: tuple[int, ...]


class Given(NamedTuple):
    """Given forces on a shaft: their positions, m, loads, N and N m, and torques, N m."""

    position: Float[Array, " force"]
    load: Float[Array, "force 5"]
    torque: Float[Array, " force"]


def given_forces(system: ShaftSystem) -> Given:
    """The given forces on the shaft. The torque of a force with `balances` makes all torques add up to 0."""
    forces: tuple[AbstractForce, ...] = system.forces
    if not forces:
        return Given(jnp.zeros(0), jnp.zeros((0, 5)), jnp.zeros(0))
    torques = [force.torque_given for force in forces]
    others = sum((t for force, t in zip(forces, torques, strict=True) if not force.balances), jnp.zeros(()))
    torques = [-others if force.balances else t for force, t in zip(forces, torques, strict=True)]
    gravity = gravity_along(system.shaft.gravity)
    acting: list[ActingForce] = [force.acting(t, gravity) for force, t in zip(forces, torques, strict=True)]
    position = jnp.stack([jnp.asarray(force.position, dtype=float) for force in forces])
    return Given(position, jnp.stack([force.load for force in acting]), jnp.stack([force.torque for force in acting]))


class Axis(NamedTuple):
    """The shaft and all that acts on it except its bearings."""

    beam: Beam | None
    given: Given

    def moved(
        self,
        at: Float[Array, " place"],
        origin: Float[Array, "5"],
        position: Float[Array, " bearing"],
        forces: Float[Array, "bearing 5"],
    ) -> Float[Array, "place 5"]:
        """Displacements of the shaft at the positions `at`, m and rad.

        **Arguments:** `at`: m; `origin`, `forces`: as in `Parts`; `position`: positions of the bearings, m.
        """
        displacement = jnp.einsum("pij,j->pi", shifts(at), origin) + self.bent_by_loads(at)
        if self.beam is None:
            return displacement
        return displacement + jnp.einsum("pbij,bj->pi", self.beam.compliance(at, position), forces)

    def bent_by_loads(self, at: Float[Array, " place"]) -> Float[Array, "place 5"]:
        """Displacements of the shaft under given forces and its weight if it is clamped at x = 0."""
        if self.beam is None:
            return jnp.zeros((at.shape[0], 5))
        bent = self.beam.sagging(at)
        if not self.given.position.size:
            return bent
        return bent + jnp.einsum("pkij,kj->pi", self.beam.compliance(at, self.given.position), self.given.load)

    def total(self) -> Float[Array, "5"]:
        """Given forces and weight, reduced to the point x = 0, N and N m."""
        total = jnp.einsum("kij,ki->j", shifts(self.given.position), self.given.load) if len(self.given.load) else 0.0
        weight = jnp.zeros(5) if self.beam is None else self.beam.weight_at(jnp.zeros(()))
        return total + weight


def axis_of(system: ShaftSystem) -> Axis:
    return Axis(beam_of(system.shaft), given_forces(system))


def support_matrix(support: Support | None) -> tuple[Float[Array, "5 5"], np.ndarray]:
    """Stiffness of the support of an outer ring, and a mask of its elastic degrees of freedom. Rigid ones have 1 on the
    diagonal."""
    if support is None:
        return jnp.eye(5), np.zeros(5, bool)
    if support.matrix is not None:
        return jnp.asarray(support.matrix), np.ones(5, bool)
    each = (support.axial, support.radial, support.radial, support.tilt, support.tilt)
    elastic = np.asarray([stiffness is not None for stiffness in each])
    return jnp.diag(jnp.stack([jnp.asarray(1.0 if stiffness is None else stiffness) for stiffness in each])), elastic


def build_balance(
    system: ShaftSystem,
    places: tuple[Place, ...],
    axis: Axis,
    position: Float[Array, " bearing"],
    closure: Float[Array, " bearing"],
    springs: tuple[Spring, ...],
) -> Balance:
    """The equations of a system. **Arguments:** `position`, `closure`: of each bearing, m."""
    n = len(places)
    mirror = np.asarray([[place.sense, 1.0, 1.0, place.sense, place.sense] for place in places]).ravel()
    compliance = jnp.zeros((5 * n, 5 * n))
    if axis.beam is not None:
        compliance = jnp.moveaxis(axis.beam.compliance(position, position), 2, 1).reshape(5 * n, 5 * n)
    columns = [shifts(position).reshape(5 * n, 5), compliance]
    lines = [columns[0], jnp.eye(5 * n)]
    blocks = [jnp.zeros((5, 5)), jnp.eye(5 * n)]
    energies, loads = [jnp.eye(5), compliance], [axis.total(), jnp.zeros(5 * n)]
    supported = system.housing is not None or any(place.support is not None for place in places)
    if supported:
        if system.housing is not None:
            stiffness, elastic = jnp.asarray(system.housing), np.ones(5 * n, bool)
        else:
            each = [support_matrix(place.support) for place in places]
            stiffness = block_diag(*(matrix for matrix, _ in each))
            elastic = np.concatenate([free for _, free in each])
        columns.append(-jnp.diag(elastic.astype(float)))
        lines.append(columns[-1])
        blocks.append(stiffness)
        energies.append(jnp.eye(5 * n))
        loads.append(jnp.zeros(5 * n))
    attach, left = mirror[:, None] * jnp.concatenate(columns, axis=1), mirror[:, None] * jnp.concatenate(lines, axis=1)
    pressed = np.zeros((5 * n, len(springs)))
    for number, spring in enumerate(springs):
        pressed[[5 * place for place in spring.places], number] = 1.0
        blocks.append(jnp.reshape(spring.stiffness, (1, 1)))
        energies.append(jnp.eye(1))
        loads.append(jnp.reshape(spring.force, (1,)))
    offset = jnp.asarray(mirror) * axis.bent_by_loads(position).ravel()
    along = np.zeros(5)
    along[0] = 1.0
    span = span_of(system, places, position)
    unit = 1.0 / jnp.stack([jnp.ones(()), jnp.ones(()), jnp.ones(()), span, span])
    sizes = [jnp.ones(1), jnp.abs(axis.given.load * unit[None]).ravel()]
    if axis.beam is not None:
        sizes.append(jnp.abs(axis.beam.weight_at(jnp.zeros(())) * unit))
    sizes += [jnp.reshape(jnp.abs(spring.force), (1,)) for spring in springs]
    return Balance(
        attach=jnp.concatenate([attach, pressed], axis=1),
        offset=jnp.asarray(offset) + (closure[:, None] * along[None]).ravel(),
        left=jnp.concatenate([left, pressed], axis=1).T,
        linear=block_diag(*blocks),
        load=jnp.concatenate(loads),
        energy=block_diag(*energies),
        span=span,
        force_scale=jnp.sqrt(jnp.sum(jnp.square(jnp.concatenate(sizes)))),
        springs=len(springs),
        supported=supported,
    )


def span_of(system: ShaftSystem, places: tuple[Place, ...], position: Float[Array, " bearing"]) -> Array:
    """Length by which tilts are multiplied, m: the length of the shaft. For a rigid shaft it is the largest distance
    between two bearings, but at least the pitch radius of the first bearing (50 mm if it has none)."""
    if system.shaft.sections:
        return jnp.asarray(system.shaft.length)
    geometry = getattr(places[0].scene, "geometry", None)
    radius = jnp.asarray(0.05 if geometry is None else 0.5 * geometry.pitch_diameter)
    return jnp.maximum(jnp.max(position) - jnp.min(position), radius)

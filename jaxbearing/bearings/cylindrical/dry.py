"""Equations of a cylindrical roller bearing whose dry, frictionless rollers carry evenly along their length."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import LineContact
from ...numerics.arrow import ArrowPoint
from ...numerics.roots import monotone_root
from ..elastic_ring import ElasticRing
from ..ring import LENGTH_UNIT, InnerRing
from .in_plane import AbstractInPlane
from .kinematics import RollerKinematics
from .loads import per_race


class DryRollerSystem(AbstractInPlane):
    """Dry frictionless bearing. Only the ring displacement is an unknown: the loads follow from it, with one well
    conditioned scalar root for each roller.

    - `directions`: dimensionless components of the outward unit vectors along the unknown degrees of freedom of the
      ring.
    - `azimuth`: of the rollers, rad.
    - `radial_clearance`: half the diametral clearance, m.
    - `roller_mass`: mass of a roller, kg.
    - `held`, `out_of_round`: approach of the races at each roller by given displacements of the ring and by races that
      are not round, m; `None` if there is none.
    """

    kinematics: RollerKinematics
    contact: LineContact
    directions: Float[Array, "freedom roller"]
    azimuth: Float[Array, " roller"]
    ring: InnerRing
    radial_clearance: Float[Array, ""]
    roller_mass: Float[Array, ""]
    held: Float[Array, " roller"] | None = None
    out_of_round: Float[Array, " roller"] | None = None
    outer: ElasticRing | None = None
    inner: ElasticRing | None = None

    def equation_names(self) -> tuple[str, ...]:
        return self.ring_names()

    def step_caps(self) -> ArrowPoint:
        # in a dry bearing the loads are convex functions of the displacement: Newton's steps need no cap
        return ArrowPoint(jnp.zeros((0, 1)), jnp.full(self.ring_unknowns, 1e4))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        edge = jnp.full(self.ring_unknowns, 1e5)
        return ArrowPoint(jnp.zeros((0, 1)), -edge), ArrowPoint(jnp.zeros((0, 1)), edge)

    def centrifugal(self) -> Array:
        return self.roller_mass * self.kinematics.pitch_radius * jnp.square(self.kinematics.free_orbit)

    def initial(self) -> ArrowPoint:
        """Starts with the whole load on one roller. The bearing is then in contact, and the root is approached from
        above."""
        compliance = jnp.sum(self.contact.palmgren_compliance)
        shift = self.radial_clearance + compliance * (self.load_scale() + self.centrifugal()) ** 0.9
        shift = jnp.maximum(shift, 0.1 * LENGTH_UNIT)
        if self.out_of_round is not None:
            shift = shift + jnp.max(jnp.abs(self.out_of_round))
        ring = self.begun(self.ring.across() * shift / LENGTH_UNIT)
        return ArrowPoint(jnp.zeros((0, self.azimuth.shape[0])), ring)

    def loads(self, shift: Array) -> tuple[Float[Array, "2 roller"], Array]:
        r"""Loads on both races, N, and the residual of the solve for them.

        The load Q at the inner race satisfies $k_i Q^{0.9} + k_o (Q + F_c)^{0.9} = d\cdot n - J_d/2$. It is 0 until
        $d\cdot n$ exceeds $J_d/2$ plus the approach that the centrifugal force causes at the outer race. The equation
        is solved for $t = Q^{0.9}$, in which it is nearly linear. Where contact begins, Q is continuously
        differentiable with slope 0.

        **Arguments:** `shift`: displacement of the inner ring towards each roller, m.
        """
        kappa = per_race(self.contact.palmgren_compliance)
        fc = self.centrifugal()
        # `where` is applied twice: 0^0.9 has an infinite derivative, and a bearing at rest has no centrifugal force
        turning = fc > 0
        outer_rest = jnp.where(turning, kappa[1] * jnp.where(turning, fc, 1.0) ** 0.9, 0.0)
        excess = (shift - self.radial_clearance - outer_rest) / kappa[0]
        taken = excess > 0
        x = jnp.where(taken, excess, 1.0)

        def balance(t, args):
            x_, fc_, ratio, rest = args
            return t + ratio * (t ** (10.0 / 9.0) + fc_) ** 0.9 - rest - x_

        args = (x, fc, kappa[1] / kappa[0], outer_rest / kappa[0])
        root = monotone_root(balance, args, 1e-3 * x, 1.001 * x, 0.5 * x)
        at_inner = jnp.where(taken, jnp.where(taken, root.value, 1.0) ** (10.0 / 9.0), 0.0)
        return jnp.stack([at_inner, at_inner + fc]), jnp.max(root.residual / x)

    def inward_shift(self, point: ArrowPoint) -> Array:
        """Displacement of the rings towards each other at each roller at a point, m."""
        return self.approaching(point.globals) if self.bent else self.inward(point.globals[:, None])

    def local_inputs(self, globals_):
        """With flexible rings, returns the displacement of the rings towards each other at each roller. Returns `None`
        if both rings are rigid."""
        return self.approaching(globals_)[None] if self.bent else None

    def gathered(self, globals_, acting):
        return self.on_rings(acting) if self.bent else jnp.sum(acting, axis=1)

    def element(self, unknowns, shared):
        if self.bent:
            load, nested = self.loads(shared[0])
            return unknowns, load, nested
        load, nested = self.loads(self.inward(shared))
        return unknowns, load[0][None, :] * self.directions, nested

    def global_residual(self, globals_, totals):
        return self.ring_rows(globals_, totals), jnp.zeros(())

r"""Equations of the tapered roller bearing without friction on the raceways: one block-arrow system.

The unknowns of a roller are the displacements of the centre of its big end, u_x along its axis towards the small end
and u_z outwards, and its tilt phi, which moves the small end outwards. The global unknowns are the displacements of the
cone. Its motion at a roller is (Da, Dr, t): displacements of the apex along a and r, and the tilt t that turns a
towards r. The approaches are (source eqs. (44)-(50), with coefficients derived here):

- $\delta_k(s) = f_k + g_ks$: $f_i = u_x\sin\epsilon - u_z\cos\epsilon + \phi C + D_a\sin\alpha_i + D_r\cos\alpha_i -
  td$, $g_i = t - \phi$; $f_o = u_x\sin\epsilon + u_z\cos\epsilon - \phi C$, $g_o = \phi$; $C =
  \frac{D_w}{2}\sin\epsilon$;
- $\delta_f = -u_x\cos\theta - u_z\sin\theta - \phi R_s\cos\lambda\sin\theta + D_a\cos\alpha_f - D_r\sin\alpha_f +
  tT_f$.
  (Eq. (50) prints D_f for B_f in its second term, and -D_f, +E_f in its ring terms, which contradict eqs. (56)-(57).)

The equations are the gradient of one convex potential, $\Pi = \sum[w_i + w_o + \frac25k_f\delta_{f+}^{5/2} - F_c\,u_r +
M_g\phi] - F\cdot q$, with the outward displacement $u_r$ of the centre of mass. They are eqs. (54), (56), (57), with
*all* moments about the centre of the big end. (The source takes the moments of the raceway contacts about this point,
but the lever of the rib about the centre of mass. Its moment equation is wrong by $s_c(Q_i - Q_o)$.)

A cup that bends moves its raceway outwards by w at a roller, which subtracts $w\cos\alpha_o$ from $f_o$; the roller
presses it outwards by $Q_o\cos\alpha_o$. A cone that bends moves with its rib: its deflection is a part of $D_r$ at the
roller, which presses it outwards by $Q_f\sin\alpha_f - Q_i\cos\alpha_i$. Raceways that are not round change the
approaches of the raceways only, not that of the rib.

The position of a roller without contact is undetermined, and so is that of a cone that touches no roller. Each is
therefore held where it is by a spring of stiffness `ANCHOR`, which adds to the Jacobian but not to the balances.
"""

import dataclasses
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float

from ..._types import Scalar
from ...contacts import AbstractTiltedLine
from ...numerics.arrow import ArrowPoint, seen_by_elements
from ...numerics.batching import in_turn
from ...numerics.convex import Minimum, anchored, find_minimum
from ...numerics.safe import positive_power
from ..elastic_ring import ElasticRing
from ..ring import ANCHOR, LENGTH_UNIT, TILTS, InnerRing
from ..row import AbstractRowSystem

START_TOLERANCE = 1e-11
"""Scaled residual at which the descent of the potential hands over to Newton. With 1e-7, random tapered bearings take a
fifth more steps in all, and 12 instead of 8 of 1 000 tilted cylindrical ones fail."""
LONGEST_STEP = 1e-4
"""Largest change of a displacement in one Newton step, m."""
FARTHEST = 100.0
"""Largest displacement of a roller in the iteration, m."""
MOST_TILT = 0.1
"""Largest tilt of a ring that is free to tilt, rad. The equations are those of small displacements; they do have roots
beyond, where rollers carry all load on the last micrometres of their length while the others are millimetres apart."""


SEATING = 1e-3
"""Centrifugal force divided by a roller's share of the load, below which unloaded rollers hardly find their positions,
because the forces on them are as small as 1e-10 of the others. If Newton's iteration fails for this reason, it begins
again with the centrifugal force increased to this value, and reduces it in steps."""


class TaperedForm(NamedTuple):
    """Geometry in the equations: angles, rad, and lengths, m. `sine`, `cosine`: of the roller half angle epsilon."""

    sine: Array
    cosine: Array
    cone_angle: Array
    cup_angle: Array
    axis_angle: Array
    flange_angle: Array
    flange_tilt: Array
    offset: Array
    """Length C in the approaches of the raceways."""
    apex_distance: Array
    end_height: Array
    flange_arm: Array
    """Length T_f, the lever of the rib contact about the apex."""


class Inertia(NamedTuple):
    """Inertia forces on a roller: centrifugal force, N, which acts at the distance `centre`, m, from the big end along
    the roller axis, and gyroscopic moment, N m."""

    force: Array
    centre: Array
    moment: Array

    def times(self, factor: Scalar) -> "Inertia":
        """The same with forces and moments multiplied by a factor."""
        return self._replace(force=self.force * factor, moment=self.moment * factor)


class TaperedState(NamedTuple):
    """Contacts of every roller; a first axis of length 2 runs over the races (inner, outer). The approach of a raceway
    is f + g s, with `approach` f, m, and `slope` g, rad. Loads in N, moments about s = 0 in N m."""

    approach: Float[Array, "2 roller"]
    slope: Float[Array, "2 roller"]
    flange_approach: Float[Array, " roller"]
    load: Float[Array, "2 roller"]
    moment: Float[Array, "2 roller"]
    flange_load: Float[Array, " roller"]


class TaperedSystem(AbstractRowSystem):
    """Equations of a tapered roller bearing (see the module). All unknowns are lengths in units of 10 um: phi is
    multiplied by the roller length, and tilts of the ring by d.

    - `columns`: motion (Da, Dr, t) of the cone at every roller, for a unit of each unknown degree of freedom.
    - `held`: the same motion by given displacements of the ring and by expansion, m and rad.
    - `multiplicity`: number of rollers for which each modelled roller stands.
    """

    form: TaperedForm
    line: AbstractTiltedLine
    flange_stiffness: Float[Array, ""]
    inertia: Inertia
    columns: Float[Array, "freedom 3 roller"]
    held: Float[Array, "3 roller"]
    ring: InnerRing
    outer: ElasticRing | None
    """The cup if it bends; `None`: it is rigid."""
    inner: ElasticRing | None
    """The cone if it bends; `None`: it is rigid."""
    out_of_round: Float[Array, "2 roller"] | None
    """Changes of the approaches of inner and outer race by raceways that are not round, m; `None`: both are round."""
    guess: ArrowPoint | None
    seated: ArrowPoint | None
    """First guess at parameter 1 of the homotopy; `None`: there is no homotopy."""
    multiplicity: int = eqx.field(static=True)
    closing: Float[Array, "3"] | None = None
    """Changes of the approaches of inner race, outer race and rib by growth, m; `None`: there is no growth."""

    # -- scales ---------------------------------------------------------------------------------------------------

    @property
    def roller_count(self) -> int:
        return self.multiplicity * self.held.shape[1]

    def load_scale(self) -> Array:
        """Scale of the ring's balances, N."""
        return self.ring.scale()

    def roller_scale(self) -> Array:
        """Scale of a roller's balances, N."""
        return self.load_scale() / self.roller_count + self.inertia.force

    def units(self) -> Float[Array, "3 1"]:
        """Factors that convert the unknowns of a roller to u_x, u_z, m, and phi, rad."""
        return LENGTH_UNIT * jnp.stack([jnp.ones(()), jnp.ones(()), 1.0 / jnp.asarray(self.line.length)])[:, None]

    # -- solver contract ------------------------------------------------------------------------------------------

    def equation_names(self) -> tuple[str, ...]:
        own = ("force balance along a roller", "force balance across a roller", "moment balance of a roller")
        return (*own, *self.ring_names())

    def step_caps(self) -> ArrowPoint:
        cap = LONGEST_STEP / LENGTH_UNIT
        return ArrowPoint(jnp.full((3, 1), cap), jnp.full(self.ring_unknowns, cap))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        """Limits of the unknowns: `FARTHEST` for the rollers, the apex distance for displacements of the rings, and
        `MOST_TILT` for their tilts."""
        away = self.form.apex_distance / LENGTH_UNIT
        ring = self.ring.of_each(lambda name: MOST_TILT * away if name in TILTS else away)
        if self.bent:
            ring = jnp.concatenate([ring, jnp.full(self.bent.modes, away)])
        high = ArrowPoint(jnp.full((3, 1), FARTHEST / LENGTH_UNIT), ring)
        return ArrowPoint(-high.elements, -high.globals), high

    def initial(self) -> ArrowPoint:
        """First guess in contact: the ring is displaced axially by at least 2 um, and each roller follows along its
        axis by 0.9 of this."""
        if self.guess is not None:
            return self.guess
        if not self.freedoms:
            # axial displacement that would bring the cone as near to each roller as the given displacements do
            pressed = self.pressed(self.held) / jnp.sin(self.form.cone_angle)
            axial = jnp.maximum(pressed, 2e-6) / LENGTH_UNIT
            return ArrowPoint(jnp.stack([0.9 * axial, 0.05 * axial, 0.0 * axial]), jnp.zeros(self.ring_unknowns))
        share = self.load_scale() / (self.roller_count * jnp.sin(self.form.cup_angle))
        even = (share / (self.line.stiffness * self.line.length)) ** 0.9
        axial = jnp.maximum(2.0 * even / jnp.sin(self.form.cone_angle), 2e-6) / LENGTH_UNIT
        ring = self.ring.of_each(lambda name: axial if name == "axial" else 0.0)
        if self.bent:
            ring = jnp.concatenate([ring, jnp.zeros(self.bent.modes)])
        ones = jnp.ones(self.held.shape[1])
        return ArrowPoint(jnp.stack([0.9 * axial * ones, 0.05 * axial * ones, 0.0 * ones]), ring)

    def without_guess(self) -> "TaperedSystem":
        return dataclasses.replace(self, guess=None, seated=None)

    def acting(self, unknowns, shared):
        """See `AbstractConvexArrow`. The energy of a roller is the energy of its contacts minus the work of its inertia
        forces, J."""
        state = self.state(unknowns, shared)
        balance = self.balance(state, self.inertia) + self.anchors(unknowns)
        energies = self._energies(state, self.units() * unknowns)
        return balance / self.roller_scale(), self.on_rings_of(state), energies

    def anchors(self, unknowns: Float[Array, "3 roller"]) -> Float[Array, "3 roller"]:
        """Forces of the artificial springs that hold the rollers, N: 0, with derivatives that are not (`ANCHOR`)."""
        return anchored(unknowns, ANCHOR * LENGTH_UNIT)

    def on_rings_of(self, state: TaperedState) -> Float[Array, "row roller"]:
        """Contributions of the rollers to the balances of both rings, N."""
        force = self.ring_force(state)
        totals = self.multiplicity * jnp.einsum("fcn,cn->fn", self.columns, force)
        return self.on_both(totals, state.load[1] * jnp.cos(self.form.cup_angle), force[1]) if self.bent else totals

    def global_residual(self, globals_, totals):
        return self.ring_balance(globals_, totals, floats=True) / self.load_scale(), jnp.zeros(())

    def _energies(self, state: TaperedState, place: Float[Array, "3 roller"]) -> Float[Array, " roller"]:
        along, across, tilt = place
        line = jnp.sum(self.line.energy(state.approach, state.slope), axis=0)
        flange = 0.4 * self.flange_stiffness * positive_power(state.flange_approach, 2.5)
        sine, cosine = jnp.sin(self.form.axis_angle), jnp.cos(self.form.axis_angle)
        outwards = -along * sine + (across + tilt * self.inertia.centre) * cosine
        return self.multiplicity * (line + flange - self.inertia.force * outwards + self.inertia.moment * tilt)

    @property
    def homotopies(self) -> int:
        return 0 if self.seated is None else 1

    def homotopy(self, parameter, path):
        """Increases the inertia forces if they are small but not 0: they bring the unloaded rollers to their
        positions."""
        del path
        guess = None
        if self.guess is not None and self.seated is not None:
            guess = jax.tree.map(lambda own, other: jnp.where(parameter < 1.0, own, other), self.guess, self.seated)
        factor = jnp.maximum(self.slowness(), 1.0) ** parameter
        return dataclasses.replace(self, inertia=self.inertia.times(factor), guess=guess)

    def slowness(self) -> Array:
        """Centrifugal force that `SEATING` asks for, divided by the actual one; 0 at rest."""
        force = self.inertia.force
        least = SEATING * self.load_scale() / self.roller_count
        return jnp.where(force > 0, least / jnp.where(force > 0, force, 1.0), 0.0)

    def started(self, hopeless: Bool[Array, ""]) -> tuple["TaperedSystem", Minimum]:
        """These equations with the minima of the potential, for the actual and for increased inertia forces, as first
        guesses; and the result of the search for the first.

        **Arguments:** `hopeless`: True if it is known that there is no minimum.
        """
        both = in_turn(_minima, jax.lax.stop_gradient((self, hopeless)))
        minimum, seated = (jax.tree.map(lambda leaf, i=i: leaf[i], both) for i in (0, 1))
        system = dataclasses.replace(self, guess=minimum.point, seated=seated.point)
        return system, minimum._replace(steps=minimum.steps + seated.steps)

    # -- physics --------------------------------------------------------------------------------------------------

    def at(self, point: ArrowPoint) -> TaperedState:
        return self.state(point.elements, seen_by_elements(self, point))

    def state(self, unknowns: Float[Array, "3 roller"], shared: Float[Array, "p roller"]) -> TaperedState:
        motion = self.held + LENGTH_UNIT * jnp.einsum("fn,fcn->cn", self.of_freedoms(shared), self.columns)
        opened = self.opened(shared)
        if "inner" in opened:
            motion = motion.at[1].add(-opened["inner"])
        approach, slope, flange = self.approaches(self.units() * unknowns, motion)
        if self.out_of_round is not None:
            approach = approach + self.out_of_round
        if "outer" in opened:
            approach = approach.at[1].add(-opened["outer"] * jnp.cos(self.form.cup_angle))
        return self._loaded(approach, slope, flange)

    def pressed(self, motion: Float[Array, "3 roller"]) -> Float[Array, " roller"]:
        """Displacement of the cone's raceway towards each roller at mid length, plus the growth of the raceway
        approaches, m.

        **Arguments:** `motion`: (Da, Dr, t) of the cone, m and rad.
        """
        axial, radial, turn = motion
        normal = axial * jnp.sin(self.form.cone_angle) + radial * jnp.cos(self.form.cone_angle)
        normal = normal - turn * (self.form.apex_distance - 0.5 * self.line.length)
        return normal if self.closing is None else normal + self.closing[0] + self.closing[1]

    def approaches(
        self, place: Float[Array, "3 roller"], motion: Float[Array, "3 roller"]
    ) -> tuple[Float[Array, "2 roller"], Float[Array, "2 roller"], Float[Array, " roller"]]:
        """Approaches f, m, and slopes g, rad, of both races, and approach delta_f of the rib, m.

        **Arguments:** `place`: (u_x, u_z, phi) of each roller; `motion`: (Da, Dr, t) of the cone; m and rad.
        """
        form, (along, across, tilt), (axial, radial, turn) = self.form, place, motion
        cone = axial * jnp.sin(form.cone_angle) + radial * jnp.cos(form.cone_angle) - turn * form.apex_distance
        inner = along * form.sine - across * form.cosine + tilt * form.offset + cone
        outer = along * form.sine + across * form.cosine - tilt * form.offset
        rib = axial * jnp.cos(form.flange_angle) - radial * jnp.sin(form.flange_angle) + turn * form.flange_arm
        below = jnp.sin(form.flange_tilt)
        flange = rib - along * jnp.cos(form.flange_tilt) - (across + tilt * form.end_height) * below
        if self.closing is not None:
            inner, outer, flange = (
                approach + more for approach, more in zip((inner, outer, flange), self.closing, strict=True)
            )
        return jnp.stack([inner, outer]), jnp.stack([turn - tilt, tilt]), flange

    def _loaded(self, approach: Array, slope: Array, flange: Array) -> TaperedState:
        load, moment = self.line.load_and_moment(approach, slope)
        return TaperedState(approach, slope, flange, load, moment, self.flange_stiffness * positive_power(flange, 1.5))

    def balance(self, state: TaperedState, inertia: Inertia) -> Float[Array, "3 roller"]:
        """Residuals of the balances of each roller, N: forces along and across its axis, and moment about the centre of
        its big end, divided by the roller length. **Arguments:** `inertia`: inertia forces on the rollers."""
        form, (inner, outer), (inner_moment, outer_moment) = self.form, state.load, state.moment
        flange = state.flange_load
        sine, cosine = jnp.sin(form.axis_angle), jnp.cos(form.axis_angle)
        below = jnp.sin(form.flange_tilt)
        along = (inner + outer) * form.sine - flange * jnp.cos(form.flange_tilt) + inertia.force * sine
        across = (outer - inner) * form.cosine - flange * below - inertia.force * cosine
        moment = outer_moment - inner_moment + form.offset * (inner - outer) - flange * form.end_height * below
        moment = moment - inertia.force * inertia.centre * cosine + inertia.moment
        return jnp.stack([along, across, moment / self.line.length])

    def ring_force(self, state: TaperedState) -> Float[Array, "3 roller"]:
        """Axial and radial force of the cone on each roller, N, and moment about the apex, N m. They are conjugate to
        (Da, Dr, t)."""
        form, inner, flange = self.form, state.load[0], state.flange_load
        axial = inner * jnp.sin(form.cone_angle) + flange * jnp.cos(form.flange_angle)
        radial = inner * jnp.cos(form.cone_angle) - flange * jnp.sin(form.flange_angle)
        return jnp.stack([axial, radial, state.moment[0] - form.apex_distance * inner + form.flange_arm * flange])

    def cup_force(self, state: TaperedState) -> Float[Array, "3 roller"]:
        """Axial and radial force of each roller on the cup, N, and moment about the apex, N m. They are conjugate to
        (Da, Dr, t) of the cup, and serve to check the balance of the whole bearing."""
        form, outer = self.form, state.load[1]
        axial, radial = outer * jnp.sin(form.cup_angle), outer * jnp.cos(form.cup_angle)
        return jnp.stack([axial, radial, state.moment[1] - form.apex_distance * outer])


def _minima(inputs: tuple[TaperedSystem, Bool[Array, ""]]) -> Minimum:
    """Minima of the potential for the actual and for increased inertia forces, along a first axis."""
    system, hopeless = inputs
    start = system.initial()
    nothing = Minimum(start, jnp.asarray(0), jnp.asarray(False))

    def search(parameter: Array) -> Minimum:
        # a bearing that turns fast enough needs no second minimum
        there = dataclasses.replace(system.homotopy(parameter, jnp.asarray(0)), guess=start)
        find = lambda: find_minimum(there, tolerance=START_TOLERANCE, hopeless=hopeless)
        return jax.lax.cond((parameter > 0.0) & ((system.slowness() <= 1.0) | hopeless), lambda: nothing, find)

    return jax.lax.map(search, jnp.asarray([0.0, 1.0]))

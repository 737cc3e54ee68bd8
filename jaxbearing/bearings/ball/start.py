r"""First guess of a ball bearing's equilibrium: without friction, at frozen centrifugal forces, it is a convex problem.

$\Pi = \sum_j[\frac25K_o\delta_{o+}^{5/2} + \frac25K_i\delta_{i+}^{5/2} - F_CW] - F\cdot q$: each $\delta$ is the norm
of an affine map minus a constant, and the power is convex and increasing. The ring's displacements descend it, every
ball in equilibrium (`numerics.convex.descend_settled`). Nothing here is differentiated: an iteration starts from it.
"""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from ...numerics.arrow import ArrowPoint
from ...numerics.convex import AbstractConvexArrow, anchored, descend_settled, settle
from ...numerics.safe import safe_norm

RING_TOLERANCE = 2e-2
"""Tolerance of the ring's balance, relative to the load: sufficient for a start of the full equations."""
BALL_TOLERANCE = 1e-5
"""Tolerance of a ball's balance, relative to its load scale."""
RING_TRIALS, BALL_TRIALS = 40, 60
"""Most trials of the search for the ring, and of that for the balls at one place of the ring."""
SOFTEST = 1e2
"""Spring that holds each ball and the ring where it is, N/m: where no ball carries anything the ring would be free."""


class CentrifugalProblem(AbstractConvexArrow):
    """Balls between two grooves under given forces. Units m, N; (inner, outer) or (axial, radial) first.

    Unknowns, m: the centre of each ball from that of its outer groove, and the displacements of the ring. `groove`:
    inner groove centre of every ball with the ring at rest; `directions`: its change for a unit of every ring freedom
    (a length each); `ring_load`: on them; `load_scale`: of the ring's balances, N; `aligned`: axial displacement at
    which the planes of the grooves coincide; `multiplicity`: balls that each ball stands for.
    """

    offset: Float[Array, "2"]
    stiffness: Float[Array, "2"]
    groove: Float[Array, "2 ball"]
    directions: Float[Array, "freedom 2 ball"]
    ring_load: Float[Array, " freedom"]
    load_scale: Float[Array, ""]
    centrifugal: Float[Array, " ball"]
    centre_distance: Float[Array, ""]
    free_cosine: Float[Array, ""]
    aligned: Float[Array, ""]
    multiplicity: int = eqx.field(static=True)
    freedoms: tuple[str, ...] = eqx.field(static=True)

    @property
    def count(self) -> int:
        """Number of balls that carry the load."""
        return self.groove.shape[1] * self.multiplicity

    def groove_at(self, ring: Float[Array, " freedom"]) -> Float[Array, "2 ball"]:
        return self.groove + jnp.einsum("f,fcn->cn", ring, self.directions)

    def initial(self) -> ArrowPoint:
        return self.near(ArrowPoint(self.groove, ring_estimate(self)))

    def near(self, point: ArrowPoint) -> ArrowPoint:
        return ArrowPoint(free_centres(self, self.groove_at(point.globals))[0], point.globals)

    def equation_names(self) -> tuple[str, ...]:
        return ("axial balance of a ball", "radial balance of a ball", *(f"{name} balance" for name in self.freedoms))

    def step_caps(self) -> ArrowPoint:
        half = 0.5 * self.centre_distance
        return ArrowPoint(jnp.stack([half, half])[:, None], jnp.full(len(self.freedoms), half))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        elements, ring = jnp.full((2, 1), jnp.inf), jnp.full(len(self.freedoms), jnp.inf)
        return ArrowPoint(-elements, -ring), ArrowPoint(elements, ring)

    def acting(self, unknowns, shared):
        values, _, energies = self.tangents(unknowns, shared)
        return values[:2], values[2:], energies

    def tangents(self, unknowns, shared):
        """See `AbstractConvexArrow`; written out, since this is what the search computes most."""
        groove = self.groove + jnp.sum(shared[:, None] * self.directions, axis=0)
        arm = jnp.stack([groove - unknowns, unknowns])
        length = safe_norm(arm[:, 0], arm[:, 1], 1e-30)
        depth = jnp.maximum(length - self.offset[:, None], 0.0)
        root = self.stiffness[:, None] * jnp.sqrt(depth)
        load = root * depth
        across = load / length
        along = (1.5 * root - across) / jnp.square(length)
        identity = jnp.eye(2)[:, :, None]
        stiffness = along[:, None, None] * arm[:, :, None] * arm[:, None] + across[:, None, None] * identity[None]
        inner, outer = across[:, None] * arm
        push = jnp.stack([jnp.zeros_like(self.centrifugal), self.centrifugal])
        energies = 0.4 * jnp.sum(load * depth, axis=0) - self.centrifugal * unknowns[1]
        # per unit of each freedom: change of the force on the inner groove, and its part along each freedom
        turned = jnp.sum(stiffness[:1] * self.directions[:, None], axis=2)
        along_freedoms = self.multiplicity * jnp.sum(self.directions[:, None] * turned[None], axis=2)
        scale = self.load_scale / self.count + self.centrifugal
        totals = self.multiplicity * jnp.sum(self.directions * inner[None], axis=1)
        local = stiffness[0] + stiffness[1] + SOFTEST * identity
        own = jnp.concatenate([local, -jnp.swapaxes(turned, 0, 1)], axis=1) / scale[None, None]
        of_ring = jnp.concatenate([-self.multiplicity * turned, along_freedoms], axis=1)
        values = jnp.concatenate([(outer - inner - push) / scale[None], totals])
        return values, jnp.concatenate([own, of_ring]), self.multiplicity * energies

    def global_residual(self, globals_, totals):
        return (totals - self.ring_load + anchored(globals_, SOFTEST)) / self.load_scale, jnp.zeros(())

    def work(self, globals_):
        return jnp.sum(self.ring_load * globals_)


class Start(NamedTuple):
    """Ball centres from the outer groove centre and ring displacements, m; Newton steps of the ring."""

    centre: Float[Array, "2 ball"]
    ring: Float[Array, " freedom"]
    steps: Int[Array, ""]


def free_centres(
    problem: CentrifugalProblem, groove: Array, blocked: bool | Bool[Array, ""] = True
) -> tuple[Array, Bool[Array, " ball"]]:
    """Ball centres for given inner grooves, near equilibrium; and which balls do not touch the inner race (exact).

    **Arguments:** `blocked`: whether the inner race stops a ball that the centrifugal force turns down the outer
    groove. Where the ring has not followed yet, contact angles of the equilibrium are nearer to those without.
    """
    compliance = problem.stiffness ** (-2.0 / 3.0)
    length = safe_norm(groove[0], groove[1], 1e-30)
    load = together(problem.stiffness) * jnp.maximum(length - jnp.sum(problem.offset), 0.0) ** 1.5
    axial, radial = load * groove[0] / length, load * groove[1] / length + problem.centrifugal
    outer = safe_norm(axial, radial, 1e-30)
    reach = problem.offset[1] + compliance[1] * outer ** (2.0 / 3.0)
    # as far down the outer groove as the forces on the ball point, but not through the inner race
    angle, side = jnp.arctan2(groove[0], groove[1]), jnp.where(groove[0] < 0, -1.0, 1.0)
    inner = problem.offset[0] + compliance[0] * load ** (2.0 / 3.0)
    swing = (jnp.square(reach) + jnp.square(length) - jnp.square(inner)) / (2.0 * reach * length)
    stopped = side * angle - jnp.arccos(jnp.clip(swing, -1.0, 1.0))
    stopped = jnp.where(blocked, stopped, -jnp.inf)
    angle = side * jnp.maximum(side * jnp.arctan2(axial, radial), stopped)
    centre = reach[None] * jnp.stack([jnp.sin(angle), jnp.cos(angle)])
    alone = problem.offset[1] + compliance[1] * problem.centrifugal ** (2.0 / 3.0)
    lost = safe_norm(groove[0], groove[1] - alone) <= problem.offset[0]
    resting = jnp.stack([jnp.zeros_like(length), alone])
    return jnp.where(lost[None], resting, centre), lost


def start(problem: CentrifugalProblem, ring: Float[Array, " freedom"]) -> Start:
    """The minimum of the potential to `RING_TOLERANCE`, from an estimate of the ring's displacement, `ring`, m."""
    guess = ArrowPoint(problem.groove, ring)
    if not problem.freedoms:
        found = settle(problem, problem.near(guess), tolerance=BALL_TOLERANCE, trials=BALL_TRIALS)
        return Start(found.elements, ring, jnp.asarray(0))
    end = descend_settled(
        problem,
        guess,
        tolerance=RING_TOLERANCE,
        trials=RING_TRIALS,
        element_tolerance=BALL_TOLERANCE,
        element_trials=BALL_TRIALS,
    )
    return Start(end.point.elements, end.point.globals, end.steps)


def together(stiffness: Float[Array, "2"]) -> Float[Array, ""]:
    """Constant of both contacts of a ball, one behind the other, N/m^(3/2)."""
    return jnp.sum(stiffness ** (-2.0 / 3.0)) ** -1.5


def ring_estimate(problem: CentrifugalProblem) -> Float[Array, " freedom"]:
    """Ring displacements, pressed in rather too deep: Newton on a power 3/2 contracts from there, and a ring that
    touches no ball has no stiffness.

    Axially from $\\sin\\alpha(\\cos\\alpha_0/\\cos\\alpha - 1)^{3/2} = F/(NK_nBD^{3/2})$ with the axial force that
    would load half the balls (Harris), radially from Sjovall's load distribution.
    """
    if not problem.freedoms:
        return jnp.zeros(0)
    count = problem.count
    load = dict(zip(problem.freedoms, problem.ring_load, strict=True))
    zero = jnp.zeros(())
    both = together(problem.stiffness)
    # with radial preload the rings are nearer than the balls are thick
    distance, cosine = problem.centre_distance, jnp.minimum(problem.free_cosine, 1.0)
    axial, across = load.get("axial", zero), jnp.stack([load.get("radial", zero), load.get("lateral", zero)])
    radial = jnp.sqrt(jnp.sum(jnp.square(across)))
    tilting = jnp.abs(load.get("tilt", zero)) + jnp.abs(load.get("tilt_lateral", zero))
    sine = jnp.sqrt(jnp.maximum(1.0 - cosine * cosine, 0.0))
    tangent = sine / cosine
    thrust = jnp.maximum(jnp.maximum(jnp.abs(axial) + tilting, 1.22 * radial * tangent), 1.0)
    target = jnp.log(thrust / (count * both * distance**1.5))

    def deeper(_, angle):
        """Newton on the logarithm of the thrust, from above."""
        lift = jnp.maximum(cosine / jnp.cos(angle) - 1.0, 1e-12)
        value = jnp.log(jnp.sin(angle)) + 1.5 * jnp.log(lift) - target
        slope = 1.0 / jnp.tan(angle) + 1.5 * cosine * jnp.tan(angle) / (jnp.cos(angle) * lift)
        low = jnp.arccos(cosine) + 1e-9
        return jnp.clip(angle - value / slope, 0.5 * (low + angle), 1.5)

    free = jnp.arccos(cosine)
    angle = jax.lax.fori_loop(0, 12, deeper, jnp.minimum(free + 0.3, 1.45))
    depth = distance * jnp.sin(angle - free) / jnp.cos(angle)
    pushed = jnp.where(axial < 0, -1.0, 1.0)
    mixed = 1.0 - 0.6 * jnp.minimum(1.0, radial * tangent / jnp.maximum(jnp.abs(axial), 1e-3))
    alone = (jnp.abs(axial) + tilting) <= 1e-9 * problem.load_scale
    inward = jnp.where(alone, problem.aligned, problem.aligned + pushed * (distance * sine + depth * mixed))
    moved = (5.0 * radial / (count * cosine * both)) ** (2.0 / 3.0)
    moved = moved + jnp.where(alone, distance * (1.0 - cosine), 0.0)
    along = moved * across / jnp.where(radial > 0, radial, 1.0)
    guesses = {"axial": inward, "radial": along[0], "lateral": along[1]}
    return jnp.stack([guesses.get(name, zero) for name in problem.freedoms])

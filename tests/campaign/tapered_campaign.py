"""Random load cases of the tapered roller bearing: python tests/campaign/tapered_campaign.py [CASES] [--free]

Fa 0.2 to 40 kN, Fr 0 to 30 kN, tilt held within 2 mrad, or, with --free, free under a moment; 0 to 10 000 rpm. What
does not converge must be `no_equilibrium`: linear programming must find no distribution of contact forces that balances
it, or the cone, held at a tilt of 0.1 rad to the one side and to the other, must be pushed on by its moment to the same
side. Prints counts, Newton steps, the worst balance and whether all gradients are finite.
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import jax
import jax.numpy as jnp
import numpy as np
import scipy.optimize
from tapered_cases import RPM, tapered

import jaxbearing as jb
from jaxbearing.bearings.tapered.build import build_tapered
from jaxbearing.bearings.tapered.system import MOST_TILT
from jaxbearing.numerics.arrow import ArrowPoint
from jaxbearing.numerics.status import Status


def random_points(cases, free, seed=0):
    """Half of the radial loads below the static bound, which few would be by chance."""
    rng = np.random.default_rng(seed)
    axial = np.exp(rng.uniform(np.log(200.0), np.log(40e3), cases))
    bound = np.minimum(axial / np.tan(np.radians(14.036)), 30e3)
    radial = rng.uniform(0.0, np.where(rng.uniform(size=cases) < 0.5, bound, 30e3))
    points = {"axial_load": axial, "radial_load": radial, "inner_speed": rng.uniform(0.0, 1e4, cases) * RPM}
    points["inner_speed"] *= rng.uniform(size=cases) > 0.1  # some at rest
    if free:
        # about the moment that the rollers' middles give to loads: -0.11 m from the apex
        points["moment"] = 0.11 * radial + rng.uniform(-1.0, 1.0, cases) * 0.01 * axial
    else:
        points["misalignment"] = rng.uniform(-2e-3, 2e-3, cases)
    return {name: jnp.asarray(value) for name, value in points.items()}


def solve_points(points, free):
    """Status, steps, residual, smallest load, and gradients of the largest load, the displacement and the stiffness."""
    extra = {"moment": 0.0} if free else {"misalignment": 0.0}
    scene = tapered(1e4, 1e3, **extra)

    def one(operation):
        def measured(operation_):
            solution = jb.solve(scene.at_operation(**operation_), throw=False)
            loads = solution.elements.load_inner
            return jnp.stack([jnp.sum(loads**2) ** 0.5, solution.ring.axial * 1e9, jnp.sum(loads**4) ** 0.25]), solution

        slopes, solution = jax.jacrev(measured, has_aux=True)(operation)
        finite = jnp.all(jnp.stack([jnp.all(jnp.isfinite(s)) for s in jax.tree.leaves(slopes)]))
        stiff = jnp.all(jnp.isfinite(solution.stiffness))
        return solution.status, solution.iterations, solution.residual_norm, finite & stiff

    return [np.asarray(a) for a in jax.jit(lambda p: jax.lax.map(one, p))(points)]


def scene_of(point, free):
    extra = {"moment": point["moment"]} if free else {"misalignment": point["misalignment"]}
    scene = tapered(point["axial_load"], point["radial_load"], 0.0, **extra)
    return scene.at_operation(inner_speed=point["inner_speed"])


def feasible(scene):
    """Whether forces of contacts that only push can balance all loads: linear programming, no stiffness in it.

    A line contact gives any load Q with a moment between 0 and l Q about its big end.
    """
    system = build_tapered(scene)
    n, d = system.held.shape[1], len(system.freedoms)
    zero = np.zeros((3, n))
    columns, units = np.asarray(system.columns), np.asarray(system.units())

    def approaches(place, motion):
        f, g, flange = system.approaches(jnp.asarray(place), jnp.asarray(motion))
        return np.stack([*np.asarray(f), *np.asarray(f + g * system.line.length), np.asarray(flange)])  # (5, n)

    rows = [approaches(np.eye(3)[:, [k]] * np.ones((1, n)) * units, zero) for k in range(3)]
    matrix = np.zeros((3 * n + d, 5 * n))
    for k in range(3):
        for j in range(n):
            matrix[3 * j + k, 5 * j : 5 * j + 5] = rows[k][:, j] / 1e-5
    for f in range(d):
        moved = approaches(zero, columns[f])
        for j in range(n):
            matrix[3 * n + f, 5 * j : 5 * j + 5] = system.multiplicity * moved[:, j]
    unloaded = system.balance(system._loaded(-jnp.ones((2, n)), jnp.zeros((2, n)), -jnp.ones(n)), system.inertia)
    rollers = np.broadcast_to(np.asarray(unloaded), (3, n)).T.ravel()
    # balance = contact forces' part + unloaded part = 0; sign: contacts enter as + d approach / d unknown
    right = np.concatenate([-rollers, np.asarray(system.ring.load)])
    scale = np.linalg.norm(right)
    found = scipy.optimize.linprog(np.zeros(5 * n), A_eq=matrix, b_eq=right / scale, bounds=(0, None), method="highs")
    return found.status == 0


def runs_away(free):
    """Whether a cone that is free to tilt finds no rest within +-0.1 rad: its moment is beyond what the cone held at
    those tilts asks for. That moment grows with the tilt (the potential is convex), so that a balance asks for more
    tilt still. Returns no for a cone that is held, and where a held solve fails."""
    moment = free.operation.moment
    if moment is None:
        return False
    reactions = []
    for tilt in (-MOST_TILT, MOST_TILT):
        scene = free.at_operation(moment=None, misalignment=tilt)
        system = build_tapered(scene)
        solution = jb.solve(scene, throw=False)
        if not solution.converged:
            return False
        e = solution.elements
        place = jnp.stack([e.roller_shift, e.roller_lift, e.roller_tilt]) / system.units()
        state = system.at(ArrowPoint(place, jnp.stack([solution.ring.axial, solution.ring.radial]) / 1e-5))
        # conjugate to t, which is minus the tilt
        reactions.append(-float(jnp.sum(system.ring_force(state)[2] * jnp.cos(e.azimuth))))
    return not reactions[0] <= float(moment) <= reactions[1]


def campaign(cases, free, seed=0):
    points = random_points(cases, free, seed)
    start = time.time()
    status, steps, residual, finite = solve_points(points, free)
    seconds = time.time() - start
    solved, none = status == Status.CONVERGED, status == Status.NO_EQUILIBRIUM
    single = lambda i: {name: float(value[i]) for name, value in points.items()}
    scene = lambda i: scene_of(single(i), free)
    return {
        "points": points,
        "solved": solved,
        "none": none,
        "other": ~(solved | none),
        "steps": steps,
        "residual": residual,
        "finite": finite,
        "seconds": seconds,
        "contradicted": [i for i in np.flatnonzero(none) if feasible(scene(i)) and not runs_away(scene(i))],
        "ran away": [i for i in np.flatnonzero(none) if feasible(scene(i))],
        "single": single,
    }


if __name__ == "__main__":
    free = "--free" in sys.argv
    count = int(next((a for a in sys.argv[1:] if a.isdigit()), "1000"))
    out = campaign(count, free)
    good = out["solved"]
    print(f"{count} cases: {good.sum()} solved, {out['none'].sum()} no equilibrium, {out['other'].sum()} other")
    print(f"no equilibrium, but linear programming finds a balance: {len(out['contradicted'])}")
    print(f"steps: median {np.median(out['steps'][good])}, most {out['steps'][good].max()}")
    print(f"largest scaled residual {out['residual'][good].max():.1e}; gradients finite: {out['finite'][good].all()}")
    print(f"{out['seconds']:.1f} s with compilation")
    for i in np.flatnonzero(out["other"])[:10]:
        point = out["single"](i)
        print("other:", point, feasible(scene_of(point, free)))
    print(f"balances beyond a tilt of {MOST_TILT} rad: {len(out['ran away'])}")
    for i in out["contradicted"][:5]:
        print("contradicted:", out["single"](i))

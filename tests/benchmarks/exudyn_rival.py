"""Speed AND error of moving balls beside EXUDYN, on a dry ball bearing that both state alike.

    python tests/benchmarks/exudyn_rival.py [--quick] [--case fast|slow] [--python PATH]

The bearing is that of EXUDYN's public example: 14 balls of 8.73 mm, 1 % too large, so that they are preloaded by
218 N; grooves of 1.25 times the radius of a ball; linear contacts of 5e6 N/m; Coulomb friction 0.2 that is linear below
a small sliding speed. The inner ring turns at a constant speed, has a mass and moves in its plane; a radial load of
200 N acts on it from time 0, when all balls roll in the middle. No cage, no oil, no weight, no axial motion. `slow` has
the speed (120 rpm) and the sliding speed (0.01 m/s) of the example, which make friction very stiff; `fast` has
12 500 rpm and 0.5 m/s.

The equations, the integrators and the transposition of forces are the package's. Three laws live here, by which the
same case is stated: the linear contact, the friction, and the exact place of the contact points in the plane
(`PlaneLevers`). The damping is the package's, which EXUDYN has as Hunt and Crossley's model.

An error is the largest one of all coordinates of balls and ring at the end of the run, in fixed axes, of each program
against itself at a tight tolerance; how far both of these are apart is printed. Times are CPU seconds of a run, the
best of several, without building the model and compiling. "Times" is the CPU time of EXUDYN's fastest method that is
as exact, interpolated between its steps or tolerances, over ours.
"""

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, NamedTuple

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--quick", action="store_true", help="0.2 ms, few tolerances, batches of 2")
parser.add_argument("--case", choices=("fast", "slow"), help="one of the two cases")
parser.add_argument(
    "--python",
    default=os.environ.get("EXUDYN_PYTHON", sys.executable),
    help="interpreter of an environment that has exudyn; also the environment variable EXUDYN_PYTHON",
)
arguments = parser.parse_args() if __name__ == "__main__" else parser.parse_args(["--quick"])

SUPPORT = Path(__file__).parents[1] / "support"
sys.path.insert(0, str(SUPPORT))

import equinox as eqx  # noqa: E402
import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
import numpy as np  # noqa: E402
from benchmark_tools import time_at  # noqa: E402
from exudyn_process import ANSWER  # noqa: E402
from jaxtyping import Array, Float  # noqa: E402

from jaxbearing.bearings.ball.kinematics import BallKinematics, RaceMotion  # noqa: E402
from jaxbearing.bearings.ball.motion.bodies import MovingRing, TurningBody  # noqa: E402
from jaxbearing.bearings.ball.motion.energy import WORKS  # noqa: E402
from jaxbearing.bearings.ball.motion.layout import BALL_STATE, GLOBAL_STATE, Places, Rates  # noqa: E402
from jaxbearing.bearings.ball.motion.races import AbstractRaceLaw, Pressed, RaceFriction  # noqa: E402
from jaxbearing.bearings.ball.motion.rates import BallDynamics  # noqa: E402
from jaxbearing.bearings.ball.motion.speeds import Levers, Meridian  # noqa: E402
from jaxbearing.bearings.ball.system import Grooves  # noqa: E402
from jaxbearing.bearings.motion.run import FIELD  # noqa: E402
from jaxbearing.contacts import PointContact  # noqa: E402
from jaxbearing.numerics.arrow import ArrowPoint  # noqa: E402
from jaxbearing.numerics.integrate import integrate_segment  # noqa: E402
from jaxbearing.numerics.integrator import IntegratorOptions, Segment  # noqa: E402
from jaxbearing.numerics.safe import safe_norm  # noqa: E402
from jaxbearing.numerics.series import cosine_and_sine  # noqa: E402
from jaxbearing.numerics.status import Status  # noqa: E402

COUNT, PITCH, NOMINAL = 14, 32.5e-3, 4.365e-3
"""Number of balls; radius of the circle of their centres and nominal radius of a ball, m."""
BALL, GROOVE = 1.01 * NOMINAL, 1.25 * NOMINAL
"""Radius of a ball and of the grooves, m."""
BESIDE = GROOVE - NOMINAL
"""Distance of the circles of groove centres from that of the balls, m."""
MASS, RING_MASS = 7800.0 * 4.0 / 3.0 * np.pi * BALL**3, 0.9
"""Of a ball and of the ring with its shaft, kg."""
STIFFNESS, FRICTION, DAMPING, LOAD = 5e6, 0.2, 0.2, 200.0
"""Of a contact, N/m; Coulomb's coefficient; damping of a contact over its load, s/m; radial load, N."""
RESTITUTION = 0.5
"""With Hunt and Crossley's damping 3/2 k (1 - e)/v, v the smallest speed of impact, that follows from `DAMPING`."""
FIRST = 1e-7
"""First step that is tried, s."""


class Case(NamedTuple):
    """Speed of the inner ring, rad/s; sliding speed below which friction is linear, m/s; duration, s; our methods with
    their tolerances; EXUDYN's methods; a tight method of each."""

    inner_speed: float
    zone: float
    duration: float
    ours: dict[str, tuple[float, ...]]
    theirs: tuple[dict[str, Any], ...]
    tight: tuple[str, float]
    tight_of_theirs: float
    batches: tuple[tuple[str, float], ...]


def of_steps(solver: str, *steps: int) -> tuple[dict[str, Any], ...]:
    return tuple({"solver": solver, "steps": count} for count in steps)


def of_tolerances(*tolerances: float) -> tuple[dict[str, Any], ...]:
    return tuple({"solver": "DOPRI5", "steps": 1, "tolerance": each, "first_step": FIRST} for each in tolerances)


CASES = {
    "fast": Case(
        inner_speed=12500.0 * np.pi / 30.0,
        zone=0.5,
        duration=5e-3,
        ours={"tsit5": (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7), "dopri8": (1e-2, 1e-3, 1e-4, 1e-6)},
        theirs=(
            *of_steps("VelocityVerlet", 500, 1000, 3000),
            *of_steps("RK44", 400, 500, 700, 1000),
            *of_steps("RK67", 400, 500, 700, 1000),
            *of_tolerances(1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8),
            *of_steps("GeneralizedAlpha", 100, 300, 1000, 3000),
            *of_steps("TrapezoidalIndex2", 100, 300, 1000),
        ),
        tight=("dopri8", 1e-11),
        tight_of_theirs=1e-10,
        batches=(("tsit5", 1e-2), ("tsit5", 1e-3), ("tsit5", 1e-4), ("tsit5", 1e-6), ("dopri8", 1e-4)),
    ),
    "slow": Case(
        inner_speed=120.0 * np.pi / 30.0,
        zone=0.01,
        duration=50e-3,
        ours={"kvaerno5": (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)},
        theirs=(
            *of_steps("GeneralizedAlpha", 100, 300, 1000, 3000, 10000, 30000),
            *of_steps("TrapezoidalIndex2", 100, 300, 1000, 3000, 10000),
            *of_tolerances(1e-4),
        ),
        tight=("kvaerno5", 1e-9),
        tight_of_theirs=1e-7,
        batches=(("kvaerno5", 1e-4),),
    ),
}
QUICK = 2e-4
"""Duration of quick runs, s."""
REPEATS = 3


class DryRaces(AbstractRaceLaw):
    r"""Linear contacts, $Q = k\max(\delta, 0)$, and Coulomb friction, $F = -\mu Q\,u/\max(|u|, v_0)$, at a point: no
    moment resists the spin.

    **Arguments:** `contact`: shape of the contacts, which nothing here depends on; `stiffness`, N/m;
    `friction_coefficient`; `zone`: v_0, m/s.
    """

    contact: PointContact
    stiffness: Float[Array, ""]
    friction_coefficient: Float[Array, ""]
    zone: Float[Array, ""]

    def pressed(self, approach: Float[Array, "2 ball"], meridian: Meridian, races: RaceMotion) -> Pressed:
        return Pressed(self.stiffness * jnp.maximum(approach, 0.0), self.contact, None)

    def friction(self, pressed: Pressed, load: Float[Array, "2 ball"], races: RaceMotion) -> RaceFriction:
        speed = jnp.maximum(safe_norm(races.rolling, races.transverse), self.zone)
        rate = -self.friction_coefficient * load / speed
        return RaceFriction(rate * races.rolling, rate * races.transverse, jnp.zeros_like(rate))


class PlaneLevers(Levers):
    """Speeds of contacts for a ring that moves in its plane, without two simplifications of the package: the contact
    lies in the middle of the compression, and distances from the axis of the displaced ring are exact."""

    def around(self, places: Places) -> tuple[Array, Array, Array]:
        """Distance of each ball from the axis of the inner ring, m, and the direction of that distance: (outward, along
        the orbit) of the ball."""
        cosine, sine = cosine_and_sine(places.azimuth)
        _, dy, dz, _, _ = places.ring
        outward, along = places.radius - dy * cosine - dz * sine, dy * sine - dz * cosine
        distance = jnp.hypot(outward, along)
        return distance, outward / distance, along / distance

    def meridian(self, places: Places) -> Meridian:
        plain = super().meridian(places)
        axial, radial = plain.sine[0] * plain.distance[0], self.grooves.lever - self.around(places)[0]
        distance = safe_norm(axial, radial)
        put = lambda values, inner: jnp.stack([inner, values[1]])
        return Meridian(
            put(plain.sine, axial / distance),
            put(plain.cosine, radial / distance),
            put(plain.distance, distance),
            plain.wedge,
        )

    def race_speeds(self, places: Places, meridian: Meridian, rates: Rates) -> tuple[Array, RaceMotion]:
        apart, races = super().race_speeds(places, meridian, rates)
        half = 0.5 * (meridian.distance - self.grooves.offset[:, None])
        distance, outward, along = self.around(places)
        cosine, sine = cosine_and_sine(places.azimuth)
        d_x, d_y, d_z, _, _ = rates.ring
        x, r = rates.centre
        # of the ball's centre over the ring's, outward and along the orbit
        v_r, v_t = r - d_y * cosine - d_z * sine, places.radius * rates.orbit + d_y * sine - d_z * cosine
        closing = (d_x - x) * meridian.sine[0] - (outward * v_r + along * v_t) * meridian.cosine[0]
        arm = (self.ball_radius - half[0]) * meridian.cosine[0]
        turning = (rates.orbit - rates.spin[0]) * arm + rates.races[0] * (distance - arm)
        rolling = jnp.stack([outward * v_t - along * v_r - turning, (races.rolling - half * races.roll)[1]])
        transverse = races.transverse + half * rates.spin[2][None]
        return apart.at[0].set(closing), races._replace(rolling=rolling, transverse=transverse)


def equations(case: Case, levers: type[Levers] = PlaneLevers) -> BallDynamics:
    """The bearing in motion."""
    zero, one, lever = jnp.zeros(()), jnp.ones(()), jnp.asarray(PITCH + BESIDE)
    grooves = Grooves(
        offset=jnp.full(2, GROOVE - BALL),
        stiffness=jnp.full(2, STIFFNESS),
        centre_distance=jnp.asarray(2.0 * BESIDE),
        free_cosine=one,
        free_sine=zero,
        aligned=zero,
        lever=lever,
        groove_arm=jnp.asarray(GROOVE),
    )
    shape = [
        np.array([[1.0 / (1.0 / BALL + side / (PITCH - side * BALL))] for side in (1.0, -1.0)]),
        np.full((2, 1), 1.0 / (1.0 / BALL - 1.0 / GROOVE)),
        np.full((2, 1), 207e9 / (1.0 - 0.3**2)),
    ]
    return BallDynamics(
        kinematics=BallKinematics(*map(jnp.asarray, (case.inner_speed, 0.0, 2.0 * PITCH, 2.0 * BALL))),
        levers=levers(grooves, jnp.asarray(BALL), jnp.asarray(PITCH)),
        azimuth=jnp.asarray(2.0 * np.pi * np.arange(COUNT) / COUNT),
        mass=jnp.asarray(MASS),
        inertia=jnp.asarray(0.4 * MASS * BALL**2),
        races=DryRaces(PointContact(*map(jnp.asarray, shape)), *map(jnp.asarray, (STIFFNESS, FRICTION, case.zone))),
        contact_damping=jnp.asarray(DAMPING),
        free_offset=zero,
        free_radius=jnp.asarray(BESIDE),
        ring=MovingRing(
            TurningBody(jnp.asarray(RING_MASS), one, one),
            jnp.zeros(5).at[1].set(LOAD),
            jnp.zeros(5),
            zero,
            lever,
            (False, True, True, False, False),
        ),
        reference_speed=jnp.asarray(rolling(case)[0]),
    )


def rolling(case: Case) -> tuple[float, float]:
    """Orbit and spin, rad/s, of balls that roll on both races of the ring in the middle."""
    arm = BALL - 0.5 * (BALL - NOMINAL)
    # arm spin = orbit (PITCH + arm) = (inner_speed - orbit) (PITCH - arm)
    orbit = case.inner_speed * (PITCH - arm) / (2.0 * PITCH)
    return orbit, orbit * (PITCH + arm) / arm


def beginning(case: Case, of: BallDynamics) -> ArrowPoint:
    """State at time 0."""
    balls = np.zeros((len(BALL_STATE), COUNT))
    balls[BALL_STATE.index("u_x")] = BALL * rolling(case)[1]
    return of.scaled(jnp.asarray(balls), jnp.zeros(len(GLOBAL_STATE)))


def advance(of: BallDynamics, state: ArrowPoint, duration: Array, options: IntegratorOptions) -> Segment:
    first = jnp.asarray(FIRST)
    return integrate_segment(FIELD, state, jnp.zeros(()), duration[None], of, options, first, idle=len(WORKS))


ours = eqx.filter_jit(advance)


def in_space(
    of: BallDynamics, time_: float, state: ArrowPoint
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Places, m, speeds, m/s, and angular speeds, rad/s, of the balls, and the place of the ring, m, in fixed axes."""
    places, rates = of.moving(time_, state)
    psi, radius, orbit, centre, spin = map(
        np.asarray, (places.azimuth, places.radius, rates.orbit, rates.centre, rates.spin)
    )
    zero = np.zeros(COUNT)
    e_x, e_r = np.stack([zero + 1.0, zero, zero]), np.stack([zero, np.cos(psi), np.sin(psi)])
    e_t = np.stack([zero, -np.sin(psi), np.cos(psi)])
    place = np.asarray(places.offset) * e_x + radius * e_r
    speed = centre[0] * e_x + centre[1] * e_r + radius * orbit * e_t
    turning = (orbit - spin[0]) * e_x + spin[1] * e_r + spin[2] * e_t
    return place.T, speed.T, turning.T, np.asarray(places.ring[:3])


def coordinates(of: BallDynamics, case: Case, run: Segment) -> np.ndarray:
    """Places of the balls and of the ring at the end, m."""
    assert int(run.status) == Status.CONVERGED
    place, _, _, ring = in_space(of, case.duration, run.last)
    return np.append(place.ravel(), ring)


def for_exudyn(case: Case, of: BallDynamics, state: ArrowPoint) -> dict[str, Any]:
    """The case in EXUDYN's words."""
    place, speed, turning, _ = in_space(of, 0.0, state)
    return {
        "inner_speed": case.inner_speed,
        "radial_load": LOAD,
        "ring_mass": RING_MASS,
        "ball_mass": MASS,
        "ball_radius": BALL,
        "groove_radius": GROOVE,
        "pitch_radius": PITCH,
        "inner_circle": PITCH + BESIDE,
        "outer_circle": PITCH - BESIDE,
        "dynamicFriction": FRICTION,
        "frictionProportionalZone": case.zone,
        "contactStiffness": STIFFNESS,
        "restitutionCoefficient": RESTITUTION,
        "minimumImpactVelocity": 1.5 * (1.0 - RESTITUTION) / DAMPING,
        "places": place.tolist(),
        "speeds": speed.tolist(),
        "turning": turning.tolist(),
        "duration": case.duration,
    }


def installed(python: str) -> bool:
    """True if the interpreter has EXUDYN."""
    return subprocess.run([python, "-c", "import exudyn"], capture_output=True).returncode == 0


def ask(python: str, **question: Any) -> Any:
    """Answer of a process with EXUDYN."""
    command = [python, str(SUPPORT / "exudyn_process.py")]
    done = subprocess.run(command, input=json.dumps(question), capture_output=True, text=True)
    said, mark, answer = done.stdout.rpartition(ANSWER)
    if not mark:
        raise RuntimeError(f"EXUDYN gave no answer: {(said + answer + done.stderr)[-2000:]}")
    return json.loads(answer)


def cpu_time(run: Any, repeats: int) -> tuple[float, float]:
    """Least CPU and wall time of a call, s. The machine may be busy: CPU seconds are those to compare."""
    best = np.inf, np.inf
    for _ in range(repeats):
        begin, used = time.perf_counter(), time.process_time()
        jax.block_until_ready(run())
        best = min(best[0], time.process_time() - used), min(best[1], time.perf_counter() - begin)
    return best


class Row(NamedTuple):
    """One run: name of the method, tolerance or number of steps, steps, error, m, CPU and wall time, s, and by how many
    times EXUDYN takes longer (`None`: it is never as exact, or the row is EXUDYN's)."""

    method: str
    setting: float
    steps: int | None
    error: float
    cpu: float
    wall: float
    times: float | None = None


def _said(row: Row) -> Row:
    print(*(f"{value:.3g}" if isinstance(value, float) else value for value in row), file=sys.stderr, flush=True)
    return row


def batch(case: Case, of: BallDynamics, state: ArrowPoint, solver: Any, size: int) -> Any:
    """A compiled batch of runs at loads from 90 % to 110 %, as a function of the tolerance."""

    def one(share: Array, tolerance: Array) -> Segment:
        loaded = eqx.tree_at(lambda given: given.ring.load, of, share * of.ring.load)
        options = IntegratorOptions(solver=solver, tolerance=tolerance)
        return advance(loaded, state, jnp.asarray(case.duration), options)

    program = jax.jit(jax.vmap(one, in_axes=(0, None)))
    return lambda tolerance: program(jnp.linspace(0.9, 1.1, size), jnp.asarray(tolerance))


class Figures(NamedTuple):
    """Results of a case: EXUDYN's version; rows of both; CPU seconds of the first call of each of our methods; how far
    the tight runs are apart, m, and how far with the package's levers (`None`: not looked at); how far the ring moved,
    m; of each batch, by (solver, tolerance): CPU and wall seconds a run, failed lanes, error, m, and times."""

    exudyn: str
    rows: list[Row]
    first: dict[str, float]
    apart: float
    plain: float | None
    moved: float
    batches: dict[tuple[str, float], tuple[float, float, int, float, float | None]]


def benchmark(name: str, python: str, quick: bool = False) -> Figures:
    """Figures of one case."""
    case = CASES[name]
    if quick:
        case = case._replace(
            duration=QUICK,
            ours={solver: tolerances[2:4] for solver, tolerances in case.ours.items()},
            theirs=of_steps("GeneralizedAlpha", 100, 200) if name == "slow" else of_tolerances(1e-5, 1e-7),
            tight_of_theirs=1e-9,
            batches=case.batches[-1:],
        )
    of = equations(case)
    state, duration, repeats = beginning(case, of), jnp.asarray(case.duration), 1 if quick else REPEATS
    options = lambda solver, tolerance: IntegratorOptions(solver=solver, tolerance=tolerance)
    begin = time.process_time()
    exact = coordinates(of, case, ours(of, state, duration, options(*case.tight)))
    first, errors = {case.tight[0]: time.process_time() - begin}, {}

    given = for_exudyn(case, of, state)
    at_end = lambda answer: np.append(np.ravel(answer["balls"]), answer["ring"])
    tight = ask(python, asked="run", case=given, method=of_tolerances(case.tight_of_theirs)[0], repeats=1)
    assert tight["success"]
    theirs = at_end(tight)
    difference = lambda one: float(np.max(np.abs(one - theirs)))
    plain = None
    if name == "fast":
        simple = equations(case, Levers)
        plain = difference(coordinates(simple, case, ours(simple, state, duration, options(*case.tight))))

    rows, points = [], {}
    for method in case.theirs:
        answer = ask(python, asked="run", case=given, method=method, repeats=repeats)
        solver = f"EXUDYN {method['solver']}"
        error = difference(at_end(answer)) if answer["success"] else np.inf
        setting, steps = method.get("tolerance", method["steps"]), None if "tolerance" in method else method["steps"]
        rows.append(_said(Row(solver, setting, steps, error, answer["cpu"], answer["wall"])))
        points.setdefault(solver, []).append((error, answer["cpu"]))

    def over(error: float, cpu: float) -> float | None:
        """Time of EXUDYN's fastest method over a time of ours."""
        found = [each for each in (time_at(error, method) for method in points.values()) if each is not None]
        return min(found) / cpu if found else None

    for solver, tolerances in case.ours.items():
        for tolerance in tolerances:
            call = lambda solver=solver, tolerance=tolerance: ours(of, state, duration, options(solver, tolerance))
            begin = time.process_time()
            run = jax.block_until_ready(call())
            first.setdefault(solver, time.process_time() - begin)
            error = float(np.max(np.abs(coordinates(of, case, run) - exact)))
            cpu, wall = cpu_time(call, repeats)
            steps = int(run.accepted) + int(run.rejected)
            rows.append(_said(Row(solver, tolerance, steps, error, cpu, wall, over(error, cpu))))
            errors[solver, tolerance] = error
    batches, programs, size = {}, {}, 2 if quick else 64
    for solver, tolerance in case.batches:
        program = programs.setdefault(solver, batch(case, of, state, solver, size))
        failed = int(np.sum(np.asarray(program(tolerance).status) != Status.CONVERGED))
        cpu, wall = (each / size for each in cpu_time(lambda p=program, t=tolerance: p(t), min(repeats, 2)))
        error = errors[solver, tolerance]
        batches[solver, tolerance] = cpu, wall, failed, error, over(error, cpu)
        print("batch", solver, tolerance, *batches[solver, tolerance], file=sys.stderr, flush=True)
    moved = float(np.linalg.norm(exact[-3:]))
    return Figures(tight["version"], rows, first, difference(exact), plain, moved, batches)


def print_figures(name: str, figures: Figures) -> None:
    print(f"{name}: EXUDYN {figures.exudyn}, jax {jax.__version__}, {jax.devices()[0].platform}")
    print(f"Tight runs of both are {figures.apart:.1e} m apart; the ring moves {figures.moved:.3e} m.")
    if figures.plain is not None:
        print(f"With the package's own levers they are {figures.plain:.1e} m apart.")
    said = ", ".join(f"{solver} {seconds:.0f} s" for solver, seconds in figures.first.items())
    print(f"CPU seconds of the first call: {said}.")
    print("| method | tolerance or steps | steps | error, m | CPU, s | wall, s | times |")
    print("|---|---|---|---|---|---|---|")
    for row in figures.rows:
        times = "" if row.times is None else f"{row.times:.1f}"
        steps = "" if row.steps is None else row.steps
        print(
            f"| {row.method} | {row.setting:g} | {steps} | {row.error:.1e} | {row.cpu:.4f} | {row.wall:.4f} | {times} |"
        )
    for (solver, tolerance), (cpu, wall, failed, error, ratio) in figures.batches.items():
        times = "" if ratio is None else f", {ratio:.1f} times"
        print(
            f"batch, {solver} {tolerance:.0e}: {cpu:.5f} s CPU, {wall:.5f} s wall a run, error {error:.1e} m{times}, "
            f"{failed} failed"
        )


def print_lean(python: str) -> None:
    case = CASES["fast"]
    of = equations(case)
    azimuths = np.radians([0.0, 45.0, 115.0])
    given = for_exudyn(case, of, beginning(case, of))
    found = ask(python, asked="lean", case=given, offset=1e-4, azimuths=azimuths.tolist())
    print("EXUDYN's force on a ball at rest, 0.1 mm beside the middle of the outer groove, without friction:")
    for azimuth, (outward, along, axial) in zip(np.degrees(azimuths), found, strict=True):
        print(f"at {azimuth:.0f} deg: {outward:.2f} N outward, {along:.2f} N along the orbit, {axial:.2f} N axial")


if __name__ == "__main__":
    if not installed(arguments.python):
        sys.exit(f"EXUDYN is not installed for {arguments.python}: pip install '.[rivals]', or give --python")
    print_lean(arguments.python)
    for each in (arguments.case,) if arguments.case else CASES:
        print_figures(each, benchmark(each, arguments.python, arguments.quick))

"""Errors of sign and constant, made by hand in the physics one at a time: does the default test run see them?

    python tests/mutations.py            # all of them, after 0: the unchanged package, whose tests must pass
    python tests/mutations.py 3 17       # these

Each is made in a copy of the repository, where the test files run that ought to catch it. pytest does not collect this
file; `test_mutations.py` watches that the list still fits the code.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
LIMIT = 900
"""Seconds for the tests of one error."""


class Mutation(NamedTuple):
    """`file`, the text that stands in it once, `new` text, `what` is wrong then, `tests`: files, by their beginning."""

    file: str
    old: str
    new: str
    what: str
    tests: str


M = Mutation
# fmt: off
# ruff: noqa: E501 (one error a line)
MUTATIONS = (
    M("jaxbearing/contacts/line.py", "8.0 / jnp.pi * load", "4.0 / jnp.pi * load", "Hertz line contact: width with E* for E'", "contacts/test_line.py"),
    M("jaxbearing/contacts/line.py", "** 0.9 / self.length**0.8", "** 0.9 / self.length**0.9", "Palmgren: exponent of the length", "contacts/test_line.py"),
    M("jaxbearing/contacts/point.py", "2.0 / 9.0 * _second_kind", "4.0 / 9.0 * _second_kind", "Hertz point contact: stiffness", "contacts/test_point.py"),
    M("jaxbearing/contacts/film.py", "jnp.log(2.621) - 0.2", "jnp.log(2.612) - 0.2", "Moes' film: digits of a constant swapped", "contacts/test_film.py"),
    M("jaxbearing/contacts/film.py", "3.06, 0.69, 0.56, -0.10", "3.06, 0.69, 0.56, -0.11", "Dowson-Toyoda film: exponent of the load", "contacts/test_film.py"),
    M("jaxbearing/contacts/thermal.py", "1.0 - 13.2 * severity", "1.0 - 12.3 * severity", "Gupta's thermal factor: digits swapped", "contacts/test_thermal.py"),
    M("jaxbearing/contacts/traction.py", "log_modulus - jnp.log(half_width)", "log_modulus - jnp.log(2.0 * half_width)", "Maxwell correction: transit of the whole width", "contacts/test_traction.py"),
    M("jaxbearing/contacts/viscous.py", "return -sign * jnp.log1p(-size)", "return sign * jnp.log1p(size)", "Bair-Winer: no limiting stress", "contacts/test_viscous.py"),
    M("jaxbearing/contacts/distributed.py", "                stress = 2.0 * middle - stress\n", "                stress = middle\n", "Traction march: half a relaxation step", "contacts/test_distributed.py"),
    M("jaxbearing/contacts/distributed.py", "self.half_width - sums.rolling * self.strips.offset", "self.half_width + sums.rolling * self.strips.offset", "Spin moment: sign of one part", "contacts/test_distributed.py"),
    M("jaxbearing/contacts/heating.py", "self.conductance = 6.0 * conductivity", "self.conductance = 12.0 * conductivity", "Heat of the film: all of it into each surface", "contacts/test_heating.py"),
    M("jaxbearing/contacts/point_rolling.py", "0.022 * log_viscous - 0.35", "0.022 * log_viscous - 0.33", "Rolling moment of a point contact: exponent", "contacts/test_point.py"),
    M("jaxbearing/lubricants/simple_viscosity.py", "LOG_ROELANDS_VISCOSITY = -9.67", "LOG_ROELANDS_VISCOSITY = -9.76", "Roelands: digits swapped", "lubricants/test_viscosity_laws.py"),
    M("jaxbearing/lubricants/rheology.py", "pressure + self.stress_temperature * inverse", "pressure - self.stress_temperature * inverse", "Eyring stress: sign of its temperature coefficient", "lubricants/test_properties.py"),
    M("jaxbearing/gaps/martin.py", "load=6.0 * (speed * sin2 - squeeze * i2)", "load=6.0 * (speed * sin2 + squeeze * i2)", "Martin film: sign of the squeeze", "gaps/test_martin_and_pocket.py"),
    M("jaxbearing/gaps/pocket.py", "+ 0.13 * jnp.log(modulus * radius", "- 0.13 * jnp.log(modulus * radius", "Pocket face: sign of an exponent of the elastic film", "gaps/test_martin_and_pocket.py"),
    M("jaxbearing/gaps/journal.py", "return -shear - couple, shear - couple", "return -shear - couple, shear + couple", "Land: couple of the offset film on the bush", "gaps/test_turbulence_and_journal.py"),
    M("jaxbearing/gaps/couette.py", "self.side_clearance + height * jnp.tan", "self.side_clearance - height * jnp.tan", "Flange: film closes outwards", "gaps/test_couette_and_drag.py"),
    M("jaxbearing/gaps/drag.py", "(rpm * diameter**1.7)", "(rpm * diameter**1.5)", "Parker's oil fraction: exponent of the diameter", "gaps/test_couette_and_drag.py"),
    M("jaxbearing/bearings/cylindrical/forces.py", "+ rolling[0] * lean[0] - rolling[1] * lean[1]", "+ rolling[0] * lean[0] + rolling[1] * lean[1]", "Roller: rolling resistance at the outer race pushes forward", "bearings/cylindrical/test_roller_balances.py bearings/cylindrical/test_roller_scene.py"),
    M("jaxbearing/bearings/cylindrical/motion/cage_forces.py", "jnp.stack([rate, -rate])", "jnp.stack([-rate, rate])", "Moving roller: pocket films squeezed the wrong way", "bearings/motion/test_roller_dynamics.py campaign/test_moving_roller.py"),
    M("jaxbearing/bearings/cylindrical/motion/energy.py", "lever = jnp.sum(push * arm * now.orbit)", "lever = -jnp.sum(push * arm * now.orbit)", "Moving roller: energy audit, sign of one work", "bearings/motion/test_roller_dynamics.py campaign/test_moving_roller.py"),
    M("jaxbearing/bearings/ball/friction.py", "radius = radius + couple * motion.transverse", "radius = radius - couple * motion.transverse", "Ball: sign of the gyroscopic couple about the radius", "bearings/ball/test_ball_options.py bearings/ball/test_ball_laws.py"),
    M("jaxbearing/bearings/ball/system.py", "0.5 * self.mass * self.kinematics.pitch_diameter", "self.mass * self.kinematics.pitch_diameter", "Ball: centrifugal force with the diameter for the radius", "bearings/ball/test_ball_core.py"),
    M("jaxbearing/bearings/ball/kinematics.py", "100.0 * (inner - attitude)", "100.0 * (attitude - outer)", "Race control: counted from the other race", "bearings/ball/test_ball_laws.py bearings/ball/test_ball_check_values.py"),
    M("jaxbearing/bearings/tapered/geometry.py", "jnp.sin(self.rib_angle) / self.flange_radius", "jnp.cos(self.rib_angle) / self.flange_radius", "Tapered roller: curvature of the rib", "bearings/tapered/test_tapered_roller.py"),
    M("jaxbearing/bearings/cylindrical/tilting.py", "0.5 * self.line.length * turn - out", "-0.5 * self.line.length * turn - out", "Tilting roller: sign of the ring's tilt", "bearings/cylindrical/test_tilting_rollers.py"),
    M("jaxbearing/life/modification.py", "0.4, -9.185)", "0.4, -9.158)", "a_ISO of roller bearings: digits swapped", "life/test_ratings.py"),
    M("jaxbearing/ehl/equations.py", "m[1:] - jnp.concatenate([behind", "m[1:] + jnp.concatenate([behind", "Reynolds: upwind mass flow of a reversed contact", "ehl/test_steady.py ehl/test_runs.py"),
    M("fitting/uncertainty.py", "informative(jacobian, free) - len(indices)", "informative(jacobian, free)", "Rheology fit: degrees of freedom of the intervals", "fitting/test_fit.py"),
)
# fmt: on


class Outcome(NamedTuple):
    """How a run of tests ended: the first test that failed, or "" where none did; whether the tests could run."""

    failed: str
    ran: bool
    seconds: float


def tried(mutation: Mutation | None, tests: str) -> Outcome:
    """Run test files in a copy of the repository with one error, or with none."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "repository"
        unneeded = shutil.ignore_patterns(".git", ".venv*", ".*_cache", "__pycache__", "notebooks", "site")
        shutil.copytree(ROOT, copy, ignore=unneeded)
        # compiled programs, keyed by what they compute: an error compiles its own
        (ROOT / ".pytest_cache").mkdir(exist_ok=True)
        (copy / ".pytest_cache").symlink_to(ROOT / ".pytest_cache", target_is_directory=True)
        if mutation is not None:
            path = copy / mutation.file
            path.write_text(path.read_text(encoding="utf-8").replace(mutation.old, mutation.new), encoding="utf-8")
        command = [sys.executable, "-m", "pytest", "-m", "not slow", "-x", "-q", "--tb=no", "-p", "no:cacheprovider"]
        command += [f"tests/{name}" for name in tests.split()]
        environment = os.environ | {"PYTHONPATH": str(copy), "PYTHONDONTWRITEBYTECODE": "1"}
        begin = time.monotonic()
        try:
            run = subprocess.run(
                command, cwd=copy, env=environment, capture_output=True, text=True, timeout=LIMIT, check=False
            )
        except subprocess.TimeoutExpired:
            return Outcome("", False, time.monotonic() - begin)
    # what goes wrong in the preparation of a test (ERROR) is no test that failed
    failed = re.search(r"^FAILED tests/(\S+?::.*?)(?: - |$)", run.stdout, re.MULTILINE)
    ran = run.returncode == 0 or failed is not None
    if not ran:
        print(run.stdout[-2000:], run.stderr[-2000:], sep="\n")
    return Outcome(failed[1] if failed else "", ran, time.monotonic() - begin)


def main(numbers: list[int]) -> int:
    """Print a line for each, and a table; 1 where one survived or could not be tried."""
    found = {}
    for number in numbers:
        mutation = MUTATIONS[number - 1] if number else None
        every = " ".join(sorted({name for one in MUTATIONS for name in one.tests.split()}))
        outcome = found[number] = tried(mutation, mutation.tests if mutation else every)
        what = mutation.what if mutation else "nothing changed"
        verdict = "caught" if outcome.failed else "SURVIVED" if outcome.ran else "BROKEN"
        if number == 0:
            verdict = "passed" if outcome.ran and not outcome.failed else "FAILED"
        print(f"{number:2d} {verdict:8s} {outcome.seconds:4.0f} s  {what}: {outcome.failed}", flush=True)
    print("\n| | error | file | caught by |\n|---|---|---|---|")
    for number, outcome in found.items():
        if number:
            mutation = MUTATIONS[number - 1]
            file = mutation.file.removeprefix("jaxbearing/")
            print(f"| {number} | {mutation.what} | `{file}` | {f'`{outcome.failed}`' if outcome.failed else '-'} |")
    caught = sum(bool(outcome.failed) for number, outcome in found.items() if number)
    print(f"\n{caught} of {len(found) - (0 in found)} caught")
    sound = 0 not in found or (found[0].ran and not found[0].failed)
    return int(caught < len(found) - (0 in found) or not sound)


if __name__ == "__main__":
    sys.exit(main([int(text) for text in sys.argv[1:]] or list(range(len(MUTATIONS) + 1))))

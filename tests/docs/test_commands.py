"""Every command line of README and docs runs as it is printed, page by page, as a reader would type it.

With made up results (`filled_results`) all but the solvers is real: reading, `--set` paths, options, files, pictures,
screen; commands whose options others have shown are only read. The slow test runs all, with the solvers too; it
shortens transient runs and sweeps.
"""

import dataclasses
import functools
import json
import re
import shlex
import shutil
import sys
import warnings
from pathlib import Path

import fit_results
import jax
import jax.numpy as jnp
import pytest
from filled_results import MadeUpProgram, history_of, slopes_of, solution_of
from typer.main import get_command

import jaxbearing as jb
from fitting import fit as _fit  # noqa: F401  (the module of this name is in sys.modules)
from jaxbearing import CylindricalRollerBearing, EHLLineContact
from jaxbearing.cli.main import app, main
from jaxbearing.scenes.overrides import split_assignments
from jaxbearing.sensitivity import Sensitivities
from jaxbearing.sweeps import engine
from jaxbearing.sweeps.cases import Cases

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
MANY = ("docs/sweeps.md", "docs/using.md", "docs/worked_examples.md")
"""Pages with so many commands that they take several seconds even without the solvers."""
FEW = 12
"""Cases of a sweep that are solved here, at most; of a grid so many along each axis that it has not more."""
SHORT = 2e-5
"""Duration of a transient run with its solver, s."""


def commands_of(text):
    """Arguments of all commands of a page: lines of shell blocks, and code spans that name a scene or a file."""
    found = []
    for language, block in re.findall(r"^```(\w*)\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL):
        if language in ("", "sh", "bash", "console"):
            found += [part for line in block.splitlines() for part in _programs(line)]
    prose = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    spans = (" ".join(span.split()) for span in re.findall(r"`([^`]+)`", prose))
    return found + [part for span in spans if re.match(r"jaxbearing \w+ [^-\s]", span) for part in _programs(span)]


def _programs(line):
    """Arguments of `jaxbearing` in a shell line, without what is set or run before it."""
    words = shlex.split(line, comments=True)
    while "&&" in words:
        words = words[words.index("&&") + 1 :]
    words = words[next((i for i, word in enumerate(words) if not re.match(r"[A-Z_]+=", word)), 0) :]
    return [words[1:]] if words and Path(words[0]).name == "jaxbearing" and words[1:] else []


COMMANDS = {page.relative_to(ROOT).as_posix(): commands_of(page.read_text(encoding="utf-8")) for page in PAGES}


def once(commands):
    """By page, each command where it stands first."""
    found, done = {}, []
    for page, lines in commands.items():
        found[page] = []
        for arguments in lines:
            if arguments not in done:
                found[page].append(arguments)
                done.append(arguments)
    return {page: lines for page, lines in found.items() if lines}


ONCE = once(COMMANDS)


def telling(commands):
    """Commands with an option that none of their verb before them has, and those that write scenes for others."""
    chosen, shown = [], set()
    for arguments in (words for lines in commands.values() for words in lines):
        verb, *words = arguments
        options = {(verb, word) for word in words if word.startswith("--")} | {verb}
        if not options <= shown or verb == "new":
            chosen.append(arguments)
        shown |= options
    return chosen


TELLING = telling(ONCE)


def test_commands_are_found():
    assert len(COMMANDS["README.md"]) > 4
    assert ["solve", "misaligned.toml"] in COMMANDS["docs/life.md"]
    assert sum(map(len, COMMANDS.values())) > 50


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Where a reader works, with the files that the pages show or describe."""
    names = ("fitting", "life", "spectrum", "calibration", "worked_examples")
    fitting, life, spectrum, calibration, worked = (ROOT / "docs" / f"{name}.md" for name in names)
    (displacements,) = re.findall(r"```csv\n(.*?)```", calibration.read_text(encoding="utf-8"), flags=re.DOTALL)
    (curves,) = re.findall(r"```csv\n(.*?)```", fitting.read_text(encoding="utf-8"), flags=re.DOTALL)
    (scene,) = re.findall(r"```toml\n(.*?)```", life.read_text(encoding="utf-8"), flags=re.DOTALL)
    (duty,) = re.findall(r"```toml\n(.*?)```", spectrum.read_text(encoding="utf-8"), flags=re.DOTALL)
    (pair,) = re.findall(r"```toml\n(.*?)```", worked.read_text(encoding="utf-8"), flags=re.DOTALL)
    files = {
        "pair.toml": pair,
        "duty.toml": duty,
        "curves.csv": curves,
        "displacements.csv": displacements,
        "candidates.csv": "operation.radial_load [kN]\n0.1\n1\n8\n",
        "misaligned.toml": scene,
        "cases.csv": "operation.inner_speed [rpm],operation.radial_load [kN]\n8000,20\n10000,25\n",
        "run_up.csv": "time [ms],speed [rpm]\n0,8000\n10,9000\n50,10500\n",
    }
    shutil.copytree(ROOT / "docs" / "examples", tmp_path / "docs" / "examples")
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.setenv("JAXBEARING_CACHE", "off")
    return tmp_path


@pytest.fixture
def one_process(monkeypatch):
    """No other processes, and few cases of grids and samples: the plan is made as the command says, then cut."""
    run = engine.run
    few = lambda plan, *given, **more: run(dataclasses.replace(plan, cases=_few(plan.cases)), *given, **more)
    monkeypatch.setattr(engine, "run", few)
    monkeypatch.setattr("jaxbearing.sweeps.verb.on_workers", lambda *_: engine.in_process())


def measured_values(base, conditions, fields, active, wanted, options):
    """Results that each field changes in its own way, and their slopes."""
    paths = sorted(fields)
    start = jnp.stack([functools.reduce(getattr, path.split("."), base) for path in paths])
    given = jnp.stack([fields[path] for path in paths], axis=1)
    load = sum(values / 4e3 for values in conditions.values())

    def one(values, load):
        shares = 0.3 + 0.4 * jnp.arange(float(len(paths))) * load
        return 2e-5 * (1.0 + load + shares @ jnp.log(values / start)) * jnp.ones(len(wanted))

    slopes = jnp.swapaxes(jax.vmap(jax.jacfwd(one))(given, load), 1, 2)
    return jax.vmap(one)(given, load), slopes, active


def _few(cases):
    if cases.kind == "list":
        return cases
    if cases.kind == "grid":
        along = max(1, round(FEW ** (1.0 / len(cases.paths))))
        return Cases(cases.kind, cases.paths, tuple(values[:along] for values in cases.values))
    return Cases(cases.kind, cases.paths, tuple(values[:FEW] for values in cases.values))


@pytest.fixture
def made_up(monkeypatch, one_process):
    """Results of every solver without a solve."""

    def slopes(scene, throw, of=None):
        numbers = {"operation.inner_speed": jnp.asarray(1.0), "geometry.pitch_diameter": jnp.asarray(-0.5)}
        return solution_of(scene), Sensitivities(numbers, numbers)

    run = lambda scene, duration, **_: history_of(scene, duration or scene.simulation.duration)
    monkeypatch.setattr(jb, "simulate", jb.simulate)  # a command that loads the verbs meanwhile takes what is made up
    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solution_of)
    monkeypatch.setattr(sys.modules["jaxbearing.sensitivity"], "sensitivities", slopes)
    monkeypatch.setattr(sys.modules["jaxbearing.simulate"], "simulate", run)
    # a made up state is that of no bearing
    for kind in (CylindricalRollerBearing, EHLLineContact):
        monkeypatch.setattr(kind, "check_restart", lambda *_: None)
    for module in ("sweeps.plan", "spectrum.verb"):
        monkeypatch.setattr(f"jaxbearing.{module}.LaneProgram", MadeUpProgram)
    monkeypatch.setattr("jaxbearing.tolerance.verb.slopes_at", slopes_of)
    fit = lambda measurements, machine, options: fit_results.made_up(machine, "curves.csv")
    monkeypatch.setattr(sys.modules["fitting.fit"], "fit", fit)
    monkeypatch.setattr("jaxbearing.calibration.evaluation._kept_points", measured_values)


@pytest.fixture
def shortened(monkeypatch, one_process):
    """Solvers as they are; transient runs are short."""
    simulate = jb.simulate
    monkeypatch.setattr(jb, "simulate", simulate)
    short = lambda scene, duration, **more: simulate(scene, min(duration or SHORT, SHORT), **more)
    monkeypatch.setattr(sys.modules["jaxbearing.simulate"], "simulate", short)


def run_one(page, arguments, folder, monkeypatch, capfd):
    command = shlex.join(["jaxbearing", *arguments])
    monkeypatch.setattr("sys.argv", ["jaxbearing", *arguments])
    capfd.readouterr()
    with pytest.raises(SystemExit) as ended:
        main()
    out, err = capfd.readouterr()
    assert not ended.value.code, f"{page}: {command}\n{err}{out}"
    if "--json" in arguments:
        assert json.loads(out)["converged"] is True, command
    for option in ("--out", "--plot", "--ross", "--animation"):
        if option in arguments:
            assert (folder / arguments[arguments.index(option) + 1]).stat().st_size > 0, command


def read_one(arguments):
    """As far as a command reads before it solves: options, values, the scene with its changes."""
    verb, *words = arguments
    with get_command(app).commands[verb].make_context(verb, words) as context:
        given = context.params
    if given.get("scene"):
        with warnings.catch_warnings(action="ignore"):  # of a preset: a command says it on its screen
            jb.load_scene(given["scene"], split_assignments(given.get("changes") or []))


@pytest.mark.usefixtures("made_up")
@pytest.mark.parametrize(
    "page", [pytest.param(page, marks=pytest.mark.slow) if page in MANY else page for page in ONCE]
)
def test_commands_run(page, folder, monkeypatch, capfd):
    """In the order of the page, in one folder."""
    monkeypatch.chdir(folder)
    for arguments in ONCE[page]:
        if arguments in TELLING:
            run_one(page, arguments, folder, monkeypatch, capfd)
        else:
            read_one(arguments)


@pytest.mark.slow
@pytest.mark.usefixtures("shortened")
@pytest.mark.parametrize("page", ONCE)
def test_commands_run_with_their_solvers(page, folder, monkeypatch, capfd):
    monkeypatch.chdir(folder)
    for arguments in ONCE[page]:
        # the study, of 100 solves, has a test of its own
        if arguments[0] != "study":
            run_one(page, arguments, folder, monkeypatch, capfd)


def test_scripts_and_tests_that_are_named_are_there():
    """Other programs of shell blocks: their files."""
    for page in PAGES:
        for block in re.findall(r"^```sh\n(.*?)^```", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL):
            for path in re.findall(r"(?<![\w/.])((?:tests|docs|notebooks)/[\w./-]+)", block):
                assert (ROOT / path).exists(), f"{page.name}: {path}"

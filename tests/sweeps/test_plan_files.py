"""The plan in the folder of a sweep is data: it comes back as it was, and nothing in a foreign folder is run."""

import ast
import json
import pickle
import subprocess
import sys
from pathlib import Path

import jax
import numpy as np
import pytest
from command_process import environment
from life_page import PAGE_SCENE
from roller_cases import dry_roller

import jaxbearing as jb
from jaxbearing.lubricants.viscosity import AbstractViscosity
from jaxbearing.sweeps import grid, run_chunk
from jaxbearing.sweeps.as_data import ForeignPartError, decoded, encoded
from jaxbearing.sweeps.chunks import chunk_path
from jaxbearing.sweeps.engine import SweepError, chunk_folder, run
from jaxbearing.sweeps.fields import SceneSource, described_fields
from jaxbearing.sweeps.plan import PLAN, read_key, read_plan, write_plan
from jaxbearing.sweeps.recipe import Read
from jaxbearing.sweeps.verb import make_plan, plan_in_scene

PACKAGES = [Path(jb.__file__).parent, Path(__file__).parents[2] / "fitting"]
KEPT = Path(jb.__file__).parent / "programs" / "kept.py"
LOADS = {"operation.radial_load": [1e3, 2e3]}
FIELD = {"two_disk": "materials.body_1.density", "satellite": "operation.oil_temperature"}


class Payload:
    """Makes a file where it is unpickled."""

    def __init__(self, mark):
        self.mark = mark

    def __reduce__(self):
        return open, (str(self.mark), "w")


class OwnLaw(AbstractViscosity):
    """A law of the user's own, in no module of the package."""

    reference: jax.Array

    def log_viscosity(self, pressure, temperature):
        return jax.numpy.log(self.reference) + 1e-8 * jax.numpy.asarray(pressure)


def plan_of(name):
    path = next((path for start, path in FIELD.items() if name.startswith(start)), "operation.inner_speed")
    values = [310.0, 320.0] if path.endswith("temperature") else [700.0, 800.0]
    return plan_in_scene(jb.load_scene(name), {path: values})


def same(one, other):
    assert jax.tree.structure(one) == jax.tree.structure(other)
    for a, b in zip(jax.tree.leaves(one), jax.tree.leaves(other), strict=True):
        assert np.asarray(a).tobytes() == np.asarray(b).tobytes()


# a shaft has no operating point of a bearing: see the next test
@pytest.mark.parametrize("name", [name for name in jb.builtin_names() if jb.load_scene(name).kind != "shaft"])
def test_plans_come_back(name, tmp_path):
    plan = plan_of(name)
    write_plan(plan, tmp_path)
    key, found = read_plan(tmp_path)
    assert key == read_key(tmp_path) == found.key == plan.key
    same(found.recipe.base, plan.recipe.base)
    same(found.options, plan.options)
    assert (found.cases.paths, found.metadata, found.label) == (plan.cases.paths, plan.metadata, plan.label)
    assert found.cache is None


def test_plan_of_a_shaft_comes_back(tmp_path):
    plan = plan_in_scene(jb.load_scene("gear_shaft"), {"force.pinion.torque": [10.0, 20.0]})
    write_plan(plan, tmp_path)
    _, found = read_plan(tmp_path)
    same(found.recipe.base, plan.recipe.base)
    assert (found.cases.paths, found.metadata) == (plan.cases.paths, plan.metadata)


def test_plan_of_a_scene_file_that_is_read_case_by_case(tmp_path):
    (tmp_path / "scene.toml").write_text(PAGE_SCENE, encoding="utf-8")
    source = SceneSource.of(tmp_path / "scene.toml")
    field = source.field("profile.drop", "--over")
    cases, fields = grid({field.path: [4e-6, 5e-6]}), {field.path: field}
    recipe = source.recipe(cases, fields)
    assert isinstance(recipe, Read)
    plan = make_plan(recipe, cases, described_fields(fields, recipe.example_scene), "a scene")
    write_plan(plan, tmp_path)
    key, found = read_plan(tmp_path)
    assert key == found.key == plan.key
    same(found.recipe.scene({"profile.drop": 4.5e-6}), plan.recipe.scene({"profile.drop": 4.5e-6}))


@pytest.mark.slow
def test_plan_in_another_process(tmp_path):
    """A process that has imported nothing but the sweeps knows all classes."""
    keys = []
    for name in ("turbine_ball", "turbine_roller_dynamic", "tapered_example", "two_disk_etm", "satellite_contact_1"):
        (tmp_path / name).mkdir()
        plan = plan_of(name)
        write_plan(plan, tmp_path / name)
        keys.append([name, plan.key])
    program = (
        "import json, sys; from jaxbearing.sweeps import run_chunk; from jaxbearing.sweeps.plan import read_plan\n"
        "print(json.dumps([[name, read_plan(name)[1].key] for name in sys.argv[1:]]))"
    )
    names = [name for name, _ in keys]
    command = [sys.executable, "-c", program, *names]
    done = subprocess.run(command, env=environment(), cwd=tmp_path, capture_output=True, check=True)
    assert json.loads(done.stdout) == keys


def test_a_foreign_folder_runs_nothing(tmp_path):
    mark, target = tmp_path / "mark", tmp_path / "sweep.nc"
    folder = chunk_folder(target)
    plan = plan_in_scene(dry_roller(), LOADS)
    hostile = {
        "pickle": lambda: (folder / PLAN).write_bytes(pickle.dumps((plan.key, Payload(mark)))),
        "older": lambda: (folder / "plan.pickle").write_bytes(pickle.dumps(Payload(mark))),
        "objects": lambda: np.savez(folder / PLAN, said=np.asarray([Payload(mark)], dtype=object)),
        "array": lambda: np.savez(
            folder / PLAN, **saved(plan, tmp_path), array_0=np.asarray([Payload(mark)], dtype=object)
        ),
        "no numbers": lambda: (folder / PLAN).write_bytes(b"PK\x03\x04"),
    }
    for write in hostile.values():
        folder.mkdir()
        write()
        chunk_path(folder, 0).write_bytes(b"a chunk of something else")
        with pytest.raises((ValueError, OSError)):
            run_chunk(folder, 0, plan.key)
        with pytest.raises(SweepError, match="another sweep"):
            run(plan, target)
        assert not mark.exists()
        for path in folder.iterdir():
            path.unlink()
        folder.rmdir()


def saved(plan, tmp_path):
    """What a good plan's file holds, but for one of its arrays."""
    (tmp_path / "good").mkdir(exist_ok=True)
    write_plan(plan, tmp_path / "good")
    with np.load(tmp_path / "good" / PLAN) as file:
        return {name: file[name] for name in file.files if name != "array_0"}


@pytest.mark.parametrize(
    "name",
    [
        "os:system",
        "builtins:eval",
        "subprocess:Popen",
        "jaxbearing.__main__:main",
        "jaxbearing.cli.main:main",
        "jaxbearing.sweeps.plan:os",
        "jaxbearing.sweeps.plan:Path",
        "jaxbearing.sweeps.chunks:run_chunk",
        "jaxbearing.no_module:Nothing",
        "jaxbearing.lubricants.viscosity:AbstractViscosity",
        "jaxbearing._scene:AbstractScene.__init__",
        "jaxbearing.numerics.newton:",
    ],
)
def test_names_of_other_things_are_refused(name):
    with pytest.raises(ValueError, match=r"class|part"):
        decoded(json.dumps({"class": name, "fields": {}}), {})


@pytest.mark.parametrize(
    "text", ['{"a": 1}', "[1]", '{"array": "nothing"}', "{", '{"class": 1, "fields": 2}', "[" * 5000]
)
def test_other_data_are_refused(text):
    with pytest.raises(ValueError, match=r".+"):
        decoded(text, {})


def test_parts_of_other_fields_are_refused():
    text, arrays = encoded(jb.NewtonOptions())
    changed = json.loads(text)
    changed["fields"]["more"] = 1
    with pytest.raises(ValueError, match="another version"):
        decoded(json.dumps(changed), arrays)


def test_a_law_of_the_users_own_is_swept_but_not_written(tmp_path):
    scene = jb.load_scene("reference_roller", {"contact.traction": "none", "cage": "none"})
    own = jax.numpy.asarray(0.005)
    scene = scene.replace({"oil.viscosity": OwnLaw(own)})
    with pytest.raises(ForeignPartError, match="OwnLaw"):
        encoded(scene)
    plan = plan_in_scene(scene, LOADS)
    write_plan(plan, tmp_path)
    assert read_key(tmp_path) == plan.key
    with pytest.raises(ValueError, match=r"OwnLaw.*--workers"):
        run_chunk(tmp_path, 0, plan.key)


def test_nothing_in_the_packages_reads_what_can_run():
    """No pickles but those of Dask's own wire, and no text that is run. Programs that are kept are code in any case,
    which only their owner may write: `tests/programs/test_kept.py`."""
    refused = {"pickle", "cPickle", "dill", "cloudpickle", "marshal", "shelve", "joblib", "runpy", "code"}
    for path in [one for package in PACKAGES for one in package.rglob("*.py")]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import | ast.ImportFrom) and path != KEPT:
                names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else [node.module or ""]
                assert not refused & {name.split(".")[0] for name in names}, path
            elif isinstance(node, ast.Call):
                called = node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
                assert called not in ("eval", "exec") or isinstance(node.func, ast.Attribute), path
                allowed = [word.value for word in node.keywords if word.arg == "allow_pickle"]
                assert all(isinstance(value, ast.Constant) and value.value is False for value in allowed), path
                loads = (
                    called == "load" and isinstance(node.func, ast.Attribute) and ast.unparse(node.func) == "np.load"
                )
                assert not loads or allowed, f"{path}: np.load without allow_pickle=False"


def test_what_others_left_in_the_folder_stays_when_it_cannot_be_read(tmp_path):
    """Only a folder that this run has claimed is removed: an error before that says nothing about what is in it."""
    target = tmp_path / "x.nc"
    folder = chunk_folder(target)
    (folder / PLAN).mkdir(parents=True)
    precious = folder / "precious.txt"
    precious.write_text("of somebody")
    with pytest.raises(OSError, match="folder"):
        run(plan_in_scene(dry_roller(), LOADS), target)
    assert precious.read_text() == "of somebody"

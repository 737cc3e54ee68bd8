"""Reads a scene from a scene file or by the name of a built-in scene."""

import importlib
import typing
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, overload

from pydantic import BaseModel

from .._scene import AbstractScene
from ..distribution import Distribution
from .data_files import builtin_names, builtin_summary, builtin_text
from .distributions import means_of, said_of
from .drafts import Unreadable, draft
from .errors import MeanUsedWarning, PresetUsedWarning, SceneError, StatesUnusedWarning, nearest, one_of
from .kinds import kind_named, kind_refused
from .oil.catalogue import with_catalogue
from .oil.files import Origin, origins, prior_ranges
from .overrides import REMOVE, Overrides, applied, apply, as_texts, parse_value, preset
from .presets import names_a_preset
from .presets import said_of as said_of_preset
from .problems import from_class
from .shaft.members import at, each_bearing, put
from .table import Table
from .toml_files import parse_toml, read_text
from .words import shortened

if TYPE_CHECKING:
    from ..bearings.ball.scene import BallBearing
    from ..bearings.cylindrical.scene import CylindricalRollerBearing
    from ..bearings.tapered.scene import TaperedRollerBearing
    from ..ehl import EHLLineContact
    from ..machines import TwoDisk
    from ..shafts import ShaftSystem

__all__ = ["builtin_names", "builtin_summary", "builtin_text", "load_scene", "scene_from_tables"]

_KIND_EXAMPLE = 'kind = "cylindrical_roller_bearing"'


class _Kind(NamedTuple):
    """Tells where the code of a kind of scene is.

    - `folder`: package with the modules `schema`, `build` and `writer`.
    - `table`: class in `schema` that validates a scene file.
    - `function`: function in `build` that makes the scene.
    - `tables`: function in `writer` that makes the tables of a scene file.
    """

    folder: str
    table: str
    function: str
    tables: str


_KINDS = {
    "ball_bearing": _Kind("ball", "BallBearingTable", "ball_bearing", "ball_tables"),
    "cylindrical_roller_bearing": _Kind(
        "cylindrical", "CylindricalRollerTable", "cylindrical_roller_bearing", "roller_tables"
    ),
    "tapered_roller_bearing": _Kind("tapered", "TaperedRollerTable", "tapered_roller_bearing", "tapered_tables"),
    "two_disk": _Kind("two_disk", "TwoDiskTable", "two_disk", "two_disk_tables"),
    "line_contact": _Kind("line_contact", "LineContactTable", "line_contact", "line_contact_tables"),
    "shaft": _Kind("shaft", "ShaftTable", "shaft", "shaft_tables"),
}
"""Kinds of scenes; each is imported when the first scene of it is read."""
KINDS = tuple(_KINDS)
SHAFT = "shaft"
"""Kind of the scenes whose parts include the scenes of bearings."""

# Names of the built-in scenes of each kind, so that an editor knows the class of what `load_scene` returns.
BallName: TypeAlias = Literal[
    "angular_contact_218",
    "deep_groove_6205",
    "deep_groove_6205_fitted",
    "deep_groove_6205_mounted",
    "four_point_qj",
    "turbine_ball",
    "turbine_ball_dynamic",
    "turbine_ball_mounted",
]
CylindricalName: TypeAlias = Literal["planet_roller", "reference_roller", "turbine_roller", "turbine_roller_dynamic"]
TaperedName: TypeAlias = Literal["tapered_example"]
TwoDiskName: TypeAlias = Literal["two_disk_etm", "two_disk_mobil_jet_ii", "two_disk_pennzane"]
LineContactName: TypeAlias = Literal["satellite_contact_1", "satellite_contact_2"]
ShaftName: TypeAlias = Literal["gear_shaft", "satellite_pair", "spindle_pair"]


def _module(kind: _Kind, name: str) -> ModuleType:
    return importlib.import_module(f".{kind.folder}.{name}", __package__)


def _table_and_build(kind: str) -> tuple[type[Table], Callable[[Any], AbstractScene]]:
    entry = _KINDS[kind]
    table = getattr(_module(entry, "schema"), entry.table)
    return table, getattr(_module(entry, "build"), entry.function)


def schema_of_kind(kind: str) -> tuple[type[BaseModel], type]:
    """The schema of the scene files of a kind, one of `KINDS`, and the class of the scenes that they become."""
    model, build = _table_and_build(kind)
    return model.example(), typing.get_type_hints(build)["return"]


def tables_of(scene: AbstractScene) -> dict[str, Any]:
    """The tables of a scene file that describe a scene of a kind in `KINDS`.

    **Raises:** `SceneError` for what a file cannot hold.
    """
    entry = _KINDS[scene.kind]
    return getattr(_module(entry, "writer"), entry.tables)(scene)


def plain_scene(scene: AbstractScene) -> AbstractScene:
    """The scene, with the fields that have no effect set to the values that scene files give them. Only scenes of
    shafts have such fields."""
    return _module(_KINDS[SHAFT], "writer").plain_scene(scene) if scene.kind == SHAFT else scene


@overload
def load_scene(source: BallName, overrides: Overrides | None = None) -> "BallBearing": ...
@overload
def load_scene(source: CylindricalName, overrides: Overrides | None = None) -> "CylindricalRollerBearing": ...
@overload
def load_scene(source: TaperedName, overrides: Overrides | None = None) -> "TaperedRollerBearing": ...
@overload
def load_scene(source: TwoDiskName, overrides: Overrides | None = None) -> "TwoDisk": ...
@overload
def load_scene(source: LineContactName, overrides: Overrides | None = None) -> "EHLLineContact": ...
@overload
def load_scene(source: ShaftName, overrides: Overrides | None = None) -> "ShaftSystem": ...
@overload
def load_scene(source: str | Path, overrides: Overrides | None = None) -> AbstractScene: ...
def load_scene(source: str | Path, overrides: Overrides | None = None) -> AbstractScene:
    """A scene from a file or by the name of a built-in scene.

    **Arguments:**
    - `source`: path of a TOML file, or one of `builtin_names()`.
    - `overrides`: maps the dotted path of a field to its value. The value is a text with a unit,
      {"operation.inner_speed": "12000 rpm"}, or a plain number for a field without a unit. The value "none" removes an
      optional table or field. Paths of files (`oil.file` and the files of `simulation`) in overrides are relative to
      the working folder; in a scene file they are relative to the folder of that file.

    A field that is given as a distribution takes its mean, and a `MeanUsedWarning` reports it. A `PresetUsedWarning`
    lists the laws that `laws = "best"` stands for. The scene leaves out the states of a load spectrum, and a
    `StatesUnusedWarning` reports it.

    **Raises:** `SceneError` with file, field, what was found and what is expected.
    """
    label, mapping = read_base(source)
    warn_of_means(mapping, label, overrides)
    scene = scene_from_tables(mapping, label, overrides)
    warn_of_preset(mapping, label, overrides)
    return scene


def load_distributions(source: str | Path, overrides: Overrides | None = None) -> dict[str, Distribution]:
    """The distributions in a scene, by dotted path, in SI units. These are the fields that are given as a distribution,
    and the prior distributions that the catalogue gives for the rheology of a standard oil. Arguments as for
    `load_scene`.

    **Raises:** as `load_scene`.
    """
    label, mapping = read_tables(source)
    return distributions_in(mapping, label, overrides, priors=True)


def distributions_in(
    mapping: Mapping[str, object], origin: str, overrides: Overrides | None = None, *, priors: bool = False
) -> dict[str, Distribution]:
    """The distributions in the tables of a scene. Arguments as those of `scene_from_tables`; `priors`: True to include
    the priors of the oil catalogue. **Raises:** `SceneError` for errors in the distributions; other errors of the scene
    are not checked."""
    overrides = as_texts(overrides)
    try:
        model, _ = _schema(mapping, overrides, origin)
        raw, _ = applied(mapping, overrides, model, origin)
        distributions = means_of(raw, model, origin)[1]
        if priors and isinstance(raw.get("oil"), Mapping):
            distributions |= means_of({"oil": prior_ranges(raw["oil"])}, model, origin)[1]
        return distributions
    except SceneError as error:
        raise SceneError.of_all([_with_culprit(problem, overrides, origin) for problem in error.problems]) from None


def warn_of_means(mapping: Mapping[str, object], origin: str, overrides: Overrides | None = None) -> None:
    """Warns about each distribution that a scene replaces by its mean. Arguments and errors as those of
    `distributions_in`."""
    distributions = distributions_in(mapping, origin, overrides)
    if not distributions:
        return
    model = scene_model(mapping, as_texts(overrides), origin)
    for path, distribution in distributions.items():
        warnings.warn(said_of(path, distribution, model), MeanUsedWarning, stacklevel=3)


def warn_of_preset(mapping: Mapping[str, object], origin: str, overrides: Overrides | None = None) -> None:
    """Warns which laws and estimates the preset of a scene stands for. Arguments as those of `scene_from_tables`, which
    must have accepted them."""
    note = preset_note(mapping, origin, overrides)
    if note:
        warnings.warn(note, PresetUsedWarning, stacklevel=3)


def preset_note(mapping: Mapping[str, object], origin: str, overrides: Overrides | None = None) -> str:
    """Text that lists the laws for which the preset of a scene stands; "" if there is no preset. Arguments as for
    `warn_of_preset`."""
    texts = as_texts(overrides)
    if not names_a_preset(mapping) and not any(path.rpartition(".")[2] in ("laws", "scene") for path in texts):
        return ""
    return said_of_preset(preset(mapping, texts, scene_model(mapping, texts, origin), origin)[0])


def oil_origins(source: str | Path, overrides: Overrides | None = None) -> dict[str, Origin]:
    """Origins of the oil's laws, for a scene that `load_scene` takes with the same arguments."""
    label, mapping = read_tables(source)
    overrides = as_texts(overrides)
    model, _ = _schema(mapping, overrides, label)
    return origins(apply(mapping, overrides, model, label).get("oil", {}), label)


def scene_from_tables(
    mapping: Mapping[str, object], origin: str = "scene", overrides: Overrides | None = None
) -> AbstractScene:
    """A scene from the tables of a scene file, {"kind": ..., "geometry": {...}, ...}; `origin` names it in messages.

    **Raises:** `SceneError`.
    """
    overrides = as_texts(overrides)
    try:
        model, build = _schema(mapping, overrides, origin)
        raw, problems = applied(mapping, overrides, model, origin)
        raw, _ = means_of(raw, model, origin)
        states = raw.pop(STATES, None) if is_shaft(raw) else None
        scene = _build(raw, model, build, origin, problems)
        return scene if states is None else _module(_KINDS[SHAFT], "states").with_states(scene, states, raw, origin)
    except SceneError as error:
        raise SceneError.of_all([_with_culprit(problem, overrides, origin) for problem in error.problems]) from None


def scene_model(mapping: Mapping[str, object], overrides: Mapping[str, str], origin: str) -> type[BaseModel]:
    """The schema of a scene's tables. **Raises:** `SceneError` for an unknown kind."""
    return _schema(mapping, overrides, origin)[0]


def model_of(scene: AbstractScene) -> type[BaseModel] | None:
    """The schema of scene files for scenes of the kind of `scene`; `None` if files cannot describe this kind."""
    if scene.kind not in _KINDS:
        return None
    table = _table_and_build(scene.kind)[0]
    return _module(_KINDS[SHAFT], "schema").model_of_scene(scene) if scene.kind == SHAFT else table


def _schema(
    mapping: Mapping[str, object], overrides: Mapping[str, str], origin: str
) -> tuple[type[Table], Callable[[Any], AbstractScene]]:
    kind = mapping.get("kind")
    if "kind" in overrides:
        kind = None if overrides["kind"] == REMOVE else parse_value(overrides["kind"])
    table, build = _table_and_build(_known_kind(kind, mapping, origin))
    return table.of_file(mapping, overrides, origin), build


def _with_culprit(problem: SceneError, overrides: Mapping[str, str], origin: str) -> SceneError:
    """The problem. If an override caused it, that `--set` is added to the name of the file."""
    culprit = next((path for path in overrides if _related(path, problem.path)), None)
    if culprit is None or problem.file != origin:
        return problem
    return problem.of(f"{origin} with --set {culprit}={shortened(overrides[culprit])}")


def _build(
    raw: Mapping[str, object],
    model: type[Table],
    build: Callable[[Any], AbstractScene],
    origin: str,
    problems: list[SceneError],
) -> AbstractScene:
    """Builds the scene. **Raises:** `SceneError` with `problems` and all errors that schema and classes find."""
    complete, refused, unknown = _with_oils(raw)
    table, errors = draft(model, complete, origin, refused)
    problems = [*problems, *unknown, *errors]
    try:
        scene = build(table)
    except Unreadable:
        pass
    except ValueError as error:
        reported = [problem.path for problem in problems]
        # an unknown name may be meant for what its table lacks
        unsure = {
            problem.path.rpartition(".")[0] for problem in problems if problem.found.startswith("the unknown name")
        }
        # the classes repeat some checks of the tables: a problem that is already known is not reported twice
        for refusal in from_class(error, raw, origin).problems:
            known = any(refusal.path and _related(refusal.path, path) for path in reported)
            if not known and not (refusal.found == "nothing" and refusal.path.rpartition(".")[0] in unsure):
                problems.append(refusal)
    else:
        if not problems:
            return scene
    raise SceneError.of_all(problems)


def _with_oils(raw: Mapping[str, Any]) -> tuple[dict[str, Any], list[str], list[SceneError]]:
    """The tables with catalogue oils replaced by their data, also for bearings on a shaft. Also returns the names of
    tables whose oil is invalid, and the errors."""
    complete, refused, problems = dict(raw), [], []
    if isinstance(raw.get("oil"), Mapping):
        try:
            complete["oil"] = with_catalogue(raw["oil"])
        except SceneError as error:
            refused, problems = ["oil"], [error]
    for keys in each_bearing(raw) if is_shaft(raw) else ():
        entry = at(raw, keys)
        if isinstance(entry, Mapping):
            inner, wrong, errors = _with_oils(entry)
            complete = put(complete, keys, inner)
            refused += [keys[0]] if wrong else []
            problems += [problem.inside(".".join(keys)) for problem in errors]
    return complete, refused, problems


def is_shaft(tables: Mapping[str, object]) -> bool:
    """True for the tables of a shaft."""
    return kind_named(tables.get("kind")) == SHAFT


def _related(a: str, b: str) -> bool:
    """True if two dotted paths are equal, or if one path contains the other."""
    return f"{a}.".startswith(f"{b}.") or f"{b}.".startswith(f"{a}.")


STATES = "state"
"""Name of the tables of a load spectrum. The module `states` reads them."""


def read_tables(source: str | Path) -> tuple[str, dict[str, Any]]:
    """Reads a file or a built-in scene. Returns its name for messages, and its tables without the states of a load
    spectrum (the states of a shaft are kept).

    **Raises:** `SceneError`.
    """
    label, mapping = read_all(source)
    return label, without_states(mapping)


def without_states(mapping: Mapping[str, object]) -> dict[str, object]:
    """The tables without the states of a load spectrum. The tables of a shaft are returned unchanged, because states
    are part of a shaft."""
    return {name: table for name, table in mapping.items() if name != STATES or is_shaft(mapping)}


def read_base(source: str | Path) -> tuple[str, dict[str, object]]:
    """Does what `read_tables` does, but warns with `StatesUnusedWarning` if states are left out."""
    label, mapping = read_all(source)
    states = None if is_shaft(mapping) else mapping.pop(STATES, None)
    if states is not None:
        count = len(states) if isinstance(states, list) else 1
        text = f"{label}: the scene leaves out its {count} [[state]] tables; 'jaxbearing spectrum' solves them"
        warnings.warn(text, StatesUnusedWarning, stacklevel=3)
    return label, mapping


def read_all(source: str | Path) -> tuple[str, dict[str, object]]:
    """Name for messages, and all tables of a file or a built-in scene. **Raises:** `SceneError`."""
    label, mapping = _read_file(source)
    if is_shaft(mapping):
        files = _module(_KINDS[SHAFT], "files")
        mapping = files.beside(files.named(mapping, label), Path(source).parent)
        mapping = files.read_scenes(mapping, label, tables_of_file)
    return label, mapping


def tables_of_file(source: str | Path) -> dict[str, Any]:
    """The tables of a file or a built-in scene as they stand there: other scenes that it names are not read.
    **Raises:** `SceneError`."""
    return _read_file(source)[1]


def _read_file(source: str | Path) -> tuple[str, dict[str, object]]:
    label = str(source)
    if isinstance(source, str) and source in builtin_names():
        text = builtin_text(source)
    else:
        text = read_text(source, f"a scene file, or a built-in scene ({', '.join(builtin_names())})", builtin_names())
    return label, _relocated(parse_toml(text, label, f"a scene that begins with {_KIND_EXAMPLE}"), Path(source).parent)


_OF_OIL = (("simulation", "oil_inlet_table"), ("simulation", "oil_flow_table"))
_FILES = (("oil",), ("simulation", "speed_table"), ("simulation", "load_table"), *_OF_OIL)
"""Tables whose field `file` names another file."""


def _relocated(mapping: dict[str, object], folder: Path) -> dict[str, object]:
    """The tables of a file in `folder`, with the paths of other files made relative to the working folder."""
    for tables in _FILES:
        mapping = _moved(mapping, tables, folder)
    return mapping


def _moved(table: dict[str, Any], inside: tuple[str, ...], folder: Path) -> dict[str, Any]:
    """The tables with `folder` put before the field `file` of the table that is reached by the names `inside`."""
    if not inside:
        file = table.get("file")
        return {**table, "file": str(folder / file)} if isinstance(file, str) else table
    deeper = table.get(inside[0])
    return {**table, inside[0]: _moved(deeper, inside[1:], folder)} if isinstance(deeper, dict) else table


def _known_kind(kind: Any, mapping: Mapping[str, object], origin: str) -> str:
    if kind is None:
        # an unknown name close to "kind" is a likelier culprit than a forgotten line
        near = next((key for key in mapping if key != "kind" and nearest(key, ("kind",))), "")
        actual = f"the unknown name {near!r}" if near else "nothing"
        raise SceneError(origin, "kind", actual, f"the kind of scene, e.g. {_KIND_EXAMPLE}", "kind" if near else "")
    kind = kind_named(kind)
    if kind in KINDS:
        return kind
    actual, near = kind_refused(kind, KINDS)
    raise SceneError(origin, "kind", actual, one_of(KINDS), near)

"""The scene file of a shaft. Names are the attribute names of the classes that it builds.

The table of a file has a field for each of its bearings, sets, forces and sections, with the schema of its own kind:
`shaft_model` makes it. `ShaftTable` is that of no file in particular, for lists of fields.
"""

import functools
import operator
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field, create_model
from pydantic_core import PydanticCustomError

from ...bearings.ball.scene import BallOperation
from ...bearings.operation import Operation
from ...bearings.solution import RING_FREEDOMS, stiffness_units
from ...bearings.tapered.scene import TaperedOperation
from ...shafts.forces import FORCES
from ...shafts.mounting import LinearBearing, MatchedSet, MountedBearing, Preload, Support
from ...shafts.scene import ShaftState, SystemLife
from ...shafts.shaft import Gravity, Section, Shaft
from .. import units
from ..ball.schema import BallBearingTable
from ..cylindrical.schema import CylindricalRollerTable
from ..drafts import Unreadable
from ..errors import SceneError, nearest, one_of
from ..kinds import KIND, kind_named
from ..materials import MaterialField
from ..table import Table
from ..table_of import fields_of_class, table_of
from ..tapered.schema import TaperedRollerTable
from .files import (
    BEARINGS,
    LINEAR,
    OF_SHAFT,
    REMOVE,
    SCENE,
    SECTIONS,
    kind_of,
    merged,
    with_scenes,
    without_loads,
)

FOLLOWS = "nothing: loads and speeds of a bearing on a shaft follow from [shaft] and [[force]]"
_PICTURE = "a text of two or more signs '<' and '>', from -x to +x, e.g. '<>' for an O arrangement"
_ISO = "iso"
_WAYS = ("force", "class_force", "offset", "spring_force")


def _matrix(value: Any) -> tuple[tuple[float, ...], ...]:
    """Five rows of five stiffnesses, each with its unit; zeros need none."""
    wanted = f"5 rows of 5 stiffnesses with units, of {', '.join(RING_FREEDOMS)}; a 0 needs no unit"
    if (
        not isinstance(value, list)
        or len(value) != 5
        or any(not isinstance(row, list) or len(row) != 5 for row in value)
    ):
        raise units.refusal(wanted, units.describe(value))
    return tuple(
        tuple(_entry(one, row, column) for column, one in enumerate(values)) for row, values in enumerate(value)
    )


def _entry(value: Any, row: int, column: int) -> float:
    if isinstance(value, int | float) and not isinstance(value, bool) and value == 0:
        return 0.0
    unit = MATRIX_UNITS[row][column]
    try:
        return units.quantity(value, units.dimension_of_unit(unit))
    except PydanticCustomError as error:
        context = error.context or {}
        place = f"{RING_FREEDOMS[row]}, {RING_FREEDOMS[column]}"
        raise units.refusal(context["expected"], f"{context['found']} ({place})") from None


def _units_of_matrix() -> tuple[tuple[str, ...], ...]:
    """Units of a stiffness, as dimensions know them: a force over an angle, and a moment over a length, are forces."""
    plain = {"N/m": "N/m", "N/rad": "N", "N m/m": "N", "N m/rad": "N m/rad"}
    return tuple(tuple(plain[unit] for unit in row) for row in stiffness_units())


MATRIX_UNITS = _units_of_matrix()
"""Units of the entries of a stiffness matrix in files: N/m, N and N m/rad."""
Matrix = Annotated[tuple[tuple[float, ...], ...], BeforeValidator(_matrix)]


def _picture(value: Any) -> str:
    if not isinstance(value, str) or len(value) < 2 or set(value) - {"<", ">"}:
        raise units.refusal(_PICTURE, units.describe(value))
    return value


def _weibull(value: Any) -> float | None:
    """A slope, or the word for those of the standards."""
    if value == _ISO:
        return None
    try:
        return units.number(value, "> 0")
    except PydanticCustomError as error:
        expected = f"'{_ISO}' or a number > 0 without a unit, e.g. 1.5"
        raise units.refusal(expected, (error.context or {})["found"]) from None


class SectionTable(table_of(Section)):
    """A cylindrical part of the shaft.

    - `material`: if it is not that of the shaft
    """

    material: MaterialField | None = None


class GravityTable(table_of(Gravity)):
    """The weight of the shaft and of the masses on it."""


class ShaftPart(table_of(Shaft)):
    """The shaft itself: see `shafts.shaft.Shaft`.

    - `material`: of the sections that name none; not given: steel
    - `gravity`: weight of shaft and masses; not given: weightless
    - `sections`: cylindrical parts from x = 0, a list of tables; paths number them from 1. Not given: a rigid shaft
    """

    material: MaterialField | None = None
    gravity: GravityTable | None = None


class SupportTable(table_of(Support)):
    """Elastic support of an outer ring.

    - `matrix`: all of the stiffness in the frame of the shaft, in the place of the three numbers
    """

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {"matrix": ("axial", "radial", "tilt")}
    matrix: Matrix | None = None


class PreloadTable(table_of(Preload)):
    """Preload of a set: one of force, class_force, offset, spring_force."""

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        way: tuple(other for other in (*_WAYS, "spring_stiffness") if other != way) for way in _WAYS
    }


class MountTable(table_of(MountedBearing)):
    """A bearing on the shaft: where it is, and how its outer ring is held.

    - `support`: elastic support of the outer ring; not given: rigid
    """

    support: SupportTable | None = None


class SetMountTable(table_of(MatchedSet)):
    """A matched set.

    - `picture`: one sign a bearing from -x to +x, the cone of its contact lines: '<>' is an O arrangement, '><' an X
      arrangement, '<<' a tandem
    - `distance`: of neighbouring rows, one length or one for each gap
    - `preload`: not given: all bearings touch and carry nothing
    - `mismatch`: additional closure of each bearing; not given: 0
    - `support`: elastic support of each outer ring; not given: rigid
    """

    picture: Annotated[str, BeforeValidator(_picture)]
    distance: Annotated[tuple[float, ...], units.several_note("> 0", "m")]
    preload: PreloadTable | None = None
    mismatch: Annotated[tuple[float, ...], units.several_note("finite", "m")] | None = None
    support: SupportTable | None = None


class LifeTable(Table):
    """Life of all bearings together. Given, bearings without a rating are rated as one with an empty [rating] is.

    - `weibull`: slope of the distribution of every bearing's life, 1.5 in API 610; 'iso': those of the standards, 10/9
      of ball and 9/8 of roller bearings
    """

    builds: ClassVar[type | None] = SystemLife
    weibull: Annotated[float | None, BeforeValidator(_weibull)] = None


class StateTable(table_of(ShaftState)):
    """A state of a duty cycle, in a table [[state]].

    - `name`: of the state; not given: its number
    - `set`: what differs in it, values by dotted paths in quotes; the paths may also stand in the state itself
    """

    name: units.Text | None = None
    set: dict[str, Any] | None = None


def _loads_elsewhere(operation: type) -> dict[str, str]:
    names = (*fields_of_class(operation), "displacement")
    return {name: FOLLOWS for name in names if name not in OF_SHAFT}


def _operation_of(operation: type, **load: float) -> Any:
    """The operating point of a bearing on a shaft: oil, and speed of the outer ring."""

    class MountedOperation(
        table_of(
            operation,
            leave_out=tuple(name for name in fields_of_class(operation) if name not in OF_SHAFT),
            optional=("oil_temperature", "oil_flow"),
        )
    ):
        """Oil and outer ring of a bearing on a shaft, whose loads and inner speed follow from the shaft."""

        elsewhere: ClassVar[Mapping[str, str]] = _loads_elsewhere(operation)

        def model_dump(self, **given: Any) -> dict[str, Any]:
            """The fields, with a load and a speed that make the bearing valid and have no effect."""
            return super().model_dump(**given) | load | {"inner_speed": self.outer_speed + 1.0}

    return MountedOperation


class _OnShaft(Table):
    """What a bearing has that stands on a shaft, in the place of what it has alone."""

    simulation: Literal[None] = None


def _mounted(name: str, bearing: type[Table], mount: type[Table], operation: type[Table], doc: str) -> type[Table]:
    given = {"operation": (operation, Field(default_factory=operation))}
    made: Any = create_model(name, __base__=(mount, _OnShaft, bearing), __module__=__name__, __doc__=doc, **given)
    return made


OPERATIONS: dict[str, Any] = {
    "ball_bearing": _operation_of(BallOperation, axial_load=1.0),
    "cylindrical_roller_bearing": _operation_of(Operation, radial_load=1.0),
    "tapered_roller_bearing": _operation_of(TaperedOperation, axial_load=1.0),
}
"""Kind of a bearing -> table of its operating point on a shaft."""
FAMILIES: dict[str, type[Table]] = {
    "ball_bearing": BallBearingTable,
    "cylindrical_roller_bearing": CylindricalRollerTable,
    "tapered_roller_bearing": TaperedRollerTable,
}
"""Kind of a bearing -> table of its own file."""


class LinearTable(MountTable):
    """A bearing on a shaft that is known by its stiffness alone.

    - `stiffness`: in the bearing's own frame, 5 rows of 5 entries, N/m, N and N m/rad
    """

    builds: ClassVar[type | None] = LinearBearing
    kind: Literal["linear"]
    stiffness: Matrix


@functools.cache
def mounted_table(kind: str, of_set: bool) -> type[Table]:
    """The table of a bearing of this kind on a shaft, or of a set of such bearings."""
    if kind == LINEAR:
        return LinearTable
    mount = SetMountTable if of_set else MountTable
    doc = "A set of such bearings." if of_set else "Such a bearing on a shaft."
    name = f"{'SetOf' if of_set else 'Mounted'}{FAMILIES[kind].__name__}"
    return _mounted(name, FAMILIES[kind], mount, OPERATIONS[kind], doc)


def _force_table(kind: str) -> type[Table]:
    owner = FORCES[kind]
    made: Any = create_model(
        f"{owner.__name__}Table",
        __base__=table_of(owner),
        __module__=__name__,
        __doc__=f"A force of the kind {kind}.",
        kind=(Literal[kind], ...),
    )
    made.tag = f"<{kind}>"
    return made


FORCE_TABLES = {kind: _force_table(kind) for kind in FORCES}
"""Kind of a force -> its table."""


class BearingEntry(MountTable):
    """A bearing on the shaft, in a table [[bearing]].

    - `scene`: of the bearing, a file or a built-in scene, whose loads and speeds do not count
    - `kind`: of the bearing, in the place of a scene: then the tables of its own scene file, such as geometry, are
      here; beside a scene they change it
    - `stiffness`: of the kind linear, in the bearing's own frame, 5 rows of 5 entries, N/m, N and N m/rad
    """

    scene: units.Text | None = None
    kind: Literal["ball_bearing", "cylindrical_roller_bearing", "tapered_roller_bearing", "linear"] | None = None
    stiffness: Matrix | None = None


class SetEntry(SetMountTable):
    """A matched set, in a table [[set]]; its bearings are called `name.1`, `name.2` ...

    - `scene`: of the bearing, a file or a built-in scene, whose loads and speeds do not count
    - `kind`: of the bearing, in the place of a scene: then the tables of its own scene file, such as geometry, are
      here; beside a scene they change it
    """

    scene: units.Text | None = None
    kind: Literal["ball_bearing", "cylindrical_roller_bearing", "tapered_roller_bearing"] | None = None


def _kind_of_force(entry: Mapping[str, Any], path: str, file: str) -> str:
    """**Raises:** `SceneError` for an entry without a known kind."""
    kind = entry.get("kind")
    if isinstance(kind, str) and kind in FORCES:
        return kind
    near = nearest(kind, FORCES) if isinstance(kind, str) else ""
    raise SceneError(file, f"{path}.kind", "nothing" if kind is None else units.describe(kind), one_of(FORCES), near)


def with_kind(entry: Any, kind: str | None) -> dict[str, Any]:
    """An entry with the kind of an override."""
    own = dict(entry) if isinstance(entry, Mapping) else {}
    return own if kind is None else {**own, "kind": kind}


def _with_scene(entry: Any, word: str, name: str, file: str) -> Any:
    """An entry with the tables of its scene. **Raises:** `SceneError` for a kind beside the scene."""
    if not isinstance(entry, Mapping) or not isinstance(entry.get(SCENE), Mapping):
        return entry
    scene, own = entry[SCENE], {key: value for key, value in entry.items() if key != SCENE}
    kind = kind_named(scene.get("kind"))
    if "kind" in own and kind_named(own["kind"]) != kind:
        expected = f"none beside the scene, whose kind is '{kind}'"
        raise SceneError(file, f"{word}.{name}.kind", units.describe(own["kind"]), expected)
    scene = without_loads({**scene, "kind": kind})
    return merged(scene, own, mounted_table(kind, word == "set") if kind in FAMILIES else None)


ANY_NAME, NUMBER = "NAME", "NUMBER"
"""What stands for a name, and for the number of a section, in lists of fields."""
_ANY_FORCE: Any = functools.reduce(operator.or_, FORCE_TABLES.values())


class ShaftTable(Table):
    """The whole file, but for the names of its bearings, sets and forces."""

    kind: Annotated[Literal["shaft"], KIND]
    shaft: ShaftPart
    life: LifeTable | None = None

    @classmethod
    def example(cls) -> type[Table]:
        fields: dict[str, Any] = {
            "shaft": (_with_sections((NUMBER,)), ...),
            "bearing": (_by_name("bearing", {ANY_NAME: BearingEntry}) | None, None),
            "set": (_by_name("set", {ANY_NAME: SetEntry}) | None, None),
            "force": (_by_name("force", {ANY_NAME: _ANY_FORCE}) | None, None),
            "state": (StateTable | None, None),
        }
        made: Any = create_model("AnyShaftTable", __base__=ShaftTable, __module__=__name__, **fields)
        return made

    @classmethod
    def of_file(cls, tables: Mapping[str, Any], overrides: Mapping[str, str], file: str) -> type[Table]:
        known, left = with_scenes(tables, overrides, file)
        kinds: dict[str, tuple[tuple[str, str], ...]] = {}
        for word, kind_in in (("bearing", kind_of), ("set", kind_of), ("force", _kind_of_force)):
            entries = known.get(word)
            there = {
                name: with_kind(entry, left.get(f"{word}.{name}.kind"))
                for name, entry in (entries.items() if isinstance(entries, Mapping) else ())
                if left.get(f"{word}.{name}") != REMOVE
            }
            kinds[word] = tuple((name, kind_in(entry, f"{word}.{name}", file)) for name, entry in there.items())
        for name, kind in kinds["set"]:
            if kind == LINEAR:
                raise SceneError(file, f"set.{name}.kind", f"'{LINEAR}'", one_of(BEARINGS))
        sections = known["shaft"].get(SECTIONS) if isinstance(known.get("shaft"), Mapping) else None
        numbers = tuple(sections) if isinstance(sections, Mapping) else ()
        left_in = tuple(name for name in numbers if left.get(f"shaft.{SECTIONS}.{name}") != REMOVE)
        return shaft_model(kinds["bearing"], kinds["set"], kinds["force"], left_in)

    @classmethod
    def completed(
        cls, tables: dict[str, Any], overrides: Mapping[str, str], file: str
    ) -> tuple[dict[str, Any], Mapping[str, str]]:
        found, left = with_scenes(tables, overrides, file)
        for word in ("bearing", "set"):
            entries = found.get(word)
            if isinstance(entries, Mapping):
                found[word] = {name: _with_scene(entry, word, name, file) for name, entry in entries.items()}
        return found, left

    def entries(self, table: str) -> dict[str, Any]:
        """The tables of the bearings, sets or forces, or the sections, by name."""
        owner = self.shaft if table == SECTIONS else self
        found = getattr(owner, table, None)
        if not isinstance(found, Table | None):
            raise Unreadable(table)
        return {} if found is None else {name: getattr(found, name) for name in type(found).model_fields}


def _by_name(word: str, tables: Mapping[str, Any]) -> Any:
    """A table with a table for each name. **Arguments:** `word`: of the list in files."""
    doc = f"""Tables by name.

    - `{ANY_NAME}`: one for each, under its name; in a file each is a table [[{word}]] with a `name`
    - `{NUMBER}`: one for each, numbered from 1
    """
    fields: Any = {name: (table, ...) for name, table in tables.items()}
    return create_model(f"{word.capitalize()}Tables", __base__=Table, __module__=__name__, __doc__=doc, **fields)


def _with_sections(names: tuple[str, ...]) -> Any:
    parts = _by_name(SECTIONS, dict.fromkeys(names, SectionTable))
    doc = ShaftPart.__doc__
    return create_model(
        "ShaftPart", __base__=ShaftPart, __module__=__name__, __doc__=doc, sections=(parts | None, None)
    )


@functools.lru_cache(64)
def shaft_model(
    bearings: tuple[tuple[str, str], ...],
    sets: tuple[tuple[str, str], ...],
    forces: tuple[tuple[str, str], ...],
    sections: tuple[str, ...],
) -> type[ShaftTable]:
    """The schema of a file with these names of bearings, sets and forces, each with its kind, and these sections."""
    tables: dict[str, dict[str, type[Table]]] = {
        "bearing": {name: mounted_table(kind, False) for name, kind in bearings},
        "set": {name: mounted_table(kind, True) for name, kind in sets},
        "force": {name: FORCE_TABLES[kind] for name, kind in forces},
    }
    fields: dict[str, Any] = {word: (_by_name(word, named) | None, None) for word, named in tables.items()}
    if sections:
        fields["shaft"] = (_with_sections(sections), ...)
    made: Any = create_model("ShaftFileTable", __base__=ShaftTable, __module__=__name__, **fields)
    return made


def model_of_scene(scene: Any) -> type[ShaftTable]:
    """The schema of the file of a shaft."""
    bearings = tuple((one.name, one.scene.kind) for one in scene.bearings)
    sets = tuple((one.name, one.scenes[0].kind) for one in scene.sets)
    forces = tuple((one.name, one.kind) for one in scene.forces)
    return shaft_model(bearings, sets, forces, tuple(str(i + 1) for i in range(len(scene.shaft.sections))))

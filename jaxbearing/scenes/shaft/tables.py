"""Tables of a shaft's file: sections, bearings and sets on it, forces, states. Names are the attribute names of the
classes that they build."""

import functools
from collections.abc import Callable, Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field, create_model
from pydantic_core import PydanticCustomError

from ...bearings.ball.scene import BallOperation
from ...bearings.operation import Operation
from ...bearings.solution import RING_FREEDOMS, stiffness_units
from ...bearings.tapered.scene import TaperedOperation
from ...shafts.forces import FORCES
from ...shafts.heat import ShaftThermal
from ...shafts.mounting import LinearBearing, MatchedSet, MountedBearing, Preload, Support
from ...shafts.scene import ShaftState, SystemLife
from ...shafts.shaft import Gravity, Section, Shaft
from .. import units
from ..ball.schema import BallBearingTable
from ..cylindrical.schema import CylindricalRollerTable
from ..materials import MaterialField
from ..table import Table
from ..table_of import fields_of_class, table_of
from ..tapered.schema import TaperedRollerTable
from ..words import describe
from .files import LINEAR, OF_SHAFT

FOLLOWS = "nothing: loads and speeds of a bearing on a shaft follow from [shaft] and [[force]]"
_PICTURE = "a text of two or more signs '<' and '>', from -x to +x, e.g. '<>' for an O arrangement"
_ISO = "iso"
_WAYS = ("force", "class_force", "offset", "spring_force")


_FREEDOMS = ", ".join(RING_FREEDOMS)


def _matrix(value: object) -> tuple[tuple[float, ...], ...]:
    """A matrix of five rows of five stiffnesses, each with its unit; zeros need no unit."""
    wanted = f"5 rows of 5 stiffnesses with units, of {_FREEDOMS}; a 0 needs no unit"
    return _square(value, wanted, lambda count: count == 5)


def _matrix_of_all(value: object) -> tuple[tuple[float, ...], ...]:
    """A matrix of stiffnesses with five rows and columns for each bearing."""
    wanted = f"5 n rows of 5 n stiffnesses with units, of {_FREEDOMS} for each of n bearings; a 0 needs no unit"
    return _square(value, wanted, lambda count: count > 0 and count % 5 == 0)


def _square(value: Any, wanted: str, fits: Callable[[int], bool]) -> tuple[tuple[float, ...], ...]:
    """A square matrix of stiffnesses. **Arguments:** `fits`: function that is True for a valid number of rows."""
    square = isinstance(value, list) and all(isinstance(row, list) and len(row) == len(value) for row in value)
    if not square or not fits(len(value)):
        raise units.refusal(wanted, describe(value))
    return tuple(
        tuple(_entry(entry, row % 5, column % 5) for column, entry in enumerate(values))
        for row, values in enumerate(value)
    )


def _entry(value: object, row: int, column: int) -> float:
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
    """Units of the stiffnesses for `dimension_of_unit`; force over angle and moment over length have the unit N."""
    plain = {"N/m": "N/m", "N/rad": "N", "N m/m": "N", "N m/rad": "N m/rad"}
    return tuple(tuple(plain[unit] for unit in row) for row in stiffness_units())


MATRIX_UNITS = _units_of_matrix()
"""Units of the entries of a stiffness matrix in files: N/m, N and N m/rad."""
Matrix = Annotated[tuple[tuple[float, ...], ...], BeforeValidator(_matrix)]
MatrixOfAll = Annotated[tuple[tuple[float, ...], ...], BeforeValidator(_matrix_of_all)]


def _picture(value: object) -> str:
    if not isinstance(value, str) or len(value) < 2 or set(value) - {"<", ">"}:
        raise units.refusal(_PICTURE, describe(value))
    return value


def _scenes(value: Any) -> tuple[str, ...]:
    names = value if isinstance(value, list) else [value]
    if not names or not all(isinstance(name, str) for name in names):
        raise units.refusal("a text, e.g. '7207.toml', or a list of such texts", describe(value))
    return tuple(names)


def _weibull(value: object) -> float | None:
    """A Weibull slope; `None` for the word 'iso', which means the slopes of the standards."""
    if value == _ISO:
        return None
    try:
        return units.number(value, "> 0")
    except PydanticCustomError as error:
        expected = f"'{_ISO}' or a number > 0 without a unit, e.g. 1.5"
        raise units.refusal(expected, (error.context or {})["found"]) from None


class SectionTable(table_of(Section)):
    """A cylindrical section of the shaft.

    - `material`: material of the section; not given: that of the shaft
    """

    material: MaterialField | None = None


class GravityTable(table_of(Gravity)):
    """The weight of the shaft and of the masses on it."""


class ShaftPart(table_of(Shaft)):
    """The shaft itself: see `shafts.shaft.Shaft`.

    - `material`: material of the sections without their own; not given: steel
    - `gravity`: weight of shaft and masses; not given: no weight
    - `sections`: cylindrical sections from x = 0, a list of tables; paths number them from 1. Not given: a rigid shaft
    """

    material: MaterialField | None = None
    gravity: GravityTable | None = None


class SupportTable(table_of(Support)):
    """Elastic support of an outer ring.

    - `matrix`: full stiffness matrix in the frame of the shaft, in place of the three stiffnesses
    """

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {"matrix": ("axial", "radial", "tilt")}
    matrix: Matrix | None = None


class HousingTable(Table):
    """An elastic housing that holds all outer rings, in place of a support for each ring.

    - `matrix`: its stiffness in the frame of the shaft, 5 rows and columns for each bearing, bearings of sets first
    """

    matrix: MatrixOfAll


class ShaftThermalTable(table_of(ShaftThermal)):
    """Connects the thermal networks of the bearings, each with six nodes, along shaft and housing."""


class PreloadTable(table_of(Preload)):
    """Preload of a set, given as force, class_force, offset or spring_force."""

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        way: tuple(other for other in (*_WAYS, "spring_stiffness") if other != way) for way in _WAYS
    }


class MountTable(table_of(MountedBearing)):
    """Position of a bearing on the shaft, and the support of its outer ring.

    - `support`: elastic support of the outer ring; not given: rigid
    """

    support: SupportTable | None = None


class SetMountTable(table_of(MatchedSet)):
    """A matched set.

    - `picture`: one sign for each bearing from -x to +x, the cone of its contact lines: '<>' is an O arrangement, '><'
      an X arrangement, '<<' a tandem
    - `distance`: distance of neighbouring rows, one length or one for each pair of rows
    - `preload`: preload of the set; not given: all bearings touch without load
    - `mismatch`: additional closure of each bearing; not given: 0
    - `support`: elastic support of each outer ring; not given: rigid
    """

    picture: Annotated[str, BeforeValidator(_picture)]
    distance: Annotated[tuple[float, ...], units.several_note("> 0", "m")]
    preload: PreloadTable | None = None
    mismatch: Annotated[tuple[float, ...], units.several_note("finite", "m")] | None = None
    support: SupportTable | None = None


class LifeTable(Table):
    """Life of the system of all bearings. With this table, bearings without [rating] are rated as with an empty one.

    - `weibull`: Weibull slope of the life of every bearing, 1.5 in API 610; 'iso': slopes of the standards, 10/9 for
      ball and 9/8 for roller bearings
    """

    builds: ClassVar[type | None] = SystemLife
    weibull: Annotated[float | None, BeforeValidator(_weibull)] = None


class StateTable(table_of(ShaftState)):
    """A state of a duty cycle, in a table [[state]].

    - `name`: name of the state; not given: its number
    - `set`: changes of the scene, values by dotted paths in quotes; the paths may also be in the state itself
    """

    name: units.Text | None = None
    set: dict[str, Any] | None = None


def _loads_elsewhere(operation: type) -> dict[str, str]:
    names = (*fields_of_class(operation), "displacement")
    return {name: FOLLOWS for name in names if name not in OF_SHAFT}


def _operation_of(operation: type, **load: float) -> Any:
    """The table of the operating point of a bearing on a shaft: oil, and speed of the outer ring.

    **Arguments:** `load`: a load that makes the bearing valid and has no effect.
    """

    class MountedOperation(
        table_of(
            operation,
            leave_out=tuple(name for name in fields_of_class(operation) if name not in OF_SHAFT),
            optional=("oil_temperature", "oil_flow"),
        )
    ):
        """Oil and outer ring of a bearing on a shaft, whose loads and inner speed follow from the shaft."""

        elsewhere: ClassVar[Mapping[str, str]] = _loads_elsewhere(operation)

        def model_dump(self, **options: Any) -> dict[str, Any]:
            """The fields, with a load and an inner speed that make the bearing valid and have no effect."""
            return super().model_dump(**options) | load | {"inner_speed": self.outer_speed + 1.0}

    return MountedOperation


class _OnShaft(Table):
    """Replaces fields that only a single bearing can have."""

    simulation: Literal[None] = None


def _mounted(name: str, bearing: type[Table], mount: type[Table], operation: type[Table], doc: str) -> type[Table]:
    fields: Any = {"operation": (operation, Field(default_factory=operation))}
    base = (_OnShaft, bearing) if mount is Table else (mount, _OnShaft, bearing)
    made: Any = create_model(name, __base__=base, __module__=__name__, __doc__=doc, **fields)
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
    """A bearing on a shaft that is described by its stiffness alone.

    - `stiffness`: stiffness matrix in the bearing's own frame, 5 rows of 5 entries in N/m, N and N m/rad
    """

    builds: ClassVar[type | None] = LinearBearing
    kind: Literal["linear"]
    stiffness: Matrix


@functools.cache
def member_table(kind: str) -> type[Table]:
    """The table of one bearing of a set with different bearings."""
    doc = "One of the different bearings of a set."
    return _mounted(f"MemberOf{FAMILIES[kind].__name__}", FAMILIES[kind], Table, OPERATIONS[kind], doc)


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
    owner, doc = FORCES[kind], f"A force of the kind {kind}."
    fields: Any = {"kind": (Literal[kind], ...)}
    base = table_of(owner)
    made: Any = create_model(f"{owner.__name__}Table", __base__=base, __module__=__name__, __doc__=doc, **fields)
    made.tag = f"<{kind}>"
    return made


FORCE_TABLES = {kind: _force_table(kind) for kind in FORCES}
"""Kind of a force -> its table."""


class BearingEntry(MountTable):
    """A bearing on the shaft, in a table [[bearing]].

    - `scene`: scene of the bearing, a file or a built-in scene, of which loads and speeds are ignored
    - `kind`: kind of the bearing, in place of a scene. The entry then has the tables of a scene file, such as geometry;
      with a scene, these tables change it
    - `stiffness`: stiffness matrix of the kind linear in the bearing's frame, 5 rows of 5 entries in N/m, N and N m/rad
    """

    scene: units.Text | None = None
    kind: Literal["ball_bearing", "cylindrical_roller_bearing", "tapered_roller_bearing", "linear"] | None = None
    stiffness: Matrix | None = None


class MemberEntry(Table):
    """One of the different bearings of a set, in a table [[set.bearing]].

    - `scene`: scene of the bearing, a file or a built-in scene, of which loads and speeds are ignored
    - `kind`: kind of the bearing, in place of a scene. The entry then has the tables of a scene file, such as geometry;
      with a scene, these tables change it
    """

    scene: units.Text | None = None
    kind: Literal["ball_bearing", "cylindrical_roller_bearing", "tapered_roller_bearing"] | None = None


class SetEntry(SetMountTable):
    """A matched set, in a table [[set]]; its bearings are called `name.1`, `name.2` ...

    - `scene`: scene of the bearing, a file or a built-in scene, of which loads and speeds are ignored; or a list of
      scenes, one for each sign of the picture
    - `kind`: kind of the bearing, in place of a scene. The entry then has the tables of a scene file, such as geometry;
      with a scene, these tables change it
    - `bearing`: different bearings, in tables [[set.bearing]], one for each sign of the picture, each with a scene or
      with a kind and its tables; paths number them from 1
    """

    scene: Annotated[tuple[str, ...], BeforeValidator(_scenes)] | None = None
    kind: Literal["ball_bearing", "cylindrical_roller_bearing", "tapered_roller_bearing"] | None = None

"""The thermal network of a bearing as a table of a scene."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Literal, TypeVar

import equinox as eqx

from .._scene import label, number, optional_number
from .._types import Scalar
from ..numerics.checks import Checked
from ..numerics.structure import choice, count, switch
from .network import NODES
from .solve import LIMIT

Part = TypeVar("Part", bound=Checked)
ROOM_TEMPERATURE = 293.15
"""Default temperature of the ambient, K."""


def _conductance(between: str) -> Any:
    return optional_number(bound=">= 0", metadata=label("W/K", f"conductance between {between}"))


class Conductances(Checked):
    """Given conductances; the others are computed from dimensions, contacts and oil.

    Fields that end in `_ambient` lead to the ambient: in a network of four nodes from the rings, through shaft and
    housing, and in a network of six nodes from shaft and housing.
    """

    part: ClassVar[str] = "thermal.conductance"

    inner_ring_elements: Scalar | None = _conductance("inner ring and elements")
    outer_ring_elements: Scalar | None = _conductance("outer ring and elements")
    inner_ring_oil: Scalar | None = _conductance("inner ring and oil")
    outer_ring_oil: Scalar | None = _conductance("outer ring and oil")
    elements_oil: Scalar | None = _conductance("elements and oil")
    inner_ring_shaft: Scalar | None = _conductance("inner ring and shaft")
    outer_ring_housing: Scalar | None = _conductance("outer ring and housing")
    housing_oil: Scalar | None = _conductance("housing and oil (0 where not given)")
    bearing_ambient: Scalar | None = _conductance("the whole bearing, of one node, and ambient")
    inner_ring_ambient: Scalar | None = _conductance("inner ring and ambient, of four nodes")
    outer_ring_ambient: Scalar | None = _conductance("outer ring and ambient, of four nodes")
    shaft_ambient: Scalar | None = _conductance("shaft and ambient")
    housing_ambient: Scalar | None = _conductance("housing and ambient")


def _capacity(of: str) -> Any:
    return optional_number(bound="> 0", metadata=label("J/K", f"heat capacity of {of}"))


class Capacities(Checked):
    """Given heat capacities. If not given, those of the bearing itself are computed, and those of shaft and housing are
    not known. Only the growth rate of disturbances and the search by steps in time use them."""

    part: ClassVar[str] = "thermal.capacity"

    bearing: Scalar | None = _capacity("the whole bearing, of one node")
    inner_ring: Scalar | None = _capacity("the inner ring")
    outer_ring: Scalar | None = _capacity("the outer ring")
    elements: Scalar | None = _capacity("all rolling elements")
    oil: Scalar | None = _capacity("the oil in the bearing")
    shaft: Scalar | None = _capacity("the shaft")
    housing: Scalar | None = _capacity("the housing")


def _factor(of: str) -> Any:
    return number(1.0, bound=">= 0", metadata=label("1", f"factor of the conductances {of}"))


class ConductanceFactors(Checked):
    """Factors of groups of conductances, both computed and given ones."""

    part: ClassVar[str] = "thermal.factor"

    contacts: Scalar = _factor("between rings and elements")
    oil: Scalar = _factor("between oil and rings, elements and housing (1 to 3 for rings by measurements)")
    seats: Scalar = _factor("of the seats")
    ambient: Scalar = _factor("to the ambient")


def _share(of: str, to: str) -> Any:
    return optional_number(bound="between 0 and 1", metadata=label("1", f"part of the loss {of} that heats {to}"))


class Shares(Checked):
    """Parts of the losses that heat the first of two bodies; the rest heats the second one."""

    part: ClassVar[str] = "thermal.share"

    inner_raceway: Scalar | None = _share("on the inner raceway", "the inner ring, the rest the elements")
    outer_raceway: Scalar | None = _share("on the outer raceway", "the outer ring, the rest the elements")
    flange: Scalar | None = _share("at the flanges or the rib", "their rings, the rest the elements")
    element_ends: Scalar | None = _share("at the element ends", "the elements, the rest the oil")
    pocket: Scalar | None = _share("in the cage pockets", "the elements, the rest the oil")
    cage_pilot: Scalar | None = _share("in the cage lands", "the guiding ring, the rest the oil")
    drag: Scalar | None = _share("of the drag", "the elements, the rest the oil")


def _as_part(kind: type[Part], name: str) -> Callable[[object], Part]:
    def read(value: object) -> Part:
        if value is None:
            return kind()
        if isinstance(value, Mapping):
            names = [*kind.__dataclass_fields__]
            unknown = [str(key) for key in value if key not in names]
            if unknown:
                raise ValueError(f"thermal.{name} has {', '.join(names)}, got {', '.join(sorted(unknown))}")
            return kind(**value)
        if not isinstance(value, kind):
            raise ValueError(f"thermal.{name} must be a {kind.__name__} or a mapping, got {value!r}")
        return value

    return read


def _part(kind: type[Checked], name: str) -> Any:
    return eqx.field(converter=_as_part(kind, name), default=None, metadata={"part": name})


class Thermal(Checked):
    """A thermal network around the bearing: the temperatures of its parts are results.

    **Arguments:**
    - `nodes`: number of nodes. 1: the whole bearing; 4: rings, elements and oil; 6: shaft and housing too.
    - `ambient`: temperature of the ambient, K.
    - `oil_inlet`: temperature of the oil that enters, K; if not given, `operation.oil_temperature`.
    - `mixing`: 1 if the oil in the bearing is well mixed, 1/2 if its temperature rises linearly from inlet to outlet.
    - `rolling_to_oil`: part of the rolling resistance that heats the oil in the inlet of the contacts; an assumption.
    - `limit`: temperature that no node may exceed, K: above 250 degC no law of an oil is valid.
    - `start`: temperature of all nodes where the search begins, K; if not given, that of oil inlet or ambient,
      whichever is higher.
    - `jacobian`: `when_needed`: if Broyden's iteration fails, Newton's iteration follows before steps in time. `never`:
      there is no Newton's iteration, and the program compiles in half the time. If not given, `when_needed` with
      `stability`, else `never`.
    - `stability`: true to compute margin and rate, which takes one more Jacobian.
    - `housing_diameter`, `housing_area`: outside diameter, m, and surface, m^2, of a housing in still air; if not
      given, the conductance to the ambient is that of the reference heat flow of ISO 15312.
    - `emissivity`: emissivity of the surface of the housing.
    - `conductance`, `capacity`, `factor`, `share`: given values in place of computed ones.
    """

    part: ClassVar[str] = "thermal"

    nodes: int = count("thermal.nodes", 4, least=1, most=6)
    ambient: Scalar = number(ROOM_TEMPERATURE, bound="> 0", metadata=label("K", "temperature of the ambient"))
    oil_inlet: Scalar | None = optional_number(bound="> 0", metadata=label("K", "temperature of the oil that enters"))
    mixing: Scalar = number(1.0, bound="above 0 and at most 1", unit="1")
    rolling_to_oil: Scalar = number(0.5, bound="between 0 and 1", unit="1")
    limit: Scalar = number(LIMIT, bound="> 0", metadata=label("K", "temperature that no node may pass"))
    start: Scalar | None = optional_number(bound="> 0", metadata=label("K", "temperature where the search begins"))
    jacobian: Literal["when_needed", "never"] | None = choice("thermal.jacobian", ("when_needed", "never"), None)
    stability: bool = switch("thermal.stability", False)
    housing_diameter: Scalar | None = optional_number(bound="> 0", metadata=label("m", "outside of a housing in air"))
    housing_area: Scalar | None = optional_number(bound="> 0", metadata=label("m^2", "surface of a housing in air"))
    emissivity: Scalar = number(0.9, bound="between 0 and 1", unit="1")
    conductance: Conductances = _part(Conductances, "conductance")
    capacity: Capacities = _part(Capacities, "capacity")
    factor: ConductanceFactors = _part(ConductanceFactors, "factor")
    share: Shares = _part(Shares, "share")

    def __check_init__(self):
        super().__check_init__()
        if self.nodes not in NODES:
            raise ValueError(f"thermal.nodes must be one of {', '.join(map(str, NODES))}, got {self.nodes}")
        if self.stability and self.jacobian == "never":
            raise ValueError("thermal.stability = true needs the Jacobian: only with thermal.jacobian = 'when_needed'")
        if (self.housing_diameter is None) != (self.housing_area is None):
            missing, present = ("diameter", "area") if self.housing_diameter is None else ("area", "diameter")
            raise ValueError(f"thermal.housing_{missing}: found nothing, housing_{present} needs it beside it")

    @property
    def exact_jacobian(self) -> Literal["when_needed", "never"]:
        """The given `jacobian`, else the value that `stability` needs."""
        if self.jacobian is not None:
            return self.jacobian
        return "when_needed" if self.stability else "never"

    @property
    def node_names(self) -> tuple[str, ...]:
        """Names of the nodes."""
        return NODES[self.nodes]

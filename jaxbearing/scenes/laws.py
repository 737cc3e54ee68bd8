"""Names of laws in scene files, each registered once: the fields that take them, their lists in messages and pages, and
the laws that are built all follow from here.

A law of another package is named by an entry point of the group `jaxbearing.laws`, see `docs/contributing.md`.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from types import MappingProxyType
from typing import Annotated, Any, Generic, TypeVar

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from ..contacts import (
    PRESETS,
    AbstractLineFilm,
    AbstractPointFilm,
    AbstractPointRollingResistance,
    AbstractRollingResistance,
    AbstractThermalFactor,
    AbstractViscousFunction,
    BibouletHoupertPointRollingResistance,
    BibouletHoupertRollingResistance,
    ChittendenCentral,
    DistributedTraction,
    DowsonHigginson,
    DowsonToyoda,
    FullRangeRollingResistance,
    Grubin,
    Gupta,
    HamrockDowsonCentral,
    HsuLee,
    JoinedRollingResistance,
    MartinBlend,
    Moes,
    NijenbanningVennerMoes,
    NoThermalReduction,
    PanHamrockCentral,
    ReeEyring,
    Resolution,
    RigidBlend,
    RigidRollingResistance,
    SourceRollingResistance,
)
from ..contacts import viscous_function as viscous_function_named
from ..contacts.viscous import VISCOUS_LAWS
from ..gaps import AbstractTurbulence, BlendedTurbulence, FullTurbulence, Laminar
from ..lubricants import Lubricant
from . import units
from .problems import LAW_ERROR

ENTRY_POINTS = "jaxbearing.laws"
"""Group of the entry points by which other packages name their laws."""
AnyLaw = TypeVar("AnyLaw")
_NOTHING: Mapping[str, str] = MappingProxyType({})


class Laws(Generic[AnyLaw], Mapping[str, Callable[..., AnyLaw]]):
    """Laws of one kind by their names in scene files: the type of a field that holds such a name is
    `Annotated[str, laws]`.

    **Arguments:**
    - `named`: name -> class, or another maker, of the law.
    - `kinds`: the abstract classes of which a law of another package must be one.
    """

    def __init__(self, named: Mapping[str, Callable[..., AnyLaw]], *kinds: type):
        self._named, self._kinds = dict(named), kinds

    def __getitem__(self, name: str) -> Callable[..., AnyLaw]:
        """The class of a law of this package or, by the name of an entry point, of another."""
        return self._named[name] if name in self._named else self._loaded(name)

    # a type is compared and hashed with all that annotates it
    __eq__ = object.__eq__
    __hash__ = object.__hash__  # pyright: ignore[reportAssignmentType]  (mappings have none)

    def __contains__(self, name: object) -> bool:
        return name in self._named

    def __iter__(self) -> Iterator[str]:
        return iter(self._named)

    def __len__(self) -> int:
        return len(self._named)

    @property
    def isoviscous(self) -> tuple[str, ...]:
        """The names of laws that hold for an oil of the same viscosity at every pressure."""
        return tuple(name for name in self._named if not self.piezoviscous_only(name))

    def piezoviscous_only(self, name: str) -> bool:
        """True if the law of this name holds only for oils whose viscosity rises with pressure."""
        return bool(getattr(self[name], "piezoviscous_only", True))

    def fits(self, name: str) -> bool:
        """True if the law of this name is one of these. **Raises:** `KeyError` for a name that stands for none."""
        if name in self._named:
            return True
        law = ANY_FILMS[name]
        return name not in ANY_FILMS and isinstance(law, type) and issubclass(law, self._kinds)

    def every(self) -> Iterator[str]:
        """The names of the laws of this package, then of those of other packages that fit."""
        from importlib.metadata import entry_points

        yield from self._named
        for found in entry_points(group=ENTRY_POINTS):
            with suppress(KeyError, PydanticCustomError):
                if found.name not in self._named and self._loaded(found.name):
                    yield found.name

    def name_of(self, law: object) -> str:
        """The name of the law of which this is one."""
        return next(name for name, kind in self._named.items() if type(law) is kind)

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.read, handler(source))

    def read(self, given: object) -> str:
        """The name, if it stands for a law. **Raises:** `PydanticCustomError` otherwise."""
        if isinstance(given, str):
            if given in self._named:
                return given
            if given and not given.startswith("<"):
                try:
                    self._loaded(given)
                    return given
                except KeyError:
                    pass
        quoted = [f"'{name}'" for name in self._named]
        words = " or ".join(filter(None, [", ".join(quoted[:-1]), quoted[-1]]))
        raise PydanticCustomError(LAW_ERROR, "Input should be {expected}", {"expected": words})

    def _loaded(self, name: str) -> Callable[..., AnyLaw]:
        """The class that an entry point of this name holds.

        **Raises:** `KeyError` without such an entry point; `PydanticCustomError` for one that cannot be loaded or is of
        another kind.
        """
        from importlib.metadata import entry_points

        found = next(iter(entry_points(group=ENTRY_POINTS, name=name)), None)
        if found is None:
            raise KeyError(name)
        place = f"'{name}', which an entry point says is {found.value}"
        wanted = " or ".join(kind.__name__ for kind in self._kinds)
        try:
            law = found.load()
        except Exception as error:  # whatever the import of another package raises
            reason = f"{type(error).__name__}: {error}"
            raise units.refusal("a law that can be loaded", f"{place}, which fails ({reason})") from error
        if not (isinstance(law, type) and issubclass(law, self._kinds)):
            raise units.refusal(f"a subclass of {wanted}", f"{place}, which is none")
        return law


class RollingLaws(Laws[AnyLaw]):
    """Laws of rolling resistance: `true` stands for the first of them; `older` names are read as present ones."""

    def __init__(self, named: Mapping[str, Callable[..., AnyLaw]], *kinds: type, older: Mapping[str, str] = _NOTHING):
        super().__init__(named, *kinds)
        self._older = dict(older)

    def read(self, given: object) -> str:
        if given is True:
            return next(iter(self))
        return super().read(self._older.get(given, given) if isinstance(given, str) else given)


def for_raceways(films: Laws[Any], joined: Callable[[Any], Any]) -> Laws[Any]:
    """The films of contacts of which some carry nothing.

    A formula for oils whose viscosity rises with pressure alone has a finite film at no load, where an unloaded rolling
    element needs the rigid film: `joined` puts the two together.
    """
    return _RacewayFilms(films, joined)


class _RacewayFilms(Laws[Any]):
    def __init__(self, films: Laws[Any], joined: Callable[[Any], Any]):
        super().__init__(films._named, *films._kinds)
        self._joined = joined

    def __getitem__(self, name: str) -> Callable[[], object]:
        film = super().__getitem__(name)
        return (lambda: self._joined(film())) if self.piezoviscous_only(name) else film

    def piezoviscous_only(self, name: str) -> bool:
        return bool(getattr(super().__getitem__(name), "piezoviscous_only", True))


LINE_FILMS: Laws[AbstractLineFilm] = Laws(
    {
        "moes": Moes,
        "dowson_higginson": DowsonHigginson,
        "dowson_toyoda": DowsonToyoda,
        "pan_hamrock": PanHamrockCentral,
        "grubin": Grubin,
    },
    AbstractLineFilm,
)
POINT_FILMS: Laws[AbstractPointFilm] = Laws(
    {"nijenbanning": NijenbanningVennerMoes, "hamrock_dowson": HamrockDowsonCentral}, AbstractPointFilm
)
ANY_FILMS: Laws[Any] = Laws({**POINT_FILMS, **LINE_FILMS}, AbstractPointFilm, AbstractLineFilm)
RIB_FILMS: Laws[AbstractPointFilm] = Laws({"chittenden": ChittendenCentral, **POINT_FILMS}, AbstractPointFilm)
"""Film laws of roller ends on a rib, which roll along the longer axis of the contact."""
ROLLER_FILMS = for_raceways(LINE_FILMS, MartinBlend)
BALL_FILMS = for_raceways(POINT_FILMS, RigidBlend)
"""Film laws of bearings, in which some rolling elements may carry nothing."""
POINT_THERMAL: Laws[AbstractThermalFactor] = Laws({"gupta": Gupta}, AbstractThermalFactor)
LINE_THERMAL: Laws[AbstractThermalFactor] = Laws({**POINT_THERMAL, "hsu_lee": HsuLee}, AbstractThermalFactor)
VISCOUS: Laws[AbstractViscousFunction] = Laws(VISCOUS_LAWS, AbstractViscousFunction)
MAXWELL_EYRING = "maxwell_eyring"
"""Ree and Eyring's flow with the Maxwell element that every law here has."""
TRACTIONS: Laws[AbstractViscousFunction] = Laws({MAXWELL_EYRING: ReeEyring, **VISCOUS}, AbstractViscousFunction)
ROLLING: Laws[AbstractRollingResistance] = RollingLaws(
    {
        "full_range": FullRangeRollingResistance,
        "biboulet_houpert": BibouletHoupertRollingResistance,
        "rigid_isoviscous": RigidRollingResistance,
        # under load; a roller outside the loaded zone has the rigid law's
        "ertel_grubin": JoinedRollingResistance,
    },
    AbstractRollingResistance,
)
POINT_ROLLING: Laws[AbstractPointRollingResistance] = RollingLaws(
    {"biboulet_houpert": BibouletHoupertPointRollingResistance, "source_86": SourceRollingResistance},
    AbstractPointRollingResistance,
    older={"houpert": "source_86"},
)
"""The first law of each is that of a scene with `rolling_resistance = true`."""
TURBULENCE: Laws[AbstractTurbulence] = Laws(
    {"laminar": Laminar, "blend": BlendedTurbulence, "pure": FullTurbulence}, AbstractTurbulence
)
"""Flow regimes of cage lands."""

DISTRIBUTED_ACCURACY = 1e-3
"""Accuracy of the distributed traction if a scene gives none."""


def thermal_factor(name: str | None) -> AbstractThermalFactor:
    return NoThermalReduction() if name is None else LINE_THERMAL[name]()


def viscous_function(name: str, oil: Lubricant | None) -> AbstractViscousFunction:
    """The flow law of this name, with the exponent with which the oil's data were fitted."""
    name = ReeEyring.name if name == MAXWELL_EYRING else name
    if name not in VISCOUS_LAWS:
        return VISCOUS[name]()
    return viscous_function_named(name, None if oil is None else oil.rheology)


def distributed_traction(
    name: str, accuracy: float | None, oil: Lubricant | None, spin: bool = False
) -> DistributedTraction:
    """The traction of a bearing's contact with the flow law of this name, to this or the assumed accuracy; `spin`:
    whether the bodies spin against each other."""
    resolution = Resolution.for_accuracy(DISTRIBUTED_ACCURACY if accuracy is None else accuracy, spin)
    return DistributedTraction(viscous_function(name, oil), resolution)


TractionAccuracy = Annotated[float, units.among_note(PRESETS)]
"""Relative error of the forces for which there is a measured resolution."""

"""Registry of the laws that scene files can name. Fields, lists in messages and pages, and the laws that are built
use these names.

A law of another package has the name of an entry point of the group `jaxbearing.laws`, see `docs/contributing.md`.
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
    """Laws of one kind by their names in scene files. A field that holds such a name has the type
    `Annotated[str, laws]`.

    **Arguments:**
    - `named`: name -> class or function that makes the law.
    - `kinds`: abstract classes; a law of another package must be a subclass of one of them.
    """

    def __init__(self, named: Mapping[str, Callable[..., AnyLaw]], *kinds: type):
        self._named, self._kinds = dict(named), kinds

    def __getitem__(self, name: str) -> Callable[..., AnyLaw]:
        """The class of the law with this name, from this package or from an entry point of another package."""
        return self._named[name] if name in self._named else self._loaded(name)

    # types are compared and hashed together with their annotations, of which this object is one
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
        """The names of laws that hold for an oil whose viscosity does not depend on pressure."""
        return tuple(name for name in self._named if not self.piezoviscous_only(name))

    def piezoviscous_only(self, name: str) -> bool:
        """True if the law of this name holds only for oils whose viscosity rises with pressure."""
        return bool(getattr(self[name], "piezoviscous_only", True))

    def fits(self, name: str) -> bool:
        """True if the film law of this name is of this kind. **Raises:** `KeyError` for an unknown name."""
        if name in self._named:
            return True
        law = ANY_FILMS[name]
        return name not in ANY_FILMS and isinstance(law, type) and issubclass(law, self._kinds)

    def every(self) -> Iterator[str]:
        """The names of the laws of this package, then of those of other packages that fit."""
        from importlib.metadata import entry_points

        yield from self._named
        for entry_point in entry_points(group=ENTRY_POINTS):
            with suppress(KeyError, PydanticCustomError):
                if entry_point.name not in self._named and self._loaded(entry_point.name):
                    yield entry_point.name

    def name_of(self, law: object) -> str:
        """The name of the class of this law."""
        return next(name for name, kind in self._named.items() if type(law) is kind)

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.read, handler(source))

    def read(self, value: object) -> str:
        """The given name, if there is a law of this name. **Raises:** `PydanticCustomError` otherwise."""
        if isinstance(value, str):
            if value in self._named:
                return value
            if value and not value.startswith("<"):
                try:
                    self._loaded(value)
                    return value
                except KeyError:
                    pass
        quoted = [f"'{name}'" for name in self._named]
        words = " or ".join(filter(None, [", ".join(quoted[:-1]), quoted[-1]]))
        raise PydanticCustomError(LAW_ERROR, "Input should be {expected}", {"expected": words})

    def _loaded(self, name: str) -> Callable[..., AnyLaw]:
        """The class to which the entry point of this name refers.

        **Raises:** `KeyError` if there is no such entry point; `PydanticCustomError` if its class cannot be loaded or
        is of another kind.
        """
        from importlib.metadata import entry_points

        entry_point = next(iter(entry_points(group=ENTRY_POINTS, name=name)), None)
        if entry_point is None:
            raise KeyError(name)
        place = f"'{name}', which an entry point says is {entry_point.value}"
        wanted = " or ".join(kind.__name__ for kind in self._kinds)
        try:
            law = entry_point.load()
        except Exception as error:  # whatever the import of another package raises
            reason = f"{type(error).__name__}: {error}"
            raise units.refusal("a law that can be loaded", f"{place}, which fails ({reason})") from error
        if not (isinstance(law, type) and issubclass(law, self._kinds)):
            raise units.refusal(f"a subclass of {wanted}", f"{place}, which is none")
        return law


class RollingLaws(Laws[AnyLaw]):
    """Laws of rolling resistance. In files `true` means the first of them. `older`: former name -> present name."""

    def __init__(self, named: Mapping[str, Callable[..., AnyLaw]], *kinds: type, older: Mapping[str, str] = _NOTHING):
        super().__init__(named, *kinds)
        self._older = dict(older)

    def read(self, value: object) -> str:
        if value is True:
            return next(iter(self))
        return super().read(self._older.get(value, value) if isinstance(value, str) else value)


def for_raceways(films: Laws[Any], joined: Callable[[Any], Any]) -> Laws[Any]:
    """Film laws for the raceways of bearings, in which some contacts carry no load.

    Formulas that hold only for piezoviscous oils give a finite film at zero load, but an unloaded rolling element needs
    the film of rigid bodies: `joined` combines the two.
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
"""Film laws of raceways, where some rolling elements may be unloaded."""
POINT_THERMAL: Laws[AbstractThermalFactor] = Laws({"gupta": Gupta}, AbstractThermalFactor)
LINE_THERMAL: Laws[AbstractThermalFactor] = Laws({**POINT_THERMAL, "hsu_lee": HsuLee}, AbstractThermalFactor)
VISCOUS: Laws[AbstractViscousFunction] = Laws(VISCOUS_LAWS, AbstractViscousFunction)
MAXWELL_EYRING = "maxwell_eyring"
"""Name of Ree and Eyring's flow law in bearings. Like every traction law here it has a Maxwell element."""
TRACTIONS: Laws[AbstractViscousFunction] = Laws({MAXWELL_EYRING: ReeEyring, **VISCOUS}, AbstractViscousFunction)
ROLLING: Laws[AbstractRollingResistance] = RollingLaws(
    {
        "full_range": FullRangeRollingResistance,
        "biboulet_houpert": BibouletHoupertRollingResistance,
        "rigid_isoviscous": RigidRollingResistance,
        # for loaded rollers; a roller outside the loaded zone has the rigid law
        "ertel_grubin": JoinedRollingResistance,
    },
    AbstractRollingResistance,
)
POINT_ROLLING: Laws[AbstractPointRollingResistance] = RollingLaws(
    {"biboulet_houpert": BibouletHoupertPointRollingResistance, "source_86": SourceRollingResistance},
    AbstractPointRollingResistance,
    older={"houpert": "source_86"},
)
"""Laws of rolling resistance of balls. As in `ROLLING` the first law is that of `rolling_resistance = true`."""
TURBULENCE: Laws[AbstractTurbulence] = Laws(
    {"laminar": Laminar, "blend": BlendedTurbulence, "pure": FullTurbulence}, AbstractTurbulence
)
"""Flow regimes of cage lands."""

DISTRIBUTED_ACCURACY = 1e-3
"""Accuracy of the distributed traction if a scene gives none."""


def thermal_factor(name: str | None) -> AbstractThermalFactor:
    return NoThermalReduction() if name is None else LINE_THERMAL[name]()


def viscous_function(name: str, oil: Lubricant | None) -> AbstractViscousFunction:
    """The flow law of this name, with the exponent that was used to fit the data of the oil."""
    name = ReeEyring.name if name == MAXWELL_EYRING else name
    if name not in VISCOUS_LAWS:
        return VISCOUS[name]()
    return viscous_function_named(name, None if oil is None else oil.rheology)


def distributed_traction(
    name: str, accuracy: float | None, oil: Lubricant | None, spin: bool = False
) -> DistributedTraction:
    """Distributed traction with the flow law of this name, resolved for `accuracy` or else `DISTRIBUTED_ACCURACY`.
    **Arguments:** `spin`: True if the bodies spin against each other."""
    resolution = Resolution.for_accuracy(DISTRIBUTED_ACCURACY if accuracy is None else accuracy, spin)
    return DistributedTraction(viscous_function(name, oil), resolution)


TractionAccuracy = Annotated[float, units.among_note(PRESETS)]
"""Relative error of the traction forces; for each allowed value a resolution has been determined."""

"""The table [contact.mixed] of bearings: mixed friction of rough surfaces."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

from ..contacts import (
    AbstractLoadShare,
    ErrorFunctionShare,
    GreenwoodTripp,
    GreenwoodTrippPressure,
    MixedFriction,
    ZhouHoeprich,
)
from .laws import Laws
from .part_writer import Rows, law_name, rows, shown, unwritable
from .table import Problems, check, refusal_at
from .table_of import number_of, table_of

SHARES: Laws[AbstractLoadShare] = Laws(
    {
        "zhou_hoeprich": ZhouHoeprich,
        "greenwood_tripp": GreenwoodTripp,
        "greenwood_tripp_pressure": GreenwoodTrippPressure,
        "error_function": ErrorFunctionShare,
    },
    AbstractLoadShare,
)
"""Laws of the load share of asperities."""
CONSTANTS = {
    "zhou_hoeprich": ("coefficient", "exponent"),
    "greenwood_tripp_pressure": ("asperity_product", "asperity_slope"),
}
"""Law of the load share -> names of its constants."""
RIB = ZhouHoeprich(1.90, 0.99)
"""Zhou and Hoeprich's load share with the default constants for the rib of a tapered roller bearing."""
_ALL = tuple(name for names in CONSTANTS.values() for name in names)


class MixedTable(table_of(MixedFriction, ZhouHoeprich, GreenwoodTrippPressure, optional=_ALL)):
    """Mixed friction of the raceways. Without this table the films carry the whole load.

    - `share`: law of the load share of asperities
    - `coefficient`, `exponent`: constants of 'zhou_hoeprich', 2.32 and 0.97 if not given
    - `asperity_product`, `asperity_slope`: constants of 'greenwood_tripp_pressure', 0.05 and 0.001 if not given
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"share": _ALL}
    share: Annotated[str, SHARES] = "zhou_hoeprich"

    @check
    def _of_the_law(self) -> Problems:
        for law, names in CONSTANTS.items():
            for name in names:
                value = getattr(self, name)
                if value is not None and self.share != law:
                    expected = f"none with share = '{self.share}': it is a constant of '{law}'"
                    yield refusal_at(name, expected, f"the number {value:g}")


class RibMixedTable(MixedTable):
    """Mixed friction of the raceways and the rib of a tapered roller bearing.

    - `flange_roughness`: combined roughness of rib and roller end; that of the raceways if not given
    - `flange_coefficient`, `flange_exponent`: constants of 'zhou_hoeprich' on the rib, 1.90 and 0.99 if not given
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"share": (*_ALL, "flange_coefficient", "flange_exponent")}
    flange_roughness: number_of(MixedFriction, "roughness") | None = None  # pyright: ignore[reportInvalidTypeForm]
    flange_coefficient: number_of(ZhouHoeprich, "coefficient") | None = None  # pyright: ignore[reportInvalidTypeForm]
    flange_exponent: number_of(ZhouHoeprich, "exponent") | None = None  # pyright: ignore[reportInvalidTypeForm]

    @check
    def _of_the_rib(self) -> Problems:
        for name in ("flange_coefficient", "flange_exponent"):
            value = getattr(self, name)
            if value is not None and self.share != "zhou_hoeprich":
                expected = f"none with share = '{self.share}': it is a constant of 'zhou_hoeprich'"
                yield refusal_at(name, expected, f"the number {value:g}")


def mixed_needs_traction(contact: Any) -> Problems:
    """Refuses a table [contact] with mixed friction but without traction."""
    if contact.mixed is not None and contact.traction is None:
        yield refusal_at("traction", "a law, without which mixed has no meaning", "nothing")


def mixed_friction(table: MixedTable | None) -> MixedFriction | None:
    """Mixed friction of raceways."""
    if table is None:
        return None
    return _built(table, table.roughness, {name: getattr(table, name) for name in CONSTANTS.get(table.share, ())})


def rib_mixed_friction(table: RibMixedTable | None) -> MixedFriction | None:
    """Mixed friction of the rib."""
    if table is None:
        return None
    constants = {name: getattr(table, name) for name in CONSTANTS.get(table.share, ())}
    if table.share == "zhou_hoeprich":
        values = {"coefficient": table.flange_coefficient, "exponent": table.flange_exponent}
        constants = {name: getattr(RIB, name) if value is None else value for name, value in values.items()}
    return _built(table, table.roughness if table.flange_roughness is None else table.flange_roughness, constants)


def _built(table: MixedTable, roughness: float, constants: Mapping[str, object]) -> MixedFriction:
    share = SHARES[table.share](**{name: value for name, value in constants.items() if value is not None})
    return MixedFriction(roughness, share, table.mu_boundary, table.slide_width, table.film)


def mixed_rows(mixed: MixedFriction | None) -> Rows:
    """The load share of the raceways, for the table [contact]."""
    if mixed is None:
        return {}
    return {"mixed": {"share": _name(mixed.share, "contact.mixed.share")} | rows(MixedTable, mixed.share)}


def rib_mixed_rows(races: MixedFriction | None, rib: MixedFriction | None) -> Rows:
    """The load shares of raceways and rib of a tapered roller bearing, for the table [contact]."""
    if (races is None) != (rib is None):
        raise unwritable("rib.mixed", shown(rib), "mixed friction of raceways and rib, or of neither")
    if races is None or rib is None:
        return {}
    entries = mixed_rows(races)
    if type(rib.share) is not type(races.share):
        raise unwritable("rib.mixed.share", shown(rib.share), f"a {type(races.share).__name__}, as on the raceways")
    more = {"flange_roughness": rows(MixedTable, rib)["roughness"]}
    if isinstance(rib.share, ZhouHoeprich):
        more |= {f"flange_{name}": value for name, value in rows(MixedTable, rib.share).items()}
    return {"mixed": entries["mixed"] | more}


def _name(law: AbstractLoadShare, path: str) -> str:
    """The name of a law; its constants may have any values."""
    try:
        return SHARES.name_of(law)
    except StopIteration:
        return law_name(SHARES, law, path)

"""The scene file of a two-disk machine. Names are the attribute names of the classes that it builds, except for
[contact], which combines several laws (see `two_disk.build`)."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator, Discriminator, Tag
from pydantic_core import PydanticCustomError

from ...machines import DiskGeometry, DiskOperation
from .. import units
from ..errors import nearest, one_of
from ..kinds import KIND
from ..laws import ANY_FILMS, LINE_FILMS, LINE_THERMAL, POINT_FILMS, POINT_THERMAL, VISCOUS, TractionAccuracy
from ..materials import MaterialField
from ..oil.needs import require_laws, require_piezoviscous
from ..oil.schema import OilTable
from ..table import Problems, Table, check, refusal_at
from ..table_of import table_of
from ..words import describe

HALF_SPACE = "half_space"
_SLIDE = "a number (a ratio, 0.05) or a text in per cent ('5 %')"


def _slide(value: object) -> float:
    """A ratio: a number, or a text in per cent."""
    if not isinstance(value, str):
        try:
            return units.number(value)
        except PydanticCustomError:
            raise units.refusal(_SLIDE, describe(value)) from None
    percent, sign, rest = value.partition("%")
    try:
        ratio = float(percent) / 100.0
    except ValueError:
        ratio = np.nan
    if not sign or rest.strip() or not np.isfinite(ratio):
        raise units.refusal(_SLIDE, describe(value))
    return ratio


def _slides(value: object) -> tuple[float, ...]:
    return units.several(value, _slide, f"{_SLIDE}, a list of them, or a table with start, stop and count")


class SlideRange(Table):
    """Evenly spaced slide-to-roll ratios, both ends included."""

    tag: ClassVar[str] = "<table>"
    start: Annotated[float, BeforeValidator(_slide)]
    stop: Annotated[float, BeforeValidator(_slide)]
    count: units.Count
    spacing: Literal["linear", "log"] = "linear"

    @check
    def _logarithms_exist(self) -> Problems:
        if self.spacing == "log" and self.start * self.stop <= 0.0:
            expected = "ends other than 0 and of one sign, which spacing = 'log' needs"
            yield refusal_at("start", expected, f"{self.start:g} to {self.stop:g}")

    def values(self) -> np.ndarray:
        space = np.geomspace if self.spacing == "log" else np.linspace
        return space(self.start, self.stop, self.count)


SlideField = Annotated[
    Annotated[tuple[float, ...], BeforeValidator(_slides), Tag("<list>")] | Annotated[SlideRange, Tag("<table>")],
    Discriminator(lambda value: "<table>" if isinstance(value, dict) else "<list>"),
]
"""A number, a list of them, or a range."""


def _compliance(value: object) -> float | str:
    """Tangential compliance L1, m/Pa, or the word for the compliance of the bodies of the scene as half-spaces."""
    if value == HALF_SPACE:
        return HALF_SPACE
    try:
        return units.quantity(value, units.TANGENTIAL_COMPLIANCE, ">= 0")
    except PydanticCustomError as error:
        expected = f"'{HALF_SPACE}' or {units.TANGENTIAL_COMPLIANCE.expected('>= 0')}"
        near = nearest(value, (HALF_SPACE,)) if isinstance(value, str) else ""
        raise units.refusal(expected, (error.context or {})["found"], near) from None


class DiskGeometryTable(table_of(DiskGeometry)):
    """See `machines.two_disk.DiskGeometry`."""


class DiskMaterialsTable(Table):
    body_1: MaterialField
    body_2: MaterialField


class TwoDiskContactTable(Table):
    """Laws of the contact by name; `scenes.laws` lists the names.

    - `traction_accuracy`: relative error of the traction forces, for which the integration over the contact is resolved
    - `compliance`: tangential compliance of the bodies in series with the film; not given: none
    - `film_heating`: true: the shear heating of the film is considered
    - `inlet`: temperature of the oil in the contact, that of the heated inlet (warm) or of the supply (cold)
    - `elastic`: true: the oil is a Maxwell element; false: the viscous limit
    """

    film: Annotated[str, ANY_FILMS]
    traction: Annotated[str, VISCOUS]
    thermal: Annotated[str, LINE_THERMAL] | None = None
    traction_accuracy: TractionAccuracy = 1e-4
    compliance: Annotated[float | str, BeforeValidator(_compliance)] | None = None
    film_heating: units.Switch = False
    inlet: Literal["warm", "cold"] = "warm"
    elastic: units.Switch = True


class DiskOperationTable(table_of(DiskOperation, leave_out=("slide_to_roll",))):
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {"pressure": ("load",), "load": ("pressure",)}
    slide_to_roll: SlideField


class TwoDiskTable(Table):
    """The whole file."""

    kind: Annotated[Literal["two_disk"], KIND]
    geometry: DiskGeometryTable
    materials: DiskMaterialsTable
    oil: OilTable
    contact: TwoDiskContactTable
    operation: DiskOperationTable

    @check
    def _fits_together(self) -> Problems:
        contact = self.contact
        line = self.geometry.contact_length is not None
        shape = (
            "line contact (geometry has a contact_length)" if line else "point contact (geometry has no contact_length)"
        )
        films = LINE_FILMS if line else POINT_FILMS
        if not films.fits(contact.film):
            yield refusal_at("contact.film", f"a film of a {shape}: {one_of(films)}", f"'{contact.film}'")
        if contact.thermal in LINE_THERMAL and contact.thermal not in POINT_THERMAL and not line:
            expected = f"{one_of(POINT_THERMAL)}, or leave it out: this factor is not for a {shape}"
            yield refusal_at("contact.thermal", expected, f"'{contact.thermal}'")

    @check
    def _oil(self) -> Problems:
        contact = self.contact
        thermal = "contact.film_heating" if contact.film_heating else ""
        thermal = f"contact.thermal = '{contact.thermal}'" if contact.thermal else thermal
        yield from require_laws(
            self.oil, {"rheology": f"contact.traction = '{contact.traction}'", "conductivity": thermal}
        )
        yield from require_piezoviscous(self.oil, contact, {"film": ANY_FILMS})

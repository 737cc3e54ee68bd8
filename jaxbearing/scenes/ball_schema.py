"""The scene file of a ball bearing. Names are the attribute names of the classes that it builds."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from . import units
from .bearing_schema import BearingCageTable as BallCageTable
from .bearing_schema import RatingTable, ThrustOperationTable, require_oil, require_oil_flow
from .laws import TractionAccuracy
from .materials import MaterialField
from .oil_schema import OilTable
from .table import Problems, Table, check, refusal_at


class BallGeometryTable(Table):
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "contact_angle": ("diametral_clearance",),
        "diametral_clearance": ("contact_angle",),
    }
    n_balls: units.Count
    pitch_diameter: units.PositiveLength
    ball_diameter: units.PositiveLength
    conformity_inner: units.Conformity
    conformity_outer: units.Conformity
    contact_angle: units.FlangeAngle | None = None
    diametral_clearance: units.NonNegativeLength | None = None
    shoulder_angle_inner: units.FlangeAngle | None = None
    shoulder_angle_outer: units.FlangeAngle | None = None
    first_element_angle: units.Angle | None = None

    @check
    def _one_of_both(self) -> Problems:
        if (self.contact_angle is None) == (self.diametral_clearance is None):
            both = "both 'contact_angle' and 'diametral_clearance'"
            found = both if self.contact_angle is not None else "neither 'contact_angle' nor 'diametral_clearance'"
            yield refusal_at("contact_angle", "one of the two: each follows from the other", found)


class BallMaterialsTable(Table):
    rings: MaterialField
    balls: MaterialField


class BallContactTable(Table):
    """Laws of the raceway contacts, by the names in `scenes.laws`, which says what each stands for.

    - `traction_accuracy`: relative error of the traction forces for which the march through the Hertz pressure is cut
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"traction": ("traction_accuracy", "heathcote")}
    film: Literal["nijenbanning", "hamrock_dowson"]
    thermal: Literal["gupta"] | None = None
    traction: Literal["maxwell_eyring", "ree_eyring", "bair_winer", "gecim_winer", "elsharkawy_hamrock"] | None = None
    traction_accuracy: TractionAccuracy | None = None
    rolling_resistance: Literal["houpert"] | None = None
    heathcote: units.Switch = False

    @check
    def _consistent(self) -> Problems:
        given = [name for name in ("traction_accuracy", "heathcote") if getattr(self, name)]
        if given and self.traction is None:
            has = "has" if len(given) == 1 else "have"
            yield refusal_at("traction", f"a law, without which {' and '.join(given)} {has} no meaning", "nothing")


ISOVISCOUS = {"film": ("nijenbanning",)}
"""The laws of `BallContactTable` that hold for an oil of the same viscosity at every pressure."""


def _sign(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or abs(value) != 1:
        raise units.refusal(
            "1 (Euler's equation) or -1 (as the source prints it), without quotes", units.describe(value)
        )
    return float(value)


def _share(value: Any) -> float:
    share = units.number(value)
    if not 0.0 <= share <= 2.0:
        raise units.refusal("a number from 0 to 2", units.describe(value))
    return share


OF_COUPLE = {
    "gyroscopic_sign": ("shared", "capped"),
    "gyroscopic_friction": ("capped",),
    "inner_share": ("shared",),
    "outer_share": ("shared",),
}
"""Field -> the laws of the gyroscopic couple that it is about."""


class KinematicsTable(Table):
    """`inner_share` and `outer_share`: parts of the couple that the friction of each race carries, in units of half of
    it; one of them is enough, since they add up to 2.

    - `gyroscopic_sign`: of the force pair that carries the couple
    - `gyroscopic_friction`: coefficient of friction that caps what a race carries
    - `inner_share`, `outer_share`: part of the couple that the race carries, in units of half of it
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"gyroscopic": tuple(OF_COUPLE)}
    attitude: Literal["outer", "inner", "min_power", "equilibrium"] | None = None
    gyroscopic: Literal["off", "shared", "capped", "resolved"] = "off"
    gyroscopic_sign: Annotated[float, BeforeValidator(_sign)] | None = None
    gyroscopic_friction: units.PositiveNumber | None = None
    inner_share: Annotated[float, BeforeValidator(_share)] | None = None
    outer_share: Annotated[float, BeforeValidator(_share)] | None = None
    orbit: Literal["own", "common"] = "own"

    @check
    def _of_the_law(self) -> Problems:
        for name, laws in OF_COUPLE.items():
            given = getattr(self, name)
            if given is not None and self.gyroscopic not in laws:
                wanted = " or ".join(f"'{law}'" for law in laws)
                expected = f"none with gyroscopic = '{self.gyroscopic}': it is about {wanted}"
                yield refusal_at(name, expected, f"the number {given:g}")
        inner, outer = self.inner_share, self.outer_share
        if inner is not None and outer is not None and not math.isclose(inner + outer, 2.0, rel_tol=1e-9):
            expected = f"{2.0 - inner:g}, or leave it out: the shares add up to 2"
            yield refusal_at("outer_share", expected, f"the number {outer:g}")


class BallDragTable(Table):
    coefficient: units.NonNegativeNumber | None = None
    through_flow_fraction: units.Fraction = 1.0


class BallBearingTable(Table):
    """The whole file. A table that is left out is not modelled."""

    kind: Literal["ball_bearing"]
    geometry: BallGeometryTable
    materials: BallMaterialsTable
    operation: ThrustOperationTable
    oil: OilTable | None = None
    contact: BallContactTable | None = None
    kinematics: KinematicsTable | None = None
    cage: BallCageTable | None = None
    drag: BallDragTable | None = None
    rating: RatingTable | None = None

    @check
    def _flow(self) -> Problems:
        """Checks what one table needs of another. The classes check the rest when they are built."""
        if self.contact is not None and self.contact.traction is not None:
            yield from require_oil_flow(self.drag, self.operation)

    @check
    def _oil(self) -> Problems:
        if self.contact is None:
            return
        slips = self.contact.traction is not None
        density = "the cage or the drag" if slips and (self.cage is not None or self.drag is not None) else ""
        yield from require_oil(self.oil, self.operation, self.contact, density, ISOVISCOUS)

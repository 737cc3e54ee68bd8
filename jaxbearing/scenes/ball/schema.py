"""The scene file of a ball bearing. Names are the attribute names of the classes that it builds."""

import math
from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from ...bearings.ball.geometry import BallGeometry
from ...bearings.ball.gyroscopic import CappedCouple, SharedCouple
from ...bearings.ball.scene import BallAttitude, BallCage, BallDragSettings, BallOperation
from ...contacts import PointLaws
from .. import units
from ..bearing.schema import (
    CageBase,
    CatalogueTable,
    FitsTable,
    InnerRingTable,
    InnerRoundnessTable,
    OuterRingTable,
    OuterRoundnessTable,
    RatingTable,
    SupplyTable,
    TemperaturesTable,
    ThermalTable,
    heating_problems,
    operation_table,
    require_oil,
    require_oil_flow,
)
from ..bearing.simulation import BallSimulationTable
from ..kinds import KIND
from ..laws import BALL_FILMS, POINT_ROLLING, POINT_THERMAL, TRACTIONS, TractionAccuracy
from ..materials import MaterialField, RingMaterialsTable
from ..mixed import MixedTable, mixed_needs_traction
from ..oil.schema import OilTable
from ..presets import Preset
from ..table import Problems, Table, check, refusal_at
from ..table_of import table_of
from ..words import describe


class BallGeometryTable(table_of(BallGeometry)):
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "contact_angle": ("diametral_clearance",),
        "diametral_clearance": ("contact_angle",),
    }


class BallMaterialsTable(RingMaterialsTable):
    balls: MaterialField
    cage: MaterialField | None = None


class BallContactTable(table_of(PointLaws)):
    """Laws of the raceway contacts by name; `scenes.laws` lists the names.

    - `traction_accuracy`: relative error of the traction forces, for which the integration over the contact is resolved
    - `rolling_resistance`: law of the raceways; `true`: the first of these laws; not given: none
    - `supply`: how much oil reaches the raceways; not given: they are fully flooded
    - `mixed`: mixed friction of rough raceways; not given: the films carry all of the loads
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "traction": ("traction_accuracy", "heathcote", "mixed"),
        "rolling_resistance": ("rolling_heating",),
    }
    film: Annotated[str, BALL_FILMS]
    thermal: Annotated[str, POINT_THERMAL] | None = None
    traction: Annotated[str, TRACTIONS] | None = None
    traction_accuracy: TractionAccuracy | None = None
    rolling_resistance: Annotated[str, POINT_ROLLING] | None = None
    supply: SupplyTable | None = None
    mixed: MixedTable | None = None

    @check
    def _mixed(self) -> Problems:
        yield from mixed_needs_traction(self)

    @check
    def _consistent(self) -> Problems:
        fields = [name for name in ("traction_accuracy", "heathcote") if getattr(self, name)]
        if fields and self.traction is None:
            has = "has" if len(fields) == 1 else "have"
            yield refusal_at("traction", f"a law, without which {' and '.join(fields)} {has} no meaning", "nothing")
        yield from heating_problems(self)


def _sign(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or abs(value) != 1:
        raise units.refusal("1 (Euler's equation) or -1 (as the source prints it), without quotes", describe(value))
    return float(value)


OF_COUPLE = {
    "gyroscopic_sign": ("shared", "capped"),
    "gyroscopic_friction": ("capped",),
    "inner_share": ("shared",),
    "outer_share": ("shared",),
}
"""Field -> laws of the gyroscopic couple that have this field."""


class KinematicsTable(
    table_of(
        *(BallAttitude, SharedCouple, CappedCouple),
        optional=("attitude", "inner_share", "outer_share", "gyroscopic_friction"),
    )
):
    """Kinematics of the balls. Only one of `inner_share` and `outer_share` is needed, since they add up to 2.

    - `gyroscopic_sign`: sign of the force pair that carries the gyroscopic couple
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"gyroscopic": tuple(OF_COUPLE)}
    gyroscopic: Literal["off", "shared", "capped", "resolved"] = "off"
    gyroscopic_sign: Annotated[float, BeforeValidator(_sign)] | None = None

    @check
    def _of_the_law(self) -> Problems:
        for name, laws in OF_COUPLE.items():
            value = getattr(self, name)
            if value is not None and self.gyroscopic not in laws:
                wanted = " or ".join(f"'{law}'" for law in laws)
                expected = f"none with gyroscopic = '{self.gyroscopic}': it is about {wanted}"
                yield refusal_at(name, expected, f"the number {value:g}")
        inner, outer = self.inner_share, self.outer_share
        if inner is not None and outer is not None and not math.isclose(inner + outer, 2.0, rel_tol=1e-9):
            expected = f"{2.0 - inner:g}, or leave it out: the shares add up to 2"
            yield refusal_at("outer_share", expected, f"the number {outer:g}")


class BallCageTable(table_of(BallCage, base=CageBase)):
    """See `bearings.ball.scene.BallCage`."""


class BallOperationTable(operation_table(BallOperation)):
    """See `bearings.ball.scene.BallOperation`."""


class BallDragTable(table_of(BallDragSettings)):
    """See `bearings.ball.scene.BallDragSettings`."""


class BallBearingTable(Table):
    """The whole file. A table that is left out is not modelled."""

    kind: Annotated[Literal["ball_bearing"], KIND]
    laws: Preset | None = None
    geometry: BallGeometryTable
    materials: BallMaterialsTable
    operation: BallOperationTable
    oil: OilTable | None = None
    contact: BallContactTable | None = None
    kinematics: KinematicsTable | None = None
    cage: BallCageTable | None = None
    drag: BallDragTable | None = None
    rating: RatingTable | None = None
    catalogue: CatalogueTable | None = None
    fits: FitsTable | None = None
    temperatures: TemperaturesTable | None = None
    thermal: ThermalTable | None = None
    simulation: BallSimulationTable | None = None
    outer_ring: OuterRingTable | None = None
    inner_ring: InnerRingTable | None = None
    inner_roundness: InnerRoundnessTable | None = None
    outer_roundness: OuterRoundnessTable | None = None

    @check
    def _flow(self) -> Problems:
        """Checks what one table needs of another. The classes check the rest when they are built."""
        if self.contact is not None and self.contact.traction is not None:
            yield from require_oil_flow(self.drag, self.operation)

    @check
    def _kind_of_run(self) -> Problems:
        if self.simulation is not None:
            yield from self.simulation.of_other_run(warm=self.thermal is not None)

    @check
    def _oil(self) -> Problems:
        if self.contact is None:
            return
        slips = self.contact.traction is not None
        density = "the cage or the drag" if slips and (self.cage is not None or self.drag is not None) else ""
        yield from require_oil(self.oil, self.operation, self.contact, density, {"film": BALL_FILMS})

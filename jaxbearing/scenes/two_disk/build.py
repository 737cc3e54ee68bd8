"""Builds the scene of a two-disk machine from its valid table. Only Python and numpy numbers enter the constructors:
nothing runs on JAX."""

from functools import cache
from typing import Any

from ...contacts import DistributedTraction, FilmHeating, GivenCompliance, Resolution
from ...lubricants import Lubricant
from ...machines import DiskGeometry, DiskMaterials, DiskOperation, TwoDisk, TwoDiskLaws
from ..bearing.build import built
from ..laws import ANY_FILMS, thermal_factor, viscous_function
from ..materials import material
from ..oil.catalogue import lubricant
from .schema import HALF_SPACE, DiskOperationTable, SlideRange, TwoDiskContactTable, TwoDiskTable


def two_disk(table: TwoDiskTable) -> TwoDisk:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    oil = cache(lambda: lubricant(table.oil))
    return built(
        TwoDisk,
        geometry=lambda: DiskGeometry(**table.geometry.model_dump()),
        materials=lambda: DiskMaterials(material(table.materials.body_1), material(table.materials.body_2)),
        oil=oil,
        contact=lambda: _laws(table.contact, oil()),
        operation=lambda: _operation(table.operation),
    )


def _laws(table: TwoDiskContactTable, oil: Lubricant) -> TwoDiskLaws:
    compliance = table.compliance
    traction = DistributedTraction(
        viscous=viscous_function(table.traction, oil),
        resolution=Resolution.for_accuracy(table.traction_accuracy),
        compliance=GivenCompliance(compliance) if isinstance(compliance, float) else None,
        heating=FilmHeating() if table.film_heating else None,
        elastic=table.elastic,
    )
    return TwoDiskLaws(
        film=ANY_FILMS[table.film](),
        traction=traction,
        thermal=thermal_factor(table.thermal),
        warm_inlet=table.inlet == "warm",
        half_space_compliance=compliance == HALF_SPACE,
    )


def _operation(table: DiskOperationTable) -> DiskOperation:
    slide = table.slide_to_roll
    values: dict[str, Any] = {name: getattr(table, name) for name in DiskOperationTable.model_fields}
    values["slide_to_roll"] = slide.values() if isinstance(slide, SlideRange) else slide
    return DiskOperation(**values)

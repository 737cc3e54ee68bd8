"""Scenes of the cylindrical roller bearing built from parts in plain Python, without the scene reader."""

import math
import tomllib
from pathlib import Path

import equinox as eqx
import numpy as np
from reference_oils import mobil_jet_ii

from jaxbearing.bearings.cylindrical.scene import (
    CylindricalRollerBearing,
    RollerCage,
    RollerFlange,
    RollerGeometry,
)
from jaxbearing.bearings.operation import Operation
from jaxbearing.bearings.parts import ContactLaws, Drag, Materials
from jaxbearing.contacts import (
    DistributedTraction,
    DowsonHigginson,
    Gupta,
    MartinBlend,
    MaxwellEyring,
    Moes,
    NoThermalReduction,
)
from jaxbearing.lubricants import ConstantPressureViscosity
from jaxbearing.materials import CATALOGUE, Material

RPM = 2.0 * math.pi / 60.0
LITRE_PER_HOUR = 1e-3 / 3600.0
PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "cylindrical_roller.toml").read_text())

REFERENCE_STEEL = Material(np.float64(210e9), np.float64(0.3), np.float64(7850.0))
REFERENCE_LAWS = ContactLaws(
    film=MartinBlend(DowsonHigginson()),
    thermal=NoThermalReduction(),
    traction=MaxwellEyring(),
    entrainment_offset=1e-3,
)
BEST_LAWS = ContactLaws(film=Moes(), thermal=Gupta(), traction=DistributedTraction())


def reference_roller() -> CylindricalRollerBearing:
    """Tables 13 and 16 of the source with the reference closure (drag coefficient 1.2)."""
    oil = eqx.tree_at(lambda o: o.pressure_viscosity, mobil_jet_ii(), ConstantPressureViscosity(10.4e-9))
    return CylindricalRollerBearing(
        geometry=RollerGeometry(
            n_rollers=30,
            pitch_diameter=142e-3,
            roller_diameter=12e-3,
            roller_length=14e-3,
            contact_length=12.4e-3,
            diametral_clearance=30e-6,
        ),
        materials=Materials(REFERENCE_STEEL, REFERENCE_STEEL),
        operation=Operation(
            inner_speed=10500 * RPM, radial_load=25e3, oil_temperature=373.15, oil_flow=150 * LITRE_PER_HOUR
        ),
        oil=oil,
        contact=REFERENCE_LAWS,
        cage=RollerCage(
            guidance="inner_ring",
            guiding_clearance=480e-6,
            pocket_clearance=300e-6,
            land_width=3.98e-3,
            inner_diameter=135e-3,
            outer_diameter=146e-3,
            pocket_axial_clearance=350e-6,
        ),
        flange=RollerFlange(ring="inner", axial_clearance=30e-6, angle=math.radians(0.375), height=2.5e-3),
        drag=Drag(1.2),
    )


def turbine_roller() -> CylindricalRollerBearing:
    """The same bearing with the package's best laws, M50 steel and drag coefficient 0.3."""
    steel = CATALOGUE["M50"]
    return reference_roller().replace(
        {"contact": BEST_LAWS, "oil": mobil_jet_ii(), "materials": Materials(steel, steel), "drag.coefficient": 0.3}
    )


def dry_roller() -> CylindricalRollerBearing:
    """Only the load distribution: no films, no cage."""
    return reference_roller().replace({"contact": None, "oil": None, "cage": None, "flange": None, "drag": None})


def changed(scene: CylindricalRollerBearing, change: dict) -> CylindricalRollerBearing:
    """A row's change; "rpm" stands for the inner speed."""
    si = {("operation.inner_speed" if k == "rpm" else k): (v * RPM if k == "rpm" else v) for k, v in change.items()}
    return scene.replace(si)


HARD_CASES = {
    "nominal": {},
    "1 N": {"operation.radial_load": 1.0},
    "300 N, clearance 60 um": {"operation.radial_load": 300.0, "geometry.diametral_clearance": 60e-6},
    "preload 20 um": {"geometry.diametral_clearance": -20e-6},
    "no clearance": {"geometry.diametral_clearance": 0.0},
    "40000 rpm": {"rpm": 40000.0},
    "oil at 0 degC": {"operation.oil_temperature": 273.15},
    "oil at 0 degC, light load": {"operation.oil_temperature": 273.15, "operation.radial_load": 100.0},
    "no oil flow": {"operation.oil_flow": 0.0},
    "no drag": {"drag.coefficient": 0.0},
    "100 rpm": {"rpm": 100.0},
    "200 kN": {"operation.radial_load": 200e3},
    "100 rpm, 50 kN, 60 degC": {"rpm": 100.0, "operation.radial_load": 50e3, "operation.oil_temperature": 333.15},
    "rings nearly turning together": {"operation.outer_speed": 10400 * RPM},
    "rolling would hold the cage still": {"operation.outer_speed": -10500 * RPM * 65.0 / 77.0},
}
"""The steady solve must survive these: few loaded rollers, nothing to slip against, thick oil, thin films."""

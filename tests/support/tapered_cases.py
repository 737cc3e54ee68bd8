"""The tapered roller bearing of the check values (G1, plausible 30206)."""

import numpy as np

from jaxbearing.bearings.parts import Materials
from jaxbearing.bearings.tapered.geometry import TaperedGeometry
from jaxbearing.bearings.tapered.scene import TaperedOperation, TaperedRollerBearing
from jaxbearing.materials import Material

RPM = 2.0 * np.pi / 60.0
STEEL = Material(np.float64(206e9), np.float64(0.3), np.float64(7850.0))
G1 = {
    "n_rollers": 17,
    "roller_diameter": 7.95e-3,
    "roller_length": 9.6e-3,
    "contact_angle": np.radians(14.036),
    "roller_half_angle": np.radians(2.0),
    "flange_angle": np.radians(10.35),
    "end_radius": 108e-3,
}


def tapered(axial, radial=None, rpm=0.0, **operation):
    """G1 under loads in N."""
    point = TaperedOperation(rpm * RPM, axial_load=axial, radial_load=radial, **operation)
    return TaperedRollerBearing(TaperedGeometry(**G1), Materials(STEEL, STEEL), point)

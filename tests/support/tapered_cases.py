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


CHECKS = {
    "A": ((10e3,), {}, (58.03818, 0, 0, 2420.416, 2425.397, 169.1898, 5.54238e-5, 8.69183e-5, 4.66123e-6)),
    "B": (
        (5e3, 10e3, 3000),
        {"misalignment": 0.0},
        (30.25991, 7.121336, 0, 2452.596, 2458.972, 171.7668, 2.67573e-5, 8.80081e-5, 5.74437e-6),
    ),
    "C": ((3e3, None, 15000), {}, (19.29163, 0, 0, 692.9694, 727.6192, 56.63041, 1.82271e-5, 2.96293e-5, 1.59468e-6)),
    "D": (
        (8e3, 6e3, 3000),
        {"moment": 660.0},
        (47.20960, 133.7550, -1.154747e-3, 2672.520, 2679.348, 187.1397, 1.85987e-5, 6.72846e-4, 3.84563e-6),
    ),
}
"""Arguments of `tapered`, and `check_values` of the solution: printed to 7 digits, with a spring of 1 N/m."""


def check_values(found):
    """Displacements of the cone, um and rad, then of roller 0: Q_i, Q_o, Q_f, u_x, phi, u_z."""
    e = found.elements
    places = (e.load_inner, e.load_outer, e.load_flange, e.roller_shift, e.roller_tilt, e.roller_lift)
    return [found.ring.axial * 1e6, found.ring.radial * 1e6, found.ring.tilt, *(one[0] for one in places)]

"""Constants of SKF's friction model, by family and series.

**Source:** SKF general catalogue, chapter on friction, pages 88 to 103 (read in its text), and a later table of the
same constants for the angular contact series with a letter of the angle and for reinforced cylindrical bearings.
Lengths in mm, loads in N, speeds in rpm, moments in N mm.
"""

from typing import NamedTuple

DEEP_GROOVE = {
    ("2", "3"): (4.4e-7, 1.7, 0.002, 100.0),
    ("42", "43"): (5.4e-7, 0.96, 0.003, 40.0),
    ("60", "630"): (4.1e-7, 1.7, 0.00373, 14.6),
    ("62", "622"): (3.9e-7, 1.7, 0.00323, 36.5),
    ("63", "623"): (3.7e-7, 1.7, 0.00284, 92.8),
    ("64",): (3.6e-7, 1.7, 0.00243, 198.0),
    ("160", "161"): (4.3e-7, 1.7, 0.00463, 4.25),
    ("617", "618", "628", "637", "638"): (4.7e-7, 1.7, 0.0065, 0.78),
    ("619", "639"): (4.3e-7, 1.7, 0.00475, 3.6),
}
"""Constants R1, R2, S1, S2 by series."""
ANGULAR_CONTACT = {
    ("single row",): (5.03e-7, 1.97, 1.9e-12, 0.013, 0.68, 1.91e-12),
    ("double row",): (6.34e-7, 1.41, 7.83e-13, 0.00756, 1.21, 7.83e-13),
    ("72B",): (4.33e-7, 2.02, 2.44e-12, 0.0182, 0.71, 2.44e-12),
    ("73B",): (4.54e-7, 2.02, 1.84e-12, 0.0164, 0.71, 1.84e-12),
    ("72AC",): (3.58e-7, 3.64, 3.55e-12, 0.0114, 1.55, 3.55e-12),
    ("73AC",): (3.48e-7, 3.64, 1.66e-12, 0.00985, 1.55, 1.66e-12),
    ("32A",): (5.18e-7, 1.63, 4.18e-12, 0.0108, 1.47, 4.18e-12),
    ("33A",): (5.31e-7, 1.63, 8.83e-13, 0.00548, 1.47, 8.83e-13),
}
"""Constants R1, R2, R3, S1, S2, S3 by series."""
FOUR_POINT = {("QJ2", "QJ3"): (4.78e-7, 2.42, 1.4e-12, 0.012, 0.9, 1.4e-12)}
"""Constants R1, R2, R3, S1, S2, S3 by series."""
CYLINDRICAL = {
    ("2", "3"): (1.09e-6, 0.16, 0.0015),
    ("4",): (1.0e-6, 0.16, 0.0015),
    ("10",): (1.12e-6, 0.17, 0.0015),
    ("12", "20"): (1.23e-6, 0.16, 0.0015),
    ("22",): (1.4e-6, 0.16, 0.0015),
    ("23",): (1.48e-6, 0.16, 0.0015),
}
"""Constants R1, S1, S2 of bearings with a cage, by series."""
FULL_COMPLEMENT = (2.13e-6, 0.16, 0.0015)
"""R1, S1, S2 of full complement cylindrical roller bearings, of any series."""
TAPERED = {
    ("302",): (1.76e-6, 10.9, 0.017, 2.0),
    ("303",): (1.69e-6, 10.9, 0.017, 2.0),
    ("313", "313X"): (1.84e-6, 10.9, 0.048, 2.0),
    ("320X",): (2.38e-6, 10.9, 0.014, 2.0),
    ("322",): (2.27e-6, 10.9, 0.018, 2.0),
    ("322B",): (2.38e-6, 10.9, 0.026, 2.0),
    ("323",): (2.38e-6, 10.9, 0.019, 2.0),
    ("323B",): (2.79e-6, 10.9, 0.03, 2.0),
    ("329",): (2.31e-6, 10.9, 0.009, 2.0),
    ("330",): (2.71e-6, 11.3, 0.01, 2.0),
    ("331",): (2.71e-6, 10.9, 0.015, 2.0),
    ("332",): (2.71e-6, 10.9, 0.018, 2.0),
    ("LL",): (1.72e-6, 10.9, 0.0057, 2.0),
    ("L",): (2.19e-6, 10.9, 0.0093, 2.0),
    ("LM",): (2.25e-6, 10.9, 0.011, 2.0),
    ("M",): (2.48e-6, 10.9, 0.015, 2.0),
    ("HM",): (2.6e-6, 10.9, 0.02, 2.0),
    ("H",): (2.66e-6, 10.9, 0.025, 2.0),
    ("HH",): (2.51e-6, 10.9, 0.027, 2.0),
    ("other",): (2.31e-6, 10.9, 0.019, 2.0),
}
"""Constants R1, R2, S1, S2 by series. The later table prints 2.60e-6 for R1 of series H."""
GEOMETRY = {
    "deep_groove": 3.1,
    "angular_contact": 4.4,
    "angular_contact_double": 3.1,
    "four_point": 3.1,
    "cylindrical": 5.1,
    "cylindrical_full": 6.2,
    "tapered": 6.0,
}
"""Geometry constant K_z by family."""
ROLLER_DRAG = {"cylindrical": 0.65, "cylindrical_full": 0.7, "tapered": 0.7}
"""Geometry constant K_L of roller bearings by family."""
FILM_FRICTION = {"cylindrical": 0.02, "cylindrical_full": 0.02, "tapered": 0.002}
"""Friction coefficient mu_EHL by family; that of ball bearings is `BALL_FILM_FRICTION`."""
BALL_FILM_FRICTION = 0.05
"""Friction coefficient mu_EHL of ball bearings with mineral oil; 0.04 with synthetic oils, 0.1 with transmission
fluids."""
BOUNDARY_FRICTION = 0.15
"""Boundary friction coefficient mu_bl; the later table has 0.12 for bearings in motion."""
DRAG_LEVELS = (0.0, 0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2, 0.3, 0.5, 0.8, 1.0, 1.2, 1.4)
"""Values of H/d_m, oil level over mean diameter, for which V_M is tabulated."""
BALL_DRAG_VARIABLE = (
    *(0.0, 2e-6, 1.2e-5, 3e-5, 6.5e-5, 1e-4, 1.45e-4, 1.95e-4, 2.45e-4, 3.8e-4),
    *(5.5e-4, 8e-4, 1e-3, 1.25e-3, 1.25e-3),
)
"""V_M of ball bearings at `DRAG_LEVELS`; read from the catalogue's graph by a third party."""
ROLLER_DRAG_VARIABLE = (
    *(0.0, 5e-6, 3e-5, 6e-5, 1e-4, 1.5e-4, 2.1e-4, 2.6e-4, 3e-4, 4.8e-4),
    *(6.8e-4, 1e-3, 1.25e-3, 1.5e-3, 1.5e-3),
)
"""V_M of roller bearings at `DRAG_LEVELS`; read from the catalogue's graph by a third party."""


class SealConstants(NamedTuple):
    """Constants K_S1, K_S2 and beta of two seals of a kind, and the bearing outside diameters, mm, over which and up to
    which they hold."""

    k1: float
    k2: float
    beta: float
    over: float
    to: float


_ANY = float("inf")
SEALS = {
    ("deep_groove", "RSL"): (SealConstants(0.0, 0.0, 0.0, 0.0, 25.0), SealConstants(0.0018, 0.0, 2.25, 25.0, 52.0)),
    ("deep_groove", "RZ"): (SealConstants(0.0, 0.0, 0.0, 0.0, _ANY),),
    ("deep_groove", "RSH"): (SealConstants(0.028, 2.0, 2.25, 0.0, 52.0),),
    ("deep_groove", "RS1"): (
        SealConstants(0.023, 2.0, 2.25, 0.0, 62.0),
        SealConstants(0.018, 20.0, 2.25, 62.0, 80.0),
        SealConstants(0.018, 15.0, 2.25, 80.0, 100.0),
        SealConstants(0.018, 0.0, 2.25, 100.0, _ANY),
    ),
    ("angular_contact", "RS1"): (SealConstants(0.014, 10.0, 2.0, 30.0, 120.0),),
    ("cylindrical_full", "LS"): (SealConstants(0.032, 50.0, 2.0, 42.0, 360.0),),
}
"""Constants of seals by family and name of the seal, each for a range of outside diameters."""

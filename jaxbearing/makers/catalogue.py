"""Data of a catalogue bearing that the makers' formulas need and a scene does not have."""

from typing import ClassVar, Literal

import equinox as eqx

from .._scene import optional_number
from .._types import Scalar
from ..numerics.checks import Checked
from ..numerics.structure import choice, count

LUBRICATIONS = ("oil_bath", "oil_jet", "oil_air", "grease")
"""Ways of supplying a bearing with lubricant."""
SEALS = ("none", "RSL", "RZ", "RSH", "RS1", "LS")
"""Seals of SKF."""
ALL_FAMILIES = ("deep_groove", "angular_contact", "four_point", "cylindrical", "cylindrical_full", "tapered")


class Catalogue(Checked):
    """Data of a catalogue that the makers' formulas need besides the scene. They change no result.

    A missing value is taken from the scene, or has a usual default, which the comparison names as assumed, or leaves a
    formula without a result.

    **Arguments:**
    - `designation`: such as "6205-2RSH", "NU 210 ECP", "32216"; it gives series, bore and seals where it states them.
    - `family`: of the bearing; not given: by the designation or, for roller bearings, by the kind of scene.
    - `series`: as named in the makers' tables, such as "62", "72B", "2" (of NU 2), "320X"; not given: by the
      designation.
    - `bore`, `outside_diameter`, `width`: boundary dimensions, m; not given: those of the geometry, the bore by the
      designation.
    - `static_capacity`: C0, N; not given: that of the rating or of the life.
    - `axial_factor`: Y of a tapered bearing; not given: 0.4 cot(contact angle) of ISO 281 (assumed).
    - `kinematic_viscosity`: of the oil in operation, m^2/s; not given: of the scene's oil at the inlet temperature.
    - `lubrication`: how the bearing gets its oil; not given: by an oil bath (assumed).
    - `oil_level`: H, height of the oil above the lowest point of the outer raceway, m; not given: no drag, but with an
      oil jet twice that of a bath up to half a rolling element.
    - `starvation_constant`: K_rs of SKF, 3e-8 with a low oil level or a jet, 6e-8 with grease or oil and air; not
      given: 0 (assumed).
    - `boundary_friction`: mu_bl of SKF; not given: 0.15 (assumed).
    - `film_friction`: mu_EHL of SKF; not given: 0.05, 0.02 or 0.002 of ball, cylindrical and tapered bearings
      (assumed).
    - `seal`: seal of SKF; not given: by the designation, else none (assumed).
    - `n_seals`: number of seals; not given: by the designation, else 2.
    - `seal_diameter`: on which the seal runs, m.
    - `timken_g1`: G1 of a tapered bearing of Timken.
    - `timken_g2`: G2 of a tapered bearing of Timken, for the least speed of its formula.
    - `timken_k`: K of a tapered bearing of Timken.
    - `timken_f2`: f2 by the manual's graph, for the least speed of its formula.
    - `timken_f3`: f3 by the manual's graph; needed from K Fa/Fr = 0.47 to 2.
    """

    part: ClassVar[str] = "catalogue"

    designation: str | None = eqx.field(default=None, static=True)
    family: str | None = choice("catalogue.family", ALL_FAMILIES, None)
    series: str | None = eqx.field(default=None, static=True)
    bore: Scalar | None = optional_number(bound="> 0", unit="m")
    outside_diameter: Scalar | None = optional_number(bound="> 0", unit="m")
    width: Scalar | None = optional_number(bound="> 0", unit="m")
    static_capacity: Scalar | None = optional_number(bound="> 0", unit="N")
    axial_factor: Scalar | None = optional_number(bound="> 0", unit="1")
    kinematic_viscosity: Scalar | None = optional_number(bound="> 0", unit="m^2/s")
    lubrication: Literal["oil_bath", "oil_jet", "oil_air", "grease"] | None = choice(
        "catalogue.lubrication", LUBRICATIONS, None
    )
    oil_level: Scalar | None = optional_number(bound=">= 0", unit="m")
    starvation_constant: Scalar | None = optional_number(bound=">= 0", unit="1")
    boundary_friction: Scalar | None = optional_number(bound="> 0", unit="1")
    film_friction: Scalar | None = optional_number(bound="> 0", unit="1")
    seal: str | None = choice("catalogue.seal", SEALS, None)
    n_seals: int | None = count("catalogue.n_seals", None, least=1, most=2)
    seal_diameter: Scalar | None = optional_number(bound="> 0", unit="m")
    timken_g1: Scalar | None = optional_number(bound="> 0", unit="1")
    timken_g2: Scalar | None = optional_number(bound="> 0", unit="1")
    timken_k: Scalar | None = optional_number(bound="> 0", unit="1")
    timken_f2: Scalar | None = optional_number(bound=">= 0", unit="1")
    timken_f3: Scalar | None = optional_number(bound=">= 0", unit="1")

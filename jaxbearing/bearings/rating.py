"""Inputs of the fatigue life, for all kinds of bearings."""

import re
from typing import Any, ClassVar, Literal

from .._scene import optional_number
from .._types import Scalar
from ..numerics.checks import Checked
from ..numerics.structure import choice, constant, count, switch

CATALOGUE_CONFORMITY = 0.52
"""Groove radius over ball diameter for which ISO 281 and catalogues rate ball bearings."""
RELIABILITIES = (0.90, 0.95, 0.96, 0.97, 0.98, 0.99)
"""Reliabilities for which ISO 281 gives a factor."""
CLEANLINESS_CLASSES = (
    *(f"online_filter_{code}" for code in (13, 15, 17, 19)),
    *(f"grease_{word}" for word in ("high", "normal", "typical", "severe", "very_severe")),
)
"""Contamination classes of ISO 281: circulating oil, by the code of its cleanliness, and grease."""
_ISO_4406 = re.compile(r"(?:(?:\d{1,2}|[-\u2013*])\s*/)?\s*(\d{1,2})\s*/\s*(\d{1,2})")
_FILTERS = {f"online_filter_{code}": (code, code - 3) for code in (13, 15, 17, 19)}
"""Contamination class of circulating oil -> code numbers of ISO 4406 at 6 and 14 um."""
ISO_4406 = "the ISO 4406 code of circulating oil, such as '-/17/14'"
"""Description of the codes that are accepted in place of a contamination class, for messages."""
LAMINAE = 30
"""Number of laminae of a roller in the reference life if a scene does not give it."""


def cleanliness_named(value: object) -> Any:
    """Contamination class for an ISO 4406 code of circulating oil such as "-/17/14", "20/17/14" or "17/14".

    It is the cleanest class whose numbers at 6 and 14 um are both at least those of the code. Any other value is
    returned unchanged, also a code that is dirtier than all classes."""
    code = _ISO_4406.fullmatch(value.strip()) if isinstance(value, str) else None
    if code is None:
        return value
    fine, coarse = int(code[1]), int(code[2])
    classes = (name for name, limits in _FILTERS.items() if fine <= limits[0] and coarse <= limits[1])
    return next(classes, value)


class Rating(Checked):
    """Load ratings and conditions for the life. Ratings that are not given are computed from the geometry; conditions
    that are not given are computed from the scene or not modelled.

    **Arguments:**
    - `dynamic_capacity`: basic dynamic load rating C, computed from the geometry if not given, N.
    - `static_capacity`: basic static load rating C0, computed from the geometry if not given, N.
    - `fatigue_load_limit`: fatigue load limit C_u, computed from C0 if not given, N.
    - `grooves`: conformities with which C and C0 of a ball bearing are computed (structure): "catalogue", 0.52 for both
      races as in catalogues, or "scene", those of the bearing. ISO 281 gives no higher rating to closer grooves. With
      "scene" a closer groove of the inner race alone adds 9 %.
    - `tilt`: motion of a tilted inner ring in a ball bearing (structure): "exact", or "iso", the equations of ISO
      16281, for comparison with software based on the standard. These are linear in the tilt, use half the pitch
      diameter as the lever of tilt and moment, and the contact stiffnesses at the nominal angle. With "iso" the
      displacements and loads of the solution follow the standard too.
    - `reliability`: fraction of bearings that reach the life, 0.90, 0.95, 0.96, 0.97, 0.98 or 0.99 (structure: another
      one recompiles).
    - `cleanliness`: name of a contamination class, or an ISO 4406 code of circulating oil such as "-/17/14" or
      "18/16/13", which stands for the cleanest class that is not cleaner than the code. With a class and a viscosity
      ratio the modified life (a_ISO) is computed.
    - `contamination_factor`: contamination factor e_C (eta_c in catalogues), instead of the class: 1 without particles,
      0.8 to 0.6 clean, 0.3 to 0.1 contaminated.
    - `viscosity_ratio`: viscosity ratio kappa, by default computed from the oil, its temperature and the speed if the
      scene has them, > 0.
    - `roughness_rings`: root mean square roughness of the raceways, m. With `roughness_elements` and a film it gives
      the lambda ratio.
    - `roughness_elements`: root mean square roughness of the rolling elements, m.
    - `n_laminae`: number of laminae of each roller in the reference life, by default that of the profile or else 30
      (structure).
    - `edge_factor`: whether loads of laminae near the ends count more, by the estimate of the standard for calculations
      without pressures. If not given: yes for straight rollers, no for rollers with a profile.
    """

    part: ClassVar[str] = "rating"

    dynamic_capacity: Scalar | None = optional_number(bound="> 0", unit="N")
    static_capacity: Scalar | None = optional_number(bound="> 0", unit="N")
    fatigue_load_limit: Scalar | None = optional_number(bound="> 0", unit="N")
    viscosity_ratio: Scalar | None = optional_number(bound="> 0", unit="1")
    contamination_factor: Scalar | None = optional_number(bound="above 0 and at most 1", unit="1")
    roughness_rings: Scalar | None = optional_number(bound="> 0", unit="m")
    roughness_elements: Scalar | None = optional_number(bound="> 0", unit="m")
    reliability: float = constant("rating.reliability", 0.90, among=RELIABILITIES)
    cleanliness: str | None = choice(
        "rating.cleanliness", CLEANLINESS_CLASSES, None, also=cleanliness_named, also_words=ISO_4406
    )
    n_laminae: int | None = count("rating.n_laminae", None, least=1)
    edge_factor: bool | None = switch("rating.edge_factor", None)
    grooves: Literal["catalogue", "scene"] = choice("rating.grooves", ("catalogue", "scene"), "catalogue")
    tilt: Literal["exact", "iso"] = choice("rating.tilt", ("exact", "iso"), "exact")

    def __check_init__(self):
        super().__check_init__()
        if self.cleanliness is not None and self.contamination_factor is not None:
            raise ValueError(
                "rating.contamination_factor: expected none beside rating.cleanliness, which is a factor by its class"
            )
        if (self.roughness_rings is None) != (self.roughness_elements is None):
            missing, present = ("rings", "elements") if self.roughness_rings is None else ("elements", "rings")
            raise ValueError(
                f"rating.roughness_{missing}: found nothing, expected a length, which 'roughness_{present}' "
                "needs beside it"
            )

    @property
    def says_cleanliness(self) -> bool:
        """True if a contamination class or factor is given, so that the modified life can be computed."""
        return self.cleanliness is not None or self.contamination_factor is not None

    def groove_assumptions(self) -> tuple[str, ...]:
        """Notes for the user about the grooves that the ratings of a ball bearing assume."""
        missing = [name for name in ("dynamic_capacity", "static_capacity") if getattr(self, name) is None]
        if not missing:
            return ()
        grooves = "the conformities of the scene"
        if self.grooves == "catalogue":
            grooves = "grooves of conformity 0.52, as catalogues do (rating.grooves = 'scene' takes the scene's)"
        names = " and ".join(f"rating.{name}" for name in missing)
        return (f"{names} not given: computed with {grooves}",)


def rated_laminae(rating: Rating | None, own: int = LAMINAE) -> int:
    """Number of laminae of a roller in the reference life: that of the rating, otherwise `own`, that of its
    contacts."""
    return own if rating is None or rating.n_laminae is None else rating.n_laminae

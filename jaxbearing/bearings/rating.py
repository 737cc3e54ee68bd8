"""Inputs of the fatigue life of a bearing: the same for all kinds of bearings."""

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
"""Contamination classes of ISO 281: circulating oil by the code of its filter, and grease."""
_ISO_4406 = re.compile(r"(?:(?:\d{1,2}|[-\u2013*])\s*/)?\s*(\d{1,2})\s*/\s*(\d{1,2})")
_FILTERS = {f"online_filter_{code}": (code, code - 3) for code in (13, 15, 17, 19)}
"""Classes of circulating oil by the code numbers of ISO 4406 at 6 and 14 um."""
ISO_4406 = "the ISO 4406 code of circulating oil, such as '-/17/14'"
"""Further names of contamination classes in words."""
LAMINAE = 30
"""Laminae of a roller in the reference life where a scene does not say."""


def cleanliness_named(given: object) -> Any:
    """The contamination class of an ISO 4406 code of circulating oil, "-/17/14", "20/17/14" or "17/14".

    It is the cleanest one whose numbers at 6 and 14 um are both at least those of the code. Anything else is returned
    as it is, also a code that is dirtier than all classes."""
    code = _ISO_4406.fullmatch(given.strip()) if isinstance(given, str) else None
    if code is None:
        return given
    fine, coarse = int(code[1]), int(code[2])
    classes = (name for name, limits in _FILTERS.items() if fine <= limits[0] and coarse <= limits[1])
    return next(classes, given)


class Rating(Checked):
    """Ratings and conditions for the life; what is not given is computed from the geometry, or not modelled.

    **Arguments:**
    - `dynamic_capacity`, `static_capacity`: C and C0, N; not given: from the geometry.
    - `fatigue_load_limit`: C_u, N; not given: from C0.
    - `grooves`: of ball bearings, for which conformities C and C0 are computed: "catalogue", 0.52 of both races, which
      ratings of catalogues are made with, whatever the grooves; or "scene" (structure). ISO 281 gives no higher rating
      to closer grooves, and a closer one of the inner race alone adds 9 %.
    - `tilt`: of ball bearings, the motion of a tilted inner ring: "exact"; or "iso", the equations of ISO 16281, to
      compare with software built on the standard: to first order, with half the pitch diameter as the lever of tilt
      and moment, and stiffnesses of contacts at the nominal angle. Displacements and loads are then the standard's too
      (structure).
    - `reliability`: fraction of bearings that live longer, 0.90, 0.95, 0.96, 0.97, 0.98 or 0.99 (structure: another one
      recompiles).
    - `cleanliness`: name of a contamination class, or the ISO 4406 code of circulating oil, such as "-/17/14" or
      "18/16/13", for which the cleanest class that is not cleaner than the code counts; with it, and with a viscosity
      ratio, the life is modified (a_ISO).
    - `contamination_factor`: the factor e_C itself (eta_c of makers), in the place of the class: 1 without particles,
      0.8 to 0.6 clean, 0.3 to 0.1 contaminated.
    - `viscosity_ratio`: the ratio kappa, > 0; not given: from the oil, its temperature and the speed, where the scene
      has them.
    - `roughness_rings`, `roughness_elements`: root mean square, m; with them and films: the lambda ratio.
    - `n_laminae`: number of laminae of each roller in the reference life (structure); not given: those of the profile,
      or 30.
    - `edge_factor`: whether the load of laminae near the ends counts more, as the standard estimates where no pressure
      is computed; not given: yes for straight rollers, no for rollers with a profile.
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
            missing, given = ("rings", "elements") if self.roughness_rings is None else ("elements", "rings")
            raise ValueError(
                f"rating.roughness_{missing}: found nothing, expected a length, which 'roughness_{given}' "
                "needs beside it"
            )

    @property
    def says_cleanliness(self) -> bool:
        """True if the life is to be modified: a class of contamination or its factor is given."""
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
    """Number of laminae of a roller in the reference life: as the rating says, else `own`, that of its contacts."""
    return own if rating is None or rating.n_laminae is None else rating.n_laminae

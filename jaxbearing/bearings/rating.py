"""What a scene says about the fatigue life of its bearing: the same for all kinds of bearings."""

import equinox as eqx

from .._scene import optional_number
from .._types import Scalar
from ..numerics.checks import require

LAMINAE = 30
"""Laminae of a roller in the reference life where a scene does not say."""


class Rating(eqx.Module):
    """Ratings and conditions for the life; what is not given is computed from the geometry, or not modelled.

    **Arguments:**
    - `dynamic_capacity`, `static_capacity`: C and C0, N; not given: from the geometry.
    - `fatigue_load_limit`: C_u, N; not given: from C0.
    - `reliability`: 0.90, 0.95, 0.96, 0.97, 0.98 or 0.99 (structure: another one recompiles).
    - `cleanliness`: name of a contamination class; with it, and with a viscosity ratio, the life is modified (a_ISO).
    - `viscosity_ratio`: kappa; not given: from the oil, its temperature and the speed, where the scene has them.
    - `roughness_rings`, `roughness_elements`: root mean square, m; with them and films: the lambda ratio.
    - `n_laminae`: of each roller (structure).
    - `edge_factor`: whether the load of laminae near the ends counts more, as the standard estimates where no pressure
      is computed; not given: yes for straight rollers, no for rollers with a profile.
    """

    dynamic_capacity: Scalar | None = optional_number()
    static_capacity: Scalar | None = optional_number()
    fatigue_load_limit: Scalar | None = optional_number()
    viscosity_ratio: Scalar | None = optional_number()
    roughness_rings: Scalar | None = optional_number()
    roughness_elements: Scalar | None = optional_number()
    reliability: float = eqx.field(static=True, default=0.90)
    cleanliness: str | None = eqx.field(static=True, default=None)
    n_laminae: int = eqx.field(static=True, default=LAMINAE)
    edge_factor: bool | None = eqx.field(static=True, default=None)

    def __check_init__(self):
        positive = (
            "dynamic_capacity",
            "static_capacity",
            "fatigue_load_limit",
            "viscosity_ratio",
            "roughness_rings",
            "roughness_elements",
        )
        require("rating", **{name: (getattr(self, name), "> 0") for name in positive})
        if (self.roughness_rings is None) != (self.roughness_elements is None):
            raise ValueError("rating.roughness_rings: give it and rating.roughness_elements, or neither")
        if self.n_laminae < 1:
            raise ValueError(f"rating.n_laminae must be >= 1, got {self.n_laminae}")

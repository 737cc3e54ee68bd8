"""Measured traction curves as plain arrays in SI."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float64, Int64


@dataclass(frozen=True, eq=False)
class CurveTable:
    """Points of one or several traction curves; all arrays have one entry per point, in the order of the file.

    **Arguments:**
    - `slide_to_roll`: difference of the surface speeds over their mean, a ratio (not %), signed.
    - `traction_coefficient`: tangential over normal force, signed as the file has it.
    - `curve`: which curve a point belongs to, 0..n-1 in order of first appearance.
    - `curve_names`: a name for each curve.
    - `pressure`: maximum Hertz pressure, Pa, > 0; this and the next three are `None` where the file lacks them.
    - `load`: N, > 0. A table has pressures or loads, not both.
    - `entrainment_speed`: mean of the surface speeds, m/s, > 0.
    - `temperature`: K, > 0.
    - `notes`: what the reader ignored or assumed, a sentence each.
    - `origin`: name of the file.

    **Raises:** `ValueError` for arrays of different length, curves out of range, and pressures beside loads.
    """

    slide_to_roll: Float64[np.ndarray, " point"]
    traction_coefficient: Float64[np.ndarray, " point"]
    curve: Int64[np.ndarray, " point"]
    curve_names: tuple[str, ...]
    pressure: Float64[np.ndarray, " point"] | None = None
    load: Float64[np.ndarray, " point"] | None = None
    entrainment_speed: Float64[np.ndarray, " point"] | None = None
    temperature: Float64[np.ndarray, " point"] | None = None
    notes: tuple[str, ...] = ()
    origin: str = ""

    def __post_init__(self) -> None:
        for name in ("traction_coefficient", "curve", "pressure", "load", "entrainment_speed", "temperature"):
            values = getattr(self, name)
            if values is not None and values.shape != self.slide_to_roll.shape:
                raise ValueError(f"{name} has the shape {values.shape}, slide_to_roll {self.slide_to_roll.shape}")
        if not np.array_equal(np.unique(self.curve), np.arange(len(self.curve_names))):
            raise ValueError(f"curve must hold every index from 0 to {len(self.curve_names) - 1}")
        if self.pressure is not None and self.load is not None:
            raise ValueError("a table has pressures or loads, not both")

    @property
    def point_count(self) -> int:
        """Number of points, all curves together."""
        return self.slide_to_roll.size

    @property
    def curve_count(self) -> int:
        """Number of curves."""
        return len(self.curve_names)

"""How finely a contact is cut for its traction: steps along rolling, strips across."""

from typing import NamedTuple


class Resolution(NamedTuple):
    """Steps and strips of the traction integral.

    **Arguments:**
    - `steps`: of the march along each strip, even where `extrapolate`.
    - `strips`: Gauss points across the whole contact; a contact without spin computes half of them, a line contact
      one.
    - `extrapolate`: whether the march is repeated with half the steps and the leading error, of second order in the
      step, taken out (Richardson); half as much work again.
    """

    steps: int
    strips: int
    extrapolate: bool = False

    @classmethod
    def for_accuracy(cls, accuracy: float) -> "Resolution":
        """The cheapest measured preset whose forces are as accurate as asked.

        **Arguments:** `accuracy`: relative error of the forces, one of the keys of `PRESETS`.

        **Raises:** `ValueError` for another number.
        """
        try:
            return PRESETS[float(accuracy)]
        except KeyError:
            known = ", ".join(f"{key:g}" for key in PRESETS)
            raise ValueError(f"accuracy: found {accuracy!r}, expected one of {known}") from None


PRESETS = {
    1e-2: Resolution(14, 16),
    1e-3: Resolution(40, 16),
    1e-4: Resolution(128, 24),
    1e-6: Resolution(1200, 80),
}
"""Relative error of the forces -> resolution."""

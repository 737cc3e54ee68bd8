"""Discretisation of a contact for its traction: steps along rolling, strips across.

Measured relative error of the force without spin (`tests/benchmarks/traction.py`): 800 random contacts, Deborah number
1e-2 to 3e2, slide ratio 1e-4 to 1, Mobil Jet II and Pennzane; each entry gives the 95th percentile of the errors and
the largest error, for line or point contacts, whichever is worse.

| accuracy | steps, strips | Ree-Eyring | Bair-Winer | Gecim-Winer | Elsharkawy-Hamrock | us, point |
|---|---|---|---|---|---|---|
| 1e-2 | 14, 16 | 5.8e-3, 9.3e-3 | 3.9e-3, 5.7e-3 | 4.1e-3, 5.1e-3 | 4.6e-3, 5.9e-3 | 6.3 |
| 1e-3 | 40, 16 | 6.6e-4, 1.3e-3 | 4.8e-4, 6.8e-4 | 5.3e-4, 1.6e-3 | 5.5e-4, 7.1e-4 | 16 |
| 1e-4 | 128, 24 | 6.4e-5, 1.2e-4 | 5.6e-5, 1.1e-4 | 8.4e-5, 2.6e-4 | 5.4e-5, 7.5e-5 | 86 |
| 1e-6 | 1200, 80 | 7.3e-7, 1.4e-6 | 6.5e-7, 1.9e-6 | 8.9e-7, 1.4e-6 | 6.3e-7, 7.9e-7 | 3600 |

The last column is the time of one evaluation in a batch in us, with Ree-Eyring, on one core of a small server. Remarks:
- Extrapolation needs a smooth stress. Ree-Eyring: (32, 16) extrapolated has 95 % of the errors below 6e-5 and (128, 24)
  below 6e-7, at a fifth and a thirtieth of the work of the presets of this accuracy. With a limiting stress
  extrapolation gains little: the error of a line contact at 128 steps stays at 4e-5.
- A limiting stress makes kinks of the stress across the strips: 95 % of the errors of point contacts are below 2e-4 to
  3e-4 with 16 strips however many steps, 7e-5 with 24, 3e-5 with 32, 6e-6 with 48, 2e-6 with 64, and 8e-7 with 80.
- The processor takes four strips at a time, and by symmetry only half of the strips are computed: multiples of 8 are
  fastest.
- With spin the stress nearly jumps where the shear rate changes sign, and the strips, not the steps, limit the
  accuracy: contacts with spin have presets of their own.

Measured with spin (`tests/benchmarks/accuracy.py`): 40 random ellipses of 0.7 to 2.2 GPa, c/a up to 12, the sliding
along rolling changing sign inside or near the contact. 95 % of the errors are below the first number, all below the
second. Errors of the force are relative to the larger one of force and moment over sqrt(ac); those of moment and power
are relative to their own values.

| accuracy | steps, strips | viscous function | force | moment | power |
|---|---|---|---|---|---|
| none with spin | 40, 16 | Ree-Eyring | 2.7e-2, 7.6e-2 | 5.3e-2, 6.9e-2 | 4.8e-3, 8.3e-3 |
| | | Elsharkawy-Hamrock | 3.4e-3, 2.0e-2 | 6.5e-3, 4.6e-2 | 8.0e-4, 3.5e-3 |
| 1e-2 | 14, 24 | Ree-Eyring | 8.9e-3, 3.3e-2 | 8.9e-3, 4.2e-2 | 4.9e-3, 6.9e-3 |
| | | Elsharkawy-Hamrock | 4.3e-3, 6.2e-3 | 6.6e-3, 8.1e-3 | 4.5e-3, 4.9e-3 |
| 1e-3 | 40, 48 | Ree-Eyring | 9.4e-4, 2.1e-3 | 1.6e-3, 4.1e-3 | 6.3e-4, 8.4e-4 |
| | | Elsharkawy-Hamrock | 5.2e-4, 1.5e-3 | 9.7e-4, 1.8e-3 | 5.3e-4, 5.9e-4 |
| 1e-4 | 128, 160 | Ree-Eyring | 8.3e-5, 1.3e-4 | 6.2e-5, 1.0e-4 | 5.5e-5, 8.1e-5 |
| | | Elsharkawy-Hamrock | 5.0e-5, 6.0e-5 | 6.5e-5, 9.6e-5 | 5.2e-5, 5.7e-5 |
| 1e-6 | 1200, 192 | Ree-Eyring | 1.9e-5, 5.5e-5 | 1.2e-5, 9.3e-5 | 9.6e-7, 3.3e-6 |
| | | Elsharkawy-Hamrock | 9.4e-7, 3.3e-6 | 1.8e-6, 5.0e-6 | 6.6e-7, 3.4e-6 |

With spin an accuracy of 1e-6 is reached in the power only: forces with Ree-Eyring would take some 600 strips.
`error_estimate` gives the error of one contact.
"""

import dataclasses

from ..numerics.structure import static_count, static_number


@dataclasses.dataclass(frozen=True)
class Resolution:
    """Steps and strips of the traction integral.

    **Arguments:**
    - `steps`: number of steps of the march along each strip, >= 1; an even number with `extrapolate`.
    - `strips`: number of Gauss points across the whole contact, >= 1; without spin half of them are computed, in a line
      contact one.
    - `extrapolate`: whether the march is repeated with half the steps to remove the leading error, of second order in
      the step (Richardson); takes half as much work again.

    **Raises:** `ValueError` for other numbers.
    """

    steps: int
    strips: int
    extrapolate: bool = False

    def __post_init__(self):
        for name in ("steps", "strips"):
            object.__setattr__(self, name, static_count(f"resolution.{name}", getattr(self, name), least=1))
        extrapolate = static_number("resolution.extrapolate", self.extrapolate, bool)
        object.__setattr__(self, "extrapolate", extrapolate)
        if extrapolate and self.steps % 2:
            raise ValueError(f"resolution.steps must be even where extrapolate is set, got {self.steps}")

    @classmethod
    def for_accuracy(cls, accuracy: float, spin: bool = False) -> "Resolution":
        """The cheapest measured preset whose forces have the given accuracy in 95 % of the contacts.

        **Arguments:** `accuracy`: relative error of the forces, one of the keys of `PRESETS`; with spin, 1e-6 reaches
        only 2e-5. `spin`: whether the bodies spin relative to each other (`SPIN_PRESETS`).

        **Raises:** `ValueError` for another number.
        """
        try:
            return (SPIN_PRESETS if spin else PRESETS)[float(accuracy)]
        except KeyError:
            known = ", ".join(f"{key:g}" for key in PRESETS)
            raise ValueError(f"accuracy: found {accuracy!r}, expected one of {known}") from None


PRESETS = {
    1e-2: Resolution(14, 16),
    1e-3: Resolution(40, 16),
    1e-4: Resolution(128, 24),
    1e-6: Resolution(1200, 80),
}
"""Resolution by relative error of the forces, without spin; see the first table above."""

SPIN_PRESETS = {
    1e-2: Resolution(14, 24),
    1e-3: Resolution(40, 48),
    1e-4: Resolution(128, 160),
    1e-6: Resolution(1200, 192),
}
"""Resolution by relative error of the forces, with spin; see the second table above."""

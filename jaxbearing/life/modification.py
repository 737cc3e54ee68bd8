"""Life modification factor a_ISO of ISO 281:2007 from lubrication, cleanliness and fatigue load limit."""

from typing import Literal

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.arguments import require_choice, require_numbers
from .capacity import MILLIMETRE

Family = Literal["ball", "roller"]

LARGEST = 50.0
"""Upper limit of a_ISO."""
LEAST_BRACKET = 0.05
"""Smallest bracket in the formula of a_ISO. It changes no result: 0.1 * 0.05^-9.185 is far above 50."""
KAPPA_RANGE = (0.1, 4.0)
"""Range of the viscosity ratio kappa: below it ISO 281 gives no factor, above it the factor at 4 holds."""

_BRANCH_ENDS = (0.4, 1.0)
_EXPONENTS = (0.054381, 0.19087, 0.071739)
_CONSTANTS = {
    "ball": (2.5671, (2.2649, 1.9987, 1.9987), 0.83, 1.0 / 3.0, -9.3),
    "roller": (1.5859, (1.3993, 1.2348, 1.2348), 1.0, 0.4, -9.185),
}

CLEANLINESS = {
    "online_filter_13": (0.0864, 0.5663),
    "online_filter_15": (0.0432, 0.9987),
    "online_filter_17": (0.0288, 1.6329),
    "online_filter_19": (0.0216, 2.3362),
    "grease_high": (0.0864, 0.6796),
    "grease_normal": (0.0432, 1.141),
    "grease_typical": (0.0177, 1.887),
    "grease_severe": (0.0115, 2.662),
    "grease_very_severe": (0.00617, 4.06),
}
"""Constants k and c of the contamination factor [M]: circulating oil with on-line filters, by ISO 4406 codes -/13/10 to
-/19/16; grease, by its cleanliness (`grease_typical` has another c for pitch diameters of 500 mm and more)."""
_TYPICAL_LARGE, _LARGE = 1.677, 500.0


def modification_factor(kappa: Values, load_ratio: Values, family: Family) -> Float[Array, "..."]:
    r"""Life modification factor, at most 50: $a_{ISO} = 0.1[1 - (2.5671 - b\kappa^{-e})^{0.83}x^{1/3}]^{-9.3}$ of
    radial ball bearings, $0.1[1 - (1.5859 - b\kappa^{-e})x^{0.4}]^{-9.185}$ of roller bearings, $x = e_CC_u/P$.

    **Limits:** 0.1 at x = 0; 50 (gradient 0) for a small or negative bracket; kinks at kappa = 0.4, 1, 4 and at 50.
    **Validity:** kappa between 0.1 and 4 (outside: the factor at the nearer end).
    **Evidence:** [C] the three branches in kappa join; constants otherwise [M].

    **Arguments:** `kappa`: viscosity ratio; `load_ratio`: x.
    """
    require_choice("family", family, _CONSTANTS)
    require_numbers(">= 0 or infinite", kappa=kappa, load_ratio=load_ratio)
    kappa = jnp.clip(kappa, *KAPPA_RANGE)
    constant, scales, power, exponent, outer = _CONSTANTS[family]
    low, high = (kappa < end for end in _BRANCH_ENDS)
    pick = lambda values: jnp.where(low, values[0], jnp.where(high, values[1], values[2]))
    film = jnp.maximum(constant - pick(scales) * kappa ** -pick(_EXPONENTS), 0.0)
    positive = load_ratio > 0
    x = jnp.where(positive, jnp.where(positive, load_ratio, 1.0) ** exponent, 0.0 * load_ratio)
    bracket = jnp.maximum(1.0 - film**power * x, LEAST_BRACKET)
    return jnp.minimum(0.1 * bracket**outer, LARGEST)


def reference_viscosity(speed: Scalar, pitch_diameter: Scalar) -> Float[Array, ""]:
    r"""Reference viscosity $\nu_1$, m^2/s: $45000n^{-0.83}D_{pw}^{-0.5}$ below 1000 r/min, $4500n^{-0.5}D_{pw}^{-0.5}$
    above (mm^2/s, r/min, mm).

    **Evidence:** [M]; the branches differ by 2.3 % at 1000 r/min. **Arguments:** `speed` of the rings relative
    to each other, rad/s (below 1 r/min it is replaced by 1 r/min); `pitch_diameter`, m.
    """
    require_numbers("finite", speed=speed)
    require_numbers("> 0", pitch_diameter=pitch_diameter)
    turns = jnp.maximum(jnp.abs(speed) * 30.0 / jnp.pi, 1.0)
    factor = jnp.where(turns < 1000.0, 45000.0 * turns**-0.83, 4500.0 * turns**-0.5)
    return 1e-6 * factor * (jnp.asarray(pitch_diameter) / MILLIMETRE) ** -0.5


def contamination_factor(kappa: Values, pitch_diameter: Scalar, cleanliness: str) -> Float[Array, "..."]:
    r"""Contamination factor $e_C = a(1 - cD_{pw}^{-1/3})$, $a = \min(1, k\kappa^{0.68}D_{pw}^{0.55})$, at least 0;
    $D_{pw}$ in mm.

    **Evidence:** [M].

    **Arguments:** `kappa`: viscosity ratio; `pitch_diameter`, m; `cleanliness`: one of `CLEANLINESS`.
    """
    require_choice("cleanliness", cleanliness, CLEANLINESS)
    require_numbers(">= 0 or infinite", kappa=kappa)
    require_numbers("> 0", pitch_diameter=pitch_diameter)
    k, c = CLEANLINESS[cleanliness]
    diameter = jnp.asarray(pitch_diameter) / MILLIMETRE
    if cleanliness == "grease_typical":
        c = jnp.where(diameter >= _LARGE, _TYPICAL_LARGE, c)
    share = jnp.minimum(1.0, k * jnp.maximum(kappa, 1e-6) ** 0.68 * diameter**0.55)
    return jnp.maximum(share * (1.0 - c * diameter ** (-1.0 / 3.0)), 0.0)


def fatigue_load_limit(static_capacity: Scalar, pitch_diameter: Scalar, family: Family) -> Float[Array, ""]:
    """Fatigue load limit C_u, N: C0/22 of ball bearings, C0/8.2 of roller bearings.

    Above D_pw = 100 mm it is multiplied by (100 mm/D_pw)^0.5 (ball) or (100 mm/D_pw)^0.3 (roller).

    **Evidence:** [M], the simplified method of ISO 281. **Arguments:** `static_capacity` C0, N; `pitch_diameter` D_pw,
    m.
    """
    require_choice("family", family, _CONSTANTS)
    require_numbers("> 0", static_capacity=static_capacity, pitch_diameter=pitch_diameter)
    divisor, power = (22.0, 0.5) if family == "ball" else (8.2, 0.3)
    large = jnp.maximum(jnp.asarray(pitch_diameter) / MILLIMETRE, 100.0)
    return static_capacity / divisor * (100.0 / large) ** power


def film_ratio(film: Values, roughness_a: Values, roughness_b: Values) -> Float[Array, "..."]:
    r"""Film ratio $\Lambda = h/\sqrt{R_{q1}^2 + R_{q2}^2}$: below 1 mixed lubrication, above 3 full film.

    **Arguments:** `film`: minimum film thickness, m; `roughness_a`, `roughness_b`: rms roughness of the surfaces, m.
    """
    require_numbers(">= 0", film=film, roughness_a=roughness_a, roughness_b=roughness_b)
    roughness = jnp.sqrt(jnp.square(roughness_a) + jnp.square(roughness_b))
    require_numbers("> 0", roughness=roughness)
    return film / roughness

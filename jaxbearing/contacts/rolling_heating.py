"""Inlet heating of the rolling resistance: which viscosity a law is given, and a factor on its result."""

from typing import Any

from jaxtyping import Array, Float

from .._types import Values
from ..lubricants import InletOil
from ..numerics.safe import regular_power
from .thermal import LOADING_WIDTH, AbstractThermalFactor, NoThermalReduction, thermal_loading

AIHARA = "aihara"
FILM_TEMPERATURE = "film_temperature"
HEATINGS = (AIHARA, FILM_TEMPERATURE)
"""Kinds of inlet heating. `aihara`: the law with the viscosity at the inlet temperature, times `aihara_factor`;
`film_temperature`: the law with the viscosity at the inlet temperature that explains the film's thermal factor."""


def aihara_factor(mean_speed: Values, inlet: InletOil) -> Float[Array, "..."]:
    r"""Aihara's factor $\phi_P = 1/(1 + 0.29L^{0.78})$, $L = -(\partial\mu/\partial T)u^2/k$ at the inlet temperature.

    **Limits:** 1 at rest; the power is linear below L = 1e-9.
    **Validity:** within 0.025 of own inlet calculations at L = 0.1 to 7 (Hertz gap, heat of the parabolic flow
    conducted to isothermal walls, no convection). The outlet, 28 % of the resistance of a loaded contact, is left out.
    **Reference:** Aihara (1987), ASME J. Tribology 109, 471, as Manjunath et al. (2023) cite it.

    **Arguments:** `mean_speed` u = (u1 + u2)/2, m/s, of either sign; `inlet`, the oil there, with a conductivity.
    **Raises:** `ValueError` for an oil without a conductivity.
    """
    loading = thermal_loading(mean_speed, inlet, "Aihara's inlet heating of the rolling resistance")
    return 1.0 / (1.0 + 0.29 * regular_power(loading, 0.78, LOADING_WIDTH))


def heating_of(law: Any, named: str | None, thermal: AbstractThermalFactor) -> str:
    """Inlet heating of a law of rolling resistance: `named`; if that is `None`, the default of the law, but
    `film_temperature`, which then heats nothing, where the film is isothermal.

    **Arguments:** `law`, of a line or a point contact; `named`, one of `HEATINGS` or `None`; `thermal`, the thermal
    factor of the film.
    """
    if named is not None:
        return named
    return FILM_TEMPERATURE if isinstance(thermal, NoThermalReduction) else law.own_heating


def rolling_words(laws: Any) -> str:
    """Name of the law of rolling resistance and of its inlet heating, for the screen.

    **Arguments:** `laws` of line or point contacts with rolling resistance of the films, hysteresis of the bodies, or
    both.
    """
    names = []
    if laws.rolling is not None:
        heating = heating_of(laws.rolling, laws.rolling_heating, laws.thermal)
        isothermal = heating == FILM_TEMPERATURE and isinstance(laws.thermal, NoThermalReduction)
        names.append(f"{laws.rolling.name}, {'isothermal inlet' if isothermal else f'inlet heating {heating}'}")
    if laws.hysteresis is not None:
        names.append("hysteresis of the bodies")
    return ", and ".join(names)

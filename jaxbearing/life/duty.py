r"""Life under a load spectrum: the damage of all states adds up (Palmgren and Miner).

A state k lasts a share $s_k$ of the time, and the rings turn relative to each other at the speed $n_k$. Its share of
the revolutions is $\varphi_k = s_k|n_k|/\sum s|n|$. The life follows from $1/L = \sum\varphi_k/L_k$; L and $L_k$ are in
revolutions. The constant load $P = (\sum\varphi_kP_k^p)^{1/p}$ gives the same life. The computation uses damage rates
$1/L_k$, which are 0 without load.

**Evidence:** [D] from the rule of Palmgren and Miner that damages add up.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._scene import label
from .._types import Scalar
from ..numerics.arguments import require_numbers
from .basic import EXPONENTS, HOURS
from .result import AtReliability, Life, reliability_field

SUM_TOLERANCE = 1e-6
"""Largest deviation from 1 that the sum of the time shares may have."""
_States = Float[Array, " state"]
_Number = Float[Array, ""]


def _result(unit: str, description: str):
    return eqx.field(metadata=label(unit, description), kw_only=True)


def _optional(unit: str, description: str):
    return eqx.field(default=None, metadata=label(unit, description), kw_only=True)


class SpectrumLife(AtReliability):
    """Life under a load spectrum, with the field names of `Life`; a life that some state lacks is `None`.

    Lives are in hours or in millions of revolutions of the rings relative to each other.
    """

    Lnmr_hours: _Number | None = _optional("h", "modified reference rating life of the spectrum at the reliability n")
    Lnmr: _Number | None = _optional(
        "1", "modified reference rating life of the spectrum at the reliability n, million revolutions"
    )
    L10r_hours: _Number = _result("h", "basic reference rating life of the spectrum at 90 % reliability")
    L10r: _Number = _result("1", "basic reference rating life of the spectrum at 90 % reliability, million revolutions")
    L10mh: _Number | None = _optional("h", "modified rating life of ISO 281 of the spectrum at 90 % reliability")
    L10m: _Number | None = _optional(
        "1", "modified rating life of ISO 281 of the spectrum at 90 % reliability, million revolutions"
    )
    L10h: _Number | None = _optional("h", "basic rating life of ISO 281 of the spectrum at 90 % reliability")
    L10: _Number | None = _optional(
        "1", "basic rating life of ISO 281 of the spectrum at 90 % reliability, million revolutions"
    )
    equivalent_load: _Number = _result("N", "constant load P at which ISO 281 gives the L10r of the spectrum")
    catalogue_load: _Number | None = _optional("N", "constant load P at which ISO 281 gives the L10 of the spectrum")
    mean_speed: _Number = _result("rad/s", "mean speed of the rings against each other")
    revolutions: _States = _result("1", "share of each state in the revolutions")
    damage: _States = _result("1", "share of each state in the damage, by the modified life where all states have it")
    reference_damage: _States = _result("1", "share of each state in the damage by the basic reference life")
    reliability: float = reliability_field()


def revolution_shares(time_shares: _States, speeds: _States) -> _States:
    r"""Shares of the states in the revolutions, $\varphi_k = s_k|n_k|/\sum s|n|$; the time shares if no state turns.

    **Arguments:** `time_shares` s, which add up to 1; `speeds` n of the rings relative to each other, rad/s.
    """
    require_numbers(">= 0", time_shares=time_shares)
    turned = jnp.asarray(time_shares) * jnp.abs(jnp.asarray(speeds))
    total = jnp.sum(turned)
    moves = total > 0
    at_rest = jnp.where(total == 0, time_shares, jnp.nan)
    return jnp.where(moves, turned / jnp.where(moves, total, 1.0), at_rest)


def miner_rate(revolutions: _States, rates: _States) -> _Number:
    r"""Damage rate of a spectrum, $1/L = \sum\varphi_k/L_k$.

    **Arguments:** `revolutions`: shares of the states in the revolutions; `rates` $1/L_k$.
    """
    require_numbers(">= 0", revolutions=revolutions, rates=rates)
    return jnp.sum(jnp.asarray(revolutions) * rates)


def mean_load(revolutions: _States, loads: _States, exponent: float) -> _Number:
    r"""Mean load of a spectrum, $P = (\sum\varphi_kP_k^p)^{1/p}$, N.

    **Arguments:** `revolutions`: shares of the states in the revolutions; `loads`, N; `exponent` p (`basic.EXPONENTS`).
    """
    require_numbers(">= 0", revolutions=revolutions, loads=loads)
    require_numbers("> 0", exponent=exponent)
    mean = jnp.sum(jnp.asarray(revolutions) * jnp.asarray(loads) ** exponent)
    loaded = mean > 0
    return jnp.where(loaded, jnp.where(loaded, mean, 1.0) ** (1.0 / exponent), 0.0 * mean)


def spectrum_life(lives: Sequence[Life], time_shares: _States, speeds: _States) -> SpectrumLife:
    """Life of one bearing under all states; a pure function. A life that is NaN in one state is NaN.

    **Arguments:** `lives` of the states; `time_shares`, which add up to 1; `speeds` of the rings relative to each
    other, rad/s.

    **Raises:** `ValueError` for states of different families or reliabilities.
    """
    families = {life.family for life in lives}
    if len(families) != 1:
        raise ValueError(f"the states are of one bearing, got {' and '.join(sorted(families))} bearings")
    reliabilities = {life.reliability for life in lives}
    if len(reliabilities) != 1:
        raise ValueError(f"rating.reliability: expected the same in all states, got {sorted(reliabilities)}")
    exponent = EXPONENTS[families.pop()]
    of: Any = lambda name: jnp.stack([jnp.asarray(getattr(life, name)) for life in lives])
    shares = jnp.asarray(time_shares)
    revolutions = revolution_shares(shares, speeds)
    speed = jnp.sum(shares * jnp.abs(jnp.asarray(speeds)))
    results = lives_of(miner_rates(lives, revolutions), speed)
    rates = {name: jnp.stack(each) for name, each in common_rates(map(damage_rates, lives)).items()}
    if "L10" in rates:
        results["catalogue_load"] = mean_load(revolutions, of("catalogue_load"), exponent)
    return SpectrumLife(
        equivalent_load=mean_load(revolutions, of("equivalent_load"), exponent),
        mean_speed=speed,
        revolutions=revolutions,
        damage=_parts(revolutions * rates.get("Lnmr", rates["L10r"])),
        reference_damage=_parts(revolutions * rates["L10r"]),
        reliability=reliabilities.pop(),
        **results,
    )


IN_HOURS = {"Lnmr": "Lnmr_hours", "L10r": "L10r_hours", "L10m": "L10mh", "L10": "L10h"}
"""Field of a life in revolutions -> field of the same life in hours."""


def damage_rates(life: Life) -> dict[str, Array]:
    """Damage rate 1/L for each kind of life of a bearing, by its name, per million revolutions; 0 without load."""
    rates = {"L10r": life.damage_rate}
    if life.modification_factor is not None:
        rates["Lnmr"] = life.damage_rate / (life.reliability_factor * life.modification_factor)
    if life.catalogue_load is not None:
        rates["L10"] = (life.catalogue_load / life.dynamic_capacity) ** EXPONENTS[life.family]
    factor = life.catalogue_factor
    if factor is not None:
        rates["L10m"] = rates["L10"] / factor
    return rates


def common_rates(rates: Iterable[Mapping[str, Array]]) -> dict[str, list[Array]]:
    """Damage rates of all states (or all bearings), as one list for each kind of life that all of them have."""
    each = list(rates)
    return {name: [state[name] for state in each] for name in IN_HOURS if all(name in state for state in each)}


def miner_rates(lives: Sequence[Life], revolutions: _States) -> dict[str, Array]:
    """Damage rates of one bearing under the spectrum, for the kinds of life that all states have.

    **Arguments:** `lives` of the states; `revolutions`: shares of the states in the revolutions.
    """
    rates = common_rates(map(damage_rates, lives))
    return {name: miner_rate(revolutions, jnp.stack(each)) for name, each in rates.items()}


def lives_of(rates: Mapping[str, Array], speed: Scalar) -> dict[str, Array]:
    """Lives in millions of revolutions and in hours, by field name, from the damage rates 1/L.

    **Arguments:** `rates`: per million revolutions; `speed`: of the rings relative to each other, rad/s.
    """
    lives = {}
    for name, rate in rates.items():
        life = life_of(rate)
        lives |= {name: life, IN_HOURS[name]: life * HOURS / jnp.abs(speed)}
    return lives


def life_of(rate: Float[Array, "..."]) -> Float[Array, "..."]:
    """Life 1/rate; infinite if the rate is 0, NaN if it is NaN."""
    damaged = rate > 0
    return jnp.where(damaged, 1.0 / jnp.where(damaged, rate, 1.0), jnp.where(rate == 0, jnp.inf, jnp.nan))


def _parts(damages: _States) -> _States:
    """Share of each state in the total damage; 0 without damage."""
    total = jnp.sum(damages)
    damaged = total != 0
    return jnp.where(damaged, damages / jnp.where(damaged, total, 1.0), 0.0 * damages)


def governing(life: SpectrumLife) -> int:
    """Index, from 0, of the state with the largest share in the damage."""
    return int(np.argmax(np.asarray(life.damage)))

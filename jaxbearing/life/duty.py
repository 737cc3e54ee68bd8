r"""Life under a load spectrum: the damage of all states adds up (Palmgren and Miner).

A state k lasts a share $s_k$ of the time, in which the rings turn against each other at $n_k$. Of all revolutions it
has $\varphi_k = s_k|n_k|/\sum s|n|$, and the life is $1/L = \sum\varphi_k/L_k$, in revolutions as $L_k$. It is the life
under the load $P = (\sum\varphi_kP_k^p)^{1/p}$. Computed with rates of damage, which are 0 without load.

**Evidence:** [D] from the rule that damages add up, which is Palmgren's and Miner's.
"""

from collections.abc import Sequence
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._scene import label
from ..numerics.arguments import require_numbers
from .basic import EXPONENTS, HOURS
from .result import Life

SUM_TOLERANCE = 1e-6
"""Difference from 1 that the sum of the shares of time may have."""
_States = Float[Array, " state"]
_Number = Float[Array, ""]


def _result(unit: str, description: str):
    return eqx.field(metadata=label(unit, description), kw_only=True)


def _optional(unit: str, description: str):
    return eqx.field(default=None, metadata=label(unit, description), kw_only=True)


class SpectrumLife(eqx.Module):
    """Life under a load spectrum, with the names of `Life`; what a state does not have is `None`. Lives count millions
    of revolutions of the rings against each other."""

    Lnmr_hours: _Number | None = _optional("h", "modified reference rating life of the spectrum")
    Lnmr: _Number | None = _optional("1", "modified reference rating life of the spectrum, million revolutions")
    L10r_hours: _Number = _result("h", "basic reference rating life of the spectrum")
    L10r: _Number = _result("1", "basic reference rating life of the spectrum, million revolutions")
    L10mh: _Number | None = _optional("h", "modified rating life of ISO 281 of the spectrum at 90 % reliability")
    L10m: _Number | None = _optional(
        "1", "modified rating life of ISO 281 of the spectrum at 90 % reliability, million revolutions"
    )
    L10h: _Number | None = _optional("h", "basic rating life of ISO 281 of the spectrum")
    L10: _Number | None = _optional("1", "basic rating life of ISO 281 of the spectrum, million revolutions")
    equivalent_load: _Number = _result("N", "constant load P at which ISO 281 gives the L10r of the spectrum")
    catalogue_load: _Number | None = _optional("N", "constant load P at which ISO 281 gives the L10 of the spectrum")
    mean_speed: _Number = _result("rad/s", "mean speed of the rings against each other")
    revolutions: _States = _result("1", "share of each state in the revolutions")
    damage: _States = _result("1", "share of each state in the damage, by the modified life where all states have it")
    reference_damage: _States = _result("1", "share of each state in the damage by the basic reference life")


def revolution_shares(time_shares: _States, speeds: _States) -> _States:
    r"""$\varphi_k = s_k|n_k|/\sum s|n|$; the shares of time where nothing turns.

    **Arguments:** `time_shares` s, which add up to 1; `speeds` of the rings against each other, rad/s.
    """
    require_numbers(">= 0", time_shares=time_shares)
    turned = jnp.asarray(time_shares) * jnp.abs(jnp.asarray(speeds))
    total = jnp.sum(turned)
    moves = total > 0
    at_rest = jnp.where(total == 0, time_shares, jnp.nan)
    return jnp.where(moves, turned / jnp.where(moves, total, 1.0), at_rest)


def miner_rate(revolutions: _States, rates: _States) -> _Number:
    r"""$1/L = \sum\varphi_k/L_k$. **Arguments:** shares of the revolutions; rates $1/L_k$."""
    require_numbers(">= 0", revolutions=revolutions, rates=rates)
    return jnp.sum(jnp.asarray(revolutions) * rates)


def mean_load(revolutions: _States, loads: _States, exponent: float) -> _Number:
    r"""$P = (\sum\varphi_kP_k^p)^{1/p}$, N. **Arguments:** shares of the revolutions; loads, N; p (`basic`)."""
    require_numbers(">= 0", revolutions=revolutions, loads=loads)
    require_numbers("> 0", exponent=exponent)
    mean = jnp.sum(jnp.asarray(revolutions) * jnp.asarray(loads) ** exponent)
    loaded = mean > 0
    return jnp.where(loaded, jnp.where(loaded, mean, 1.0) ** (1.0 / exponent), 0.0 * mean)


def spectrum_life(lives: Sequence[Life], time_shares: _States, speeds: _States) -> SpectrumLife:
    """Life of one bearing under all states, pure; NaN where one of them has none.

    **Arguments:** `lives` of the states; `time_shares`, which add up to 1; `speeds` of the rings against each other,
    rad/s.

    **Raises:** `ValueError` for states of bearings of different families.
    """
    families = {life.family for life in lives}
    if len(families) != 1:
        raise ValueError(f"the states are of one bearing, got {' and '.join(sorted(families))} bearings")
    exponent = EXPONENTS[families.pop()]
    of: Any = lambda name: jnp.stack([jnp.asarray(getattr(life, name)) for life in lives])
    all_have = lambda name: all(getattr(life, name) is not None for life in lives)
    shares = jnp.asarray(time_shares)
    revolutions = revolution_shares(shares, speeds)
    speed = jnp.sum(shares * jnp.abs(jnp.asarray(speeds)))
    rates = {"L10r": of("damage_rate")}
    if all_have("modification_factor"):
        rates["Lnmr"] = rates["L10r"] / (of("reliability_factor") * of("modification_factor"))
    if all_have("catalogue_load"):
        rates["L10"] = (of("catalogue_load") / of("dynamic_capacity")) ** exponent
    if all_have("catalogue_factor"):
        rates["L10m"] = rates["L10"] / of("catalogue_factor")
    found: dict[str, Any] = {}
    for name, each in rates.items():
        rate = miner_rate(revolutions, each)
        damaged = rate > 0
        # a rate that is NaN has no life, not an endless one
        life = jnp.where(damaged, 1.0 / jnp.where(damaged, rate, 1.0), jnp.where(rate == 0, jnp.inf, jnp.nan))
        found |= {name: life, _IN_HOURS[name]: life * HOURS / speed}
    if "L10" in rates:
        found["catalogue_load"] = mean_load(revolutions, of("catalogue_load"), exponent)
    return SpectrumLife(
        equivalent_load=mean_load(revolutions, of("equivalent_load"), exponent),
        mean_speed=speed,
        revolutions=revolutions,
        damage=_parts(revolutions * rates.get("Lnmr", rates["L10r"])),
        reference_damage=_parts(revolutions * rates["L10r"]),
        **found,
    )


_IN_HOURS = {"Lnmr": "Lnmr_hours", "L10r": "L10r_hours", "L10m": "L10mh", "L10": "L10h"}
"""Life in revolutions -> the same in hours."""


def _parts(damages: _States) -> _States:
    """Each over the sum; 0 where there is no damage."""
    total = jnp.sum(damages)
    damaged = total != 0
    return jnp.where(damaged, damages / jnp.where(damaged, total, 1.0), 0.0 * damages)


def governing(life: SpectrumLife) -> int:
    """Number of the state with the largest share in the damage."""
    return int(np.argmax(np.asarray(life.damage)))

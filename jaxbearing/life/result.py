"""Results of the life calculation, labelled like all results."""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._scene import derived, label
from .basic import MINIMUM_LOADS, RELIABILITY_FACTORS
from .modification import Family, modification_factor

_Number = Float[Array, ""]


def _result(unit: str, description: str):
    return eqx.field(metadata=label(unit, description), kw_only=True)


def _optional(unit: str, description: str):
    return eqx.field(default=None, metadata=label(unit, description), kw_only=True)


def reliability_field():
    """Static field that holds the reliability n of the rating."""
    described = label("1", "reliability n of Lnmr, Lnr, Lnm and Ln")
    return eqx.field(static=True, default=0.90, kw_only=True, metadata=described)


class AtReliability(eqx.Module):
    """Lives at the reliability n of the rating: a_1 times the lives at 90 %, which are fields of the subclasses.

    ISO 281 gives a_1 for one bearing. It holds for several bearings together as well: their lives at n combine to the
    life of the system at n by the same law of survival as their lives at 90 % (`shafts.lives`).
    """

    reliability: eqx.AbstractVar[float]

    def _reduced(self, name: str) -> Array | None:
        life: Array | None = getattr(self, name)
        return None if life is None else jnp.asarray(RELIABILITY_FACTORS[self.reliability] * life)

    @derived("h", "basic reference rating life a_1 L10r at the reliability n")
    def Lnr_hours(self) -> Float[Array, "*batch"] | None:
        return self._reduced("L10r_hours")

    @derived("1", "basic reference rating life a_1 L10r at the reliability n, million revolutions")
    def Lnr(self) -> Float[Array, "*batch"] | None:
        return self._reduced("L10r")

    @derived("h", "modified rating life a_1 a_ISO L10 of ISO 281 at the reliability n")
    def Lnmh(self) -> Float[Array, "*batch"] | None:
        return self._reduced("L10mh")

    @derived("1", "modified rating life a_1 a_ISO L10 of ISO 281 at the reliability n, million revolutions")
    def Lnm(self) -> Float[Array, "*batch"] | None:
        return self._reduced("L10m")

    @derived("h", "basic rating life a_1 L10 of ISO 281 at the reliability n")
    def Lnh(self) -> Float[Array, "*batch"] | None:
        return self._reduced("L10h")

    @derived("1", "basic rating life a_1 L10 of ISO 281 at the reliability n, million revolutions")
    def Ln(self) -> Float[Array, "*batch"] | None:
        return self._reduced("L10")


class CatalogueLife(eqx.Module):
    """Rating life by catalogue formulas, from the loads alone; NaN if the formulas do not cover these loads."""

    L10h: _Number = _result("h", "basic rating life of ISO 281 by catalogue formulas at 90 % reliability")
    L10: _Number = _result(
        "1", "basic rating life of ISO 281 by catalogue formulas at 90 % reliability, million revolutions"
    )
    catalogue_load: _Number = _result("N", "equivalent dynamic load P of ISO 281, by X and Y")
    dynamic_capacity: _Number = _result("N", "basic dynamic load rating C")


class Life(AtReliability):
    """Life of a solved bearing; results that the scene does not model are `None`.

    Lives are in hours or in millions of revolutions of the rings relative to each other. 90 % of bearings
    reach a life whose name begins with L10; the part `reliability` (n), set in the rating, reaches a life whose name
    begins with Ln. The fields stand in the order of the reports: first the modified life, the one to design by.
    """

    Lnmr_hours: _Number | None = _optional("h", "modified reference rating life at the reliability n")
    Lnmr: _Number | None = _optional(
        "1", "modified reference rating life a_1 a_ISO L10r at the reliability n, million revolutions"
    )
    L10r_hours: _Number = _result("h", "basic reference rating life at 90 % reliability")
    L10r: _Number = _result("1", "basic reference rating life at 90 % reliability, million revolutions")
    L10h: _Number | None = _optional("h", "basic rating life of ISO 281 by catalogue formulas at 90 % reliability")
    L10: _Number | None = _optional(
        "1", "basic rating life of ISO 281 by catalogue formulas at 90 % reliability, million revolutions"
    )
    reliability_factor: _Number = _result("1", "a_1, by which a life at the reliability n is shorter than at 90 %")
    modification_factor: _Number | None = _optional("1", "a_ISO")
    viscosity_ratio: _Number | None = _optional("1", "kappa, viscosity over that of an adequate film")
    film_ratio_inner: Float[Array, " element"] | None = _optional(
        "1", "lambda ratio (of the minimum film) on the inner raceway"
    )
    film_ratio_outer: Float[Array, " element"] | None = _optional(
        "1", "lambda ratio (of the minimum film) on the outer raceway"
    )
    dynamic_capacity: _Number = _result("N", "basic dynamic load rating C")
    static_capacity: _Number = _result(
        "N", "basic static load rating C0, at the pressures of ISO 76: 4.2 GPa of balls, 4.0 GPa of rollers"
    )
    equivalent_load: _Number = _result("N", "load P at which ISO 281 gives the reference life")
    catalogue_load: _Number | None = _optional("N", "equivalent dynamic load P of ISO 281, by X and Y")
    static_load: _Number | None = _optional("N", "equivalent static load P0 of ISO 76, by X0 and Y0")
    contact_static_safety: _Number | None = _optional(
        "1", "static safety of the most loaded contact: load at the pressures of C0 over its load"
    )
    contamination_factor: _Number | None = _optional("1", "e_C (eta_c), factor of the contamination")
    fatigue_load_limit: _Number | None = _optional("N", "fatigue load limit C_u")
    damage_rate: _Number = _result("1", "1/L10r, per million revolutions: 0 without load, smooth")
    family: Family = eqx.field(static=True, default="ball", kw_only=True)
    reliability: float = reliability_field()

    @derived("1", "static safety C0/P0 of ISO 76")
    def static_safety(self) -> Float[Array, "*batch"] | None:
        return None if self.static_load is None else jnp.asarray(self.static_capacity / self.static_load)

    @derived("1", "modified rating life a_ISO L10 of ISO 281 at 90 % reliability, million revolutions")
    def L10m(self) -> Float[Array, "*batch"] | None:
        factor, life = self.catalogue_factor, self.L10
        return None if factor is None or life is None else factor * life

    @derived("h", "modified rating life a_ISO L10 of ISO 281 at 90 % reliability")
    def L10mh(self) -> Float[Array, "*batch"] | None:
        factor, life = self.catalogue_factor, self.L10h
        return None if factor is None or life is None else factor * life

    @derived("N", "least load against skidding, maker's rule of thumb: 0.01 C of ball, 0.02 C of roller bearings")
    def minimum_load(self) -> Float[Array, "*batch"]:
        return jnp.asarray(MINIMUM_LOADS[self.family] * self.dynamic_capacity)

    @property
    def catalogue_factor(self) -> Float[Array, "*batch"] | None:
        """Factor a_ISO at `catalogue_load`, whereas `modification_factor` is a_ISO at `equivalent_load`."""
        load, kappa, limit = self.catalogue_load, self.viscosity_ratio, self.fatigue_load_limit
        if load is None or kappa is None or limit is None or self.contamination_factor is None:
            return None
        ratio = self.contamination_factor * limit / jnp.where(load > 0, load, 1.0)
        return modification_factor(kappa, ratio, self.family)

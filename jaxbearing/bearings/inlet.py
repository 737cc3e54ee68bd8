"""Oil that enters the interactions of a bearing: all of it at the inlet temperature of the operating point, or each
interaction with a temperature of its own, which a thermal network knows."""

import dataclasses
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..lubricants import InletOil

if TYPE_CHECKING:
    from .bearing import AbstractBearing
else:
    AbstractBearing = Any


class OilElsewhere(NamedTuple):
    """Oil that enters the interactions beside the raceways."""

    flange: InletOil
    pocket: InletOil
    cage_pilot: InletOil
    drag: InletOil


def oil_of_races(scene: AbstractBearing) -> InletOil:
    """The oil that enters the raceway contacts: one for both, or with fields of shape (2, 1), races first."""
    oil, contact = scene.oil.at(race_temperatures(scene)), scene.contact
    if contact is None or contact.supply is None or contact.supply.from_flow is None:
        return oil
    return dataclasses.replace(oil, flow=jnp.asarray(scene.operation.oil_flow))


def oil_elsewhere(scene: AbstractBearing) -> OilElsewhere | None:
    """The oil that enters the other interactions; `None` where it is that of the raceways."""
    own = scene.oil_temperatures
    if own is None:
        return None
    return OilElsewhere(*(scene.oil.at(getattr(own, place)) for place in OilElsewhere._fields))


def oil_of(inlet: InletOil, elsewhere: OilElsewhere | None, place: str) -> InletOil:
    """The oil that enters an interaction beside the raceways.

    **Arguments:** `inlet`: oil of the raceways; `elsewhere`: of the other interactions, `None` where it is the same;
    `place`: field of `OilElsewhere`.
    """
    return inlet if elsewhere is None else getattr(elsewhere, place)


class AbstractOils(eqx.Module):
    """Equations whose interactions may each have an oil of their own."""

    inlet: eqx.AbstractVar[InletOil]
    """Oil of the raceways."""
    elsewhere: eqx.AbstractVar[OilElsewhere | None]
    """Oil of the other interactions where it is not that of the raceways."""

    def oil_of(self, place: str) -> InletOil:
        """The oil that enters an interaction beside the raceways."""
        return oil_of(self.inlet, self.elsewhere, place)


def oil_temperature(scene: AbstractBearing, place: str) -> Scalar:
    """Temperature of the oil of an interaction, K. **Arguments:** `place`: field of `OilTemperatures`."""
    own = scene.oil_temperatures
    return scene.operation.oil_temperature if own is None else getattr(own, place)


def race_temperatures(scene: AbstractBearing) -> Scalar | Float[Array, "2 1"]:
    """Temperature of the oil that enters the raceway contacts, K: one for both, or of shape (2, 1), races first."""
    own = scene.oil_temperatures
    if own is None:
        return scene.operation.oil_temperature
    return jnp.stack([jnp.asarray(own.inner_raceway), jnp.asarray(own.outer_raceway)])[:, None]


def of_inner_race(values: Scalar | Float[Array, "2 1"]) -> Scalar:
    """A property of the oil in the inner raceway. **Arguments:** `values`: one, or of shape (2, 1)."""
    return values[0, 0] if jnp.ndim(values) else values

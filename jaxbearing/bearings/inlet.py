"""Oil that enters the interactions of a bearing, either at the inlet temperature of the operating point, or at the
temperatures that a thermal network gives for each interaction."""

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
    """Oil that enters the interactions other than the raceway contacts."""

    flange: InletOil
    pocket: InletOil
    cage_pilot: InletOil
    drag: InletOil


def oil_of_races(scene: AbstractBearing) -> InletOil:
    """Oil that enters the raceway contacts: the same for both races, or with fields of shape (2, 1), inner race
    first."""
    oil, contact = scene.oil.at(race_temperatures(scene)), scene.contact
    if contact is None or contact.supply is None or contact.supply.from_flow is None:
        return oil
    return dataclasses.replace(oil, flow=jnp.asarray(scene.operation.oil_flow))


def oil_elsewhere(scene: AbstractBearing) -> OilElsewhere | None:
    """Oil that enters the interactions other than the raceway contacts; `None` if it is the oil of the raceways."""
    own = scene.oil_temperatures
    if own is None:
        return None
    return OilElsewhere(*(scene.oil.at(getattr(own, place)) for place in OilElsewhere._fields))


def oil_of(inlet: InletOil, elsewhere: OilElsewhere | None, place: str) -> InletOil:
    """Oil that enters an interaction other than the raceway contacts.

    **Arguments:** `inlet`: oil of the raceways; `elsewhere`: oil of the other interactions, `None` if it is the same;
    `place`: field of `OilElsewhere`.
    """
    return inlet if elsewhere is None else getattr(elsewhere, place)


class AbstractOils(eqx.Module):
    """Base of equations in which the oil may differ between the interactions."""

    inlet: eqx.AbstractVar[InletOil]
    """Oil of the raceways."""
    elsewhere: eqx.AbstractVar[OilElsewhere | None]
    """Oil of the other interactions; `None` if it is the oil of the raceways."""

    def oil_of(self, place: str) -> InletOil:
        """Oil that enters an interaction other than the raceway contacts. **Arguments:** `place`: field of
        `OilElsewhere`."""
        return oil_of(self.inlet, self.elsewhere, place)


def oil_temperature(scene: AbstractBearing, place: str) -> Scalar:
    """Temperature of the oil of an interaction, K. **Arguments:** `place`: field of `OilTemperatures`."""
    own = scene.oil_temperatures
    return scene.operation.oil_temperature if own is None else getattr(own, place)


def race_temperatures(scene: AbstractBearing) -> Scalar | Float[Array, "2 1"]:
    """Temperature of the oil that enters the raceway contacts, K: one number for both, or shape (2, 1), inner race
    first."""
    own = scene.oil_temperatures
    if own is None:
        return scene.operation.oil_temperature
    return jnp.stack([jnp.asarray(own.inner_raceway), jnp.asarray(own.outer_raceway)])[:, None]


def of_inner_race(values: Scalar | Float[Array, "2 1"]) -> Scalar:
    """Selects the value at the inner race. **Arguments:** `values`: a number for both races, or shape (2, 1)."""
    return values[0, 0] if jnp.ndim(values) else values

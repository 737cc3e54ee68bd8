"""Results of a transient run of the temperatures of a bearing, with labelled fields."""

from collections.abc import Mapping
from typing import Any, ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from ..._identity import Identity
from ..._scene import AbstractHistory, label
from ...numerics.status import Status
from ...thermal.result import HeatPaths, NodeTemperatures
from ..growth import FitResult
from ..operation import AbstractOperation
from ..solution import CageState, RingDisplacement, losses_not_modelled
from .settings import SOLVER

_Number = Float[Array, ""]


class WarmInstant(eqx.Module):
    """The bearing at one instant; in a `WarmUpHistory` the first axis of every array is time."""

    inner_speed: _Number = eqx.field(metadata=label("rad/s", "inner ring speed"))
    oil_inlet: _Number = eqx.field(metadata=label("K", "temperature of the oil that enters"))
    temperatures: NodeTemperatures
    flows: HeatPaths
    oil_out: _Number | None = eqx.field(metadata=label("K", "temperature of the oil that leaves"))
    heat_to_oil: _Number = eqx.field(metadata=label("W", "heat that leaves with the oil"))
    heat_to_ambient: _Number = eqx.field(metadata=label("W", "heat that leaves to the ambient"))
    heat_stored: _Number = eqx.field(metadata=label("W", "heat that warms the nodes"))
    power_loss: Any
    drive_power: _Number | None = eqx.field(metadata=label("W", "sum over both rings of torque times speed"))
    ring: RingDisplacement
    cage: CageState | None
    fit: FitResult | None
    largest_load: _Number = eqx.field(metadata=label("N", "largest load of all raceway contacts"))
    largest_pressure: _Number = eqx.field(metadata=label("Pa", "largest Hertz pressure of all raceway contacts"))
    smallest_film: _Number | None = eqx.field(metadata=label("m", "smallest central film on the raceways"))


def play_of(instants: WarmInstant) -> tuple[str, Array | None] | None:
    """Name and values, m, of the operating clearance or of the axial shift of first contact; `None` without fits."""
    fit = instants.fit
    if fit is None:
        return None
    return ("clearance", fit.clearance) if fit.clearance is not None else ("axial_shift", fit.axial_shift)


class WarmPeaks(eqx.Module):
    """Extreme values of a run, also between its instants. The play is the operating clearance, or for tapered bearings
    the axial shift of first contact; it is `None` without fits."""

    least_play: _Number | None = eqx.field(metadata=label("m", "least clearance, or axial shift, of the run"))
    least_play_time: _Number | None = eqx.field(metadata=label("s", "time of the least clearance or axial shift"))
    largest_load: _Number = eqx.field(metadata=label("N", "largest load of all raceway contacts in the run"))
    largest_load_time: _Number = eqx.field(metadata=label("s", "time of the largest load"))
    highest_temperature: _Number = eqx.field(metadata=label("K", "highest temperature of all nodes in the run"))
    highest_temperature_time: _Number = eqx.field(metadata=label("s", "time of the highest temperature"))


class WarmEnergy(eqx.Module):
    """Energies over the run, J. The balance is `losses` = `to_oil` + `to_ambient` + `stored`; `error` is what it leaves
    open, over the losses."""

    losses: _Number = eqx.field(metadata=label("J", "energy of all losses"))
    to_oil: _Number = eqx.field(metadata=label("J", "energy that left with the oil"))
    to_ambient: _Number = eqx.field(metadata=label("J", "energy that left to the ambient"))
    stored: _Number = eqx.field(metadata=label("J", "energy that the nodes have stored"))
    error: _Number = eqx.field(metadata=label("1", "what the balance leaves open, over the energy of the losses"))


class WarmState(eqx.Module):
    """State from which another run can continue: `WarmUpHistory.last_state`.

    **Arguments:** `time`: time of the state, s; `temperatures`: node temperatures, K, in the order of `nodes`; `nodes`:
    names of the nodes; `identity`: identity of the bearing, `None` if it is not known.
    """

    of: ClassVar[str] = "bearing with [thermal]"
    """Kind of the scenes that have this state, for messages."""

    time: Float[Array | np.ndarray, ""]
    temperatures: Float[Array | np.ndarray, " node"]
    nodes: tuple[str, ...] = eqx.field(static=True)
    identity: Identity | None = None


class WarmUpHistory(AbstractHistory):
    """Result of a transient run of temperatures: all instants up to the last good one, even if the run stopped early.

    `instants` holds the results, with time as the first axis: `history.instants.temperatures.inner_ring` has the shape
    of `time`. `peaks` holds the least clearance, the largest contact load and the highest temperature, also between the
    instants. If a node temperature passes `thermal.limit`, the run ends there with the status `thermal_runaway`.
    """

    of: ClassVar[str] = "bearing with [thermal]"
    """Kind of the scenes whose runs have this history, for messages."""

    status: Int[Array, ""] = eqx.field(metadata=label("1", "how the run ended"))
    time: Float[Array, " time"] = eqx.field(metadata=label("s", "time"))
    stop: Float[Array, ""] = eqx.field(metadata=label("s", "time to which the run was to go"))
    accepted: Int[Array, ""] = eqx.field(metadata=label("1", "steps taken"))
    rejected: Int[Array, ""] = eqx.field(metadata=label("1", "steps tried and not taken"))
    operation: AbstractOperation
    instants: WarmInstant
    energy: WarmEnergy
    peaks: WarmPeaks
    checks: Mapping[str, Bool[Array, ""]]
    nodes: tuple[str, ...] = eqx.field(static=True)
    solver: str = eqx.field(static=True, default=SOLVER)
    interrupted: bool = eqx.field(static=True, default=False)
    element_name: str = eqx.field(static=True, default="roller")
    notes: tuple[str, ...] = eqx.field(static=True, default=())
    identity: Identity | None = None

    @property
    def not_modelled(self) -> tuple[str, ...]:
        """Losses that the scene does not model, by their names in `instants.power_loss`."""
        return losses_not_modelled(self.instants.power_loss)

    def node_temperatures(self) -> Float[Array, "time node"]:
        """Node temperatures, K, in the order of `nodes`."""
        return jnp.stack([getattr(self.instants.temperatures, name) for name in self.nodes], axis=-1)

    def last_state(self) -> WarmState:
        """State of the last instant, for `jaxbearing.simulate(..., restart=...)`."""
        last = np.asarray(self.node_temperatures())[-1]
        return WarmState(np.asarray(self.time[-1]), last, self.nodes, self.identity)

    def at(self, index: int) -> WarmInstant:
        """The results at one instant. **Arguments:** `index`: number of the instant, from 0; -1 is the last one."""
        instant: WarmInstant = jax.tree.map(lambda leaf: leaf[index], self.instants)
        return instant

    def solver_failure(self) -> str:
        last = np.asarray(self.node_temperatures())[-1]
        node = int(np.argmax(last))
        hottest = f"the hottest node, the {self.nodes[node].replace('_', ' ')}, at {last[node] - 273.15:.1f} degC"
        limit = "a node passed thermal.limit; " if int(self.status) == Status.THERMAL_RUNAWAY else ""
        return self.early_end("s", limit, f", with {hottest}")

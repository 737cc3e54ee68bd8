"""Results of a transient run. Every quantity has its unit and description in the metadata of its field.

The command line, JSON, files and plots read this metadata; there is no second list. A family derives its own classes of
an instant and of the energy balance from `Instant` and `Energy`, and adds its own fields to them.
"""

from collections.abc import Mapping
from typing import Any, ClassVar, Generic, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from ..._identity import Identity
from ..._scene import AbstractHistory
from ...numerics.status import Status
from ..cage_stress import CageSection
from ..operation import AbstractOperation
from ..solution import RingDisplacement, label, losses_not_modelled

CAGE_ANGLE = "q"
"""Name of the component of the cage state that holds the angle of the cage, in the frame of the run, times the pitch
radius, m."""


class CageMotion(eqx.Module):
    """Position of the cage centre and speeds of the cage. Y points along the load line, X a quarter turn behind it."""

    x: Float[Array, ""] = eqx.field(metadata=label("m", "cage centre across the load line (X)"))
    y: Float[Array, ""] = eqx.field(metadata=label("m", "cage centre along the load line (Y)"))
    velocity_x: Float[Array, ""] = eqx.field(metadata=label("m/s", "velocity of the cage centre along X"))
    velocity_y: Float[Array, ""] = eqx.field(metadata=label("m/s", "velocity of the cage centre along Y"))
    speed: Float[Array, ""] = eqx.field(metadata=label("rad/s", "cage speed"))
    slip: Float[Array, ""] = eqx.field(metadata=label("1", "1 - cage speed / speed of rolling without slip"))
    eccentricity_ratio: Float[Array, ""] = eqx.field(metadata=label("1", "cage offset over radial guiding clearance"))


class PocketPeaks(eqx.Module):
    """Largest loads on the cage between two instants. They are recorded because a shock lasts only some microseconds,
    less than the interval between instants."""

    front: Float[Array, " element"] = eqx.field(
        metadata=label("N", "largest load on the front pocket wall since the instant before")
    )
    rear: Float[Array, " element"] = eqx.field(
        metadata=label("N", "largest load on the rear pocket wall since the instant before")
    )
    land: Float[Array, " land"] | None = eqx.field(
        default=None, metadata=label("N", "largest load of the cage on each guiding land since the instant before")
    )


class Instant(eqx.Module):
    """State and results at one time; in a `History` the first axis of every array is time.

    **Arguments:** see the labels of the fields; fields without a label are those of the steady solution of the family.
    In every family the rolling elements have `azimuth`, which continues beyond a full turn. Reports show their
    `orbital_speed`, and `load`, `pressure` and `sliding` at the inner and outer race (`_inner`, `_outer`), if the
    family has these fields.
    """

    element_state: ClassVar[tuple[str, ...]] = ()
    """Names of the components of `state_elements`."""
    cage_state: ClassVar[tuple[str, ...]] = ()
    """Names of the components of `state_cage`."""
    groove_angles: ClassVar[np.ndarray] = np.zeros(0)
    """Midpoints of the intervals of angle in which losses across a groove are summed, rad; empty without grooves."""

    inner_speed: Float[Array, ""] = eqx.field(metadata=label("rad/s", "inner ring speed"))
    radial_load: Float[Array, ""] = eqx.field(metadata=label("N", "load on the inner ring along the load line"))
    lateral_load: Float[Array, ""] = eqx.field(metadata=label("N", "load on the inner ring across the load line"))
    ring: RingDisplacement
    cage: CageMotion | None
    elements: Any
    pocket_peaks: PocketPeaks | None
    power_loss: Any
    drive_power: Float[Array, ""] = eqx.field(metadata=label("W", "sum over both rings of torque times speed"))
    kinetic_energy: Float[Array, ""] = eqx.field(metadata=label("J", "kinetic energy of rolling elements and cage"))
    pocket_energy: Float[Array, ""] = eqx.field(metadata=label("J", "elastic energy of the pocket films"))
    raceway_energy: Float[Array, ""] = eqx.field(metadata=label("J", "elastic energy of the raceway contacts"))
    state_elements: Float[Array, "element_state element"] = eqx.field(
        metadata=label("1", "state of the rolling elements in the frame of the run")
    )
    state_cage: Float[Array, " cage_state"] = eqx.field(
        metadata=label("1", "state of the cage in the frame of the run")
    )
    frame_angle: Float[Array, ""] = eqx.field(metadata=label("rad", "angle of the frame of the state"))
    frame_speed: Float[Array, ""] = eqx.field(metadata=label("rad/s", "speed of that frame"))


Moment = TypeVar("Moment", bound=Instant)
"""Instant class of a family."""


class LastState(eqx.Module):
    """State from which another run can continue: `History.last_state`, or read from a file.

    **Arguments:**
    - `time`: time of the state, s.
    - `elements`: state of each rolling element; the family names its components (`Instant.element_state`).
    - `cage`: state of the cage; the family names its components (`Instant.cage_state`).
    - `frame_angle`, `frame_speed`: angle and speed of the frame in which positions are counted, rad and rad/s.
    - `reference_speed`: speed of that frame at the operating point, rad/s.
    - `azimuth`: azimuths of the rolling elements, rad.
    - `has_cage`: True if there is a cage.
    - `identity`: identity of the bearing; `None` if it is not known, as in files of earlier versions.
    """

    of: ClassVar[str] = "bearing"
    """Kind of the scenes that have this state, for messages."""

    time: Float[Array | np.ndarray, ""]
    elements: Float[Array | np.ndarray, "component element"]
    cage: Float[Array | np.ndarray, " cage_component"]
    frame_angle: Float[Array | np.ndarray, ""]
    frame_speed: Float[Array | np.ndarray, ""]
    reference_speed: Float[Array | np.ndarray, ""]
    azimuth: Float[Array | np.ndarray, " element"]
    has_cage: bool = eqx.field(static=True)
    identity: Identity | None = None


class Energy(eqx.Module):
    """Works and energies over the run, J. The balance is `drive` = `kinetic` + `dissipation` + `pocket_films` + terms
    of the family, up to `error`."""

    drive: Float[Array, ""] = eqx.field(metadata=label("J", "work of the torques that drive the rings"))
    dissipation: Float[Array, ""] = eqx.field(metadata=label("J", "dissipated, but for the squeezed pocket films"))
    pocket_films: Float[Array, ""] = eqx.field(
        metadata=label("J", "work that closed the pocket films: oil squeezed out, and elastic energy")
    )
    kinetic: Float[Array, ""] = eqx.field(metadata=label("J", "gain of kinetic energy"))
    pocket_elastic: Float[Array, ""] = eqx.field(metadata=label("J", "gain of elastic energy of the pocket films"))
    error: Float[Array, ""] = eqx.field(metadata=label("1", "what the balance leaves open, over the drive work"))


class History(AbstractHistory, Generic[Moment]):
    """Result of a transient run: all instants up to the last good one, even if the run stopped early.

    `instants` holds the results, with time as the first axis: `history.instants.cage.speed` has the shape of `time`.
    """

    of: ClassVar[str] = "bearing"
    """Kind of the scenes that have this state, for messages."""

    status: Int[Array, ""] = eqx.field(metadata=label("1", "how the run ended"))
    time: Float[Array, " time"] = eqx.field(metadata=label("s", "time"))
    stop: Float[Array, ""] = eqx.field(metadata=label("s", "time to which the run was to go"))
    accepted: Int[Array, ""] = eqx.field(metadata=label("1", "steps taken"))
    rejected: Int[Array, ""] = eqx.field(metadata=label("1", "steps tried and not taken"))
    reference_speed: Float[Array, ""] = eqx.field(
        metadata=label("rad/s", "speed of the frame of the state at the operating point")
    )
    operation: AbstractOperation
    instants: Moment
    energy: Energy
    checks: Mapping[str, Bool[Array, ""]]
    solver: str = eqx.field(static=True)
    interrupted: bool = eqx.field(static=True, default=False)
    element_name: str = eqx.field(static=True, default="roller")
    notes: tuple[str, ...] = eqx.field(static=True, default=())
    identity: Identity | None = None
    cage_section: CageSection | None = None

    @property
    def not_modelled(self) -> tuple[str, ...]:
        """Losses that the scene does not model, by their names in `instants.power_loss`."""
        return losses_not_modelled(self.instants.power_loss)

    def last_state(self) -> LastState:
        """State of the last instant, for `jaxbearing.simulate(..., restart=...)`.

        **Raises:** `ValueError` for a run without a start.
        """
        if np.size(self.time) == 0:
            raise ValueError(self.failure())
        last = jax.tree.map(lambda leaf: np.asarray(leaf[-1]), self.instants)
        return LastState(
            time=np.asarray(self.time[-1]),
            elements=last.state_elements,
            cage=last.state_cage,
            frame_angle=last.frame_angle,
            frame_speed=last.frame_speed,
            reference_speed=np.asarray(self.reference_speed),
            azimuth=last.elements.azimuth,
            has_cage=last.cage is not None,
            identity=self.identity,
        )

    def lane(self, index: int) -> "History[Moment]":
        """One run of a batch, up to the last instant that it reached."""
        run = jax.tree.map(lambda leaf: np.asarray(np.asarray(leaf)[index]), self)
        reached = np.isfinite(run.time)
        instants = jax.tree.map(lambda leaf: leaf[reached], run.instants)
        lane = eqx.tree_at(lambda h: (h.time, h.instants), run, (run.time[reached], instants))
        return jax.tree.map(jnp.asarray, lane)

    def solver_failure(self) -> str:
        if np.size(self.time) == 0:
            return f"{Status(int(self.status)).text}: the quasi-static start of the run was not found"
        return self.early_end()

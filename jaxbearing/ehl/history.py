"""Results of a transient run of a line contact, labelled."""

from collections.abc import Mapping
from typing import ClassVar

import equinox as eqx
from jaxtyping import Array, Bool, Float, Int

from .._scene import AbstractHistory, label
from .._types import Scalar
from .last_state import FilmState
from .line_contact import ContactOperation
from .solution import HertzResult

SOLVER = "bdf2"


class FilmHistory(eqx.Module):
    """Film over time. The minimum is the lowest value at a node: a parabola may fall below 0 at the kink of a stop."""

    central: Float[Array, " time"] = eqx.field(metadata=label("m", "film at the centre"))
    minimum: Float[Array, " time"] = eqx.field(metadata=label("m", "smallest film"))
    minimum_position: Float[Array, " time"] = eqx.field(metadata=label("m", "place of the smallest film"))


class PressureHistory(eqx.Module):
    """Pressure over time."""

    central: Float[Array, " time"] = eqx.field(metadata=label("Pa", "pressure at the centre"))
    maximum: Float[Array, " time"] = eqx.field(metadata=label("Pa", "largest pressure"))


class ProfileHistory(eqx.Module):
    """Pressure and film over the contact and over time; x points along the direction of positive speed."""

    x: Float[Array, " node"] = eqx.field(metadata=label("m", "place along rolling, from the centre"))
    pressure: Float[Array, "time node"] = eqx.field(metadata=label("Pa", "pressure"))
    film: Float[Array, "time node"] = eqx.field(metadata=label("m", "film thickness"))


class LineContactHistory(AbstractHistory):
    """Result of a transient run: the steady start and every accepted step, also where the run ended early.

    A run ends where its film falls below `contact.film_limit`, the limit of the model: it counts as completed, with a
    warning. `last_state` is its final state: `simulate(scene, ..., restart=history)` continues from there.
    """

    of: ClassVar[str] = "line contact"
    """Kind of scene that has this result, for messages."""

    status: Int[Array, ""] = eqx.field(metadata=label("1", "how the run ended"))
    time: Float[Array, " time"] = eqx.field(metadata=label("s", "time"))
    stop: Float[Array, ""] = eqx.field(metadata=label("s", "time to which the run was to go"))
    accepted: Int[Array, ""] = eqx.field(metadata=label("1", "steps taken"))
    rejected: Int[Array, ""] = eqx.field(metadata=label("1", "steps tried and not taken"))
    newton_steps: Int[Array, ""] = eqx.field(metadata=label("1", "Newton steps"))
    mass_balance: Float[Array, ""] = eqx.field(
        metadata=label("1", "largest relative imbalance of mass in the zone under pressure in one step")
    )
    entrainment_speed: Float[Array, " time"] = eqx.field(metadata=label("m/s", "mean surface speed"))
    film: FilmHistory
    pressure: PressureHistory
    profile: ProfileHistory
    hertz: HertzResult
    operation: ContactOperation
    last_state: FilmState
    checks: Mapping[str, Bool[Array, ""]]
    ended_thin: bool = eqx.field(static=True, default=False)
    interrupted: bool = eqx.field(static=True, default=False)
    solver: str = eqx.field(static=True, default=SOLVER)
    notes: tuple[str, ...] = eqx.field(static=True, default=())

    def solver_failure(self) -> str:
        return self.early_end()


def thin_note(time: float, limit: Scalar) -> str:
    """Note on a run that ended below its film limit."""
    return (
        f"the run ended at {1e3 * time:.6g} ms: the smallest film fell below contact.film_limit, "
        f"{1e9 * float(limit):.3g} nm, where a continuum, and smooth surfaces, mean nothing"
    )

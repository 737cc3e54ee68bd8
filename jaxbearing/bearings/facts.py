"""Data for range checks: the contacts of a solved bearing, and the checks of a bearing family."""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from ..contacts.laws import ContactLaws
from ..contacts.oil_supply import Starvation
from ..contacts.point_laws import PointLaws
from ..lubricants import InletOil
from .solution import CageState, RingDisplacement

MEAN_OF_POINT, MEAN_OF_LINE = 2.0 / 3.0, 0.25 * np.pi
"""Mean over peak Hertz pressure of point and of line contacts."""
LOADED = 0.01
"""Fraction of the largest load at the same place from which a contact counts."""
BUSY = 0.1
"""Fraction of the largest load at the same place from which a contact counts in the checks of skidding, of the load
along a roller, and of the traction that keeps a tapered roller rolling. The cage drives the less loaded elements."""

Excess = dict[str, Array]


class Contacts(NamedTuple):
    """Contacts of one kind, as the checks see them. Quantities that are not modelled or have no limit are `None`.

    - `places`: names of the rows; `load`: N; `pressure`: peak Hertz pressure, Pa; `mean_share`: mean over peak of it.
    - `laws`: laws of film and traction; `inlet`: oil that enters the contacts; `mean_speed`, `sliding`: mean and
      sliding speed along the rolling direction, m/s; `temperature`: temperature of the oil in the contact, K.
    - `load_share`: fraction of the load that asperities carry.
    - `laminae`: loads of the laminae of the rollers, N.
    - `angle`: contact angle, rad.
    - `past_edge`: overhang of a contact ellipse over the edge of its surface, rad or m, positive if the ellipse is cut
      off; it counts for the rows that have a name in `edges`.
    - `starved`: effect of the oil supply on the contacts.
    - `largest`: load to which the loads of each place are compared, N; `None`: the largest load at the place. Both
      flanks of a raceway are compared to the same load.
    """

    places: tuple[str, ...]
    load: Float[Array, "place element"]
    pressure: Float[Array, "place element"]
    mean_share: float
    laws: ContactLaws | PointLaws | None = None
    inlet: InletOil | None = None
    mean_speed: Float[Array, "place _"] | None = None
    sliding: Float[Array, "place element"] | None = None
    temperature: Float[Array, "place element"] | None = None
    load_share: Float[Array, "place element"] | None = None
    laminae: Float[Array, "place element lamina"] | None = None
    angle: Float[Array, "place element"] | None = None
    past_edge: Float[Array, "place element"] | None = None
    edges: tuple[str | None, ...] = ()
    starved: Starvation | None = None
    largest: Float[Array, "place 1"] | None = None

    def loaded(self, part: float = LOADED) -> Bool[Array, "place element"]:
        """True for the contacts that count: those with at least the fraction `part` of the largest load at their
        place."""
        largest = jnp.max(self.load, axis=1, keepdims=True) if self.largest is None else self.largest
        return (self.load > 0) & (self.load >= part * largest)

    def most(self, values: Array, part: float = LOADED) -> Float[Array, " place"]:
        """Largest of the values over the contacts that count, at each place; -inf if none counts."""
        return jnp.max(jnp.where(self.loaded(part), values, -jnp.inf), axis=1)

    def said(self, text: str, excess: Float[Array, " place"]) -> Excess:
        """One entry for each place; its name replaces {place} in the text."""
        return {text.format(place=place): excess[i] for i, place in enumerate(self.places)}


RACEWAYS = ("the inner raceway", "the outer raceway")


class Facts(NamedTuple):
    """Results of a steady solve that the checks need.

    - `contacts`: the contacts, one entry for each kind.
    - `traction_reserve`: for tapered rollers that are constrained to roll without slip, the largest traction of the
      films less the traction needed, N.
    - `opening`: least opening of the rings along each roller, m, negative where they press it; `None`: every load
      presses.
    - `roller_tilt`: tilt of the rollers if they may tilt, rad.
    - `stiffness`: tangent stiffness of a ring that is free to tilt, with all degrees of freedom as lengths, N/m.
    """

    contacts: tuple[Contacts, ...]
    traction_reserve: Float[Array, "2 roller"] | None = None
    opening: Float[Array, " roller"] | None = None
    roller_tilt: Float[Array, " roller"] | None = None
    stiffness: Float[Array, "freedom freedom"] | None = None


class SolvedBearing(NamedTuple):
    """A solved bearing, as the checks of results see it.

    **Arguments:** `scene`: the `AbstractBearing`, of the class of its family; `held`: True if the displacement of the
    ring is prescribed and the loads of the scene do not act.
    """

    scene: Any
    facts: Facts
    ring: RingDisplacement
    cage: CageState | None
    held: bool

    @property
    def elements(self) -> str:
        """Name of the rolling elements."""
        return f"{self.scene.element}s"

    def said(self, text: str, excess: Callable[[Contacts], Array | None]) -> Excess:
        """Entries of a check with one text, for all kinds of contacts except those whose `excess` is `None`."""

        def of(contacts: Contacts) -> Excess:
            values = excess(contacts)
            return {} if values is None else contacts.said(text, values)

        return self.each(of)

    def each(self, check: Callable[[Contacts], Excess]) -> Excess:
        """Joins the entries of a check for all kinds of contacts."""
        entries: Excess = {}
        for contacts in self.facts.contacts:
            entries |= check(contacts)
        return entries


class RangeChecks(NamedTuple):
    """Range checks of one bearing family. Each check maps a text to a number that is positive if the warning applies.

    **Arguments:**
    - `results`: checks of a solved bearing.
    - `inputs`: checks of a scene.
    - `loads`: checks of the loads of the operating point; they do not apply to a held ring.
    """

    results: tuple[Callable[[SolvedBearing], Excess], ...] = ()
    inputs: tuple[Callable[[Any], Excess], ...] = ()
    loads: tuple[Callable[[Any], Excess], ...] = ()

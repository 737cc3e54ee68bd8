"""Facts that range checks look at: the contacts that a solve states, and the checks of a family of bearings."""

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
"""Mean over peak of Hertz's pressure."""
LOADED = 0.01
"""Part of the largest load at the same place from which on a contact counts."""
BUSY = 0.1
"""Part of the largest load at the same place from which on the distribution of a load along a roller counts, and from
which on a tapered roller keeps itself rolling; a cage takes the others along."""

Excess = dict[str, Array]


class Contacts(NamedTuple):
    """Contacts of one kind, as the checks see them; what is not modelled, or has no limit, is `None`.

    - `places`: names of the rows; `load`, N; `pressure`, peak of Hertz's, Pa; `mean_share`: mean over peak.
    - `laws`: of the film and what shears it; `inlet`: the oil that enters; `mean_speed` and `sliding` along rolling,
      m/s; `temperature` of the oil in the contact, K.
    - `load_share`: part of the load that asperities carry.
    - `laminae`: loads along the rollers, N.
    - `angle`: contact angle, rad.
    - `past_edge`: by how much a contact ellipse passes the end of what it rests on, positive where it is cut off, for
      the rows whose `edges` name such an end.
    - `starved`: what the supply of oil does to them.
    - `largest`: load to which those of each place are compared, N; `None`: the largest at the place. Both flanks of a
      raceway are compared to the same one.
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
        """Contacts that count: with at least this part of the largest load at the same place."""
        largest = jnp.max(self.load, axis=1, keepdims=True) if self.largest is None else self.largest
        return (self.load > 0) & (self.load >= part * largest)

    def most(self, values: Array, part: float = LOADED) -> Float[Array, " place"]:
        """Largest of the values over the contacts that count; -inf where none does."""
        return jnp.max(jnp.where(self.loaded(part), values, -jnp.inf), axis=1)

    def said(self, text: str, excess: Float[Array, " place"]) -> Excess:
        """One entry for each place, which stands in the text as {place}."""
        return {text.format(place=place): excess[i] for i, place in enumerate(self.places)}


RACEWAYS = ("the inner raceway", "the outer raceway")


class Facts(NamedTuple):
    """Facts that a steady solve states for the checks.

    - `contacts`: kinds of contacts.
    - `traction_reserve`: of tapered rollers that roll by constraint, what the films could carry less what it takes, N.
    - `roller_tilt`: of rollers that may tilt, rad.
    - `stiffness`: tangent stiffness of a ring that is free to tilt, of its degrees of freedom counted as lengths, N/m.
    """

    contacts: tuple[Contacts, ...]
    traction_reserve: Float[Array, "2 roller"] | None = None
    roller_tilt: Float[Array, " roller"] | None = None
    stiffness: Float[Array, "freedom freedom"] | None = None


class SolvedBearing(NamedTuple):
    """A solved bearing, as the checks of results see it.

    **Arguments:** `scene`: an `AbstractBearing`, which a check of a family takes as its own class; `held`: whether the
    ring is where it is told to be, whatever the loads of the scene.
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
        """The entries of a check of contacts with one text; of contacts whose `excess` is `None` there is none."""

        def of(contacts: Contacts) -> Excess:
            found = excess(contacts)
            return {} if found is None else contacts.said(text, found)

        return self.each(of)

    def each(self, check: Callable[[Contacts], Excess]) -> Excess:
        """The entries of a check of contacts, for all kinds of contacts."""
        found: Excess = {}
        for contacts in self.facts.contacts:
            found |= check(contacts)
        return found


class RangeChecks(NamedTuple):
    """Range checks of one family of bearings: text -> a number that is positive where the warning applies.

    **Arguments:**
    - `results`: checks of a solved bearing.
    - `inputs`: checks of a scene.
    - `loads`: checks of the operating point's loads, which say nothing about a ring that is held.
    """

    results: tuple[Callable[[SolvedBearing], Excess], ...] = ()
    inputs: tuple[Callable[[Any], Excess], ...] = ()
    loads: tuple[Callable[[Any], Excess], ...] = ()

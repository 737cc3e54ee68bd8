"""Laws of a lubricated line contact: film, inlet heating, traction and rolling resistance from load and speeds."""

from typing import ClassVar, NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..lubricants import InletOil, Lubricant
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float
from ..numerics.safe import smooth_abs
from ..numerics.structure import choice
from .film import AbstractLineFilm
from .heated_film import HeatedFilm, heated_film
from .hysteresis import line_hysteresis
from .line import LineContact
from .mixed import Asperities, InletState, MixedFriction, MixedState, require_traction
from .oil_supply import Starvation, Supply
from .rolling import AbstractRollingResistance, RollingInlet
from .rolling_heating import AIHARA, HEATINGS, aihara_factor, heating_of
from .shear import Sliding
from .thermal import AbstractThermalFactor, NoThermalReduction
from .traction import AbstractTraction

SPEED_SMOOTHING = 5e-7
"""Speed that smooths the absolute value of the mean surface speed, m/s: relative error < 1e-12 above 0.5 m/s."""


class ContactState(NamedTuple):
    """State of one contact.

    - `film`: film thickness, m.
    - `temperature_rise`: above the inlet temperature, K; `None` if isothermal.
    - `traction`: friction force, N; `None` if frictionless.
    - `rolling_force`: rolling resistance, N, with the sign of the mean speed; `None` without rolling resistance.
    - `inner_residual`: residual of the nested solves for temperature rise and meniscus, in units of ln(film).
    - `supply`: factors of starvation; `None` if fully flooded.
    """

    film: Float[Array, "*batch"]
    temperature_rise: Float[Array, "*batch"] | None
    traction: Float[Array, "*batch"] | None
    rolling_force: Float[Array, "*batch"] | None
    inner_residual: Float[Array, ""]
    supply: Starvation | None = None

    @property
    def separation(self) -> Float[Array, "*batch"]:
        """Film thickness in the equations for the position of a rolling element between the rings, m.

        With a supply it is kept a little above `film`: a starved film is too thin to fill the clearance of an unloaded
        element, and the equation of this element would have no root.
        """
        return self.film if self.supply is None else self.supply.separation


class ContactLaws(Checked):
    """Laws of the lubricated line contacts of rollers; `PointLaws` are those of balls.

    **Arguments:**
    - `film`: film thickness law.
    - `thermal`: thermal reduction of the film; `NoThermalReduction()` is neutral.
    - `traction`: friction force law; `None`: no friction, the rolling elements then roll without slip.
    - `entrainment_offset`: added to the absolute value of the mean surface speed of every contact, m/s. 0 by default;
      the published check values were computed with 1 mm/s.
    - `rolling`: rolling resistance; `None`: no rolling resistance.
    - `rolling_heating`: how inlet heating lowers the rolling resistance, by a factor (`"aihara"`) or by the viscosity
      at the temperature that corresponds to the thermal reduction of the film (`"film_temperature"`). The default is
      the choice of the rolling law if `thermal` is given, otherwise no reduction.
    - `entrainment_smoothing`: speed that smooths the absolute value of the mean surface speed, m/s; it sets the film
      that remains at rest.
    - `supply`: oil supply; `None`: fully flooded.
    - `mixed`: mixed friction of rough surfaces; `None`: the film carries all of the load.
    - `hysteresis`: fraction of the elastic work that is lost in the bodies in rolling; `None`: no hysteresis.
    """

    part: ClassVar[str] = "contact"

    film: AbstractLineFilm
    thermal: AbstractThermalFactor = NoThermalReduction()
    traction: AbstractTraction | None = None
    entrainment_offset: Scalar = bounded(">= 0", unit="m/s", converter=as_float, default=0.0)
    rolling: AbstractRollingResistance | None = None
    rolling_heating: str | None = choice("contact.rolling_heating", HEATINGS, None)
    entrainment_smoothing: Scalar = bounded("> 0", unit="m/s", converter=as_float, default=SPEED_SMOOTHING)
    supply: Supply | None = None
    mixed: MixedFriction | None = None
    hysteresis: Scalar | None = bounded("between 0 and 1", unit="1", default=None)

    def __check_init__(self):
        require_traction(self.part, self.mixed, self.traction)

    @property
    def resists_rolling(self) -> bool:
        """True if rolling resistance or hysteresis is modelled."""
        return self.rolling is not None or self.hysteresis is not None

    def entrainment(self, mean_speed: Values) -> Float[Array, "..."]:
        """Entrainment speed of the film, m/s, > 0. **Arguments:** `mean_speed` (u1 + u2)/2, m/s, of either sign."""
        return smooth_abs(mean_speed, self.entrainment_smoothing) + self.entrainment_offset

    def heated_film(
        self,
        contact: LineContact,
        load: Values,
        mean_speed: Values,
        sliding_speed: Values,
        lubricant: Lubricant,
        inlet: InletOil,
    ) -> HeatedFilm:
        """The fully flooded film with its temperature rise; arguments as in `evaluate`."""
        speed = self.entrainment(mean_speed)
        return heated_film(self.film, self.thermal, contact, load, speed, sliding_speed, lubricant, inlet)

    def separation(
        self,
        contact: LineContact,
        load: Values,
        mean_speed: Values,
        sliding_speed: Values,
        lubricant: Lubricant,
        inlet: InletOil,
    ) -> tuple[Array, Array]:
        """`ContactState.separation`, m, and the residual of the nested solves; arguments as in `evaluate`."""
        warm_film = self.heated_film(contact, load, mean_speed, sliding_speed, lubricant, inlet)
        if self.supply is None:
            return jnp.exp(warm_film.log_thickness), warm_film.residual
        speed = self.entrainment(mean_speed)
        starved = self.supply.starvation(contact, load, warm_film.log_thickness, speed, inlet)
        return starved.separation, jnp.maximum(warm_film.residual, starved.residual)

    def evaluate(
        self,
        contact: LineContact,
        load: Values,
        mean_speed: Values,
        sliding_speed: Values,
        lubricant: Lubricant,
        inlet: InletOil,
    ) -> ContactState:
        """Film, temperature rise, traction and rolling resistance.

        The flooded film is the thermal reduction factor phi_T times the isothermal film at the inlet temperature.
        Starvation (`supply`) makes it thinner and lowers the rolling resistance of the flooded contact. Traction is
        evaluated at the inlet temperature plus the rise that corresponds to phi_T. With `film_temperature` the rolling
        resistance takes the viscosity at this temperature and the pressure-viscosity coefficient at the inlet
        temperature; with `aihara` it takes both at the inlet temperature.

        **Arguments:** `contact`, the two bodies; `load`, N, > 0; `mean_speed` (u1 + u2)/2 and `sliding_speed` u1 - u2,
        m/s, of either sign; `inlet` = `lubricant.at(inlet temperature)`, evaluated once for all contacts.
        """
        speed = self.entrainment(mean_speed)
        warm_film = self.heated_film(contact, load, mean_speed, sliding_speed, lubricant, inlet)
        base, base_viscosity = inlet.temperature, inlet.viscosity
        if warm_film.rise is not None:
            base = inlet.temperature + warm_film.rise
            base_viscosity = lubricant.viscosity.viscosity(0.0, base)
        film = flooded = jnp.exp(warm_film.log_thickness)
        starved, residual = None, warm_film.residual
        if self.supply is not None:
            starved = self.supply.starvation(contact, load, warm_film.log_thickness, speed, inlet)
            film, residual = starved.film, jnp.maximum(residual, starved.residual)
        traction = None
        if self.traction is not None:
            traction = self.traction.force(contact, load, film, speed, sliding_speed, base, lubricant, base_viscosity)
            if self.mixed is not None:
                share = self.asperities(contact, load, film, mean_speed, inlet).share
                traction = self.mixed.force(load, share, traction, sliding_speed)
        rolling = None
        if self.rolling is not None:
            heated = heating_of(self.rolling, self.rolling_heating, self.thermal) == AIHARA
            viscosity = inlet.viscosity if heated else base_viscosity
            entering = RollingInlet(load, mean_speed, viscosity, inlet.pressure_viscosity, flooded)
            rolling = self.rolling.force(contact, entering)
            if heated:
                rolling = rolling * aihara_factor(mean_speed, inlet)
            if starved is not None:
                rolling = rolling * starved.rolling_factor
        if self.hysteresis is not None:
            lost = line_hysteresis(contact, load, mean_speed, self.hysteresis)
            rolling = lost if rolling is None else rolling + lost
        return ContactState(film, warm_film.rise, traction, rolling, jnp.max(residual), starved)

    def asperities(
        self, contact: LineContact, load: Values, film: Values, mean_speed: Values, inlet: InletOil
    ) -> Asperities:
        """Film ratio and load share of the asperities; the scene must have mixed friction. **Arguments:** `film`, m;
        others as in `evaluate`."""
        assert self.mixed is not None
        state = InletState(self.entrainment(mean_speed), inlet.viscosity, inlet.pressure_viscosity)
        return self.mixed.asperities(self.film, contact, load, film, state)

    def mixed_state(
        self,
        contact: LineContact,
        load: Values,
        state: ContactState,
        mean_speed: Values,
        sliding_speed: Values,
        inlet: InletOil,
    ) -> MixedState | None:
        """Mixed friction of the contact for the results; `None` if the scene has no mixed friction. **Arguments:**
        `state`: from `evaluate`; others as there."""
        if self.mixed is None:
            return None
        assert state.traction is not None
        asperities = self.asperities(contact, load, state.film, mean_speed, inlet)
        sliding = Sliding(sliding_speed)
        return self.mixed.state(contact, load, asperities, mean_speed, sliding, state.traction * sliding_speed)

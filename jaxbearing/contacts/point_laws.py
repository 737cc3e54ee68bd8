"""Laws of lubricated ball contacts: film, inlet heating, traction with spin, rolling resistance."""

from typing import ClassVar, NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..lubricants import InletOil, Lubricant
from ..numerics.checks import Checked, bounded
from ..numerics.safe import smooth_abs
from ..numerics.structure import choice, switch
from .distributed import DistributedTraction, Traction
from .heated_film import heated_film
from .hysteresis import point_hysteresis
from .laws import SPEED_SMOOTHING
from .mixed import Asperities, InletState, MixedFriction, MixedState, require_traction
from .oil_supply import Starvation, Supply
from .patch import contact_patch
from .point import PointContact
from .point_film import AbstractPointFilm
from .point_rolling import AbstractPointRollingResistance
from .rolling import RollingInlet
from .rolling_heating import AIHARA, HEATINGS, aihara_factor, heating_of
from .shear import Sliding
from .thermal import AbstractThermalFactor, NoThermalReduction


class PointFilm(NamedTuple):
    """Film of a ball contact and the oil at its inlet.

    - `film`: film thickness, m.
    - `temperature`: of the oil that enters the contact and of the surfaces, K.
    - `rise`: that temperature minus the bearing's inlet temperature, K; `None`: isothermal film.
    - `viscosity`: at that temperature and ambient pressure, Pa s.
    - `residual`: of the nested solves.
    - `supply`: effect of the oil supply on the contact; `None`: fully flooded.
    """

    film: Float[Array, "*batch"]
    temperature: Float[Array, "*batch"]
    rise: Float[Array, "*batch"] | None
    viscosity: Float[Array, "*batch"]
    residual: Float[Array, "*batch"]
    supply: Starvation | None = None

    @property
    def separation(self) -> Float[Array, "*batch"]:
        """Film thickness that enters the position of a ball between the rings, m (`Starvation.separation`)."""
        return self.film if self.supply is None else self.supply.separation

    @property
    def flooded(self) -> Float[Array, "*batch"]:
        """Film thickness of the fully flooded contact, m."""
        return self.film if self.supply is None else self.supply.flooded


class PointLaws(Checked):
    """Laws of the lubricated contacts between balls and races.

    **Arguments:**
    - `film`: film thickness law.
    - `thermal`: thermal reduction of the film; its rise also warms the oil in the contact.
    - `traction`: the sheared film, or `None`: frictionless, and then the balls roll without sliding.
    - `rolling`: rolling resistance, or `None`: left out.
    - `rolling_heating`: how inlet heating lowers the rolling resistance: by a factor (`"aihara"`), or by the viscosity
      at the inlet temperature that explains `thermal` (`"film_temperature"`); not given: the default of the law of
      rolling resistance where `thermal` is given, otherwise no heating.
    - `heathcote`: whether the race's curvature across rolling counts in the sliding (`Sliding.curvature`); the source's
      patch is flat.
    - `supply`: how much oil there is, or `None`: fully flooded.
    - `mixed`: mixed friction of rough surfaces, or `None`: the film carries all of the load.
    - `hysteresis`: fraction of the elastic work that the bodies lose in rolling, or `None`: left out.
    """

    part: ClassVar[str] = "contact"

    film: AbstractPointFilm
    thermal: AbstractThermalFactor = NoThermalReduction()
    traction: DistributedTraction | None = None
    rolling: AbstractPointRollingResistance | None = None
    rolling_heating: str | None = choice("contact.rolling_heating", HEATINGS, None)
    heathcote: bool = switch("contact.heathcote", False)
    supply: Supply | None = None
    mixed: MixedFriction | None = None
    hysteresis: Scalar | None = bounded("between 0 and 1", unit="1", default=None)

    def __check_init__(self):
        if self.heathcote and self.traction is None:
            raise ValueError("contact.heathcote: Heathcote slip is sliding under traction, and needs contact.traction")
        require_traction(self.part, self.mixed, self.traction)

    @property
    def resists_rolling(self) -> bool:
        """True if rolling resistance or hysteresis is modelled."""
        return self.rolling is not None or self.hysteresis is not None

    def film_state(
        self,
        contact: PointContact,
        load: Values,
        mean_speed: Values,
        sliding_speed: Values,
        lubricant: Lubricant,
        inlet: InletOil,
    ) -> PointFilm:
        """Film thickness and inlet state of the contact.

        **Arguments:** `load`, N, > 0; `mean_speed` and `sliding_speed` along rolling, m/s, of either sign.
        """
        speed = smooth_abs(mean_speed, SPEED_SMOOTHING)
        warm_film = heated_film(self.film, self.thermal, contact, load, speed, sliding_speed, lubricant, inlet)
        temperature = inlet.temperature + (
            jnp.zeros_like(warm_film.log_thickness) if warm_film.rise is None else warm_film.rise
        )
        viscosity = lubricant.viscosity.viscosity(0.0, temperature)
        film, residual, starved = jnp.exp(warm_film.log_thickness), warm_film.residual, None
        if self.supply is not None:
            starved = self.supply.starvation(contact, load, warm_film.log_thickness, speed, inlet)
            film, residual = starved.film, jnp.maximum(residual, starved.residual)
        return PointFilm(film, temperature, warm_film.rise, viscosity, residual, starved)

    def shear(
        self,
        contact: PointContact,
        load: Values,
        film: PointFilm,
        mean_speed: Values,
        sliding: Sliding,
        lubricant: Lubricant,
    ) -> Traction:
        """Traction forces of the ball on the race and the power that they dissipate."""
        assert self.traction is not None
        patch = contact_patch(contact, load)
        traction = self.traction.traction(patch, film.film, mean_speed, sliding, film.temperature, lubricant)
        if self.mixed is None:
            return traction
        share = self.asperities(contact, load, film, mean_speed, lubricant).share
        return self.mixed.traction(load, share, traction, sliding)

    def asperities(
        self, contact: PointContact, load: Values, film: PointFilm, mean_speed: Values, lubricant: Lubricant
    ) -> Asperities:
        """Film ratio and load share of the asperities in mixed friction; arguments as in `shear`."""
        assert self.mixed is not None
        coefficient = lubricant.pressure_viscosity.coefficient(film.temperature)
        state = InletState(smooth_abs(mean_speed, SPEED_SMOOTHING), film.viscosity, coefficient)
        return self.mixed.asperities(self.film, contact, load, film.film, state)

    def mixed_state(
        self,
        contact: PointContact,
        load: Values,
        film: PointFilm,
        mean_speed: Values,
        sliding: Sliding,
        sheared: Traction,
        lubricant: Lubricant,
    ) -> MixedState | None:
        """Mixed friction for the results, `None` where it is not modelled.

        **Arguments:** `sheared`: the result of `shear`; others as in `shear`.
        """
        if self.mixed is None:
            return None
        asperities = self.asperities(contact, load, film, mean_speed, lubricant)
        return self.mixed.state(contact, load, asperities, mean_speed, sliding, sheared.power)

    def rolling_moment(
        self, contact: PointContact, load: Values, film: PointFilm, mean_speed: Values, roll: Values, inlet: InletOil
    ) -> Float[Array, "..."] | None:
        r"""Moment against the roll of the ball over the race, N m (None: not modelled).

        The law holds for rolling without sliding, $\omega_rR_x = u$, and gives a modulus. For a skidding ball, which
        rolls at another rate, $x = \omega_rR_x/|u|$, it is multiplied by $\sqrt2\,x/\sqrt{1 + x^2}$, which is 1 at
        x = 1 and at most $\sqrt2$ in modulus. With the sign of x the moment always takes power; with that of u it would
        drive a ball that turns backwards. The moment of hysteresis has the sign of the roll.

        **Arguments:** `roll`, rad/s: rate of the relative roll about the axis across rolling, of the sign of the mean
        speed, m/s, in rolling without sliding.
        """
        lost = None
        if self.hysteresis is not None:
            lost = point_hysteresis(contact, load, roll, self.hysteresis)
        if self.rolling is None:
            return lost
        speed = smooth_abs(mean_speed, SPEED_SMOOTHING)
        ratio = roll * contact.reduced_radius_rolling / speed
        heated = heating_of(self.rolling, self.rolling_heating, self.thermal) == AIHARA
        viscosity = inlet.viscosity if heated else film.viscosity
        entering = RollingInlet(load, speed, viscosity, inlet.pressure_viscosity, film.flooded)
        moment = self.rolling.moment(contact, entering)
        if heated:
            moment = moment * aihara_factor(speed, inlet)
        if film.supply is not None:
            moment = moment * film.supply.rolling_factor
        moment = moment * ratio * jnp.sqrt(2.0 / (1.0 + jnp.square(ratio)))
        return moment if lost is None else moment + lost

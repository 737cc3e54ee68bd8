"""The amount of oil that reaches the raceway contacts of a bearing: the part `contact.supply` of a scene."""

from typing import Any, ClassVar, Literal, NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..lubricants import InletOil
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float
from ..numerics.safe import log_add
from ..numerics.structure import choice
from . import supply
from .line import LineContact
from .point import PointContact

LEVELS = {"jet": 100.0, "under_race": 100.0, "bath": 10.0, "grease": 1.0, "oil_air": 1.0}
"""Kind of lubrication -> median of the ratio of the gap at the inlet meniscus to the flooded central film. The standard
deviation of the logarithm of this ratio is ln 3 (a judgement from few tests)."""
GIVEN = ("meniscus_gap", "meniscus_distance", "layer", "from_flow", "gap_over_central", "level")
"""Fields of `Supply` of which exactly one must be given."""
SEPARATION_SHARE = 0.01
"""Fraction of the difference between flooded and starved film that is added to the starved film in the equations for
the position of a rolling element. A starved film is limited by the oil supply and cannot fill the clearance of an
unloaded element; the flooded film grows without bound and can."""
LARGEST_LOG = 600.0
"""Upper limit of the logarithm of gap over central film in the results: with thick layers the ratio would overflow."""


class Starvation(NamedTuple):
    """Effect of the oil supply on a contact.

    - `flooded`, `film`: thickness of the flooded film and of the film with this supply, m.
    - `separation`: film thickness in the equations for the position of a rolling element between the rings, m: `film`
      plus a hundredth of its difference to `flooded`.
    - `film_factor`, `rolling_factor`: factors of the film thickness and of the rolling resistance.
    - `gap_over_central`: gap at the inlet meniscus over the flooded central film.
    - `residual`: residual of the nested solve for the gap, in units of its logarithm.
    - `reach`: half-width over the meniscus distance; from 1 on the contact has no inlet. `None` if the distance is not
      given.
    """

    flooded: Float[Array, "*batch"]
    film: Float[Array, "*batch"]
    separation: Float[Array, "*batch"]
    film_factor: Float[Array, "*batch"]
    rolling_factor: Float[Array, "*batch"]
    gap_over_central: Float[Array, "*batch"]
    residual: Float[Array, "*batch"]
    reach: Float[Array, "*batch"] | None = None


def given_by(field: str) -> str:
    """Text that says which field of `Supply` gives the oil."""
    return f"given by contact.supply.{field}"


def _optional(bound: str, unit: str) -> Any:
    return bounded(bound, unit=unit, converter=lambda v: None if v is None else as_float(v), default=None)


class Supply(Checked):
    r"""Oil supply of the raceway contacts; without it all contacts are fully flooded.

    Exactly one of the first six arguments must be given; it says how much oil there is. The film is
    $\varphi_f\varphi_Th_{iso}$, and the rolling resistance is $\varphi_r$ times that of the flooded contact; for the
    factors see `contacts.supply`. The thermal factor $\varphi_T$ is that of the flooded film.

    **Limits:** the flooded contact at a thick layer (at 1 m within 1e-12) and at a wide gap (at 1 m within 1e-7 of the
    film and 2e-3 of the resistance, which depends on the far inlet too).
    **Validity:** the factors are fitted to line contacts with S, the gap over the flooded minimum film, from 0.3 to
    540. The supply itself is known to a factor of 3 at best. The rib of a tapered bearing and the cage stay flooded.

    **Arguments:**
    - `meniscus_gap`: gap between the surfaces at the inlet meniscus, where the oil begins to fill the gap, h_m, m.
    - `meniscus_distance`: distance of the inlet meniscus from the centre of the contact, x_m, m. A contact whose
      half-width reaches the meniscus has no inlet.
    - `layer`: sum of the oil layers on both surfaces far upstream of the contact, h_l, m. The film is never thicker.
    - `from_flow`: fraction of the oil flow of the operating point that reaches the track and forms the layer there;
      known to a factor of 10.
    - `gap_over_central`: gap at the inlet meniscus over the flooded central film, S_c, the same in every contact.
    - `level`: kind of lubrication, which gives an assumed S_c: jet and under_race 100, bath 10, grease and oil_air 1;
      one standard deviation is a factor of 3 (structure). Grease is modelled as a supply of its base oil.
    - `film_law`: law of the film factor at a meniscus distance, gap (from the gap there) or hamrock_dowson (structure).
    - `rolling_law`: law of the factor of the rolling resistance, full_solutions (our fit) or biboulet_houpert, their
      eq. (44) (structure).
    - `gap_exponent`: exponent g in the film factor of a gap.
    - `layer_exponent`: exponent gamma in the film factor of a layer; not given: 8 for lines, 3 for ellipses.
    """

    part: ClassVar[str] = "contact.supply"

    meniscus_gap: Scalar | None = _optional(">= 0", "m")
    meniscus_distance: Scalar | None = _optional("> 0", "m")
    layer: Scalar | None = _optional(">= 0", "m")
    from_flow: Scalar | None = _optional("above 0 and at most 1", "1")
    gap_over_central: Scalar | None = _optional("> 0", "1")
    level: str | None = choice("contact.supply.level", LEVELS, None)
    film_law: Literal["gap", "hamrock_dowson"] = choice("contact.supply.film_law", ("gap", "hamrock_dowson"), "gap")
    rolling_law: Literal["full_solutions", "biboulet_houpert"] = choice(
        "contact.supply.rolling_law", ("full_solutions", "biboulet_houpert"), "full_solutions"
    )
    gap_exponent: Scalar = bounded("between 0.5 and 8", unit="1", converter=as_float, default=supply.GAP_EXPONENT)
    layer_exponent: Scalar | None = _optional("between 2 and 64", "1")

    def __check_init__(self):
        super().__check_init__()
        names = [name for name in GIVEN if getattr(self, name) is not None]
        if len(names) != 1:
            listed = " and ".join(names) or "none"
            raise ValueError(f"contact.supply: expected exactly one of {', '.join(GIVEN)}, found {listed}")
        if self.film_law == "hamrock_dowson" and self.meniscus_distance is None:
            raise ValueError("contact.supply.film_law: 'hamrock_dowson' needs meniscus_distance")
        if self.layer_exponent is not None and self.layer is None and self.from_flow is None:
            raise ValueError("contact.supply.layer_exponent: only a layer, or one from_flow, has it")

    @property
    def stated(self) -> str:
        """Text that says how the supply is given, without the number."""
        field = next(name for name in GIVEN if getattr(self, name) is not None)
        if field == "level" and self.level is not None:
            gap = f"inlet gap {LEVELS[self.level]:g} times the central film"
            return f"level = '{self.level}' (assumed: {gap}; one standard deviation is a factor of 3)"
        return given_by(field)

    def starvation(
        self, contact: LineContact | PointContact, load: Values, log_flooded: Values, speed: Values, inlet: InletOil
    ) -> Starvation:
        """Effect of this supply on a contact.

        **Arguments:** `load`, N, >= 0; `log_flooded`: ln of the flooded central film, m, thermal factor included;
        `speed`: mean speed of both surfaces, m/s, > 0; `inlet`: oil at the inlet, with its `flow` if `from_flow` is
        given.
        """
        log_factor, log_gap, residual = self._factor_and_gap(contact, load, jnp.asarray(log_flooded), speed, inlet)
        flooded, factor = jnp.exp(log_flooded), jnp.exp(log_factor)
        log_minimum = log_gap - jnp.log(supply.MINIMUM_OVER_CENTRAL)
        published = self.rolling_law == "biboulet_houpert"
        rolling = supply.biboulet_houpert_rolling_factor if published else supply.starved_rolling_factor
        return Starvation(
            flooded=flooded,
            film=factor * flooded,
            separation=flooded * (factor + SEPARATION_SHARE * (1.0 - factor)),
            film_factor=factor,
            rolling_factor=rolling(log_minimum),
            gap_over_central=jnp.exp(jnp.minimum(log_gap, LARGEST_LOG)),
            residual=residual,
            reach=None if self.meniscus_distance is None else _half_width(contact, load) / self.meniscus_distance,
        )

    def _factor_and_gap(
        self, contact: LineContact | PointContact, load: Values, log_flooded: Array, speed: Values, inlet: InletOil
    ) -> tuple[Array, Array, Array]:
        """Logarithms of the film factor and of the gap over the flooded film; residual of the search for the gap."""
        exact, power = jnp.zeros_like(log_flooded), self.gap_exponent
        if self.layer is not None or self.from_flow is not None:
            layer = self._layer(contact, load, speed, inlet) - log_flooded
            own = supply.LINE_LAYER_EXPONENT if isinstance(contact, LineContact) else supply.POINT_LAYER_EXPONENT
            exponent = own if self.layer_exponent is None else self.layer_exponent
            gap = supply.log_gap_of_layer(layer, exponent, power)
            return supply.log_film_factor_of_layer(layer, exponent), gap, exact
        if self.meniscus_distance is not None:
            return self._at_distance(contact, load, log_flooded)
        if self.meniscus_gap is not None:
            gap = jnp.log(self.meniscus_gap + supply.LAYER_FLOOR) - log_flooded
        else:
            gap = exact + jnp.log(self._ratio())
        return supply.log_film_factor_of_gap(gap, power), gap, exact

    def _ratio(self) -> Scalar:
        """Gap over the flooded film from `gap_over_central` or `level`, of which one must be given."""
        if self.gap_over_central is not None:
            return self.gap_over_central
        assert self.level is not None
        return LEVELS[self.level]

    def _layer(self, contact: LineContact | PointContact, load: Values, speed: Values, inlet: InletOil) -> Array:
        """Logarithm of the layer in m, from `layer` or `from_flow`."""
        if self.layer is not None:
            return jnp.log(self.layer + supply.LAYER_FLOOR)
        assert inlet.flow is not None
        width = contact.length if isinstance(contact, LineContact) else 2.0 * contact.semi_axis_transverse(load)
        assert self.from_flow is not None
        return jnp.log(supply.layer_of_flow(self.from_flow, inlet.flow, width, speed) + supply.LAYER_FLOOR)

    def _at_distance(
        self, contact: LineContact | PointContact, load: Values, log_flooded: Array
    ) -> tuple[Array, Array, Array]:
        """Results of `_factor_and_gap` for a given `meniscus_distance`."""
        assert self.meniscus_distance is not None
        half_width = _half_width(contact, load)
        radius = contact.reduced_radius if isinstance(contact, LineContact) else contact.reduced_radius_rolling
        hertz = jnp.log(supply.hertz_gap(half_width, radius, self.meniscus_distance)) - log_flooded
        if self.film_law == "gap":
            root = supply.log_gap_at_meniscus(hertz, self.gap_exponent)
            return supply.log_film_factor_of_gap(root.value, self.gap_exponent), root.value, root.residual
        ratio = radius / jnp.square(half_width) * jnp.exp(log_flooded)
        factor = supply.hamrock_dowson_log_film_factor(self.meniscus_distance / half_width, ratio)
        return factor, log_add(factor, hertz), jnp.zeros_like(factor)


def _half_width(contact: LineContact | PointContact, load: Values) -> Array:
    """Half-width of the contact along rolling, m."""
    return contact.half_width(load) if isinstance(contact, LineContact) else contact.semi_axis_rolling(load)

r"""Mixed friction: the asperities carry a part of a contact's load and rub; the film carries the rest and is sheared.

$F = (1 - \varphi)F_{film} + \varphi Q\mu_bv/\sqrt{v^2 + v_s^2}$ with the asperities' load share $\varphi(\Lambda)$ of
`load_share` and the film ratio $\Lambda = h/\sigma$. Force and power are computed with the same sliding speed v at the
centre of the contact. Rolling resistance arises in the inlet and is not reduced.
"""

from typing import ClassVar, Literal, NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float
from ..numerics.safe import smooth_abs, smooth_sign
from ..numerics.structure import choice
from .distributed import Traction
from .film import AbstractLineFilm
from .heating import FilmHeating
from .line import LineContact
from .load_share import AbstractLoadShare, ZhouHoeprich
from .minimum_film import minimum_over_central, minimum_share, of_minimum
from .patch import contact_patch
from .point import PointContact
from .point_film import AbstractPointFilm
from .shear import Sliding

FLASH_CONSTANT = 1.11155
"""Constant of `flash_temperature` for a band-shaped heat source with Hertz's distribution, from our quadrature. For a
uniform source it is 2/sqrt(pi)."""
FLASH_SPEED = 1e-6
"""Smoothing of the surface speeds in the flash temperature, m/s."""


class InletState(NamedTuple):
    """Inputs of a film law: mean surface speed, m/s, and viscosity, Pa s, and pressure-viscosity coefficient, 1/Pa, of
    the oil in the inlet."""

    speed: Values
    viscosity: Values
    pressure_viscosity: Values


class Asperities(NamedTuple):
    """Film ratio, which is film thickness over roughness, and fraction of the load that the asperities carry."""

    film_ratio: Float[Array, "..."]
    share: Float[Array, "..."]


class MixedState(NamedTuple):
    """Mixed friction of contacts in the results: film ratio, load share, boundary force along rolling, N, power of the
    boundary friction, W, and flash temperature, K. No force depends on the flash temperature."""

    film_ratio: Float[Array, "..."]
    share: Float[Array, "..."]
    boundary: Float[Array, "..."]
    boundary_power: Float[Array, "..."]
    flash: Float[Array, "..."]


class MixedFriction(Checked):
    r"""Rough surfaces whose asperities touch through the film.

    **Limits:** without a film the share is 1, and the force is dry friction $\mu_bQ$, smoothed at low sliding speed.
    With a thick film it is the force of the film alone. Without sliding the boundary force is 0, with the slope
    $\varphi Q\mu_b/v_s$.
    **Validity:** the boundary force follows from the sliding at the centre of the contact. The boundary moment against
    spin ($3\pi/16\,\mu_b\varphi Qa$ for a circle) is neglected, and spin does not lower the force along rolling.
    $\mu_b$ does not change with the speed. The smoothing makes the force 0.5 % too small at $10v_s$ and 0.005 % at
    $100v_s$.
    **Reference:** load-sharing concept of Johnson, Greenwood and Poon (1972), Wear 19, 91.

    **Arguments:**
    - `roughness`: composite roughness of both surfaces, m: root of the sum of the squares of their root mean square
      roughness.
    - `share`: law of the load share.
    - `mu_boundary`: friction coefficient of the asperities; 0.10 to 0.15.
    - `slide_width`: sliding speed below which the boundary friction falls smoothly to 0, m/s; a run that starts from
      rest needs 1 to 10 % of the rolling speed.
    - `film`: film thickness in the film ratio, "central" or "minimum". The film of a law of the other kind is
      converted. The constants of the load shares were fitted with the central film.
    """

    part: ClassVar[str] = "contact.mixed"

    roughness: Scalar = bounded("> 0", unit="m", converter=as_float)
    share: AbstractLoadShare = ZhouHoeprich()
    mu_boundary: Scalar = bounded(">= 0", unit="1", converter=as_float, default=0.12)
    slide_width: Scalar = bounded("> 0", unit="m/s", converter=as_float, default=1e-3)
    film: Literal["central", "minimum"] = choice("contact.mixed.film", ("central", "minimum"), "central")

    def asperities(
        self,
        law: AbstractLineFilm | AbstractPointFilm,
        contact: LineContact | PointContact,
        load: Values,
        film: Values,
        inlet: InletState,
    ) -> Asperities:
        """Film ratio and load share.

        **Arguments:** `law`: film law; `load`, N, > 0; `film`: thickness from this law, with inlet heating, m, > 0.
        """
        ratio = film / self.roughness
        if self.film == "minimum":
            ratio = ratio * minimum_share(law, contact, load, *inlet)
        elif of_minimum(law):
            ratio = ratio / minimum_over_central(contact, load, *inlet)
        pressure = contact_patch(contact, load).mean_pressure
        return Asperities(jnp.asarray(ratio), self.share.share(ratio, pressure, contact.reduced_modulus))

    def boundary_force(self, load: Values, share: Values, sliding_speed: Values) -> Float[Array, "..."]:
        """Friction force of the asperities, N, with the sign of the sliding speed. **Arguments:** `load`, N; `share`:
        fraction of it that the asperities carry; `sliding_speed`, m/s."""
        return share * load * self.mu_boundary * smooth_sign(sliding_speed, self.slide_width)

    def force(self, load: Values, share: Values, film_force: Values, sliding_speed: Values) -> Float[Array, "..."]:
        """Friction force of film and asperities, N. **Arguments:** `film_force`: friction force of a film that carries
        all of the load, N; others as for `boundary_force`."""
        return (1.0 - share) * film_force + self.boundary_force(load, share, sliding_speed)

    def traction(self, load: Values, share: Values, sheared: Traction, sliding: Sliding) -> Traction:
        """Traction of film and asperities of a point contact.

        **Arguments:** `sheared`: traction of a film that carries all of the load; `sliding`: sliding of body 1 over
        body 2, as for `sheared`.
        """
        left = 1.0 - share
        along, across = self._boundary(load, share, sliding)
        return sheared._replace(
            rolling=left * sheared.rolling + along,
            transverse=left * sheared.transverse + across,
            moment=left * sheared.moment,
            power=left * sheared.power + self._power(along, across, sliding),
            curvature=None if sheared.curvature is None else left * sheared.curvature,
            by_strip=None,
        )

    def _boundary(self, load: Values, share: Values, sliding: Sliding) -> tuple[Array, Array]:
        """Boundary force along and across rolling, N. It acts in the direction of the sliding at the centre."""
        if sliding.transverse is None:
            along = self.boundary_force(load, share, sliding.rolling)
            return along, jnp.zeros_like(along)
        size = jnp.sqrt(jnp.square(sliding.rolling) + jnp.square(sliding.transverse) + jnp.square(self.slide_width))
        per_speed = share * load * self.mu_boundary / size
        return per_speed * sliding.rolling, per_speed * sliding.transverse

    def _power(self, along: Array, across: Array, sliding: Sliding) -> Array:
        power = along * sliding.rolling
        return power if sliding.transverse is None else power + across * sliding.transverse

    def state(
        self,
        contact: LineContact | PointContact,
        load: Values,
        asperities: Asperities,
        mean_speed: Values,
        sliding: Sliding,
        power: Values,
    ) -> MixedState:
        """Mixed friction of contacts for the results.

        **Arguments:** `asperities`: film ratio and load share of the contacts; `mean_speed`, m/s, signed; `sliding`:
        sliding of body 1 over body 2; `power`: friction power of film and asperities in each contact, W.
        """
        along, across = self._boundary(load, asperities.share, sliding)
        heat = flash_temperature(contact, load, power, mean_speed, sliding.rolling)
        return MixedState(*asperities, along, self._power(along, across, sliding), heat)


def require_traction(part: str, mixed: MixedFriction | None, traction: object) -> None:
    """Check of a scene: without a traction law contacts do not slide.

    **Raises:** `ValueError` for mixed friction without a traction law.
    """
    if mixed is not None and traction is None:
        raise ValueError(f"{part}.mixed: mixed friction is of contacts that slide, and needs {part}.traction")


def flash_temperature(
    contact: LineContact | PointContact,
    load: Values,
    power: Values,
    mean_speed: Values,
    sliding_speed: Values,
    heating: FilmHeating | None = None,
) -> Float[Array, "..."]:
    r"""Flash temperature: largest temperature rise of the rubbing surfaces, K.

    $\Delta T = 1.11155\,P/(\ell\sqrt{2a}\,\epsilon(\sqrt{u_1} + \sqrt{u_2}))$.

    The friction power P has Hertz's distribution, and both bodies have the same effusivity
    $\epsilon = \sqrt{k\rho c}$. A point contact is represented by its middle strip, $\ell = 4c/3$.

    The flash temperature is a result and changes no force: the boundary friction coefficient does not depend on
    temperature. It would be part of the surface temperature of a heated film (`FilmHeating`), but no scene has both:
    only bearings have asperities, and their films have the temperature of the inlet; only two-disk machines have heated
    films.

    **Limits:** the speeds count as $\sqrt{u^2 + u_\epsilon^2}$, $u_\epsilon$ = 1e-6 m/s: the rise is finite where a
    surface is at rest, but far too high.
    **Validity:** Peclet numbers $ua/(2\kappa)$ above 5.
    **Reference:** Carslaw and Jaeger, *Conduction of Heat in Solids*, ch. 10; the constant is from our quadrature.

    **Arguments:** `load`, N; `power`, W; `mean_speed` (u1 + u2)/2 and `sliding_speed` u1 - u2, m/s; `heating`: holds
    the properties of the surfaces; `None`: bearing steel.
    """
    steel = FilmHeating() if heating is None else heating
    effusivity = jnp.sqrt(steel.solid_density * steel.solid_heat_capacity * steel.solid_conductivity)
    patch = contact_patch(contact, load)
    length = (2.0 if patch.line else 4.0 / 3.0) * patch.half_length
    roots = sum(jnp.sqrt(smooth_abs(mean_speed + part * sliding_speed, FLASH_SPEED)) for part in (0.5, -0.5))
    return FLASH_CONSTANT * power / (length * jnp.sqrt(2.0 * patch.half_width) * effusivity * roots)

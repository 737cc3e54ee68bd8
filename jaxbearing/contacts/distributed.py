"""Traction of a contact under its Hertz pressure: non-Newtonian, viscoelastic, isothermal or thermal."""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..lubricants import Lubricant
from ..numerics.roots import monotone_root
from ..numerics.safe import log_add, smooth_abs
from .compliance import AbstractTangentialCompliance
from .heating import COLDEST, FilmHeating, HeatFlow, LARGEST_RISE, limited_rise
from .line import LineContact
from .patch import ContactPatch, Strips, contact_patch
from .resolution import Resolution
from .shear import Mesh, Oil, Sliding, relaxed_stress, viscous_stress
from .traction import AbstractTraction, inlet_shear
from .viscous import AbstractViscousFunction, ReeEyring

SPEED_FLOOR = 1e-6
"""Smoothing of the mean speed's modulus, m/s: at rest the oil has all the time it needs and flows as a viscous fluid."""
RISE_TOLERANCE = 1e-10
"""Newton step at which the search for a temperature ends, relative to the rise or 1 K."""


class Traction(NamedTuple):
    """What a sheared film does. Forces are those of body 1 on body 2, along the sliding of body 1 over body 2.

    `rolling`, `transverse`, N; `moment`, N m, about the normal through the centre; `power`, W, dissipated.
    `film_rise`, `surface_rise`, K: largest rises of the mean film and surface temperature above the base (None:
    isothermal); `inner_residual`, K, of the nested solves for it.
    """

    rolling: Float[Array, "*batch"]
    transverse: Float[Array, "*batch"]
    moment: Float[Array, "*batch"]
    power: Float[Array, "*batch"]
    film_rise: Float[Array, "*batch"] | None = None
    surface_rise: Float[Array, "*batch"] | None = None
    inner_residual: Float[Array, "*batch"] | None = None


class DistributedTraction(AbstractTraction):
    r"""Maxwell fluid under the local Hertz pressure, followed along strips in the rolling direction.

    $\frac{u}{G'}\frac{\partial\tau}{\partial x} + \frac{\tau_r}{\mu}F(|\tau|/\tau_r)\frac{\tau}{|\tau|} = \gamma$,
    $\tau(-a) = 0$, $\gamma_x = (\Delta U - \Delta\Omega\,y)/h$, $\gamma_y = (\Delta V + \Delta\Omega\,x)/h$; G', $\mu$,
    $\tau_r$ at the local pressure and temperature, $h/G' = h/G + L_1$. With $x = -a\cos\theta$ the pressure is smooth in
    $\theta$, and the implicit midpoint rule is of second order; each step is one scalar root.

    **Limits:** viscous flow at every point where the Deborah number $\mu u/(Ga)$ is small (`elastic=False` is that
    limit, without a march); for a large one and small sliding the slope of `elastic_slope`; odd in the
    sliding; 0 at no sliding with a finite slope.
    **Validity:** film of one thickness, Hertz pressure; rheology fits hold for 0.6 to 1.8 GPa. The discretization error
    is that of `resolution` (see its table); `error_estimate` tells it for a case.
    **Reference:** Johnson and Tevaarwerk (1977), Proc. R. Soc. A 356, 215; Houpert (1985), ASME J. Tribology 107, 241;
    source eqs. (66)-(72). The source's stress is on body 2, as here; its eq. (69) has another transverse axis.

    **Arguments:**
    - `viscous`: the viscous function that the rheology's stress belongs to.
    - `resolution`: steps and strips.
    - `compliance`: tangential compliance of the bodies, or `None`: rigid.
    - `heating`: `None`: isothermal.
    - `elastic`: whether the oil's shear modulus counts.
    """

    viscous: AbstractViscousFunction = ReeEyring()
    resolution: Resolution = eqx.field(static=True, default=Resolution.for_accuracy(1e-3))
    compliance: AbstractTangentialCompliance | None = None
    heating: FilmHeating | None = None
    elastic: bool = eqx.field(static=True, default=True)

    def force(
        self,
        contact: LineContact,
        load: Values,
        film: Values,
        entrainment_speed: Values,
        sliding_speed: Values,
        temperature: Values,
        lubricant: Lubricant,
        viscosity_inlet: Values,
    ) -> Float[Array, "..."]:
        patch = contact_patch(contact, load)
        pressed = self.traction(patch, film, entrainment_speed, Sliding(sliding_speed), temperature, lubricant).rolling
        return pressed + inlet_shear(contact, film, sliding_speed, viscosity_inlet)

    def traction(
        self,
        patch: ContactPatch,
        film: Values,
        entrainment_speed: Values,
        sliding: Sliding,
        temperature: Values,
        lubricant: Lubricant,
    ) -> Traction:
        """Forces, moment, power and temperatures of one film (the inlet's shear is not in it).

        **Arguments:** `film`, m, > 0; `entrainment_speed`, m/s, of either sign; `temperature`: base, of the oil that
        enters and of the surfaces, K. All broadcast against each other and the fields of `patch`.

        **Raises:** `ValueError` where the lubricant lacks a law that is needed.
        """
        fine, coarse = self._fine_and_coarse(patch, film, entrainment_speed, sliding, temperature, lubricant)
        if coarse is None:
            return fine
        better = [a + (a - b) / 3.0 for a, b in zip(fine[:4], coarse[:4], strict=True)]
        return Traction(*better, *fine[4:])

    def _fine_and_coarse(
        self,
        patch: ContactPatch,
        film: Values,
        entrainment_speed: Values,
        sliding: Sliding,
        temperature: Values,
        lubricant: Lubricant,
    ) -> tuple[Traction, Traction | None]:
        if lubricant.rheology is None:
            raise ValueError(
                "The traction law needs the lubricant's rheology (shear modulus and stress): none is given."
            )
        problem = _problem(self, patch, film, entrainment_speed, sliding, temperature, lubricant)
        fine = problem.solved(self.resolution.steps)
        if not self.resolution.extrapolate:
            return fine, None
        return fine, problem.solved(self.resolution.steps // 2)


class _Problem(eqx.Module):
    """One film on its strips: arrays of shape (*batch, strip)."""

    law: DistributedTraction
    lubricant: Lubricant
    film: Array
    temperature: Array
    pressure: Array
    """Highest of the strip."""
    half_width: Array
    speed: Array
    strips: Strips
    log_compliance: Array | None
    """ln(L1/h)."""
    direction: Array
    """Sign of the mean speed; the problem is turned until it is 1."""
    rate: Array
    """Shear rate where x = 0, 1/s; the first axis holds the components."""
    rate_slope: Array
    """Its change over one half-width."""

    def solved(self, steps: int) -> Traction:
        mesh = Mesh.of(steps)
        if self.law.heating is not None:
            return self._thermal(mesh)
        oil = jax.vmap(lambda sine: self.oil(sine, 0.0))(jnp.asarray(mesh.sine))
        if self.law.elastic:
            return self._march(mesh, oil)
        return self._viscous(mesh, oil)

    def oil(self, sine: Array, rise: Values) -> Oil:
        """At the relative pressure `sine` of each strip, `rise` K above the base."""
        pressure = sine * self.pressure
        temperature = self.temperature + rise
        rheology = self.lubricant.rheology
        assert rheology is not None
        log_modulus = rheology.log_shear_modulus(pressure, temperature)
        if self.log_compliance is not None:
            log_modulus = log_modulus - log_add(log_modulus + self.log_compliance, 0.0)
        log_viscosity = self.lubricant.viscosity.log_viscosity(pressure, temperature)
        fields = (log_modulus, log_viscosity, rheology.log_stress(pressure, temperature))
        return Oil(*(jnp.broadcast_to(field, self.half_width.shape) for field in fields))

    def half_step(self, mesh: Mesh) -> Array:
        """Half a step of time per sin(theta), s."""
        return 0.5 * mesh.step * self.half_width / self.speed

    def middle(self, half_step: Array, stress: Array, rate: Array, oil: Oil) -> Array:
        """Stress at the middle of a step."""
        if self.law.elastic:
            return relaxed_stress(self.law.viscous, oil, half_step, stress, rate)
        return viscous_stress(self.law.viscous, oil, rate)

    def _viscous(self, mesh: Mesh, oil: Oil) -> Traction:
        column = lambda values: jnp.reshape(values, (-1,) + (1,) * self.half_width.ndim)
        sine, position = column(mesh.sine), column(mesh.position)
        rate = self.rate[:, None] + self.rate_slope[:, None] * position
        stress = viscous_stress(self.law.viscous, oil, rate)
        sums = _Sums.zero(self).plus(stress, rate, mesh.step * sine, position)
        return self.assembled(_Sums(*(None if s is None else jnp.sum(s, axis=0) for s in sums)))

    def _march(self, mesh: Mesh, oil: Oil) -> Traction:
        half_step = self.half_step(mesh)

        def advance(carry, row):
            stress, sums = carry
            sine, position, oil = row
            rate = self.rate + self.rate_slope * position
            middle = self.middle(half_step * sine, stress, rate, oil)
            return (2.0 * middle - stress, sums.plus(middle, rate, mesh.step * sine, position)), None

        rows = (jnp.asarray(mesh.sine), jnp.asarray(mesh.position), oil)
        (_, sums), _ = jax.lax.scan(advance, (jnp.zeros_like(self.rate), _Sums.zero(self)), rows)
        return self.assembled(sums)

    def _thermal(self, mesh: Mesh) -> Traction:
        heating, conductivity = self.law.heating, self.conductivity()
        flow = HeatFlow(heating, len(mesh.sine), self.half_width, self.film, self.speed, conductivity)
        half_step = self.half_step(mesh)

        def source(rise, args):
            problem, stress, rate, sine, half = args
            oil = problem.oil(sine, rise)
            middle = problem.middle(half * sine, stress, rate, oil)
            return jnp.sum(middle * rate, axis=0), middle

        def excess(rise, args):
            heat, *args = args
            return rise - limited_rise(heat.base + heat.slope * source(rise, args)[0])

        def advance(carry, row):
            stress, sums, flux, entering, guess = carry
            index, sine, position, history, own, width = row
            before = flow.surface_rise * jnp.tensordot(history, flux, axes=1)
            heat = flow.step(own, width, before, entering)
            rate = self.rate + self.rate_slope * position
            args = (self, stress, rate, sine, half_step)
            root = monotone_root(
                excess, (heat, *args), COLDEST, LARGEST_RISE, guess, tolerance=RISE_TOLERANCE
            )
            middle = source(root.value, args)[1]
            surface, into = flow.surface(own, before, root.value)
            flux = jax.lax.dynamic_update_index_in_dim(flux, into, index, 0)
            sums = sums.plus(middle, rate, mesh.step * sine, position)
            carry = (2.0 * middle - stress, sums, flux, flow.leaving(width, entering, root.value), root.value)
            return carry, (root.value, surface, root.residual)

        shape, steps = self.half_width.shape, len(mesh.sine)
        zeros = jnp.zeros(shape)
        start = (jnp.zeros_like(self.rate), _Sums.zero(self), jnp.zeros((steps, *shape)), zeros, zeros)
        rows = (jnp.arange(steps), mesh.sine, mesh.position, flow.history, flow.own, flow.widths)
        (_, sums, *_), (film, surface, residual) = jax.lax.scan(advance, start, jax.tree.map(jnp.asarray, rows))
        largest = lambda field: jnp.max(field, axis=(0, -1))
        return self.assembled(sums)._replace(
            film_rise=largest(film), surface_rise=largest(surface), inner_residual=largest(residual)
        )

    def conductivity(self) -> Array:
        """Of the oil, W/(m K)."""
        heating = self.law.heating
        if heating is not None and heating.conductivity is not None:
            return jnp.asarray(heating.conductivity)
        if self.lubricant.conductivity is None:
            raise ValueError("The film's heating needs the lubricant's conductivity: none is given.")
        return self.lubricant.conductivity.conductivity(self.temperature)

    def assembled(self, sums: "_Sums") -> Traction:
        weight = self.half_width * self.strips.width
        total = lambda values: jnp.sum(values * weight, axis=-1)
        sign = self.direction[..., 0]
        rolling, power = total(sums.rolling), total(sums.power * self.film)
        transverse = moment = jnp.zeros_like(rolling)
        if sums.transverse is not None:
            transverse = total(sums.transverse)
            moment = total(sums.moment * self.half_width - sums.rolling * self.strips.offset)
        return Traction(sign * rolling, sign * transverse, moment, power)


class _Sums(NamedTuple):
    """Integrals over x/a on each strip of stress, stress times rate, and x/a times transverse stress."""

    rolling: Array
    power: Array
    transverse: Array | None
    moment: Array | None

    @classmethod
    def zero(cls, problem: _Problem) -> "_Sums":
        zeros = jnp.zeros(problem.half_width.shape)
        more = None if problem.rate.shape[0] == 1 else zeros
        return cls(zeros, zeros, more, more)

    def plus(self, stress: Array, rate: Array, weight: Array, position: Array) -> "_Sums":
        power = self.power + weight * jnp.sum(stress * rate, axis=0)
        rolling = self.rolling + weight * stress[0]
        if self.transverse is None:
            return _Sums(rolling, power, None, None)
        transverse = weight * stress[1]
        return _Sums(rolling, power, self.transverse + transverse, self.moment + position * transverse)


def _problem(
    law: DistributedTraction,
    patch: ContactPatch,
    film: Values,
    entrainment_speed: Values,
    sliding: Sliding,
    temperature: Values,
    lubricant: Lubricant,
) -> _Problem:
    leaves = jax.tree.leaves((patch, film, entrainment_speed, sliding, temperature))
    batch = jnp.broadcast_shapes(*(jnp.shape(leaf) for leaf in leaves))
    column = lambda value: jnp.broadcast_to(jnp.asarray(value, dtype=float), batch)[..., None]
    strips = patch.strips(law.resolution.strips, symmetric=sliding.spin is None)
    film, speed = column(film), column(entrainment_speed)
    half_width = column(patch.half_width) * strips.scale
    direction = jnp.where(speed >= 0, 1.0, -1.0)
    log_compliance = None
    if law.compliance is not None:
        log_compliance = jnp.log(column(law.compliance.compliance(patch))) - jnp.log(film)

    in_strips = lambda value: jnp.broadcast_to(value, half_width.shape)
    spin = 0.0 if sliding.spin is None else column(sliding.spin)
    rate = [in_strips((direction * column(sliding.rolling) - spin * strips.offset) / film)]
    slope = [jnp.zeros(half_width.shape)]
    if not sliding.plane:
        transverse = 0.0 if sliding.transverse is None else direction * column(sliding.transverse)
        rate.append(in_strips(transverse / film))
        slope.append(in_strips(spin * half_width / film))
    return _Problem(
        law=law,
        lubricant=lubricant,
        film=film,
        temperature=column(temperature),
        pressure=column(patch.pressure) * strips.scale,
        half_width=half_width,
        speed=smooth_abs(speed, SPEED_FLOOR),
        strips=strips,
        log_compliance=log_compliance,
        direction=direction,
        rate=jnp.stack(rate),
        rate_slope=jnp.stack(slope),
    )

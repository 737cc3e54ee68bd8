"""Traction of a contact with a film under the local Hertz pressure. The oil is non-Newtonian and viscoelastic, and the
film is isothermal or heated by its shear."""

import dataclasses
import functools
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Values
from ..lubricants import Lubricant
from ..numerics.compiling import compiled_by_hand
from ..numerics.peak import peak
from ..numerics.roots import monotone_root
from ..numerics.safe import smooth_abs
from ..numerics.structure import switch
from .compliance import AbstractTangentialCompliance
from .heating import COLDEST, LARGEST_RISE, FilmHeating, HeatFlow, limited_rise
from .line import LineContact
from .patch import ContactPatch, Strips, contact_patch
from .resolution import Resolution
from .shear import Maxwell, Mesh, Oil, Sliding, relaxed_stress, viscous_stress
from .traction import AbstractTraction, inlet_shear
from .viscous import AbstractViscousFunction, viscous_function_for, viscous_notes

SPEED_FLOOR = 1e-6
"""Speed with which the absolute value of the mean speed is smoothed near 0, m/s. At rest the oil has unlimited time to
relax and flows as a viscous fluid."""
UNCERTAIN_SHARE = 0.1
"""Safety margin of `error_estimate`: this fraction of the absolute value of each part is added to the estimate."""
RISE_TOLERANCE = 1e-10
"""Length of the Newton step at which the search for a temperature rise ends, relative to the rise or to 1 K, whichever
is larger."""


class StripPower(NamedTuple):
    """Dissipated power of the strips of a contact. The strips run along rolling and are ordered across it.

    - `power`: power of each strip, W. The sum is the power of the contact: if only one half of the contact is computed,
      each strip also holds the power of its mirror image.
    - `offset`: distance from the middle across rolling, m; `width`: width of the strip, m.
    """

    power: Float[Array, "*batch strip"]
    offset: Float[Array, "*#batch strip"]
    width: Float[Array, "*#batch strip"]


class Traction(NamedTuple):
    """Traction of a sheared film. Forces are those of body 1 on body 2, along the sliding of body 1 over body 2.

    - `rolling`, `transverse`: forces, N; `moment`: about the normal through the centre, N m; `power`: dissipation, W.
    - `film_rise`, `surface_rise`: largest rise of the mean film temperature and of the surface temperature above the
      base, K; with 40 steps they are too low by at most 0.2 and 0.4 %. `None` if isothermal.
    - `inner_residual`: residual of the nested solves for the temperature, K.
    - `curvature`: integral of the rolling stress times y^2, N m^2, where y is the distance of a strip from the middle;
      `None` if the sliding has no part that varies with y^2 (`Sliding.curvature`).
    - `by_strip`: power of each strip; `None` if it is not known.
    """

    rolling: Float[Array, "*batch"]
    transverse: Float[Array, "*batch"]
    moment: Float[Array, "*batch"]
    power: Float[Array, "*batch"]
    film_rise: Float[Array, "*batch"] | None = None
    surface_rise: Float[Array, "*batch"] | None = None
    inner_residual: Float[Array, "*batch"] | None = None
    curvature: Float[Array, "*batch"] | None = None
    by_strip: StripPower | None = None

    def coefficient(self, load: Values) -> Float[Array, "*batch"]:
        """Traction coefficient along rolling. **Arguments:** `load`: load of the contact, N, > 0."""
        return self.rolling / load


class DistributedTraction(AbstractTraction):
    r"""Maxwell fluid under the local Hertz pressure, followed along strips in the rolling direction.

    $\frac{u}{G'}\frac{\partial\tau}{\partial x} + \frac{\tau_r}{\mu}F(|\tau|/\tau_r)\frac{\tau}{|\tau|} = \gamma$,
    $\tau(-a) = 0$, $\gamma_x = (\Delta U - \Delta\Omega\,y - c\,y^2)/h$, $\gamma_y = (\Delta V + \Delta\Omega\,x)/h$
    with c for a curved contact (`Sliding.curvature`). u is the mean speed, h the film thickness, a the half-width,
    $\mu$ the viscosity, G the shear modulus, $\tau_r$ the characteristic stress and F the viscous function. $\Delta U$
    and $\Delta V$ are the sliding speeds along and across rolling, and $\Delta\Omega$ is the spin. G, $\mu$ and
    $\tau_r$ are those at the local pressure and temperature. The compliance $L_1$ of the bodies reduces the modulus to
    G', with $h/G' = h/G + L_1$. With $x = -a\cos\theta$ the pressure is smooth in $\theta$, and the implicit midpoint
    rule is of second order. Each step solves one scalar equation.

    **Limits:** Where the Deborah number $\mu u/(Ga)$ is small, the flow is viscous at every point. With `elastic=False`
    this limit is computed, without integration of the stress along x. Where the number is large and the sliding is
    small, the slope of the traction is that of `elastic_slope`. The traction is odd in the sliding, and it is 0 without
    sliding, with a finite slope.
    **Validity:** film of one thickness, Hertz pressure; rheology fits hold for 0.6 to 1.8 GPa. The discretization error
    is that of `resolution` (see its table); `error_estimate` estimates it for a given case.
    **Reference:** Johnson and Tevaarwerk (1977), Proc. R. Soc. A 356, 215; Houpert (1985), ASME J. Tribology 107, 241;
    source eqs. (66)-(72). The source's stress is on body 2, as here; its eq. (69) has another transverse axis.

    **Arguments:**
    - `viscous`: the viscous function F. `None` stands for the function with which the rheology of the oil was fitted,
      or for that of Ree and Eyring if the oil does not name one.
    - `resolution`: numbers of steps and strips.
    - `compliance`: tangential compliance of the bodies; `None` if they are rigid.
    - `heating`: heating of the film by its shear; `None` for an isothermal film.
    - `elastic`: True to include the shear modulus of the oil, False for a purely viscous oil.
    """

    viscous: AbstractViscousFunction | None = None
    resolution: Resolution = eqx.field(static=True, default=Resolution.for_accuracy(1e-3))
    compliance: AbstractTangentialCompliance | None = None
    heating: FilmHeating | None = None
    elastic: bool = switch("elastic", True)

    def __check_init__(self):
        if not isinstance(self.resolution, Resolution):
            raise ValueError(f"resolution must be a Resolution, got {self.resolution!r}")

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

    def notes(self, lubricant: Lubricant) -> tuple[str, ...]:
        return viscous_notes(self.viscous, lubricant)

    @compiled_by_hand
    def traction(
        self,
        patch: ContactPatch,
        film: Values,
        entrainment_speed: Values,
        sliding: Sliding,
        temperature: Values,
        lubricant: Lubricant,
    ) -> Traction:
        """Forces, moment, power and temperatures of one film, without the shear in the inlet.

        **Arguments:** `film`, m, > 0; `entrainment_speed`, m/s, of either sign; `temperature`: base temperature of the
        entering oil and of the surfaces, K. All broadcast against each other and the fields of `patch`.

        **Raises:** `ValueError` where the lubricant lacks a law that is needed.
        """
        problem = _problem(self, patch, film, entrainment_speed, sliding, temperature, lubricant)
        return problem.solved(self.resolution.steps, self.resolution.extrapolate)

    def error_estimate(
        self,
        patch: ContactPatch,
        film: Values,
        entrainment_speed: Values,
        sliding: Sliding,
        temperature: Values,
        lubricant: Lubricant,
    ) -> Traction:
        """Discretization error of each field of `traction` at the same arguments, >= 0, in the unit of the field.

        The error of the steps is the change with twice as many steps, times 4/3 (16/15 with `extrapolate`), the factor
        for an error of order 2 (4). The error of the strips is the change with twice as many strips. The estimate is
        the absolute value of their sum, plus a tenth of their absolute values, because neither is exact. It is within a
        factor of about 3 of the true error, unless the true error is small by chance. It costs four more tractions (two
        for a line contact without spin) and does not include errors of the model. `inner_residual` is the largest one
        of all runs.
        """
        arguments = (patch, film, entrainment_speed, sliding, temperature, lubricant)
        steps, strips, extrapolate = dataclasses.astuple(self.resolution)

        def run(*resolution):
            law = dataclasses.replace(self, resolution=Resolution(*resolution))
            return law.traction(*arguments)._replace(by_strip=None)

        coarse = run(steps, strips, extrapolate)
        finer, shares = [run(2 * steps, strips, extrapolate)], [16.0 / 15.0 if extrapolate else 4.0 / 3.0]
        if not (patch.line and sliding.alike):
            finer.append(run(steps, 2 * strips, extrapolate))
            shares.append(1.0)

        def error(value, *others):
            parts = jnp.stack([share * (value - other) for share, other in zip(shares, others, strict=True)])
            return jnp.abs(jnp.sum(parts, axis=0)) + UNCERTAIN_SHARE * jnp.sum(jnp.abs(parts), axis=0)

        errors = jax.tree.map(error, coarse, *finer)
        residuals = [each.inner_residual for each in (coarse, *finer) if each.inner_residual is not None]
        return errors._replace(inner_residual=functools.reduce(jnp.maximum, residuals) if residuals else None)


class _Problem(eqx.Module):
    """One film, cut into strips. The arrays have the shape (*batch, strip)."""

    law: DistributedTraction
    viscous: AbstractViscousFunction
    lubricant: Lubricant
    film: Array
    temperature: Array
    pressure: Array
    """Highest pressure on each strip, Pa."""
    half_width: Array
    speed: Array
    strips: Strips
    compliance: Array | None
    """Tangential compliance of the bodies over the film thickness, L1/h, 1/Pa."""
    direction: Array
    """Sign of the mean speed; the problem is turned so that the mean speed becomes positive."""
    rate: Array
    """Shear rate where x = 0, 1/s; the first axis runs over the components (rolling, transverse)."""
    rate_slope: Array | None
    """Change of the shear rate, caused by spin, between x = 0 and x = a, 1/s."""
    half: bool = eqx.field(static=True)
    """True if the strips cover one half of the contact; the other half is its mirror image."""
    curved: bool = eqx.field(static=True)
    """True if the sliding changes with the square of the distance from the middle."""

    def solved(self, steps: int, extrapolate: bool) -> Traction:
        heating = self.law.heating
        if heating is None:
            return self._isothermal(Mesh.extrapolated(steps) if extrapolate else Mesh.of(steps))
        fine = self._thermal(Mesh.of(steps), heating)
        if not extrapolate:
            return fine
        coarse = self._thermal(Mesh.of(steps // 2), heating)
        better = lambda a, b: a + (a - b) / 3.0
        names = ("rolling", "transverse", "moment", "power", "curvature", "by_strip")
        both = ({name: getattr(traction, name) for name in names} for traction in (fine, coarse))
        return fine._replace(**jax.tree.map(better, *both))

    def oil(self, sine: Array, rise: Values) -> Oil:
        """Oil properties at the relative pressure `sine` of each strip, at a temperature `rise` K above the base."""
        pressure = sine * self.pressure
        temperature = self.temperature + rise
        rheology = self.lubricant.rheology
        assert rheology is not None
        log_modulus = rheology.log_shear_modulus(pressure, temperature)
        if self.compliance is not None:
            log_modulus = log_modulus - jnp.log1p(jnp.exp(log_modulus) * self.compliance)
        log_viscosity = self.lubricant.viscosity.log_viscosity(pressure, temperature)
        fields = (log_modulus, log_viscosity, rheology.log_stress(pressure, temperature))
        return Oil(*(jnp.broadcast_to(field, self.half_width.shape) for field in fields))

    def half_step(self, step: Values) -> Array:
        """Half of the time step, divided by sin(theta), s."""
        return 0.5 * step * self.half_width / self.speed

    def middle(self, half_step: Array, stress: Array, rate: Array, oil: Oil) -> Array:
        """Stress at the middle of a step."""
        if self.law.elastic:
            return relaxed_stress(self.viscous, Maxwell.of(oil), half_step, stress, rate)
        return viscous_stress(self.viscous, oil, rate)

    def _isothermal(self, mesh: Mesh) -> Traction:
        elastic = self.law.elastic
        oils = jax.vmap(lambda sine: self.oil(sine, 0.0))(jnp.asarray(mesh.sines))
        oils = Maxwell.of(oils) if elastic else oils
        time = self.half_width / self.speed

        def advance(carry, row):
            stress, sums = carry
            # `going`: 0 where the march begins anew, otherwise 1; `place`: index of the oil of this step in `oils`
            step, weight, sine, position, going, place = row
            oil = jax.tree.map(lambda field: jax.lax.dynamic_index_in_dim(field, place, keepdims=False), oils)
            rate = self.rate_at(position)
            if elastic:
                stress = going * stress
                middle = relaxed_stress(self.viscous, oil, (0.5 * step * sine) * time, stress, rate)
                stress = 2.0 * middle - stress
            else:
                middle = viscous_stress(self.viscous, oil, rate)
            return (stress, sums.plus(middle, rate, weight * sine, position)), None

        rows = jax.tree.map(jnp.asarray, tuple(mesh[:-1]))
        (_, sums), _ = jax.lax.scan(advance, (jnp.zeros_like(self.rate), _Sums.zero(self)), rows)
        return self.assembled(sums)

    def rate_at(self, position: Array) -> Array:
        """Shear rate at the relative position x/a, 1/s."""
        return self.rate if self.rate_slope is None else self.rate + self.rate_slope * position

    def _thermal(self, mesh: Mesh, heating: FilmHeating) -> Traction:
        conductivity = self.conductivity(heating)
        flow = HeatFlow(heating, len(mesh.sine), self.half_width, self.film, self.speed, conductivity)
        half_step = self.half_step(mesh.step[0])

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
            rate = self.rate_at(position)
            args = (self, stress, rate, sine, half_step)
            root = monotone_root(excess, (heat, *args), COLDEST, LARGEST_RISE, guess, tolerance=RISE_TOLERANCE)
            middle = source(root.value, args)[1]
            surface, into = flow.surface(own, before, root.value)
            flux = jax.lax.dynamic_update_index_in_dim(flux, into, index, 0)
            sums = sums.plus(middle, rate, mesh.weight[0] * sine, position)
            carry = (2.0 * middle - stress, sums, flux, flow.leaving(width, entering, root.value), root.value)
            return carry, (root.value, surface, root.residual)

        shape, steps = self.half_width.shape, len(mesh.sine)
        zeros = jnp.zeros(shape)
        start = (jnp.zeros_like(self.rate), _Sums.zero(self), jnp.zeros((steps, *shape)), zeros, zeros)
        rows = (jnp.arange(steps), mesh.sine, mesh.position, flow.history, flow.own, flow.widths)
        (_, sums, *_), (film, surface, residual) = jax.lax.scan(advance, start, jax.tree.map(jnp.asarray, rows))
        return self.assembled(sums)._replace(
            film_rise=self.highest(film), surface_rise=self.highest(surface), inner_residual=jnp.max(residual, (0, -1))
        )

    def highest(self, field: Float[Array, "step ... strip"]) -> Array:
        """Peak over the contact of a field that is given at the middle of each step on each strip."""
        offset, strips = self.strips.offset, peak(np.arange(float(len(field))), jnp.moveaxis(field, 0, -1))
        if self.half:  # the first strip is at the centre; the second has a mirror image on the other side
            offset, strips = (jnp.append(s * v[..., 1:2], v, axis=-1) for s, v in ((-1.0, offset), (1.0, strips)))
        return peak(offset, strips)

    def conductivity(self, heating: FilmHeating) -> Array:
        """Thermal conductivity of the oil, W/(m K)."""
        if heating.conductivity is not None:
            return jnp.asarray(heating.conductivity)
        if self.lubricant.conductivity is None:
            raise ValueError("The film's heating needs the lubricant's conductivity: none is given.")
        return self.lubricant.conductivity.conductivity(self.temperature)

    def assembled(self, sums: "_Sums") -> Traction:
        weight = self.half_width * self.strips.width
        total = lambda values: jnp.sum(values * weight, axis=-1)
        sign = self.direction[..., 0]
        by_strip = StripPower(sums.power * self.film * weight, self.strips.offset, self.strips.width)
        rolling, power = total(sums.rolling), jnp.sum(by_strip.power, axis=-1)
        transverse = moment = jnp.zeros_like(rolling)
        if sums.transverse is not None and sums.moment is not None:
            transverse = total(sums.transverse)
            moment = total(sums.moment * self.half_width - sums.rolling * self.strips.offset)
        curvature = sign * total(sums.rolling * jnp.square(self.strips.offset)) if self.curved else None
        return Traction(sign * rolling, sign * transverse, moment, power, curvature=curvature, by_strip=by_strip)


class _Sums(NamedTuple):
    """Integrals over x/a on each strip: `rolling` and `transverse` of the stress components, `power` of stress times
    shear rate, and `moment` of x/a times the transverse stress."""

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
        if self.transverse is None or self.moment is None:
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
    patch = jax.tree.map(lambda field: column(field)[..., 0], patch)
    if lubricant.rheology is None:
        raise ValueError("The traction law needs the lubricant's rheology (shear modulus and stress): none is given.")
    # in a line contact with the same sliding at every strip, a single strip represents all of them
    symmetric = sliding.alike if patch.line else sliding.spin is None
    # the hottest point is usually at the centre, where no strip lies if their number is even
    strips = patch.strips(law.resolution.strips, symmetric, middle=law.heating is not None)
    film, speed = column(film), column(entrainment_speed)
    half_width = column(patch.half_width) * strips.scale
    direction = jnp.where(speed >= 0, 1.0, -1.0)
    compliance = None if law.compliance is None else column(law.compliance.compliance(patch)) / film

    in_strips = lambda value: jnp.broadcast_to(value, half_width.shape)
    spin = 0.0 if sliding.spin is None else column(sliding.spin)
    along = direction * column(sliding.rolling) - spin * strips.offset
    if sliding.curvature is not None:
        along = along - direction * column(sliding.curvature) * jnp.square(strips.offset)
    rate = [in_strips(along / film)]
    if not sliding.plane:
        transverse = 0.0 if sliding.transverse is None else direction * column(sliding.transverse)
        rate.append(in_strips(transverse / film))
    slope = None
    if sliding.spin is not None:
        slope = jnp.stack([jnp.zeros(half_width.shape), in_strips(spin * half_width / film)])
    return _Problem(
        law=law,
        viscous=viscous_function_for(law.viscous, lubricant),
        lubricant=lubricant,
        film=film,
        temperature=column(temperature),
        pressure=in_strips(column(patch.pressure) * strips.scale),
        half_width=half_width,
        speed=smooth_abs(speed, SPEED_FLOOR),
        strips=strips,
        compliance=compliance,
        direction=direction,
        rate=jnp.stack(rate),
        rate_slope=slope,
        half=symmetric and not patch.line,
        curved=sliding.curvature is not None,
    )

"""The two-disk machine: two bodies that roll and slide on each other under load, and the traction between them."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._scene import AbstractScene, label, number, optional_number
from .._types import Scalar, Values
from ..contacts import (
    AbstractLineFilm,
    AbstractPointFilm,
    AbstractThermalFactor,
    ContactPatch,
    DistributedTraction,
    LineContact,
    NoThermalReduction,
    PointContact,
    Sliding,
    Traction,
    contact_patch,
    deborah_number,
    inlet_temperature_rise,
)
from ..lubricants import Lubricant
from ..materials import Material, reduced_modulus
from ..numerics.checks import require
from ..numerics.precision import as_float
from ..numerics.status import SolveError, Status

INNER_TOLERANCE = 1e-6
"""Largest residual of a nested solve: ln(film) of the inlet's rise, K of the film's."""


class DiskGeometry(eqx.Module):
    """Reduced radii of the contact, m: 1/R = 1/R1 + 1/R2, convex > 0. A ball on a flat disc has its own radius twice.

    **Arguments:**
    - `reduced_radius_rolling`: in the plane of rolling.
    - `reduced_radius_transverse`: across; not given: as along rolling, a circular contact.
    - `contact_length`: of a line contact between cylinders; then there is no transverse radius.
    """

    reduced_radius_rolling: Scalar = number()
    reduced_radius_transverse: Scalar | None = optional_number()
    contact_length: Scalar | None = optional_number()

    def __check_init__(self):
        require(
            "geometry",
            reduced_radius_rolling=(self.reduced_radius_rolling, "> 0"),
            reduced_radius_transverse=(self.reduced_radius_transverse, "> 0"),
            contact_length=(self.contact_length, "> 0"),
        )
        if self.contact_length is not None and self.reduced_radius_transverse is not None:
            raise ValueError("geometry.contact_length: a line contact has no geometry.reduced_radius_transverse")

    def contact(self, modulus: Values) -> LineContact | PointContact:
        """**Arguments:** `modulus`: reduced modulus E', Pa."""
        along = self.reduced_radius_rolling
        if self.contact_length is not None:
            return LineContact(along, self.contact_length, modulus)
        across = along if self.reduced_radius_transverse is None else self.reduced_radius_transverse
        return PointContact(along, across, modulus)


class TwoDiskLaws(eqx.Module):
    """Laws of the contact.

    **Arguments:**
    - `film`: film thickness law, of a point or a line contact as the geometry says.
    - `thermal`: thermal reduction of the film; its inlet rise also warms the oil in the contact.
    - `traction`: the sheared film.
    - `warm_inlet`: whether the oil enters the contact, and the surfaces are, warmer by the inlet rise; else at the
      oil's temperature, and the thermal factor thins the film only.
    """

    film: AbstractPointFilm | AbstractLineFilm
    traction: DistributedTraction
    thermal: AbstractThermalFactor = NoThermalReduction()
    warm_inlet: bool = eqx.field(static=True, default=True)


def _axis(unit: str, description: str) -> Any:
    """A list of numbers, one dimension of the family of curves; None where it is not given."""
    convert = lambda v: None if v is None else as_float(np.atleast_1d(v) if isinstance(v, list | tuple | float | int) else v)
    return eqx.field(converter=convert, default=None, metadata=label(unit, description))


class DiskOperation(eqx.Module):
    """The family of traction curves: each curve over all slide-to-roll ratios, one for each combination of the others.

    **Arguments:** one-dimensional arrays;
    - `slide_to_roll`: (u1 - u2)/entrainment speed, signed.
    - `pressure`: Hertz (peak) pressures, Pa, or `load`: N; one of the two.
    - `entrainment_speed`: (u1 + u2)/2, m/s, > 0.
    - `temperature`: of the oil that is fed, K.
    """

    slide_to_roll: Float[Array, " slide"] = _axis("1", "slide-to-roll ratio, difference over mean speed")
    entrainment_speed: Float[Array, " speed"] = _axis("m/s", "mean surface speed")
    temperature: Float[Array, " temperature"] = _axis("K", "oil temperature")
    pressure: Float[Array, " load"] | None = _axis("Pa", "Hertz (peak) pressure")
    load: Float[Array, " load"] | None = _axis("N", "normal load")

    def __check_init__(self):
        if (self.pressure is None) == (self.load is None):
            found = "neither" if self.pressure is None else "both"
            raise ValueError(f"operation.pressure: found {found} of pressure and load, expected one of the two")


class DiskState(NamedTuple):
    """One point, or many: everything before the oil's rheology is asked. Shapes broadcast."""

    patch: ContactPatch
    load: Float[Array, "*batch"]
    film: Float[Array, "*batch"]
    entrainment_speed: Float[Array, "*batch"]
    sliding_speed: Float[Array, "*batch"]
    temperature: Float[Array, "*batch"]
    """Of the oil that enters the contact, K."""
    inner_residual: Float[Array, "*batch"]


class TwoDiskSolution(eqx.Module):
    """Traction curves. Axes: temperature, speed, load, slide. What a failed point gives is NaN."""

    status: Int[Array, "temperature speed load slide"]
    operation: DiskOperation
    pressure: Float[Array, " load"] = eqx.field(metadata=label("Pa", "Hertz (peak) pressure"))
    load: Float[Array, " load"] = eqx.field(metadata=label("N", "normal load"))
    traction_coefficient: Float[Array, "temperature speed load slide"] = eqx.field(
        metadata=label("1", "traction coefficient")
    )
    film: Float[Array, "temperature speed load slide"] = eqx.field(metadata=label("m", "central film"))
    deborah_number: Float[Array, "temperature speed load slide"] = eqx.field(
        metadata=label("1", "Deborah number at the mean pressure")
    )
    inlet_temperature: Float[Array, "temperature speed load slide"] = eqx.field(
        metadata=label("K", "temperature of the oil that enters the contact")
    )
    power: Float[Array, "temperature speed load slide"] = eqx.field(metadata=label("W", "power dissipated"))
    inner_residual: Float[Array, "temperature speed load slide"] = eqx.field(
        metadata=label("1", "largest residual of nested solves")
    )
    film_rise: Float[Array, "temperature speed load slide"] | None = eqx.field(
        default=None, metadata=label("K", "largest rise of the film's mean temperature in the contact")
    )
    surface_rise: Float[Array, "temperature speed load slide"] | None = eqx.field(
        default=None, metadata=label("K", "largest rise of the surface temperature in the contact")
    )
    notes: tuple[str, ...] = eqx.field(static=True, default=())

    @property
    def converged(self) -> Bool[Array, ""]:
        return jnp.all(self.status == Status.CONVERGED)

    def failure(self) -> str:
        """One sentence on the points that failed."""
        failed = int(jnp.sum(self.status != Status.CONVERGED))
        worst = float(jnp.max(jnp.where(jnp.isfinite(self.inner_residual), self.inner_residual, jnp.inf)))
        return (
            f"{Status.NOT_CONVERGED.text}: {failed} of {self.status.size} points; nested solve (temperature of inlet "
            f"or film), residual {worst:.3g}"
        )

    def raise_if_failed(self) -> None:
        """Does nothing while JAX traces. **Raises:** `SolveError`."""
        try:
            failed = not bool(self.converged)
        except jax.errors.ConcretizationTypeError:
            return
        if failed:
            raise SolveError(self.failure())


class TwoDisk(AbstractScene):
    """A two-disk machine (or a ball on a disc) as a scene.

    **Arguments:** `geometry`; `materials`: of the two bodies; `oil`, with a rheology; `contact`: its laws;
    `operation`: the family of curves.
    """

    geometry: DiskGeometry
    materials: tuple[Material, Material]
    oil: Lubricant
    contact: TwoDiskLaws
    operation: DiskOperation

    def __check_init__(self):
        line = self.geometry.contact_length is not None
        if line != isinstance(self.contact.film, AbstractLineFilm):
            kind = "line" if line else "point"
            raise ValueError(f"contact.film: found {type(self.contact.film).__name__}, expected a film of a {kind} contact")

    @property
    def hertz(self) -> LineContact | PointContact:
        """The dry contact."""
        return self.geometry.contact(reduced_modulus(*self.materials))

    def state(
        self,
        slide_to_roll: Values,
        entrainment_speed: Values,
        temperature: Values,
        pressure: Values | None = None,
        load: Values | None = None,
    ) -> DiskState:
        """Patch, film and temperatures at points, which broadcast against each other: all that does not depend on the
        oil's rheology. **Arguments:** as in `DiskOperation`."""
        contact = self.hertz
        load = contact.load_at_pressure(pressure) if load is None else load
        slide_to_roll, speed, temperature, load = jnp.broadcast_arrays(
            *(jnp.asarray(v, dtype=float) for v in (slide_to_roll, entrainment_speed, temperature, load))
        )
        sliding = slide_to_roll * speed
        inlet = self.oil.at(temperature)
        laws = self.contact
        log_film = laws.film.log_thickness(contact, load, speed, inlet.viscosity, inlet.pressure_viscosity)
        residual = jnp.zeros_like(log_film)
        if not isinstance(laws.thermal, NoThermalReduction):
            log_factor = laws.thermal.log_factor(contact, load, speed, sliding, inlet)
            if laws.warm_inlet:
                args = (laws.film, contact, load, speed, self.oil)
                root = inlet_temperature_rise(_log_film_at, args, temperature, log_film, log_factor)
                temperature, residual = temperature + root.value, root.residual
            log_film = log_film + log_factor
        patch = contact_patch(contact, load)
        return DiskState(patch, load, jnp.exp(log_film), speed, sliding, temperature, residual)

    def traction(self, state: DiskState, oil: Lubricant | None = None) -> Traction:
        """Forces, power and temperatures. **Arguments:** `oil`: one with another rheology than the scene's."""
        law, oil = self.contact.traction, self.oil if oil is None else oil
        sliding = Sliding(state.sliding_speed)
        return law.traction(state.patch, state.film, state.entrainment_speed, sliding, state.temperature, oil)


def _log_film_at(temperature: Array, args: Any) -> Array:
    film, contact, load, speed, oil = args
    viscosity = oil.viscosity.viscosity(0.0, temperature)
    return film.log_thickness(contact, load, speed, viscosity, oil.pressure_viscosity.coefficient(temperature))


def solve_two_disk(scene: TwoDisk, options: Any = None) -> TwoDiskSolution:
    """All curves of the scene's operation. `options` is there for the other scenes' sake: nothing is iterated here
    but scalar roots."""
    operation = scene.operation
    contact = scene.hertz
    load = operation.load
    if load is None:
        load = contact.load_at_pressure(operation.pressure)
    grid = jnp.meshgrid(
        operation.temperature, operation.entrainment_speed, load, operation.slide_to_roll, indexing="ij"
    )
    flat = [axis.reshape(-1) for axis in grid]

    def point(values):
        temperature, speed, load, slide = values
        state = scene.state(slide, speed, temperature, load=load)
        return state, scene.traction(state), deborah_number(state.patch, speed, state.temperature, scene.oil)

    state, traction, deborah = jax.tree.map(
        lambda leaf: leaf.reshape(grid[0].shape), jax.lax.map(point, flat, batch_size=256)
    )
    residual = state.inner_residual
    if traction.inner_residual is not None:
        residual = jnp.maximum(residual, traction.inner_residual)
    coefficient = traction.rolling / state.load
    good = (residual <= INNER_TOLERANCE) & jnp.isfinite(coefficient)
    shown = lambda field: None if field is None else jnp.where(good, field, jnp.nan)
    return TwoDiskSolution(
        status=jnp.where(good, int(Status.CONVERGED), int(Status.NOT_CONVERGED)),
        operation=operation,
        pressure=contact.hertz_pressure(load),
        load=load,
        traction_coefficient=shown(coefficient),
        film=shown(state.film),
        deborah_number=shown(deborah),
        inlet_temperature=shown(state.temperature),
        power=shown(traction.power),
        inner_residual=residual,
        film_rise=shown(traction.film_rise),
        surface_rise=shown(traction.surface_rise),
        notes=scene.oil.notes,
    )

"""The two-disk machine: two bodies that roll and slide on each other under load, and the traction between them."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._checks import Information
from .._scene import AbstractScene, AbstractSolution, label, number, optional_number
from .._types import Scalar, Values
from ..contacts import (
    AbstractLineFilm,
    AbstractPointFilm,
    AbstractThermalFactor,
    ContactPatch,
    DistributedTraction,
    Gupta,
    HalfSpaceCompliance,
    LineContact,
    NoThermalReduction,
    PointContact,
    Sliding,
    Traction,
    contact_patch,
    deborah_number,
)
from ..contacts.heated_film import heated_film
from ..lubricants import Lubricant, NoPressureViscosity
from ..lubricants.ranges import FITTED_PRESSURE, FITTED_TEMPERATURES
from ..materials import Material, reduced_modulus
from ..numerics.checks import Checked, array_module, demand
from ..numerics.newton import NewtonOptions
from ..numerics.precision import as_float
from ..numerics.ranges import RANGES
from ..numerics.refusals import refuse_all
from ..numerics.status import Status
from ..numerics.structure import switch

INNER_TOLERANCE = 1e-6
"""Largest residual of a nested solve: ln(film) of the inlet's rise, K of the film's."""
BATCH = 512
"""Points that are computed side by side; more of them are taken one batch after the other."""


class DiskGeometry(Checked):
    """Reduced radii of the contact, m: 1/R = 1/R1 + 1/R2, convex > 0. A ball on a flat disc has its own radius twice.

    **Arguments:**
    - `reduced_radius_rolling`: in the plane of rolling, m, > 0.
    - `reduced_radius_transverse`: across, m, > 0; not given: as along rolling, a circular contact.
    - `contact_length`: of a line contact between cylinders, m, > 0; then there is no transverse radius.
    """

    part: ClassVar[str] = "geometry"

    reduced_radius_rolling: Scalar = number(bound="> 0", unit="m")
    reduced_radius_transverse: Scalar | None = optional_number(bound="> 0", unit="m")
    contact_length: Scalar | None = optional_number(bound="> 0", unit="m")

    def __check_init__(self):
        super().__check_init__()
        if self.contact_length is not None and self.reduced_radius_transverse is not None:
            raise ValueError(
                "geometry.reduced_radius_transverse: expected none beside contact_length: a line contact is "
                "straight across"
            )

    def contact(self, modulus: Values) -> LineContact | PointContact:
        """**Arguments:** `modulus`: reduced modulus E', Pa."""
        along = self.reduced_radius_rolling
        if self.contact_length is not None:
            return LineContact(along, self.contact_length, modulus)
        across = along if self.reduced_radius_transverse is None else self.reduced_radius_transverse
        return PointContact(along, across, modulus)


class DiskMaterials(eqx.Module):
    """Solids of the two bodies."""

    body_1: Material
    body_2: Material


class TwoDiskLaws(eqx.Module):
    """Laws of the contact.

    **Arguments:**
    - `film`: film thickness law, of a point or a line contact as the geometry says.
    - `traction`: the sheared film.
    - `thermal`: thermal reduction of the film; its inlet rise also warms the oil in the contact.
    - `warm_inlet`: whether the oil enters the contact, and the surfaces are, warmer by the inlet rise; else at the
      oil's temperature, and the thermal factor thins the film only.
    - `half_space_compliance`: whether the bodies give way tangentially as elastic half-spaces of the scene's materials;
      `traction` has no compliance of its own then.
    """

    film: AbstractPointFilm | AbstractLineFilm
    traction: DistributedTraction
    thermal: AbstractThermalFactor = NoThermalReduction()
    warm_inlet: bool = switch("contact.warm_inlet", True)
    half_space_compliance: bool = switch("contact.half_space_compliance", False)

    def __check_init__(self):
        if self.half_space_compliance and self.traction.compliance is not None:
            raise ValueError("contact.compliance: found one in contact.traction, expected none beside the half-spaces'")


def _values(values: Any) -> Any:
    """A one-dimensional array of float64; what is not a number passes through for the type checker to judge."""
    if isinstance(values, list | tuple):
        traced = any(isinstance(value, jax.Array) for value in values)
        values = jnp.stack(values) if traced else np.asarray(values, dtype=np.float64)
    values = as_float(values)
    return values.reshape(1) if getattr(values, "ndim", None) == 0 else values


def _axis(unit: str, description: str, bound: str = "> 0", **kwargs: Any) -> Any:
    """Field with one dimension of the family of curves: a number or a list of them, each within the bound."""
    metadata = {**label(unit, description), "each": bound}
    return eqx.field(converter=lambda v: None if v is None else _values(v), metadata=metadata, **kwargs)


class DiskOperation(eqx.Module):
    """The family of traction curves: each curve over all slide-to-roll ratios, one for each combination of the others.

    **Arguments:** each a number or a one-dimensional array;
    - `slide_to_roll`: (u1 - u2)/entrainment speed, signed.
    - `entrainment_speed`: (u1 + u2)/2, m/s, > 0.
    - `temperature`: of the oil that is fed, K.
    - `pressure`: Hertz (peak) pressures, Pa, or `load`: N; one of the two.
    """

    slide_to_roll: Float[Array | np.ndarray, " slide"] = _axis(
        "1", "slide-to-roll ratio, difference over mean speed", "finite"
    )
    entrainment_speed: Float[Array | np.ndarray, " speed"] = _axis("m/s", "mean surface speed")
    temperature: Float[Array | np.ndarray, " temperature"] = _axis("K", "oil temperature")
    pressure: Float[Array | np.ndarray, " load"] | None = _axis("Pa", "Hertz (peak) pressure", default=None)
    load: Float[Array | np.ndarray, " load"] | None = _axis("N", "normal load", default=None)

    def __check_init__(self):
        for field in dataclasses.fields(self):
            _require_each(field.name, getattr(self, field.name), field.metadata["each"])
        if (self.pressure is None) == (self.load is None):
            word = "neither" if self.pressure is None else "both"
            raise ValueError(
                f"operation.pressure: found {word} of pressure and load, expected one of the two: a Hertz (peak) "
                "pressure or a normal load"
            )


def _require_each(name: str, values: Any, allowed: str) -> None:
    """**Raises:** `ValueError` for an empty list or a number out of range, where the numbers are known."""
    if values is None:
        return
    if np.ndim(values) != 1 or np.size(values) == 0:
        raise ValueError(f"operation.{name} must be a number or a list of them, got the shape {np.shape(values)}")
    inside = RANGES[allowed].holds(values)
    demand(
        f"operation.{name} must be {allowed}",
        array_module(values).all(inside),
        lambda: f"operation.{name} must be {allowed}, got {np.asarray(values)[~np.asarray(inside)][0]:g}",
    )


class DiskState(NamedTuple):
    """One point, or many: everything before the oil's rheology is asked. Shapes broadcast."""

    patch: ContactPatch
    load: Float[Array, "*batch"]
    film: Float[Array, "*batch"]
    entrainment_speed: Float[Array, "*batch"]
    sliding_speed: Float[Array, "*batch"]
    temperature: Float[Array, "*batch"]
    """Temperature of the oil that enters the contact, K."""
    inner_residual: Float[Array, "*batch"]


class TwoDiskSolution(AbstractSolution):
    """Traction curves. Axes: temperature, speed, load, slide. What a failed point gives is NaN."""

    status: Int[Array, "temperature speed load slide"] = eqx.field(metadata=label("1", "how each point ended"))
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
    checks: Mapping[str, Bool[Array, ""]] = eqx.field(default_factory=dict)
    notes: tuple[str, ...] = eqx.field(static=True, default=())

    @property
    def converged(self) -> Bool[Array, ""]:
        """True if all points converged."""
        return jnp.all(self.status == Status.CONVERGED)

    def solver_failure(self) -> str:
        """One sentence on the points that failed."""
        status, residual = np.asarray(self.status), np.asarray(self.inner_residual)
        failed = status != Status.CONVERGED
        residual = np.where(np.isfinite(residual), residual, np.inf)
        worst = np.unravel_index(np.argmax(np.where(failed, residual, -1.0)), residual.shape)
        reason = f"nested solve (temperature of inlet or film), residual {residual[worst]:.3g}"
        if status[worst] == Status.OUTSIDE_VALIDITY:
            reason = "no inlet up to 500 K warmer has a film as thin as the thermal law's, which does not apply there"
        if residual[worst] <= INNER_TOLERANCE:
            reason = "no finite number"
        text = f"{Status(int(status.max())).text}: {int(failed.sum())} of {status.size} points"
        return f"{text}, worst{self._place(worst)}: {reason}"

    def _place(self, point: tuple[np.intp, ...]) -> str:
        if len(point) != 4:
            return ""
        operation = self.operation
        name, unit = ("load", "N") if operation.pressure is None else ("pressure", "Pa")
        axes = (operation.temperature, operation.entrainment_speed, getattr(operation, name), operation.slide_to_roll)
        t, u, q, s = (float(np.asarray(axis)[i]) for axis, i in zip(axes, point, strict=True))
        return f" at temperature {t:g} K, entrainment_speed {u:g} m/s, {name} {q:g} {unit}, slide_to_roll {s:g}"


class TwoDisk(AbstractScene):
    """A two-disk machine (or a ball on a disc) as a scene.

    **Arguments:** `geometry`; `materials`: of the two bodies; `oil`, with a rheology; `contact`: its laws;
    `operation`: the family of curves. At other loads than those of a scene with `pressure`:
    `scene.at_operation(pressure=None, load=1647.0)`.

    **Raises:** `ValueError` for laws that do not fit the geometry or the oil.
    """

    kind: ClassVar[str] = "two_disk"

    geometry: DiskGeometry
    materials: DiskMaterials
    oil: Lubricant
    contact: TwoDiskLaws
    operation: DiskOperation

    def __check_init__(self):
        refuse_all(self._problems())

    def steady_solution(self, options: NewtonOptions) -> TwoDiskSolution:
        return solve_two_disk(self, options)

    def _problems(self) -> Iterator[str | ValueError]:
        laws, oil = self.contact, self.oil
        line = self.geometry.contact_length is not None
        if line != isinstance(laws.film, AbstractLineFilm):
            kind = "line" if line else "point"
            yield f"contact.film: found {type(laws.film).__name__}, expected a film of a {kind} contact"
        if isinstance(oil.pressure_viscosity, NoPressureViscosity) and laws.film.piezoviscous_only:
            yield (
                f"contact.film: {type(laws.film).__name__} holds for oils whose viscosity rises with pressure, not for "
                "an isoviscous one"
            )
        if oil.rheology is None:
            yield "oil.rheology: the traction needs it"
        heating = laws.traction.heating
        warms = not isinstance(laws.thermal, NoThermalReduction) or (
            heating is not None and heating.conductivity is None
        )
        if warms and oil.conductivity is None:
            yield "oil.conductivity: the thermal reduction of the film, and its heating, need it"

    @property
    def hertz(self) -> LineContact | PointContact:
        """The dry contact."""
        return self.geometry.contact(self._reduced_modulus)

    @property
    def traction_law(self) -> DistributedTraction:
        """The law of the sheared film together with what it needs of the bodies."""
        law, bodies = self.contact.traction, self.materials
        if not self.contact.half_space_compliance:
            return law
        poisson_ratio = 0.5 * (bodies.body_1.poisson_ratio + bodies.body_2.poisson_ratio)
        return dataclasses.replace(law, compliance=HalfSpaceCompliance(self._reduced_modulus, poisson_ratio))

    @property
    def _reduced_modulus(self) -> Array:
        return reduced_modulus(self.materials.body_1, self.materials.body_2)

    def assumptions(self) -> tuple[str, ...]:
        """Notes for the user: uses for which the scene's data were not made, and assumptions."""
        return (*(f"oil: {note}" for note in self.oil.notes), *self.contact.traction.notes(self.oil))

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
        # film and thermal factor fit the kind of contact: checked when the scene is made
        contact: Any = self.hertz
        contact = contact.shaped() if isinstance(contact, PointContact) else contact
        load = contact.load_at_pressure(pressure) if load is None else load
        slide_to_roll, speed, temperature, load = jnp.broadcast_arrays(
            *(jnp.asarray(v, dtype=float) for v in (slide_to_roll, entrainment_speed, temperature, load))
        )
        sliding = slide_to_roll * speed
        inlet = self.oil.at(temperature)
        laws = self.contact
        warm_film = heated_film(laws.film, laws.thermal, contact, load, speed, sliding, self.oil, inlet)
        residual = jnp.zeros_like(warm_film.log_thickness)
        if warm_film.rise is not None and laws.warm_inlet:
            temperature, residual = temperature + warm_film.rise, warm_film.residual
        patch = contact_patch(contact, load)
        return DiskState(patch, load, jnp.exp(warm_film.log_thickness), speed, sliding, temperature, residual)

    def traction(self, state: DiskState, oil: Lubricant | None = None) -> Traction:
        """Forces, power and temperatures. **Arguments:** `oil`: one with another rheology than the scene's."""
        law, oil = self.traction_law, self.oil if oil is None else oil
        sliding = Sliding(state.sliding_speed)
        traction = law.traction(state.patch, state.film, state.entrainment_speed, sliding, state.temperature, oil)
        return traction._replace(by_strip=None)


def solve_two_disk(scene: TwoDisk, options: NewtonOptions | None = None) -> TwoDiskSolution:
    """The traction curves of the scene's operation. `options` has no effect: only scalar roots are iterated. It is
    there because the solves of other scenes take it."""
    operation = scene.operation
    contact = scene.hertz
    load = operation.load
    if load is None:
        load = contact.load_at_pressure(operation.pressure)
    axes = (operation.temperature, operation.entrainment_speed, load, operation.slide_to_roll)
    grid = jnp.meshgrid(*axes, indexing="ij")

    def point(temperature, speed, load, slide):
        state = scene.state(slide, speed, temperature, load=load)
        deborah = deborah_number(state.patch, speed, state.temperature, scene.oil)
        return state.film, state.temperature, state.inner_residual, scene.traction(state), deborah

    film, temperature, residual, traction, deborah = _in_batches(point, grid)
    cool = residual <= INNER_TOLERANCE
    if traction.inner_residual is not None:
        residual = jnp.maximum(residual, traction.inner_residual)
    coefficient = traction.rolling / grid[2]
    good = (residual <= INNER_TOLERANCE) & jnp.isfinite(coefficient)
    shown = lambda field: jnp.where(good, field, jnp.nan)
    modelled = lambda field: None if field is None else shown(field)
    excess = _range_excess(scene, contact, load)
    excess |= {
        Information("oil in the contacts beyond 200 degC: the oil laws are extrapolated"): _hottest_excess(
            temperature, traction, good
        )
    }
    return TwoDiskSolution(
        status=_status(good, cool | ~jnp.isfinite(residual)),
        operation=operation,
        pressure=contact.hertz_pressure(load),
        load=jnp.asarray(load),
        traction_coefficient=shown(coefficient),
        film=shown(film),
        deborah_number=shown(deborah),
        inlet_temperature=shown(temperature),
        power=shown(traction.power),
        inner_residual=residual,
        film_rise=modelled(traction.film_rise),
        surface_rise=modelled(traction.surface_rise),
        checks={text: value > 0 for text, value in excess.items()},
        notes=scene.assumptions(),
    )


def _status(good: Array, explained: Array) -> Array:
    """Status of each point; `explained`: True if an inlet temperature in bounds explains the thermal reduction."""
    failed = jnp.where(explained, np.int64(Status.NOT_CONVERGED), np.int64(Status.OUTSIDE_VALIDITY))
    return jnp.where(good, np.int64(Status.CONVERGED), failed)


def _in_batches(function: Callable[..., Any], grid: Sequence[Array]) -> Any:
    """`function` of each point of a grid; the last batch is filled up: one program does them all."""
    shape, size = grid[0].shape, grid[0].size
    count = -(-size // BATCH)
    flat = [axis.reshape(-1) for axis in grid]
    if count == 1:
        return jax.tree.map(lambda leaf: leaf.reshape(shape), jax.vmap(function)(*flat))
    width = -(-size // count)
    rows = [jnp.pad(axis, (0, count * width - size), mode="edge").reshape(count, width) for axis in flat]
    results = jax.lax.map(lambda row: jax.vmap(function)(*row), rows)
    return jax.tree.map(lambda leaf: leaf.reshape(-1)[:size].reshape(shape), results)


def _range_excess(scene: TwoDisk, contact: LineContact | PointContact, load: Array | np.ndarray) -> dict[str, Array]:
    """Excess of the operation over the ranges of the laws: positive outside of them."""
    operation, (low, high) = scene.operation, FITTED_TEMPERATURES
    temperature, slide = jnp.asarray(operation.temperature), jnp.max(jnp.abs(operation.slide_to_roll))
    excess = {
        Information("inlet oil beyond 200 degC: the oil laws are extrapolated"): jnp.max(temperature) - high,
        Information("inlet oil below -20 degC: the oil laws are extrapolated"): low - jnp.min(temperature),
        Information("mean contact pressure beyond 1.8 GPa: the traction rheology is extrapolated"): jnp.max(
            contact.mean_pressure(load)
        )
        - FITTED_PRESSURE,
        "slide_to_roll beyond 2: the surfaces move in opposite directions (1 is 100 %)": slide - 2.0,
    }
    thermal = scene.contact.thermal
    if isinstance(thermal, Gupta):
        speed = jnp.asarray(operation.entrainment_speed)
        loading = thermal.thermal_loading(speed[:, None], scene.oil.at(temperature[None, :]))
        excess[Information("thermal loading beyond 20: Gupta's factor is extrapolated")] = jnp.max(loading) - 20.0
    return excess


def _hottest_excess(temperature: Array, traction: Traction, good: Array) -> Array:
    """Excess of the hottest oil in a contact over the range of the oil laws, K."""
    hottest = temperature if traction.film_rise is None else temperature + traction.film_rise
    return jnp.max(jnp.where(good, hottest, 0.0)) - FITTED_TEMPERATURES[1]

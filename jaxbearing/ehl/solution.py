"""Results of a steady line contact, and the solve that makes them."""

from collections.abc import Mapping

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._checks import Information
from .._scene import AbstractSolution, label
from .._types import Scalar
from ..lubricants.ranges import FITTED_TEMPERATURES
from ..numerics.newton import NewtonOptions
from ..numerics.status import Status
from .equations import film_shape
from .line_contact import SMALLEST_MOES_LOAD, ContactOperation, EHLLineContact, Scales
from .mesh import Mesh, mesh
from .resolution import cut_error, mesh_error
from .steady import SMALLEST_WEDGE, judged, steady_root

THIN = "minimum film below contact.film_limit: a continuum means little"

LARGEST_MESH_ERROR, LARGEST_CUT_ERROR = 0.05, 0.005
"""Relative errors of the films by mesh and by inlet above which a warning is given."""


class FilmResult(eqx.Module):
    """Film thickness."""

    central: Float[Array, ""] = eqx.field(metadata=label("m", "film at the centre"))
    minimum: Float[Array, ""] = eqx.field(metadata=label("m", "smallest film"))
    minimum_position: Float[Array, ""] = eqx.field(metadata=label("m", "place of the smallest film"))


class HertzResult(eqx.Module):
    """The dry contact."""

    half_width: Float[Array, ""] = eqx.field(metadata=label("m", "Hertz half width"))
    pressure: Float[Array, ""] = eqx.field(metadata=label("Pa", "Hertz (peak) pressure"))


class Profile(eqx.Module):
    """Pressure and film over the contact; x points along the direction of positive speed."""

    x: Float[Array, " node"] = eqx.field(metadata=label("m", "place along rolling, from the centre"))
    pressure: Float[Array, " node"] = eqx.field(metadata=label("Pa", "pressure"))
    film: Float[Array, " node"] = eqx.field(metadata=label("m", "film thickness"))


class FormulaResult(eqx.Module):
    """Film formulas for the same contact."""

    moes_central: Float[Array, ""] = eqx.field(metadata=label("m", "central film by Moes"))
    dowson_toyoda_central: Float[Array, ""] = eqx.field(metadata=label("m", "central film by Dowson and Toyoda"))
    dowson_higginson_minimum: Float[Array, ""] = eqx.field(metadata=label("m", "minimum film by Dowson and Higginson"))


class LineContactSolution(AbstractSolution):
    """Steady film of a line contact. After a failed solve the results are NaN, except Hertz contact and formulas."""

    status: Int[Array, ""] = eqx.field(metadata=label("1", "how the solve ended"))
    iterations: Int[Array, ""] = eqx.field(metadata=label("1", "Newton steps on all meshes"))
    residual_norm: Float[Array, ""] = eqx.field(
        metadata=label("1", "largest scaled residual before the last Newton step")
    )
    last_step: Float[Array, ""] = eqx.field(metadata=label("1", "largest change of an unknown by the last Newton step"))
    film: FilmResult
    hertz: HertzResult
    profile: Profile
    formulas: FormulaResult
    load_per_length: Float[Array, ""] = eqx.field(metadata=label("N/m", "load per length"))
    central_pressure: Float[Array, ""] = eqx.field(metadata=label("Pa", "pressure at the centre"))
    moes_load: Float[Array, ""] = eqx.field(metadata=label("1", "Moes load number M"))
    moes_material: Float[Array, ""] = eqx.field(metadata=label("1", "Moes material number L"))
    speed_number: Float[Array, ""] = eqx.field(metadata=label("1", "lambda = 12 eta u R'^2/(a^3 p_h)"))
    operation: ContactOperation
    checks: Mapping[str, Bool[Array, ""]]
    unknowns: int = eqx.field(static=True, default=0, metadata=label("1", "unknowns of the equations"))
    compressible: bool = eqx.field(static=True, default=True)
    notes: tuple[str, ...] = eqx.field(static=True, default=())

    @property
    def converged(self) -> Bool[Array, "*batch"]:
        return self.status == Status.CONVERGED

    def solver_failure(self) -> str:
        """Why the solve failed, in one sentence (for a single solution, not a batch)."""
        status, speed, load = Status(int(self.status)).text, float(self.speed_number), float(self.moes_load)
        if not speed >= SMALLEST_WEDGE:
            return (
                f"{status}: the surfaces do not carry oil into the contact (speed number {speed:.3g}, "
                f"at least {SMALLEST_WEDGE:g} needed): at rest there is no steady film; a transient run (simulate) can "
                "stop there"
            )
        if not load >= SMALLEST_MOES_LOAD:
            martin = 2.447 / load
            return (
                f"{status}: load number M = {load:.3g} is below {SMALLEST_MOES_LOAD:g}: the cylinders are all but "
                f"rigid and this elastic model does not apply; rigid and isoviscous, the smallest film over "
                f"R' sqrt(U) is 2.447/M = {martin:.3g}"
            )
        return (
            f"{status} after {int(self.iterations)} Newton steps: last step {float(self.last_step):.3g}, "
            f"Reynolds' equation or the load: residual {float(self.residual_norm):.3g}"
        )


def central_weights(grid: Mesh) -> tuple[int, np.ndarray]:
    """Index of the first of three nodes around X = 0, and the weights of their values in the parabola's value there."""
    i = int(np.clip(np.argmin(np.abs(grid.x)), 1, grid.size - 2)) - 1
    a, b, c = grid.x[i : i + 3]
    return i, np.asarray([b * c / ((a - b) * (a - c)), a * c / ((b - a) * (b - c)), a * b / ((c - a) * (c - b))])


def central_value(values: Float[Array, " node"], grid: Mesh) -> Float[Array, ""]:
    """Value at X = 0, by the parabola through three nodes."""
    i, weights = central_weights(grid)
    return jnp.sum(jnp.asarray(weights) * values[i : i + 3])


def parabola_minimum(values: Float[Array, " node"], grid: Mesh) -> tuple[Float[Array, ""], Float[Array, ""]]:
    """Vertex of the parabola through the lowest node and its neighbours: value and place X."""
    i = jnp.clip(jnp.argmin(values), 1, grid.size - 2)
    x, step = jnp.asarray(grid.x), jnp.asarray(grid.step)
    left, right = step[i - 1], step[i]
    before, after = (values[i] - values[i - 1]) / left, (values[i + 1] - values[i]) / right
    curvature = (after - before) / (left + right)
    slope = (before * right + after * left) / (left + right)
    bent = jnp.where(curvature > 0, curvature, 1.0)
    shift = jnp.where(curvature > 0, -0.5 * slope / bent, 0.0)
    return values[i] + shift * (slope + curvature * shift), x[i] + shift


def solve_line_contact(scene: EHLLineContact, options: NewtonOptions | None = None) -> LineContactSolution:
    """The steady film. `options` is ignored (other scenes use it): the solver has its own tolerance,
    `steady.TOLERANCE`."""
    scales, key = scene.scales(), scene.steady_mesh
    # solved for flow in +X and mirrored: the mesh is finer and longer on the inlet's side
    speed = jnp.abs(jnp.asarray(scene.operation.entrainment_speed, dtype=float)) / scales.reference_speed
    problem = scene.steady(scales, speed)
    # a failed lane, too, must have numbers that can be differentiated
    root = steady_root(problem, key=key)
    grid = mesh(key)
    shape = film_shape(root.point, grid)
    minimum, place = parabola_minimum(shape, grid)
    good = root.solved
    shown = lambda value: jnp.where(good, value, jnp.nan)
    backwards = jnp.asarray(scene.operation.entrainment_speed) < 0
    turned = lambda values: jnp.where(backwards, values[::-1], values)
    sign = jnp.where(backwards, -1.0, 1.0)
    exists = scales.wedge * speed >= SMALLEST_WEDGE
    x, formulas = jnp.asarray(grid.x), scene.formulas()
    return LineContactSolution(
        status=judged(root.status, exists, scene.described(scales)),
        iterations=root.iterations,
        residual_norm=root.residual,
        last_step=root.step,
        film=FilmResult(
            shown(central_value(shape, grid) * scales.film),
            shown(minimum * scales.film),
            shown(sign * place * scales.half_width),
        ),
        hertz=HertzResult(scales.half_width, scales.hertz_pressure),
        profile=Profile(
            sign * turned(x) * scales.half_width,
            shown(turned(root.point.pressure) * scales.hertz_pressure),
            shown(turned(shape) * scales.film),
        ),
        formulas=FormulaResult(**formulas),
        load_per_length=scales.load_per_length,
        central_pressure=shown(central_value(root.point.pressure, grid) * scales.hertz_pressure),
        moes_load=scales.moes_load,
        moes_material=scales.moes_material,
        speed_number=scales.wedge * speed,
        operation=scene.operation,
        checks=range_checks(scene, scales, formulas["moes_central"])
        | {THIN: shown(minimum * scales.film) < scene.contact.film_limit},
        unknowns=key.nodes - 1,
        compressible=scene.contact.compressible,
        notes=scene.assumptions(),
    )


def range_checks(scene: EHLLineContact, scales: Scales, film: Scalar | None = None) -> dict[str, Bool[Array, ""]]:
    """Range checks: text -> True if the range of a law or of the mesh is left.

    **Arguments:** `film`: film thickness by Moes' formula, if it is known.
    """
    temperature, (low, high) = jnp.asarray(scene.operation.oil_temperature), FITTED_TEMPERATURES
    ratio, model = scene.film_ratio(scales, film), scene.contact
    by_mesh, by_inlet = mesh_error(model.nodes, ratio, scales.moes_material), cut_error(model.inlet, ratio)
    missed = {}
    if model.accuracy is not None:
        text = (
            f"contact.accuracy of {model.accuracy:g} is missed under this load: by the mesh, or by a cut inlet, "
            "the films are lower by more; build the scene for this load, or give contact.nodes and contact.inlet"
        )
        missed = {text: jnp.asarray(jnp.maximum(by_mesh, by_inlet) > model.accuracy)}
    return missed | {
        Information("oil beyond 200 degC: the oil laws are extrapolated"): temperature > high,
        Information("oil below -20 degC: the oil laws are extrapolated"): temperature < low,
        "Hertz pressure beyond 4.2 GPa: the bodies would yield": scales.hertz_pressure > 4.2e9,
        "contact.inlet is too short for this light load: the films are more than 0.5 % low": (
            jnp.asarray(by_inlet > LARGEST_CUT_ERROR)
        ),
        "contact.nodes are too few for this heavy load: the films are more than 5 % low": (
            jnp.asarray(by_mesh > LARGEST_MESH_ERROR)
        ),
    }

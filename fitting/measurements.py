"""Measured traction curves in the form that the model needs."""

from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from jaxbearing.machines import DiskState, TwoDisk

LARGEST_COEFFICIENT = 1.0
"""Largest traction coefficient that is accepted; no lubricated contact has a larger one."""


class MeasurementError(ValueError):
    """Error for curves that do not go with the scene; the message says why."""


class Measurements(eqx.Module):
    """Points of traction curves, SI.

    **Arguments:**
    - `slide_to_roll`: difference of the surface speeds over their mean, signed.
    - `traction_coefficient`: measured.
    - `load`, N; `entrainment_speed`, m/s; `temperature` of the oil, K: of each point.
    - `curve`: number of the curve that each point belongs to; `curve_names`: names of the curves.
    """

    slide_to_roll: Float[Array, " point"]
    traction_coefficient: Float[Array, " point"]
    load: Float[Array, " point"]
    entrainment_speed: Float[Array, " point"]
    temperature: Float[Array, " point"]
    curve: tuple[int, ...] = eqx.field(static=True)
    curve_names: tuple[str, ...] = eqx.field(static=True)

    @classmethod
    def of(cls, table: Any, scene: TwoDisk) -> "Measurements":
        """The points of a `fitting.io.CurveTable`; conditions that the file lacks come from the scene's operation.

        **Raises:** `MeasurementError` where the file lacks a condition and the scene does not give one value of it, and
        for impossible traction coefficients.
        """
        count = len(table.slide_to_roll)
        _check_signs(np.asarray(table.slide_to_roll), np.asarray(table.traction_coefficient))
        load = table.load
        if load is None and table.pressure is not None:
            load = np.asarray(scene.hertz.load_at_pressure(jnp.asarray(table.pressure)))
        if load is None:
            name = "load" if scene.operation.pressure is None else "pressure"
            value = np.asarray(_only_value(scene, name, "load or pressure"))
            load = value if name == "load" else np.asarray(scene.hertz.load_at_pressure(value))
        columns = {
            name: getattr(table, name) if getattr(table, name) is not None else _only_value(scene, name, name)
            for name in ("entrainment_speed", "temperature")
        }
        full = lambda value: jnp.asarray(np.broadcast_to(value, (count,)), dtype=float)
        return cls(
            slide_to_roll=full(table.slide_to_roll),
            traction_coefficient=full(table.traction_coefficient),
            load=full(load),
            entrainment_speed=full(columns["entrainment_speed"]),
            temperature=full(columns["temperature"]),
            curve=tuple(int(i) for i in table.curve),
            curve_names=tuple(table.curve_names),
        )

    def state(self, scene: TwoDisk) -> DiskState:
        """Patch, film and temperature of every point."""
        return scene.state(self.slide_to_roll, self.entrainment_speed, self.temperature, load=self.load)

    def in_curve(self, number: int) -> np.ndarray:
        """Mask of the points of one curve."""
        return np.asarray(self.curve) == number


def _check_signs(slide: np.ndarray, coefficient: np.ndarray) -> None:
    if not np.any(coefficient):
        raise MeasurementError("traction_coefficient: found 0 at every point; expected a traction that can be fitted")
    if np.max(np.abs(coefficient)) > LARGEST_COEFFICIENT:
        raise MeasurementError(
            f"traction_coefficient: found {np.max(np.abs(coefficient)):g}, expected at most {LARGEST_COEFFICIENT:g} "
            "(if the file means percent, its column is 'traction_coefficient [%]')"
        )
    opposed = int(np.sum(coefficient * slide < 0))
    if opposed > int(np.sum(coefficient * slide > 0)):
        raise MeasurementError(
            f"traction_coefficient: found the sign opposite to that of slide_to_roll at {opposed} of {len(slide)} "
            "points; expected the same sign (body 1, the faster one at a positive slide, drags body 2 along)"
        )


def _only_value(scene: TwoDisk, name: str, column: str) -> float:
    values = np.atleast_1d(np.asarray(getattr(scene.operation, name)))
    if values.size != 1:
        raise MeasurementError(
            f"operation.{name}: found no column of {column} in the curves, and {values.size} values in the scene; "
            "expected a column, or one value in the scene"
        )
    return float(values[0])

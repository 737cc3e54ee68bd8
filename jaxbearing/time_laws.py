"""Shaft speed and load as functions of time. They are pytrees: new numbers in them never recompile."""

import abc
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ._scene import number
from ._types import Scalar
from .numerics.checks import Checked, array_module, demand, numbers_or_none
from .numerics.precision import as_float


class AbstractTimeFactor(Checked):
    """A factor on the operating point's speed or load, as a function of time; 1 is the operating point itself."""

    @abc.abstractmethod
    def factor(self, time: Scalar) -> Float[Array, ""]:
        """**Arguments:** `time`, s, from the start of the run."""

    @abc.abstractmethod
    def antiderivative(self, time: Scalar) -> Float[Array, ""]:
        """Integral of the factor, s, with any constant."""

    def integral(self, time: Scalar) -> Float[Array, ""]:
        """Integral of the factor from 0 to `time`, s: with it a frame can turn with the shaft."""
        return self.antiderivative(time) - self.antiderivative(jnp.zeros(()))

    def kinks(self) -> Float[Array, " kink"]:
        """Times, s, at which the factor or its slope may jump: a solver does well to end a step there."""
        return jnp.zeros(0)


class Steady(AbstractTimeFactor):
    """1 at all times."""

    def factor(self, time: Scalar) -> Float[Array, ""]:
        return jnp.ones(())

    def antiderivative(self, time: Scalar) -> Float[Array, ""]:
        return jnp.asarray(time)


class Sinusoidal(AbstractTimeFactor):
    r"""$1 + A\sin(2\pi ft)$ (source, section 4.4).

    **Arguments:**
    - `frequency`: f, of the swing, Hz.
    - `amplitude`: A, as a fraction of the mean value, >= 0; beyond 1 the sign changes.
    """

    part: ClassVar[str] = "sinusoidal"

    frequency: Scalar = number(bound="> 0", unit="1/s")
    amplitude: Scalar = number(bound=">= 0", unit="1")

    def factor(self, time: Scalar) -> Float[Array, ""]:
        return 1.0 + self.amplitude * jnp.sin(2.0 * jnp.pi * self.frequency * time)

    def antiderivative(self, time: Scalar) -> Float[Array, ""]:
        half = jnp.sin(jnp.pi * self.frequency * time)
        return time + self.amplitude / (jnp.pi * self.frequency) * jnp.square(half)


class Ramp(AbstractTimeFactor):
    r"""A factor that goes from `start` to `stop` between the times `begin` and `begin + duration`.

    It is the quintic that begins and ends without slope and curvature: a jump of the acceleration would be a shock of
    its own.

    **Arguments:**
    - `start`, `stop`: factor before and after.
    - `duration`: of the change, s, > 0.
    - `begin`: when it begins, s; below 0: before the run.
    """

    part: ClassVar[str] = "ramp"

    start: Scalar = number(unit="1")
    stop: Scalar = number(unit="1")
    duration: Scalar = number(bound="> 0", unit="s")
    begin: Scalar = number(0.0, unit="s")

    def factor(self, time: Scalar) -> Float[Array, ""]:
        x = jnp.clip((time - self.begin) / self.duration, 0.0, 1.0)
        return self.start + (self.stop - self.start) * (x * x * x * (10.0 + x * (6.0 * x - 15.0)))

    def antiderivative(self, time: Scalar) -> Float[Array, ""]:
        since = (time - self.begin) / self.duration
        x = jnp.clip(since, 0.0, 1.0)
        risen = x * x * x * x * (2.5 + x * (x - 3.0)) + jnp.maximum(since - 1.0, 0.0)
        return self.start * time + (self.stop - self.start) * self.duration * risen


class LinearRamp(AbstractTimeFactor):
    """Straight from `start` to `stop` between the times `begin` and `begin + duration`; at once (just after `begin`)
    for a duration of 0.

    **Arguments:**
    - `start`, `stop`: factor before and after.
    - `duration`: of the change, s, >= 0.
    - `begin`: when it begins, s; below 0: before the run.
    """

    part: ClassVar[str] = "ramp"

    start: Scalar = number(unit="1")
    stop: Scalar = number(unit="1")
    duration: Scalar = number(bound=">= 0", unit="s")
    begin: Scalar = number(0.0, unit="s")

    def factor(self, time: Scalar) -> Float[Array, ""]:
        return self.start + (self.stop - self.start) * self._risen(time)

    def antiderivative(self, time: Scalar) -> Float[Array, ""]:
        since = jnp.asarray(time - self.begin, dtype=float)
        within = jnp.clip(since, 0.0, self.duration)
        risen = 0.5 * within * self._risen(time) + jnp.maximum(since - self.duration, 0.0)
        return self.start * time + (self.stop - self.start) * risen

    def kinks(self) -> Float[Array, " kink"]:
        return self.begin + jnp.stack([jnp.zeros(()), jnp.asarray(self.duration, dtype=float)])

    def _risen(self, time: Scalar) -> Float[Array, ""]:
        since = jnp.asarray(time - self.begin, dtype=float)
        lasting = jnp.asarray(self.duration > 0)
        slope = jnp.clip(since / jnp.where(lasting, self.duration, 1.0), 0.0, 1.0)
        return jnp.where(lasting, slope, jnp.where(since > 0, 1.0, 0.0))


class Tabulated(AbstractTimeFactor):
    """Straight lines between the entries of a table, constant before the first and after the last.

    **Arguments:** `times`, s, increasing; `factors`, as many.
    """

    times: Any = eqx.field(converter=as_float)
    factors: Any = eqx.field(converter=as_float)

    def __check_init__(self):
        super().__check_init__()
        shape = np.shape(self.times)
        if len(shape) != 1 or shape[0] < 2 or np.shape(self.factors) != shape:
            raise ValueError(
                f"a table needs as many times as factors, two or more; got {shape} and {np.shape(self.factors)}"
            )
        if numbers_or_none(self.times, self.factors) is not None:
            xp = array_module(self.times, self.factors)
            demand(
                "{path}.times must increase, and all numbers of the table be finite",
                xp.all(xp.diff(self.times) > 0) & xp.all(xp.isfinite(self.times)) & xp.all(xp.isfinite(self.factors)),
                lambda: "a table's times must increase, and all its numbers be finite",
            )

    def factor(self, time: Scalar) -> Float[Array, ""]:
        return jnp.interp(jnp.asarray(time), self.times, self.factors)

    def antiderivative(self, time: Scalar) -> Float[Array, ""]:
        times, factors = jnp.asarray(self.times), jnp.asarray(self.factors)
        # every interval as far as it lies before `time`
        steps = jnp.diff(times)
        passed = jnp.clip((time - times[:-1]) / steps, 0.0, 1.0)
        slope = jnp.diff(factors)
        within = jnp.sum(steps * passed * (factors[:-1] + 0.5 * slope * passed))
        first = jnp.minimum(times[0], time)
        return first * factors[0] + within + jnp.maximum(time - times[-1], 0.0) * factors[-1]

    def kinks(self) -> Float[Array, " kink"]:
        return jnp.asarray(self.times)


class RotatingLoad(Checked):
    """A load on the inner ring that turns, as that of an unbalanced shaft: it is added to the radial load.

    **Arguments:**
    - `load`: its size, N.
    - `speed`: at which its direction turns, rad/s, counter-clockwise positive; that of the shaft for an unbalance.
    - `phase`: its azimuth at time 0 from the load line, rad.
    """

    part: ClassVar[str] = "rotating_load"

    load: Scalar = number(bound=">= 0", unit="N")
    speed: Scalar = number(unit="rad/s")
    phase: Scalar = number(0.0, unit="rad")

    def components(self, time: Scalar) -> Float[Array, "2"]:
        """Components of the load along azimuths 0 and 90 degrees, N."""
        angle = self.speed * time + self.phase
        return self.load * jnp.stack([jnp.cos(angle), jnp.sin(angle)])

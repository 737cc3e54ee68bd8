"""Checks of what a user gives, each stated once: eager ones raise, traced ones become flags of the lane.

A class states its bounds on its fields (`bounded`, `_scene.number`) and, in `__check_init__`, what several numbers
together must satisfy (`demand`). Numbers that are known are judged when an object is made, and refused with a message.
A traced number has no value then: `check_inputs` runs the same checks again where the equations are traced, and
returns one flag for each of them.
"""

import dataclasses
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.core import Tracer
from jaxtyping import Array, Bool

from .precision import as_float
from .refusals import is_collecting, refuse_all

STAND_IN = jax.ShapeDtypeStruct((), np.dtype(np.float64))
"""In the place of a number that is refused."""


class Interval(NamedTuple):
    """Allowed values: from `low` to `high`; whether the ends belong to them. NaN and infinity never do."""

    low: float
    high: float
    low_allowed: bool = False
    high_allowed: bool = False

    def holds(self, value: Any) -> Any:
        """True if a number, or each of an array, lies inside."""
        above = value >= self.low if self.low_allowed else value > self.low
        return above & (value <= self.high if self.high_allowed else value < self.high)


RANGES = {
    "finite": Interval(-np.inf, np.inf),
    "> 0": Interval(0.0, np.inf),
    ">= 0": Interval(0.0, np.inf, low_allowed=True),
    "> 0 or infinite": Interval(0.0, np.inf, high_allowed=True),
    ">= 0 or infinite": Interval(0.0, np.inf, True, True),
    "between 0 and 1": Interval(0.0, 1.0, True, True),
    "above 0 and below 1": Interval(0.0, 1.0),
    "above 0 and at most 1": Interval(0.0, 1.0, high_allowed=True),
    ">= 0 and below 1": Interval(0.0, 1.0, low_allowed=True),
    "between 0 and 0.5": Interval(0.0, 0.5, True, True),
    "between 0 and 2": Interval(0.0, 2.0, True, True),
    "above 0.5 and at most 1": Interval(0.5, 1.0, high_allowed=True),
    ">= 0 and below 90 degrees": Interval(0.0, 0.5 * np.pi, low_allowed=True),
    "above 0 and below 90 degrees": Interval(0.0, 0.5 * np.pi),
    "between 2 and 64": Interval(2.0, 64.0, True, True),
    "> 0.0632 mPa s (Roelands' smallest viscosity)": Interval(6.32e-5, np.inf),
    "> 138 K (the pole of Roelands' law)": Interval(138.0, np.inf),
    "> 0.3 cSt (0.3e-6 m^2/s)": Interval(0.3e-6, np.inf),
}
"""Bounds of fields, by the words of messages."""


class _Record:
    """The traced checks of a scene, as they are met."""

    def __init__(self) -> None:
        self.path = ""
        self.numbers: dict[str, tuple[Any, Interval]] = {}
        self.rules: dict[str, Any] = {}


_RECORD: ContextVar[_Record | None] = ContextVar("record of traced checks", default=None)


def label(unit: str, description: str) -> dict[str, str]:
    """Metadata of a field: its SI unit and what it is."""
    return {"unit": unit, "description": description}


def bounded(bound: str, *, unit: str = "", difference: bool = False, name: str = "", **kwargs: Any) -> Any:
    """Field that holds one number within a bound of `RANGES`, of a class that is `Checked`. Scene files read the number
    by what is said here (`scenes.table_of`).

    **Arguments:**
    - `unit`: of SI, "1" for a number without a unit; where `metadata` is a `label`, that says it.
    - `difference`: whether a number in K is a difference of temperatures.
    - `name`: of the field in scene files, where that is another one.
    """
    assert bound in RANGES, bound
    said = {"bound": bound, "name": name, "difference": difference}
    if unit:
        said |= label(unit, "")
    kwargs["metadata"] = {**said, **kwargs.get("metadata", {})}
    return eqx.field(**kwargs)


class Checked(eqx.Module):
    """A part of a scene whose fields state their bounds.

    **Raises:** `ValueError`, when it is made, for a number that is known and out of its bound.
    """

    part: ClassVar[str] = ""
    """The table of a scene file that holds the fields, for messages."""

    def __check_init__(self):
        record = _RECORD.get()
        part, checks = self.part if record is None else record.path, {}
        for field in dataclasses.fields(self):
            bound, value = field.metadata.get("bound"), getattr(self, field.name)
            if bound is None:
                continue
            name = field.name if record is not None else field.metadata.get("name") or field.name
            if value is None and field.default is not None:
                raise ValueError(f"{part}.{name}".lstrip(".") + " must be one number, got None")
            checks[name] = (value, bound)
        if is_collecting():
            for name, check in checks.items():
                problems = list(_refused(part, {name: check}))
                refuse_all(problems)
                if problems and hasattr(self, name):
                    # what needs this number is left undecided
                    object.__setattr__(self, name, STAND_IN)
            return
        require(part, **checks)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float | np.generic | np.ndarray | jax.Array | Tracer)


def given(*values: Any) -> tuple[Any, ...] | None:
    """The values, known or traced; `None` where one is missing or stands in for a number (tree transformations)."""
    return values if all(_is_number(value) for value in values) else None


def known(*values: Any) -> tuple[float, ...] | None:
    """The values as floats, or `None` where one of them is traced or missing, or stands in for a number."""
    if given(*values) is None or any(isinstance(value, Tracer) for value in values):
        return None
    return tuple(float(v) for v in values)


def functions(*values: Any) -> Any:
    """numpy, or jax.numpy where one of the values is traced: for rules that need a sine or a root."""
    return jnp if any(isinstance(value, Tracer) for value in values) else np


def require(part: str, **checks: tuple[Any, str]) -> None:
    """`checks` maps a field name to (value, range), the range one of `RANGES`; `None` passes, and a traced value is
    judged by `check_inputs`.

    **Raises:** `ValueError` naming part, field, the value and what is allowed; `Refusals` of several.
    """
    refuse_all(_refused(part, checks))


def _refused(part: str, checks: dict[str, tuple[Any, str]]) -> Iterator[str]:
    """Problems of known values, a sentence each; traced ones are recorded."""
    record = _RECORD.get()
    for name, (value, allowed) in checks.items():
        field = f"{part}.{name}" if part else name
        if value is None:
            continue
        if np.ndim(value):
            found = f"an array of shape {np.shape(value)}" if isinstance(value, Tracer) else repr(value)
            yield f"{field} must be one number, got {found}"
            continue
        # what has a dtype and is no array stands in for a number (`jax.ShapeDtypeStruct`)
        if not (_is_number(value) or hasattr(value, "dtype")):
            yield f"{field} must be one number, got {value!r}"
            continue
        if isinstance(value, Tracer):
            if record is not None:
                record.numbers[f"{field} must be {allowed}"] = (value, RANGES[allowed])
            continue
        number = known(value)
        if number is not None and not RANGES[allowed].holds(number[0]):
            yield f"{field} must be {allowed}, got {number[0]:g}"


def demand(rule: str, fine: Any, message: Callable[[], str]) -> None:
    """A rule about several numbers.

    **Arguments:**
    - `rule`: it in words, beginning with the dotted path of a field; `{path}` stands for that of the part.
    - `fine`: whether it holds: a bool, or a traced one, which `check_inputs` collects; False where a number is NaN.
    - `message`: what to say of known numbers that break it.

    **Raises:** `ValueError` where it is known that the rule does not hold.
    """
    if isinstance(fine, Tracer):
        record = _RECORD.get()
        if record is not None:
            told = rule.format(path=record.path or "the part")
            record.rules[told] = record.rules[told] & fine if told in record.rules else fine
    elif not bool(fine):
        raise ValueError(message())


class InputChecks(NamedTuple):
    """The rules of the traced inputs in words; whether each is broken; whether none is."""

    rules: tuple[str, ...]
    broken: Bool[Array, " rule"]
    valid: Bool[Array, ""]


def check_inputs(scene: Any) -> InputChecks:
    """Runs the checks of a scene and of all its parts again, on traced numbers.

    **Raises:** `ValueError` for a number that is known and breaks a rule.
    """
    record = _Record()
    token = _RECORD.set(record)
    try:
        for path, part in _parts(scene, ""):
            record.path = path
            for kind in type(part).__mro__:
                check = kind.__dict__.get("__check_init__")
                if check is not None:
                    check(part)
    finally:
        _RECORD.reset(token)
    broken = [jnp.zeros(0, bool)]
    if record.numbers:
        # side by side: few operations however many numbers there are
        intervals = [interval for _, interval in record.numbers.values()]
        ends = lambda name: np.asarray([getattr(one, name) for one in intervals])
        values = jnp.stack([jnp.asarray(value) for value, _ in record.numbers.values()])
        above = (values > ends("low")) | ((values == ends("low")) & ends("low_allowed"))
        below = (values < ends("high")) | ((values == ends("high")) & ends("high_allowed"))
        broken.append(~(above & below))
    if record.rules:
        broken.append(~jnp.stack(list(record.rules.values())))
    flags = jnp.concatenate(broken)
    return InputChecks((*record.numbers, *record.rules), flags, ~jnp.any(flags))


def void(tree: Any, valid: Bool[Array, ""]) -> Any:
    """The tree with NaN for every number where the inputs are not valid: a solve of it ends at once."""
    return jax.tree.map(lambda leaf: jnp.where(valid, as_float(leaf), jnp.nan), tree)


def gate(tree: Any, valid: Bool[Array, ""]) -> Any:
    """The tree, whose traced numbers pass no derivative where the inputs are not valid: what is computed from them is
    NaN, and NaN times zero must not reach a number that lanes share."""

    def passed(leaf: Any) -> Any:
        return jnp.where(valid, leaf, jax.lax.stop_gradient(leaf)) if isinstance(leaf, Tracer) else leaf

    return jax.tree.map(passed, tree)


def _parts(node: Any, path: str) -> Iterator[tuple[str, eqx.Module]]:
    """Every module of a tree with its dotted path."""
    if isinstance(node, eqx.Module):
        inner = [(field.name, getattr(node, field.name, None)) for field in dataclasses.fields(node)]
    elif isinstance(node, dict):
        inner = list(node.items())
    elif isinstance(node, list | tuple):
        inner = list(enumerate(node))
    else:
        return
    for name, value in inner:
        yield from _parts(value, f"{path}.{name}" if path else str(name))
    # what is inside first: a part that looks at numbers of its own parts would name a consequence
    if isinstance(node, eqx.Module):
        yield path, node

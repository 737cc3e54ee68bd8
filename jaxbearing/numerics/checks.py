"""Checks of the user's input: a wrong known number raises an error, a wrong traced number sets a flag.

Each check is stated once. A class states the bounds of single numbers on its fields (`bounded`, `_scene.number`), and
the rules between several numbers in `__check_init__` (`demand`). Known numbers are checked when the object is made. A
traced number has no value at that time: `check_inputs` runs the same checks again while the equations are traced, and
returns one flag for each check. In a batch every lane (one member of the batch) has flags of its own.
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

from .._types import Tree
from .gates import derivatives_if
from .precision import as_float
from .ranges import RANGES, Interval
from .refusals import is_collecting, refuse_all
from .structure import Hinting

STAND_IN = jax.ShapeDtypeStruct((), np.dtype(np.float64))
"""Placeholder for a number that failed its check, while problems are collected (`refusals.collecting`). A rule that
needs the number meets the placeholder and is passed over."""


class _Record:
    """Traced checks, collected while `check_inputs` walks through a scene."""

    def __init__(self) -> None:
        self.path = ""
        """Dotted path of the part that is being checked."""
        self.numbers: dict[str, tuple[Tracer, Interval]] = {}
        """Check of one number in words -> the number and its allowed values."""
        self.rules: dict[str, Array] = {}
        """Rule about several numbers in words -> True where it holds."""


_RECORD: ContextVar[_Record | None] = ContextVar("record of traced checks", default=None)


def label(unit: str, description: str) -> dict[str, str]:
    """Metadata of a field: its SI unit and its description."""
    return {"unit": unit, "description": description}


def bounded(bound: str, *, unit: str = "", difference: bool = False, name: str = "", **kwargs: Any) -> Any:
    """Field of a `Checked` class that holds one number within a bound. Scene files read the number according to the
    metadata stored here (`scenes.table_of`).

    **Arguments:**
    - `bound`: a key of `RANGES`.
    - `unit`: SI unit, "1" for a number without a unit; left out if `metadata` is a `label`, which holds the unit.
    - `difference`: True if a number in K is a difference of temperatures.
    - `name`: name of the field in scene files, if it is not the attribute's.
    - `kwargs`: further arguments of `equinox.field`.
    """
    assert bound in RANGES, bound
    metadata = {"bound": bound, "name": name, "difference": difference}
    if unit:
        metadata |= label(unit, "")
    kwargs["metadata"] = {**metadata, **kwargs.get("metadata", {})}
    return eqx.field(**kwargs)


class Checked(Hinting):
    """A part of a scene whose fields state their bounds.

    **Raises:** `ValueError` on construction, for a known number outside its bound; `Refusals` if several are. While
    problems are collected (`refusals.collecting`) nothing is raised: the problem is kept, and `STAND_IN` takes the
    place of the number.
    """

    part: ClassVar[str] = ""
    """Name of the table of a scene file that holds the fields; messages use it."""

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
                    # rules that need this number are passed over
                    object.__setattr__(self, name, STAND_IN)
            return
        require(part, **checks)


def _is_number(value: object) -> bool:
    """True for a number, known or traced, but not for a truth value."""
    if isinstance(value, bool) or getattr(value, "dtype", None) == np.bool_:
        return False
    return isinstance(value, int | float | np.generic | np.ndarray | jax.Array | Tracer)


def numbers_or_none(*values: object) -> tuple[Any, ...] | None:
    """The values, known or traced; `None` if one is missing or is a placeholder (as in transformations of trees)."""
    return values if all(_is_number(value) for value in values) else None


def known(*values: Any) -> tuple[float, ...] | None:
    """The values as floats; `None` if one is traced, missing or a placeholder."""
    if numbers_or_none(*values) is None or any(isinstance(value, Tracer) for value in values):
        return None
    return tuple(float(v) for v in values)


def array_module(*values: object) -> Any:
    """The module whose functions take these values: `jax.numpy` if one is traced, else `numpy`. Rules that need a sine
    or a root call it."""
    return jnp if any(isinstance(value, Tracer) for value in values) else np


def require(part: str, **checks: tuple[Any, str]) -> None:
    """Checks single numbers. `None` passes; a traced value is left to `check_inputs`.

    **Arguments:**
    - `part`: dotted path of the part that holds the fields, for messages; may be empty.
    - `checks`: field name -> (value, key of `RANGES`).

    **Raises:** `ValueError` that names part, field, value and what is allowed; `Refusals` if several are wrong.
    """
    refuse_all(_refused(part, checks))


def _refused(part: str, checks: dict[str, tuple[Any, str]]) -> Iterator[str]:
    """Yields one sentence for each wrong known value, and records the traced values for `check_inputs`."""
    record = _RECORD.get()
    for name, (value, allowed) in checks.items():
        field = f"{part}.{name}" if part else name
        if value is None:
            continue
        if np.ndim(value):
            words = f"an array of shape {np.shape(value)}" if isinstance(value, Tracer) else repr(value)
            yield f"{field} must be one number, got {words}"
            continue
        # an object with a dtype that is no array is a placeholder (`jax.ShapeDtypeStruct`)
        if not _is_number(value) and getattr(value, "dtype", np.bool_) == np.bool_:
            yield f"{field} must be one number, got {value!r}"
            continue
        if isinstance(value, Tracer):
            if record is not None:
                record.numbers[f"{field} must be {allowed}"] = (value, RANGES[allowed])
            continue
        number = known(value)
        if number is not None and not RANGES[allowed].holds(number[0]):
            yield f"{field} must be {allowed}, got {number[0]:g}"


def demand(rule: str, fine: object, message: Callable[[], str]) -> None:
    """Checks a rule about several numbers.

    **Arguments:**
    - `rule`: the rule in words; it begins with the dotted path of a field, where `{path}` stands for that of the part.
    - `fine`: True if the rule holds, otherwise False, also if a number is NaN. A traced value is left to
      `check_inputs`, which collects it.
    - `message`: returns the text of the error, for known numbers that break the rule.

    **Raises:** `ValueError` if the rule is known not to hold.
    """
    if isinstance(fine, Tracer):
        record = _RECORD.get()
        if record is not None:
            text = rule.format(path=record.path or "the part")
            record.rules[text] = record.rules[text] & fine if text in record.rules else fine
    elif not bool(fine):
        raise ValueError(message())


def is_recording() -> bool:
    """True inside of `check_inputs`."""
    return _RECORD.get() is not None


class InputChecks(NamedTuple):
    """Checks of traced inputs: `rules` in words, `broken` for each of them, `valid` if none is broken."""

    rules: tuple[str, ...]
    broken: Bool[Array, " rule"]
    valid: Bool[Array, ""]


def check_inputs(scene: object) -> InputChecks:
    """Runs the checks of a scene and of all its parts again and collects the results for traced numbers.

    **Raises:** `ValueError` for a known number that breaks a rule.
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
        # one comparison of arrays: the program does not grow with the number of checks
        intervals = [interval for _, interval in record.numbers.values()]
        ends = lambda name: np.asarray([getattr(interval, name) for interval in intervals])
        values = jnp.stack([jnp.asarray(value) for value, _ in record.numbers.values()])
        above = (values > ends("low")) | ((values == ends("low")) & ends("low_allowed"))
        below = (values < ends("high")) | ((values == ends("high")) & ends("high_allowed"))
        broken.append(~(above & below))
    if record.rules:
        broken.append(~jnp.stack(list(record.rules.values())))
    flags = jnp.concatenate(broken)
    return InputChecks((*record.numbers, *record.rules), flags, ~jnp.any(flags))


def nan_unless(tree: Tree, valid: Bool[Array, ""]) -> Tree:
    """Replaces every number of the tree by NaN if the inputs are not valid. Newton's iteration ends at a NaN at
    once."""
    return jax.tree.map(lambda leaf: jnp.where(valid, as_float(leaf), jnp.nan), tree)


def gate(tree: Tree, valid: Bool[Array, ""]) -> Tree:
    """Returns the tree with the same values. If the inputs are not valid, the derivatives with respect to its traced
    numbers are 0."""
    traced, others = eqx.partition(tree, lambda leaf: isinstance(leaf, Tracer))
    return eqx.combine(derivatives_if(valid, traced), others)


def _parts(node: object, path: str) -> Iterator[tuple[str, eqx.Module]]:
    """Yields every module of a tree with its dotted path, inner modules first."""
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
    # an outer rule that uses a wrong inner number would report a consequence and not the cause
    if isinstance(node, eqx.Module):
        yield path, node

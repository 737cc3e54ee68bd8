"""Base of all scenes: fields that hold numbers with a label, and copies with other values."""

import abc
import dataclasses
from collections.abc import Callable, Mapping
from typing import Any, ClassVar, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from ._checks import Checks, as_note, in_groups
from ._derived import derived as derived
from ._derived import derived_part as derived_part
from ._shown import Shown
from .numerics.arguments import did_you_mean
from .numerics.checks import InputChecks, bounded, check_inputs, gate, nan_unless
from .numerics.checks import label as label
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float
from .numerics.status import SolveError, Status

Scene = TypeVar("Scene", bound="AbstractScene")
Result = TypeVar("Result", bound="AbstractSolution")
SIMULATED = (
    "a bearing with [thermal], a ball or cylindrical roller bearing with contact.traction (laws = 'best' has it), or a "
    "line contact"
)
"""Scenes with a transient run, in words."""
OF_A_BATCH = "this is a batch of solutions: take one lane of it first, jax.tree.map(lambda leaf: leaf[lane], solution)"


def number(default: object = dataclasses.MISSING, *, bound: str = "finite", **kwargs: Any) -> Any:
    """Field of a scene that holds one number, converted to a float64 leaf. Further arguments: those of
    `numerics.checks.bounded`."""
    if default is not dataclasses.MISSING:
        kwargs["default"] = default
    return bounded(bound, converter=as_float, **kwargs)


def optional_number(*, bound: str = "finite", **kwargs: Any) -> Any:
    """Like `number`, `None` where the scene does not say."""
    return bounded(bound, converter=lambda v: None if v is None else as_float(v), default=None, **kwargs)


class AbstractScene(Shown):
    """Base of scenes. It makes copies with other values; a dotted path of attributes names each value.

    A class of scenes overrides the methods that its kind supports. `jb.solve`, `jb.simulate`, the command line and the
    report call these methods and need no list of kinds.
    """

    kind: ClassVar[str] = ""
    """Kind of the scene, as `kind` in scene files has it."""
    operating_point: ClassVar[str] = "operation"
    """Name of the field that holds the operating point."""

    def steady_solution(self, options: NewtonOptions) -> "AbstractSolution":
        """The steady state, traced inside the program of `jb.solve`; pure, and never raises for a failed solve.

        **Arguments:** `options`: `NewtonOptions`, of those kinds that have unknowns.

        **Raises:** `TypeError` for a kind of scene without one.
        """
        raise TypeError(f"cannot solve a {type(self).__name__}: its class has no method steady_solution")

    runs_in_programs: ClassVar[bool] = False
    """True if a transient run can be a part of a program, see `jaxbearing.simulate_batch`."""

    def simulated(self, duration: float | None, **settings: Any) -> "AbstractHistory":
        """A transient run; `jaxbearing.simulate` says what it takes, and checks the scene.

        **Raises:** `TypeError` for a kind of scene that does not move.
        """
        raise TypeError(f"cannot simulate a {type(self).__name__}: its class has no method simulated")

    def simulated_batch(self, duration: float, over: Mapping[str, object], **settings: Any) -> "AbstractHistory":
        """Many transient runs; `jaxbearing.simulate_batch` says what it takes.

        **Raises:** `TypeError` for a kind of scene whose runs are no programs.
        """
        raise TypeError(f"cannot simulate a {type(self).__name__}: its class has no method simulated_batch")

    def check_restart(self, restart: object, duration: float | None = None) -> None:
        """Checks the state from which a run of this scene is to go on.

        **Raises:** `ValueError` where it does not fit; `TypeError` for a kind of scene that does not move.
        """
        raise TypeError(f"cannot simulate a {type(self).__name__}: its class has no method check_restart")

    def replace(self: Scene, changes: object) -> Scene:
        """A copy with other values; keys are dotted paths, values SI numbers (or parts).

        **Raises:** `AttributeError` for a path that the scene does not have; `TypeError` for what is no mapping.
        """
        if not isinstance(changes, Mapping) or not all(isinstance(path, str) for path in changes):
            raise TypeError(f"replace takes a mapping from dotted paths to values, got {changes!r}")
        return _replaced(self, {tuple(path.split(".")): value for path, value in changes.items()})

    def part_at(self, path: str) -> Any:
        """The number or part at a dotted path; `None` where there is none."""
        part: Any = self
        for name in path.split("."):
            part = getattr(part, name, None)
        return part

    def path_in_file(self, path: str) -> str:
        """The path that a number has in a scene file. **Arguments:** `path`: dotted path of the attributes that lead to
        the number. Both are the same here; a shaft, whose parts are numbered lists, has names in files."""
        return path

    def at_operation(self: Scene, **changes: Any) -> Scene:
        """A copy at another operating point: `scene.at_operation(inner_speed=1100.0)`."""
        return self.replace({f"{self.operating_point}.{name}": value for name, value in changes.items()})

    def replace_geometry(self: Scene, **changes: Any) -> Scene:
        """A copy with other dimensions: `scene.replace_geometry(diametral_clearance=30e-6)`."""
        return self.replace({f"geometry.{name}": value for name, value in changes.items()})


class AbstractSolution(Shown):
    """Interface of all results of a solve: `status`; `checks`, text -> True if an input is out of its
    bound or a law is used beyond its range; `notes`, what the model assumed or left out."""

    status: eqx.AbstractVar[Int[Array, "..."]]
    checks: eqx.AbstractVar[Mapping[str, Bool[Array, ""]]]
    notes: eqx.AbstractVar[tuple[str, ...]]

    @property
    @abc.abstractmethod
    def converged(self) -> Bool[Array, "*batch"]:
        """True if there is a result."""

    @abc.abstractmethod
    def solver_failure(self) -> str:
        """One sentence on a solve that failed, whose inputs were valid."""

    def failure(self) -> str:
        """One sentence on a solve that failed (one solution only)."""
        broken = self.broken_rules
        if broken:
            return f"{Status.INVALID_INPUT.text}: {'; '.join(broken)}"
        return self.solver_failure()

    @property
    def broken_rules(self) -> list[str]:
        """The rules that inputs break (one solution only)."""
        if not isinstance(self.checks, Checks):
            return []
        if np.ndim(self.checks.broken) > 1:
            raise ValueError(OF_A_BATCH)
        return [rule for rule, flag in zip(self.checks.rules, np.asarray(self.checks.broken), strict=True) if flag]

    @property
    def range_checks(self) -> Mapping[str, Any]:
        """The entries of `checks` about the ranges of laws."""
        return self.checks.ranges if isinstance(self.checks, Checks) else self.checks

    @property
    def warnings(self) -> list[str]:
        """The warnings in words (one solution only), in three groups: what to act on, broken rules first; what was
        assumed (`_checks.Assumed`); information (`_checks.Information`).

        **Raises:** `ValueError` for a batch of solutions, as do `failure` and `broken_rules`.
        """
        if any(np.ndim(broken) for broken in self.range_checks.values()):
            raise ValueError(OF_A_BATCH)
        left = [text for text, broken in self.range_checks.items() if bool(broken)]
        act, assumed, information = in_groups([*self.broken_rules, *left, *map(as_note, self.notes)])
        return [*act, *assumed, *information]

    def raise_if_failed(self) -> None:
        """Raises if this solve failed. It does nothing while JAX traces; look at `status` then.

        **Raises:** `SolveError` for a single failed solve.
        """
        try:
            failed = not bool(self.converged)
        except jax.errors.ConcretizationTypeError:
            return
        if failed:
            numbers = jax.lax.stop_gradient(self)  # those that are differentiated have no digits to print
            raise SolveError(numbers.failure(), Status(int(np.max(np.asarray(self.status)))))


def only_if(scene: Scene, valid: Bool[Array, ""]) -> Scene:
    """The scene if `valid`. Otherwise its operating point is NaN, so that iterations end at their first step, and the
    derivatives by all its numbers are 0, so that no NaN is carried back into numbers that lanes of a batch share."""
    return _at_nan_unless(gate(scene, valid), valid)


def _at_nan_unless(scene: Scene, valid: Bool[Array, ""]) -> Scene:
    point = nan_unless(getattr(scene, scene.operating_point), valid)
    return dataclasses.replace(scene, **{scene.operating_point: point})


def with_checked_inputs(scene: Scene, compute: Callable[[Scene], Result]) -> Result:
    """Result of `compute` for a scene, with checks of its inputs. With an invalid input the operating point is NaN, so
    that iterations end at their first step. Rules that `compute` found broken itself stay beside them."""
    inputs = check_inputs(scene)
    gated = gate(scene, inputs.valid)
    solution = compute(_at_nan_unless(gated, inputs.valid))
    return dataclasses.replace(
        solution,
        status=jnp.where(inputs.valid, solution.status, int(Status.INVALID_INPUT)),
        operation=getattr(gated, scene.operating_point),
        checks=Checks(dict(solution.range_checks), *_with_rules(solution.checks, inputs)),
    )


def _with_rules(
    checks: Mapping[str, Bool[Array, ""]], inputs: InputChecks
) -> tuple[Bool[Array, " rule"], tuple[str, ...]]:
    """The rules of the inputs, and those that the checks of a solution have already, which count if the inputs are
    valid: they meet NaN otherwise."""
    if not isinstance(checks, Checks):
        return inputs.broken, inputs.rules
    return jnp.concatenate([inputs.broken, checks.broken & inputs.valid]), (*inputs.rules, *checks.rules)


class AbstractHistory(AbstractSolution):
    """Interface of all results of a transient run. `time`: times of the stored instants, s; `stop`: time at which the
    run was to end, s; `accepted`: number of steps taken; `interrupted`: True if a person ended it."""

    time: eqx.AbstractVar[Float[Array, " time"]]
    stop: eqx.AbstractVar[Float[Array, ""]]
    accepted: eqx.AbstractVar[Int[Array, ""]]
    interrupted: eqx.AbstractVar[bool]

    @property
    def converged(self) -> Bool[Array, "*batch"]:
        """True if the run reached its end."""
        return jnp.asarray(self.status) == Status.CONVERGED

    @property
    def completed(self) -> bool:
        """True if the run reached its end (one run only)."""
        return bool(self.converged)

    def early_end(self, unit: str = "ms", cause: str = "", state: str = "") -> str:
        """One sentence on a run that stopped early (one run only).

        **Arguments:** `unit` of the times, "s" or "ms"; `cause`: what ended it; `state`: in which state.
        """
        reached, stop = (float(end) * {"s": 1.0, "ms": 1e3}[unit] for end in (self.time[-1], self.stop))
        why = "interrupted" if self.interrupted else Status(int(self.status)).text
        where = f"{reached:.6g} {unit} of {stop:.6g} {unit}, after {int(self.accepted)} steps"
        return f"{why}: {cause}the run stopped at {where}{state}; what was computed until then is kept"


def _replaced(part: object, changes: dict[tuple[str, ...], Any], above: str = "") -> Any:
    """The part rebuilt once with all changes, so that what is validated is the result and no state in between."""
    fields = {field.name: field for field in dataclasses.fields(part)} if isinstance(part, eqx.Module) else {}
    new: dict[str, Any] = {}
    inner: dict[str, dict[tuple[str, ...], Any]] = {}
    for path, value in changes.items():
        if not isinstance(part, eqx.Module) or path[0] not in fields:
            whole, there = above + ".".join(path), ", ".join(fields) or "no fields"
            near = did_you_mean(path[0], fields, above)
            raise AttributeError(f"the scene has no {whole!r}: {type(part).__name__} has {there}{near}")
        if len(path) == 1:
            new[path[0]] = value
        else:
            inner.setdefault(path[0], {})[path[1:]] = value
    for name, value in new.items():
        old = getattr(part, name)
        if isinstance(value, Mapping) and "part" in fields[name].metadata:
            continue  # the field makes a part of it
        if isinstance(old, eqx.Module) and not (value is None or isinstance(value, eqx.Module)):
            whole = ".".join([*filter(None, [above.rstrip(".")]), name])
            raise TypeError(f"{whole} must be a part such as {type(old).__name__}, got {value!r}")
    for name, deeper in inner.items():
        old = new.get(name, getattr(part, name))
        if old is None and "part" in fields[name].metadata and all(len(path) == 1 for path in deeper):
            new[name] = {path[0]: value for path, value in deeper.items()}  # the field makes a part of it
        else:
            new[name] = _replaced(old, deeper, f"{above}{name}.")
    if not isinstance(part, eqx.Module):
        return part
    # a part that holds another one twice changes both
    tied = getattr(part, "tied", None)
    return dataclasses.replace(part, **(new if tied is None else tied(new)))

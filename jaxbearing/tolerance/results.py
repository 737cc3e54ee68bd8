"""Which results of a solution are looked at, and their labels."""

import dataclasses
import functools
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from .._derived import derived_parts, derived_results
from ..bearings.operation import LOAD_FIELDS, AbstractOperation
from ..report.labels import dimensions
from ..scenes.errors import nearest

DEFAULT = (
    "fit.clearance",
    "fit.contact_angle",
    "fit.axial_shift",
    "elements.contact_angle_inner[0]",
    "elements.pressure_inner[0]",
    "ring.axial",
    "ring.radial",
    "power_loss.total",
    "life.L10r",
    "life.Lnmr",
    "film.central",
    "traction_coefficient",
)
"""Results that are looked at where none is named, as far as a scene has them."""
_NAME = re.compile(r"(?P<name>[A-Za-z_][\w.]*)(?:\[(?P<place>[0-9]{1,6})\])?")


class Label(NamedTuple):
    """Unit and description of a result, its name in data sets, and its place there."""

    unit: str
    description: str
    variable: str
    place: int | None


def values_of(solution: Any, names: Sequence[str]) -> dict[str, jax.Array]:
    """Results of a solution, each one number."""
    return {name: _value(solution, *_parted(name)) for name in names}


def names_in(solution: Any, wanted: Sequence[str] | None) -> tuple[str, ...]:
    """The results that are looked at: those that are wanted by their path or by their name in data sets, or `DEFAULT`.

    **Raises:** `ValueError` for one that the solution does not have, and for one that is not one number.
    """
    known = dict(_known(solution))
    if wanted is None:
        found = tuple(name for name in (*DEFAULT, *_forces(solution)) if _there(solution, name, known))
        if not found:
            raise ValueError("results: found none of those that are usual in this scene; expected names of results")
        return found
    return tuple(dict.fromkeys(_resolved(solution, text, known) for text in wanted))


def labels_of(solution: Any, names: Sequence[str]) -> dict[str, Label]:
    """Labels of results that a solution has."""
    known, found = dict(_known(solution)), {}
    for name in names:
        path, place = _parted(name)
        said = known[path]
        words = said["description"] if place is None else f"{said['description']}, {said['dims'][0]} {place}"
        found[name] = Label(_unit(said, place), words, variable_of(path), place)
    return found


def paths_of(solution: Any) -> tuple[str, ...]:
    """Paths of all results of a solution."""
    return tuple(path for path, _ in _known(solution))


def variable_of(path: str) -> str:
    """Name of a result in data sets."""
    return path.removeprefix("elements.").replace(".", "_")


def _unit(said: Mapping[str, Any], place: int | None) -> str:
    if said["dims"] == ("freedom",) and place is not None:
        from ..bearings.solution import force_units

        return force_units()[place]
    return said["unit"]


def _known(part: Any, above: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Path and label of every result; those that follow from others are not computed for it."""
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if dataclasses.is_dataclass(value):
            yield from _known(value, f"{above}{field.name}.")
        elif value is not None and field.metadata.get("description"):
            yield above + field.name, {**field.metadata, "dims": dimensions(field.type)}
    for name, one in derived_parts(type(part)).items():
        for field in dataclasses.fields(one.kind):
            yield f"{above}{name}.{field.name}", {**field.metadata, "dims": dimensions(field.type)}
    for name, one in derived_results(type(part)).items():
        yield above + name, {**one.metadata, "dims": dimensions(one.annotation)}


def _parted(name: str) -> tuple[str, int | None]:
    parted = _NAME.fullmatch(name)
    assert parted is not None, name
    place = parted["place"]
    return parted["name"], None if place is None else int(place)


def _value(solution: Any, path: str, place: int | None) -> Any:
    value = functools.reduce(getattr, path.split("."), solution)
    return value.reshape(()) if place is None else value[place]


def _there(solution: Any, name: str, known: Mapping[str, Any]) -> bool:
    """True if one of the usual results is one of this scene."""
    path, place = _parted(name)
    if path not in known or (known[path]["dims"] == () and place is not None):
        return False
    if path == "power_loss.total":
        # a total of no part at all is no result
        return any(value is not None for part, value in vars(solution.power_loss).items() if part != "total")
    if path == "fit.axial_shift" and solution.fit.clearance is not None:
        # the play of tapered bearings only
        return False
    value = functools.reduce(getattr, path.split("."), solution)
    return value is not None and (place is not None or value.size == 1)


def _forces(solution: Any) -> Iterator[str]:
    """Loads that the freedoms need whose displacement is given: the preload."""
    operation = getattr(solution, "operation", None)
    for place, name in enumerate(LOAD_FIELDS):
        if isinstance(operation, AbstractOperation) and operation.held_at(name) is not None:
            yield f"force[{place}]"


def _resolved(solution: Any, text: str, known: Mapping[str, Mapping[str, Any]]) -> str:
    parted = _NAME.fullmatch(text.strip())
    name = "" if parted is None else parted["name"]
    path = next((one for one in known if name in (one, variable_of(one), one.replace(".", "_"))), None)
    value = None if path is None else functools.reduce(getattr, path.split("."), solution)
    if parted is None or path is None or value is None:
        near = nearest(name, {one for path in known for one in (path, variable_of(path))}) if name else ""
        hint = f"; did you mean '{near}'?" if near else ""
        raise ValueError(f"results: found '{text}', which this scene does not have; expected a result{hint}")
    if not jnp.issubdtype(value.dtype, jnp.inexact):
        raise ValueError(f"results: found '{text}', a count; expected a result that varies smoothly")
    place, size = parted["place"], value.size
    if place is None and size != 1:
        raise ValueError(f"results: found '{text}', {size} numbers; expected one of them, '{text.strip()}[0]'")
    if place is not None and (value.ndim != 1 or int(place) >= size):
        wanted = f"a place from 0 to {size - 1}" if value.ndim == 1 else "no place: it is no list of numbers"
        raise ValueError(f"results: found '{text}'; expected {wanted}")
    return path if place is None else f"{path}[{int(place)}]"

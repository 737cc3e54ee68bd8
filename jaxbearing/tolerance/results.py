"""Choice of the results of a solution that are evaluated, and their labels."""

import dataclasses
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from .._derived import derived_parts, derived_results
from .._scene import AbstractSolution
from ..bearings.operation import LOAD_FIELDS, AbstractOperation
from ..bearings.solution import RING_FREEDOMS, force_units, stiffness_units
from ..report.labels import dimensions, variable_name
from ..scenes.errors import nearest
from ..shafts.solution import ShaftSolution

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
"""Results that are evaluated if none are named, as far as a scene has them."""
MIXED = "mixed"
"""Unit, in labels, of results whose entries have different units."""
_OF_ENTRIES = {"bearings": ("largest_load",), "sets": ("preload", "loss_force")}
"""Usual results of each bearing and set of a shaft."""
_ALONG = {"bearings": "bearing", "sets": "set"}
"""Fields of a shaft's results with one entry for each bearing or set -> their dimension in data sets."""
_SYSTEM = {"life": "system", "torque": "torque"}
"""Parts of a shaft's results -> prefix of their names in data sets."""
_NAME = re.compile(r"(?P<name>[A-Za-z_][\w.-]*)(?P<places>(?:\[[0-9]{1,6}\])*)")
_DISPLACEMENTS = ("outer", "displacement")
"""Results with mixed units that are displacements, in m and rad; all others are loads, or stiffnesses."""


class Label(NamedTuple):
    """Unit and description of a result, its name in data sets, and its place there (one number for each of its
    dimensions); `along`: dimension and name of the bearing, or set, of a shaft."""

    unit: str
    description: str
    variable: str
    place: tuple[int, ...]
    along: tuple[str, str] | None = None


def values_of(solution: AbstractSolution, names: Sequence[str]) -> dict[str, jax.Array]:
    """Results of a solution, each one number."""
    return {name: _value(solution, *_parted(name)) for name in names}


def names_in(solution: AbstractSolution, wanted: Sequence[str] | None) -> tuple[str, ...]:
    """Names of the results to evaluate: those wanted, by their path or their name in data sets, or `DEFAULT`.

    **Raises:** `ValueError` for a result that the solution does not have, and for one that is not a single number.
    """
    known = dict(_known(solution))
    if wanted is None:
        usual = (*DEFAULT, *_forces(solution), *_entry_results(solution))
        chosen = tuple(name for name in usual if _there(solution, name, known))
        if not chosen:
            raise ValueError("results: found none of those that are usual in this scene; expected names of results")
        return chosen
    return tuple(dict.fromkeys(_resolved(solution, text, known) for text in wanted))


def labels_of(solution: AbstractSolution, names: Sequence[str]) -> dict[str, Label]:
    """Labels of results that a solution has."""
    known, labels = dict(_known(solution)), {}
    for name in names:
        path, place = _parted(name)
        metadata = known[path]
        words = ", ".join(
            (metadata["description"], *(f"{_place_in_words(metadata, *pair)}" for pair in enumerate(place)))
        )
        variable, along = _data_name(solution, path)
        labels[name] = Label(_unit(path, metadata, place), words, variable, place, along)
    return labels


def _place_in_words(metadata: Mapping[str, Any], axis: int, place: int) -> str:
    along = metadata["dims"][axis]
    if metadata["unit"] == MIXED and along != "node":
        return RING_FREEDOMS[place].replace("_", " ")
    return f"{along} {place}"


def _entry_of(solution: AbstractSolution, path: str) -> tuple[str, str, str] | None:
    """Parts of a path into a shaft's results: `bearings` or `sets`, name, rest of the path; `None` for other paths."""
    table, _, rest = path.partition(".")
    entries = getattr(solution, table, None)
    if table not in _ALONG or not isinstance(entries, Mapping):
        return None
    name = max((entry for entry in entries if rest.startswith(f"{entry}.")), key=len, default=None)
    return None if name is None else (table, name, rest.removeprefix(f"{name}."))


def _data_name(solution: AbstractSolution, path: str) -> tuple[str, tuple[str, str] | None]:
    """Name of a result in data sets, and the dimension and name of its bearing or set."""
    entry = _entry_of(solution, path)
    if entry is not None:
        table, name, rest = entry
        if rest.startswith("solution.") and isinstance(solution, ShaftSolution):
            # imported here: a tolerance without samples needs no data set
            from ..report.shaft.dataset import fronts

            return f"{fronts(solution)[name]}{variable_name(rest.removeprefix('solution.'))}", None
        return f"{_ALONG[table]}_{rest.replace('.', '_')}", (_ALONG[table], name)
    part, _, rest = path.partition(".")
    if part in _SYSTEM and isinstance(getattr(solution, "bearings", None), Mapping):
        return f"{_SYSTEM[part]}_{rest.replace('.', '_')}", None
    return variable_name(path), None


def _at(solution: AbstractSolution, path: str) -> Any:
    """The result at a path."""
    entry = _entry_of(solution, path)
    if entry is not None:
        table, name, path = entry
        solution = getattr(solution, table)[name]
    for name in path.split("."):
        solution = getattr(solution, name)
    return solution


def paths_of(solution: AbstractSolution) -> tuple[str, ...]:
    """Paths of all results of a solution."""
    return tuple(path for path, _ in _known(solution))


def _unit(path: str, metadata: Mapping[str, Any], place: tuple[int, ...]) -> str:
    if not place or metadata["unit"] != MIXED:
        return metadata["unit"]
    name = path.rpartition(".")[2]
    if name == "stiffness":
        return stiffness_units()[place[0]][place[1]]
    return (("m", "m", "m", "rad", "rad") if name in _DISPLACEMENTS else force_units())[place[-1]]


def _known(part: Any, above: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Path and label of every result; derived results are not computed for this."""
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if dataclasses.is_dataclass(value):
            yield from _known(value, f"{above}{field.name}.")
        elif field.name in _ALONG and isinstance(value, Mapping):
            for name, entry in value.items():
                yield from _known(entry, f"{above}{field.name}.{name}.")
        elif value is not None and field.metadata.get("description"):
            yield above + field.name, {**field.metadata, "dims": dimensions(field.type)}
    for name, entry in derived_parts(type(part)).items():
        for field in dataclasses.fields(entry.kind):
            yield f"{above}{name}.{field.name}", {**field.metadata, "dims": dimensions(field.type)}
    for name, entry in derived_results(type(part)).items():
        yield above + name, {**entry.metadata, "dims": dimensions(entry.annotation)}


def _parted(name: str) -> tuple[str, tuple[int, ...]]:
    parted = _NAME.fullmatch(name)
    assert parted is not None, name
    return parted["name"], tuple(int(digits) for digits in re.findall("[0-9]+", parted["places"]))


def _value(solution: AbstractSolution, path: str, place: tuple[int, ...]) -> Any:
    value = _at(solution, path)
    return value[place] if place else value.reshape(())


def _there(solution: Any, name: str, known: Mapping[str, Any]) -> bool:
    """True if this scene has one of the usual results, given by its name."""
    path, place = _parted(name)
    if path not in known or (known[path]["dims"] == () and place):
        return False
    if path == "power_loss.total":
        # a total without any part is not a result
        return any(value is not None for part, value in vars(solution.power_loss).items() if part != "total")
    if path == "fit.axial_shift" and solution.fit.clearance is not None:
        # the play of tapered bearings only
        return False
    value = _at(solution, path)
    return value is not None and (bool(place) or value.size == 1)


def _forces(solution: AbstractSolution) -> Iterator[str]:
    """Names of the loads, such as a preload, that hold degrees of freedom with a prescribed displacement."""
    operation = getattr(solution, "operation", None)
    for place, name in enumerate(LOAD_FIELDS):
        if isinstance(operation, AbstractOperation) and operation.held_at(name) is not None:
            yield f"force[{place}]"


def _entry_results(solution: AbstractSolution) -> Iterator[str]:
    """Usual results of the bearings and sets of a shaft."""
    for table, names in _OF_ENTRIES.items():
        entries = getattr(solution, table, None)
        for entry in entries if isinstance(entries, Mapping) else ():
            yield from (f"{table}.{entry}.{name}" for name in names)


def _path_of(text: str, known: Mapping[str, object]) -> str | None:
    """Path of the result that a text names, without its places; `None` for any other text."""
    parted = _NAME.fullmatch(text.strip())
    name = "" if parted is None else parted["name"]
    return next((path for path in known if name in (path, variable_name(path), path.replace(".", "_"))), None)


def is_result(solution: AbstractSolution, text: str) -> bool:
    """True if the text names a result that varies smoothly, with or without places of an array. A result that this
    scene does not model counts too."""
    path = _path_of(text, dict(_known(solution)))
    if path is None:
        return not_modelled(solution, text)
    return _varies(_at(solution, path))


def _varies(value: Any) -> bool:
    """True for an array of real numbers, and not for a count or a word."""
    return hasattr(value, "dtype") and bool(jnp.issubdtype(value.dtype, jnp.inexact))


def not_modelled(solution: AbstractSolution, text: str) -> bool:
    """True for the path of a result in a part that other scenes of this kind have, but not this one."""
    part: Any = solution
    for name in text.strip().split("."):
        if not dataclasses.is_dataclass(part) or name not in {field.name for field in dataclasses.fields(part)}:
            return False
        part = getattr(part, name)
        if part is None:
            return True
    return False


def _resolved(solution: AbstractSolution, text: str, known: Mapping[str, Mapping[str, object]]) -> str:
    path = _path_of(text, known)
    value = None if path is None else _at(solution, path)
    if path is None or value is None:
        near = nearest(
            text.strip().partition("[")[0], {spelling for path in known for spelling in (path, variable_name(path))}
        )
        hint = f"; did you mean '{near}'?" if near else ""
        raise ValueError(f"results: found '{text}', which this scene does not have; expected a result{hint}")
    if not _varies(value):
        raise ValueError(f"results: found '{text}', a count; expected a result that varies smoothly")
    place = _parted(text.strip())[1]
    if not place and value.size != 1:
        entry = f"{text.strip()}{'[0]' * value.ndim}"
        raise ValueError(f"results: found '{text}', {value.size} numbers; expected one of them, '{entry}'")
    if place and len(place) != value.ndim:
        raise ValueError(f"results: found '{text}'; expected {value.ndim or 'no'} place{'s' * (value.ndim != 1)}")
    for index, size in zip(place, value.shape, strict=True) if place else ():
        if index >= size:
            raise ValueError(f"results: found '{text}'; expected a place from 0 to {size - 1}")
    return path + "".join(f"[{number}]" for number in place)

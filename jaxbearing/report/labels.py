"""The labels of results: units and dimensions."""

import dataclasses
import re
import typing
from collections.abc import Iterator, Mapping
from typing import Any

from .._derived import derived_parts, derived_results

_FACTOR = re.compile(r"([A-Za-z]+)(?:\^([2-9]))?")


def udunits(unit: str) -> str:
    """A unit of the labels in the notation of UDUNITS and the CF conventions: "m^3/s" becomes "m3 s-1". Units with a
    fractional power, which that notation lacks, stay unchanged: "N/m^(10/9)".

    **Raises:** `ValueError` if the text is not a product of unit powers, possibly divided by further units.
    """
    if "^(" in unit:
        return unit
    over, *under = unit.split("/")
    factors = [(factor, "") for factor in over.split(" ") if over != "1"] + [(factor, "-") for factor in under]
    powers = []
    for factor, sign in factors:
        parted = _FACTOR.fullmatch(factor)
        if parted is None:
            raise ValueError(f"unit {unit!r}: {factor!r} is not a unit with a power, as in 'm^3'")
        powers.append(f"{parted[1]}{sign}{parted[2] or ('1' if sign else '')}")
    return " ".join(powers) or "1"


def label_unit(units: str) -> str:
    """Inverse of `udunits`: converts the unit of a data set, "m3 s-1", to the notation of the labels, "m^3/s"."""
    powers = [re.fullmatch(r"([A-Za-z]+)(-?)([2-9]?)1?", factor) for factor in units.split()]
    if not powers or any(power is None for power in powers):
        return units
    named = [(f"{power[1]}^{power[3]}" if power[3] else power[1], power[2]) for power in powers if power is not None]
    over = " ".join(name for name, under in named if not under) or "1"
    return over + "".join(f"/{name}" for name, under in named if under)


def variable_name(path: str) -> str:
    """Name of a result in a data set."""
    return path.removeprefix("elements.").replace(".", "_")


def labelled(part: Any, above: str = "") -> Iterator[tuple[str, Any, Mapping[str, Any]]]:
    """Path, value and label of every result, at any depth: labelled fields first, then results derived from them.

    The label is the metadata of the field plus `dims`, the names of the dimensions of one result (see `dimensions`),
    and `derived`, true for results derived from others.
    """
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if dataclasses.is_dataclass(value):
            yield from labelled(value, f"{above}{field.name}.")
        elif value is not None and field.metadata.get("description"):
            yield above + field.name, value, {**field.metadata, "dims": dimensions(field.type), "derived": False}
    for name in derived_parts(type(part)):
        if (value := getattr(part, name)) is not None:
            yield from labelled(value, f"{above}{name}.")
    for name, result in derived_results(type(part)).items():
        if (value := getattr(part, name)) is not None:
            yield above + name, value, {**result.metadata, "dims": dimensions(result.annotation), "derived": True}


def dimensions(annotation: object) -> tuple[str, ...]:
    """Names of the dimensions in an annotation: `time` and `node` for `Float[Array, "time node"] | None`, none for a
    number. Batch dimensions, `*batch`, are left out, because they are not dimensions of one result."""
    shape = getattr(annotation, "dim_str", None)
    if shape is not None:
        return tuple(name.partition("=")[0] for name in shape.split() if not name.startswith("*"))
    return next((names for argument in typing.get_args(annotation) if (names := dimensions(argument))), ())

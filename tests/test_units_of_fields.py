"""Every number that a public class holds says its unit and what it is, and a clearance which one it is."""

import dataclasses
import importlib
import inspect
import pkgutil
import re
import typing

import equinox as eqx

PACKAGES = ("lubricants", "contacts", "gaps", "bearings", "life", "machines", "ehl", "thermal")
MODULES = ("materials", "time_laws", "sensitivity")
INSIDE = {
    *("ball.arched", "ball.core", "ball.equations", "ball.lubricated", "ball.motion", "ball.pairs", "ball.springs"),
    *("ball.state", "ball.system", "cylindrical.equations", "cylindrical.forces", "cylindrical.kinematics"),
    *("cylindrical.loads", "cylindrical.motion", "cylindrical.row", "cylindrical.thrust", "cylindrical.tilting"),
    *("motion.history", "tapered.row", "tapered.system", "equations", "linear", "steady", "stepping"),
}
"""Modules and packages, below `bearings` and `ehl`, of what the solvers make of a scene: quantities inside a solve."""
KINDS = re.compile(r"\b(diametral|radial|axial|circumferential|total)\b", re.IGNORECASE)
UNIT = re.compile(
    r"(?<![\w/'])(1/Pa|1/K|1/s|m\^3/s|m\^2/s|kg/m\^3|kg/\(m\^3 K\)|W/\(m K\)|W/\(m K\^2\)|N m/rad|N m|N/m|rad/s|m/s"
    r"|W/K|J/K|J/\(kg K\)|m/Pa|K/Pa|K\^2/Pa|Pa s|kg m\^2|Pa|GPa|rad|Hz|kg|mm|K|N|W|m|s|h|1)(?![\w/])"
)
PLAIN = re.compile(
    r"\b(d ln|number|ratio|fraction|part|factor|coefficient|exponent|count|share|relative|dimensionless|conformity"
    r"|per cent|percent|whether|slip|sign|nodes|steps|laminae|half widths|over|mask|index|status)\b",
    re.IGNORECASE,
)
"""Words that say that a number has no unit."""


def numbers(kind):
    """Fields of a class that hold a number or an array of numbers."""
    hints = typing.get_type_hints(kind, include_extras=True)
    for field in dataclasses.fields(kind):
        parts = typing.get_args(hints[field.name]) or (hints[field.name],)
        texts = [str(part) for part in (hints[field.name], *parts)]
        leaves = any("Float[" in text or "Int[" in text for text in texts)
        if leaves or hints[field.name] in (float, int) or float in parts or int in parts:
            yield field


def public_classes():
    found = {}
    names = [f"jaxbearing.{name}" for name in MODULES]
    for package in PACKAGES:
        path = importlib.import_module(f"jaxbearing.{package}").__path__
        names += [module.name for module in pkgutil.walk_packages(path, f"jaxbearing.{package}.")]
    for name in names:
        inner = name.split(".")[2:]
        if INSIDE & {".".join(inner[:length]) for length in range(1, len(inner) + 1)}:
            continue
        for kind in vars(importlib.import_module(name)).values():
            own = isinstance(kind, type) and issubclass(kind, eqx.Module) and kind.__module__ == name
            if own and not kind.__name__.startswith("_"):
                found[f"{name}.{kind.__name__}"] = kind
    return found


def entries(doc):
    """What the arguments are, one text each: "- `a`, `b`: text." in lines of their own, or "`a`, text; `b`, text."."""
    for entry in re.split(r"(?:^|\n)\s*- (?=`)", doc)[1:]:
        yield entry.partition("\n\n")[0]
    for text in re.findall(r"\*\*Arguments:\*\* (.*?)(?:\n\n|$)", doc, flags=re.DOTALL):
        yield from (entry.strip() + ": " if ": " not in entry else entry.strip() for entry in text.split(";"))


def said(kind, name):
    """Unit and text of a field: of its label, or of the line of an argument in the docstring of its class."""
    fields = getattr(kind, "__dataclass_fields__", {})
    label = fields[name].metadata if name in fields else {}
    unit = label.get("unit", "")
    if label.get("description"):
        return unit, label["description"]
    for owner in kind.__mro__:
        for doc in (owner.__doc__, vars(owner).get("__init__") and owner.__init__.__doc__):
            for entry in entries(inspect.cleandoc(doc or "")):
                if f"`{name}`" in entry.partition(": ")[0]:
                    return unit, " ".join(entry.split())
    return None


def test_fields():
    wrong, classes = [], public_classes()
    for name, field in ((name, field) for name, kind in classes.items() for field in numbers(kind)):
        found = said(classes[name], field.name)
        if found is None:
            wrong.append(f"{name}.{field.name}: nothing says what it is")
            continue
        unit, text = found
        if not unit and not UNIT.search(text) and not PLAIN.search(text):
            wrong.append(f"{name}.{field.name}: no unit in {text!r}")
        if "clearance" in field.name and not KINDS.search(f"{field.name} {text}"):
            wrong.append(f"{name}.{field.name}: diametral, radial or total? {text!r}")
    assert not wrong
    assert len(classes) > 200

"""The page of scene files: every table and field with its unit, range, default and meaning, from the schemas."""

import dataclasses
import itertools
import types
import typing

from pydantic import TypeAdapter, ValidationError

import jaxbearing.lubricants
from jaxbearing.materials import Material
from jaxbearing.scenes.fields import tables_at
from jaxbearing.scenes.inputs import described_argument
from jaxbearing.scenes.reader import KINDS, builtin_names, builtin_text, schema_of_kind
from jaxbearing.scenes.units import QuantityValidator

HEAD = """# Scene files

A scene file is TOML: `kind`, and one table for each part. A table that is left out is not modelled: it adds no unknown
and no run time. A dimensional field takes a text with a unit (`"12 mm"`, `"60degC"`); a bare number is refused with the
unit that it wants. Python takes the same names with SI numbers. This page is made from the schemas that read the files.

`required`: the field must be there when its table is. `optional`: what it stands for is then not modelled, computed
from the rest, or assumed, which the solution's notes say.

## Built-in scenes

"""


@dataclasses.dataclass(frozen=True)
class Field:
    """One line of a table of the page."""

    name: str
    unit: str
    expected: str
    default: str
    description: str


def page():
    """Markdown."""
    scenes = "".join(f"| `{name}` | {summary(name)} |\n" for name in builtin_names())
    parts = [HEAD + "| scene | what it is |\n|---|---|\n" + scenes]
    shared = _shared()
    for kind in KINDS:
        model, scene = schema_of_kind(kind)
        parts.append(f'## `kind = "{kind}"`')
        for name in model.model_fields:
            for table in tables_at(model, (name,)):
                if table in shared:
                    link = f"[{shared[table]}](#{_anchor(table)})"
                    parts.append(f"`[{name}]`: {link}." if name == shared[table] else "")
                else:
                    parts.append(_table(f"[{name}]", table, class_of(scene, name, table)))
    parts.append("## Tables that several kinds have")
    for table, name in shared.items():
        parts.append(_table(_title(name, table), table, _class_of_shared(name, table), _anchor(table)))
    return "\n\n".join(part for part in parts if part) + "\n"


_NAMED = {"MaterialTable": "material"}
"""Tables that stand in fields of several names."""


def summary(scene):
    """First sentence of the comment at the head of a built-in scene."""
    comment = itertools.takewhile(lambda line: line.startswith("#"), builtin_text(scene).splitlines())
    text = " ".join(line.lstrip("# ") for line in comment)
    return text.partition(". ")[0].rstrip(".") + "."


def _shared():
    """Tables of more than one kind, and the tables inside them -> name of the field that holds them."""
    found, kinds = {}, {}
    for kind in KINDS:
        model, _ = schema_of_kind(kind)
        for name, table in _below(model):
            found.setdefault(table, _NAMED.get(table.__name__, name))
            kinds.setdefault(table, set()).add(kind)
    names = [*found.values()]
    for table, name in found.items():
        if len(kinds[table]) == 1 and names.count(name) > 1 and "law" not in table.model_fields:
            found[table] = f"{name}, {min(kinds[table])}"
    tops = {t for k in KINDS for n in schema_of_kind(k)[0].model_fields for t in tables_at(schema_of_kind(k)[0], (n,))}
    return {
        table: name
        for table, name in found.items()
        if (len(kinds[table]) > 1 or table not in tops) and not table.__name__.startswith("Unknown")
    }


def _below(model):
    for name in model.model_fields:
        for table in tables_at(model, (name,)):
            yield name, table
            yield from _below(table)


def _anchor(table):
    return f"table-{table.__name__.lower()}"


def _title(name, table):
    law = table.model_fields.get("law")
    words = typing.get_args(law.annotation) if law is not None else ()
    return f"{name}" + (f', law = "{words[0]}"' if len(words) == 1 else "")


def _table(title, model, scene_class, anchor=""):
    rows = [
        f"| `{f.name}` | {f.unit} | {f.expected} | {f.default} | {f.description} |" for f in fields(model, scene_class)
    ]
    head = f"### `{title}`" + (f" {{ #{anchor} }}" if anchor else "")
    if not rows:
        return f"{head}\n\nNo fields but `law`."
    return "\n".join([head, "", "| field | SI unit | takes | default | what it is |", "|---|---|---|---|---|", *rows])


def fields(model, scene_class):
    """The fields of a table; descriptions are those of the class that the table builds."""
    for name, info in model.model_fields.items():
        if name in ("sources", "note", "law"):
            continue
        annotation = typing.Annotated[info.annotation, *info.metadata] if info.metadata else info.annotation
        dimension = _dimension(annotation)
        unit = dimension.si if dimension else ""
        if info.is_required():
            default = "required"
        elif info.default is None:
            default = "optional"
        else:
            default = f"{str(info.default).lower() if isinstance(info.default, bool) else info.default} {unit}".strip()
        words = name.replace("_", " ")
        said = described_argument(scene_class, name) if scene_class is not None else ""
        # a field that no class has, or that its class does not explain, is explained by its table
        said = said if said and said != words else described_argument(model, name)
        text = _cell(said.removeprefix(f"{words}: ") or words)
        yield Field(name, unit, _expected(model, name, annotation, unit), default, text)


def _expected(model, name, annotation, unit):
    """What the field takes, in the words of its own refusal of what is out of its range."""
    tables = [one for one in tables_at(model, (name,)) if not one.__name__.startswith("Unknown")]
    links = [f"[{one.tag.strip('<>') or 'table'}](#{_anchor(one)})" for one in tables]
    reader = TypeAdapter(annotation)
    # a value below the range, of the right kind; then what nothing takes
    for probe in (f"-1 {unit}" if unit else -1, object()):
        try:
            reader.validate_python(probe)
        except ValidationError as error:
            found = [one.get("ctx", {}).get("expected") or _PLAIN.get(one["type"], "") for one in error.errors()]
            words = dict.fromkeys(_cell(text) for text in found if text and "a table with a 'law'" not in text)
            return " or ".join([*words, *([f"a table: {', '.join(links)}"] if links else [])])
    raise ValueError(f"{model.__name__}.{name} takes anything")


_PLAIN = {"string_type": "text", "bool_type": "true or false", "float_type": "a number", "dict_type": "a table"}


def _cell(text):
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;")


def _dimension(annotation):
    for part in typing.get_args(annotation):
        if isinstance(part, QuantityValidator):
            return part.dimension
        found = _dimension(part)
        if found is not None:
            return found
    return None


def class_of(owner, name, table):
    """The class of the scene that a field of `owner` holds."""
    hint = typing.get_type_hints(owner).get(name)
    classes = [one for one in _classes(hint) if dataclasses.is_dataclass(one)]
    return classes[0] if classes else _class_of_shared(name, table)


def _classes(hint):
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return [one for part in typing.get_args(hint) for one in _classes(part)]
    return [hint] if isinstance(hint, type) else []


def _class_of_shared(name, table):
    """Tables are named after the class that they build."""
    known = {"MaterialTable": Material, **_named()}
    return known.get(table.__name__) or getattr(jaxbearing.lubricants, table.__name__.removesuffix("Table"), None)


def _named():
    from jaxbearing.bearings.cage import AbstractCage
    from jaxbearing.bearings.rating import Rating
    from jaxbearing.bearings.roller_profile import RollerProfile
    from jaxbearing.bearings.simulation import Simulation
    from jaxbearing.time_laws import Ramp, RotatingLoad, Sinusoidal

    return {
        "BearingCageTable": AbstractCage,
        "RatingTable": Rating,
        "ProfileTable": RollerProfile,
        "SimulationTable": Simulation,
        "PerturbationTable": Sinusoidal,
        "RampTable": Ramp,
        "RotatingLoadTable": RotatingLoad,
        "OilTable": jaxbearing.lubricants.Lubricant,
    }

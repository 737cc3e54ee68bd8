"""The page of scene files: every table and field with its unit, range, default and meaning, from the schemas."""

import itertools
import re
import typing
from pathlib import Path
from types import MappingProxyType

from jaxbearing.scenes.field_list import class_of, class_of_table, fields
from jaxbearing.scenes.fields import tables_at
from jaxbearing.scenes.reader import KINDS, builtin_names, builtin_text, schema_of_kind

FILE = Path(__file__).parents[1] / "scene_files.md"
"""The page is kept in the repository; `python docs/generate/scene_pages.py` writes it anew."""

HEAD = """# Scene files

A scene file is TOML: `kind`, and one table for each part. A table that is left out is not modelled: it adds no unknown
and no run time. A field with an SI unit takes a text with any unit of its kind (`"12 mm"`, `"60degC"`); a bare number
is refused with the unit that it wants. A field without one takes a bare number. Python takes the same names with SI
numbers. A field that is one number may be a distribution,
`{mean = "12 um", deviation = "2 um"}` or `{low = "5 um", high = "20 um"}`: see [Tolerances](tolerances.md).
The tables `[[state]]` are states of a [load spectrum](spectrum.md), with a share of the time and changes of any field.
The lists `[[bearing]]`, `[[set]]` and `[[force]]` of a [shaft](shafts.md) are found by their names in paths.
The table `[catalogue]` alone is no part of the scene: [makers' formulas](makers.md) take it, and no result depends on
it.
`laws = "best"` above the tables of a bearing stands for named laws, an estimated cage and drag:
[Using it](using.md#the-best-laws-with-one-word).
This page is made from the schemas that read the files.

`required`: the field must be there when its table is. `optional`: what it stands for is then not modelled, computed
from the rest, or assumed, which the solution's notes say. A table of the catalogue may be given by name: `"52100"`.

`jb.save_scene(scene, "mine.toml")` writes any scene, `jaxbearing scenes --copy SCENE --set ... --to mine.toml`
one with changes. What is read from the file is the same scene, every number to the last bit
([Using it](using.md#saving-a-scene)).

## Built-in scenes

"""


def page():
    """Markdown."""
    scenes = "".join(f"| `{name}` | {summary(name)} |\n" for name in builtin_names())
    parts = [HEAD + "| scene | what it is |\n|---|---|\n" + scenes]
    shared, earlier = _shared(), {}
    for kind in KINDS:
        model, scene = schema_of_kind(kind)
        parts.append(f'## `kind = "{kind}"`')
        for name in model.model_fields:
            for table in tables_at(model, (name,)):
                if table in shared:
                    link = f"[{shared[table]}](#{_anchor(table)})"
                    parts.append(f"`[{name}]`: {link}." if name == shared[table] else "")
                else:
                    rows = _rows(table, class_of(scene, name, table))
                    parts.append(_section(f"[{name}]", rows, "", earlier.setdefault(name, {})))
                    earlier[name] |= {row: earlier[name].get(row, kind) for row in rows.values()}
    parts.append("## Tables that several kinds have")
    for table, name in shared.items():
        parts.append(_section(_title(name, table), _rows(table, class_of_table(table)), _anchor(table)))
    return "\n\n".join(part for part in parts if part) + "\n"


_NAMED = {
    "MaterialTable": "material",
    "SectionTable": "shaft.sections",
    "BearingEntry": "bearing.NAME",
    "SetEntry": "set.NAME",
    "MemberEntry": "set.NAME.bearing.NUMBER",
    "BearingTables": "bearing",
    "MembersTables": "set.NAME.bearing",
    **{f"{one}Table": f"force.NAME, {one}" for one in ("PointLoad", "Gear", "Belt", "Mass")},
}
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


def _rows(model, scene_class):
    """Field -> its line."""
    return {
        f.name: f"| `{f.name}` | {f.unit} | {_takes(f)} | {f.default} | {_meaning(f)} |"
        for f in fields(model, scene_class)
    }


def _section(title, rows, anchor, earlier=MappingProxyType({})):
    """A heading and the lines below it. **Arguments:** `earlier`: lines that a kind above has -> this kind."""
    head = f"### `{title}`" + (f" {{ #{anchor} }}" if anchor else "")
    if not rows:
        return f"{head}\n\nNo fields but `law`."
    again = {}
    for name, row in rows.items():
        if row in earlier:
            again.setdefault(earlier[row], []).append(f"`{name}`")
    own = [row for row in rows.values() if row not in earlier]
    same = [f"As in `{kind}`: {', '.join(names)}." for kind, names in again.items()]
    table = ["| field | SI unit | takes | default | what it is |", "|---|---|---|---|---|", *own] if own else []
    return "\n\n".join(filter(None, [head, "\n".join(table), *same]))


def _takes(field):
    """Range and words, without what the head of the page says of all fields."""
    links = [f"[{one.tag.strip('<>') or 'table'}](#{_anchor(one)})" for one in field.tables]
    text = re.sub(
        r"^(a|an) | (with|without) a unit, e\.g\. '[^']*'(?=$| or|, or)|,? ?without a unit|( and|,) without quotes",
        "",
        field.expected or "",
    )
    text = re.sub(r"^material of the catalogue \(.*\) or a table with .*", "material of the catalogue", text)
    return " or ".join([*([_cell(text)] if text else []), *([", ".join(links)] if links else [])])


def _meaning(field):
    """The meaning of a field; empty if its name says as much."""
    return "" if field.description == field.name.replace("_", " ") else _cell(field.description)


def _cell(text):
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;")


if __name__ == "__main__":
    FILE.write_text(page(), encoding="utf-8")

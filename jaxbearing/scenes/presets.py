"""The preset `laws = "best"`: a set of laws for a bearing, with the further data that these laws need.

The preset supplies one law of each kind, as in the package's own scenes. Fields in the file take precedence; the word
"none" leaves a field or a table out. Dimensions of the cage, which catalogues do not print, are estimated if the file
does not give them, and a note reports it.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import Any, Literal, NamedTuple

from pydantic import BaseModel
from pydantic_core import PydanticCustomError

from ..bearings.priors import DRAG
from ..designations import readings
from .distributions import means_of
from .errors import SceneError
from .fields import names_at, tables_at
from .kinds import kind_named
from .laws import MAXWELL_EYRING
from .oil.catalogue import with_catalogue
from .shaft.members import at, each_bearing, put
from .units import LENGTH, parse

Preset = Literal["best"]
"""Names of presets."""
NONE = "none"
"""The word that leaves a field or a table of the preset out."""
GUIDING_CLEARANCE, POCKET_CLEARANCE, LAND_WIDTH = 0.004, 0.02, 0.15
"""Ratios for an estimated cage: diametral clearance of the cage land over pitch diameter (usually 0.003 to 0.006),
pocket clearance (0.015 to 0.025) and width of a land (0.1 to 0.2) over the diameter of the rolling elements."""
OUTER_RIBS = ("NU", "NJ", "NUP")
"""Types of cylindrical roller bearings with two ribs on the outer ring, which guide the cage."""
FREE_GAP = 0.3
"""Largest ratio of an estimated pocket clearance to the gap between two rolling elements."""


class Given(NamedTuple):
    """A field that a preset supplies.

    **Arguments:** `value`: value as written in a file, or a function that computes it from the tables of a scene and
    returns `None` if it cannot; `words`: text that lists of fields show instead of the function.
    """

    value: str | float | Callable[[Mapping[str, Any]], str | None]
    words: str = ""


class Filling(NamedTuple):
    """The tables of a scene with the fields that a preset adds.

    **Arguments:** `added`: dotted path -> value of each added field; `estimated`, `assumed`: paths of added fields with
    an estimated or assumed value; `left_out`: omitted fields and tables with reasons, in words.
    """

    tables: dict[str, Any]
    added: dict[str, Any]
    estimated: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()


def _flow_law(tables: Mapping[str, object]) -> str:
    """The flow law with which the oil's rheology was fitted."""
    with suppress(SceneError):
        oil = tables.get("oil")
        rheology = with_catalogue(oil).get("rheology") if isinstance(oil, Mapping) else None
        fitted = rheology.get("viscous_function") if isinstance(rheology, Mapping) else None
        if isinstance(fitted, str) and fitted != "ree_eyring":
            return fitted
    return MAXWELL_EYRING


def _length(tables: Mapping[str, object], name: str) -> float | None:
    """A dimension of the geometry, m; `None` if it is absent or invalid."""
    geometry = tables.get("geometry")
    value = geometry.get(name) if isinstance(geometry, Mapping) else None
    try:
        return parse(value, LENGTH)
    except PydanticCustomError:
        return None


def _guiding(tables: Mapping[str, object]) -> str | None:
    pitch = _length(tables, "pitch_diameter")
    return None if pitch is None else _text(GUIDING_CLEARANCE * pitch)


def _element(tables: Mapping[str, object]) -> float | None:
    sizes = (_length(tables, name) for name in ("ball_diameter", "roller_diameter"))
    return next((size for size in sizes if size is not None), None)


def _land(tables: Mapping[str, object]) -> str | None:
    size = _element(tables)
    return None if size is None else _text(LAND_WIDTH * size)


def _pocket(tables: Mapping[str, Any]) -> str | None:
    """Estimated pocket clearance; it is reduced if the gaps between the rolling elements are small."""
    size, pitch = _element(tables), _length(tables, "pitch_diameter")
    counts = [tables["geometry"].get(name) for name in ("n_balls", "n_rollers")] if size is not None else []
    count = next((number for number in counts if isinstance(number, int)), 0)
    if size is None or pitch is None or count < 1:
        return None
    gap = pitch * math.sin(math.pi / max(count, 2)) - size
    return _text(min(POCKET_CLEARANCE * size, FREE_GAP * gap)) if gap > 0.0 else None


def _text(length: float) -> str:
    return f"{1e3 * length:.3g} mm"


def _guidance(tables: Mapping[str, object]) -> str:
    """The ring with ribs of a cylindrical roller bearing whose type is known; the inner ring of any other bearing."""
    catalogue = tables.get("catalogue")
    designation = catalogue.get("designation") if isinstance(catalogue, Mapping) else None
    read = next(iter(readings(designation)), None) if isinstance(designation, str) else None
    rollers = kind_named(tables.get("kind")) == "cylindrical_roller_bearing"
    return "outer_ring" if rollers and read is not None and read.design in OUTER_RIBS else "inner_ring"


_TRACTION = Given(_flow_law, "the flow law with which the oil's friction was fitted, else 'maxwell_eyring'")
_CAGE = {
    "guidance": Given(_guidance, "assumed: 'outer_ring' of NU, NJ and NUP by the designation, else 'inner_ring'"),
    "guiding_clearance": Given(_guiding, f"estimated: {GUIDING_CLEARANCE:g} of the pitch diameter"),
    "pocket_clearance": Given(_pocket, f"estimated: {POCKET_CLEARANCE:g} of the diameter of the rolling elements"),
    "land_width": Given(_land, f"estimated: {LAND_WIDTH:g} of the diameter of the rolling elements"),
}
BEST: dict[str, dict[str, dict[str, Given]]] = {
    "ball_bearing": {
        "contact": {
            "film": Given("nijenbanning"),
            "thermal": Given("gupta"),
            "traction": _TRACTION,
            "rolling_resistance": Given("biboulet_houpert"),
        },
        "kinematics": {"attitude": Given("equilibrium")},
        "cage": _CAGE,
        "drag": {"coefficient": Given(DRAG["ball"].nominal)},
    },
    "cylindrical_roller_bearing": {
        "contact": {
            "film": Given("moes"),
            "thermal": Given("gupta"),
            "traction": _TRACTION,
            "traction_model": Given("distributed"),
            "rolling_resistance": Given("full_range"),
        },
        "cage": _CAGE,
        "drag": {"coefficient": Given(DRAG["roller"].nominal)},
    },
    "tapered_roller_bearing": {
        "contact": {
            "film": Given("moes"),
            "thermal": Given("gupta"),
            "traction": _TRACTION,
            "rolling_resistance": Given("full_range"),
            "flange_film": Given("chittenden"),
        },
        "drag": {"coefficient": Given(DRAG["roller"].nominal)},
    },
}
"""Kind of scene -> table -> field -> value that `laws = "best"` supplies."""
_ESTIMATED = ("cage.guiding_clearance", "cage.pocket_clearance", "cage.land_width", "drag.coefficient")
_ASSUMED = ("cage.guidance",)
_OF_SLIDING = {
    "ball_bearing": ("kinematics", "cage", "drag"),
    "cylindrical_roller_bearing": ("cage", "drag"),
    "tapered_roller_bearing": (),
}
"""Kind of scene -> tables that only a scene with traction has."""
_SHAFT = "shaft"
"""The kind of scene whose bearings can have presets."""


def listing(kind: str) -> Iterator[tuple[str, str]]:
    """Dotted path and value, in words, of each field that `laws = "best"` supplies."""
    for table, fields in BEST.get(kind, {}).items():
        for name, entry in fields.items():
            yield f"{table}.{name}", entry.words or _shown(entry.value)


def filling(tables: Mapping[str, object], removed: tuple[str, ...], model: type[BaseModel], file: str) -> Filling:
    """The tables of a scene with the fields that its preset, or the presets of the bearings on a shaft, add. Without a
    preset the tables are unchanged.

    **Arguments:** `removed`: dotted paths that a `--set` removes; `model`: schema of the scene; `file`: its name.
    """
    kind = kind_named(tables.get("kind"))
    if kind == _SHAFT:
        return _on_shaft(tables, removed, model, file)
    if tables.get("laws") != "best" or kind not in BEST:
        return Filling(dict(tables), {})
    known = _with_means(tables, model, file)
    left_out: list[str] = []
    filled, added = dict(tables), {}
    for table, fields in BEST[kind].items():
        reason = _absence_reason(kind, table, filled, removed)
        if reason is not None:
            if filled.get(table) == NONE:
                del filled[table]
            left_out += [f"{table}: {reason}"] if reason else []
            continue
        own = filled.get(table, {})
        if not isinstance(own, Mapping):
            continue  # the validation refuses it
        out = (*removed, *_unfit_fields(kind, table, filled, removed, left_out))
        supplied = _fields(table, fields, own, known, out, model)
        filled[table] = {name: value for name, value in own.items() if value != NONE} | supplied
        added |= {f"{table}.{name}": value for name, value in supplied.items()}
    estimated, assumed = (tuple(path for path in added if path in of) for of in (_ESTIMATED, _ASSUMED))
    return Filling(filled, added, estimated, assumed, tuple(left_out))


def _on_shaft(tables: Mapping[str, object], removed: tuple[str, ...], model: type[BaseModel], file: str) -> Filling:
    """The tables of a shaft with the fields that the presets of its bearings add; arguments as for `filling`."""
    filled = Filling(dict(tables), {})
    for keys in each_bearing(tables):
        entry, models, above = at(tables, keys), tables_at(model, keys), ".".join(keys)
        if not isinstance(entry, Mapping) or not models:
            continue
        mine = tuple(path.removeprefix(f"{above}.") for path in removed if path.startswith(f"{above}."))
        bearing = filling(entry, mine, models[0], file)
        filled = Filling(
            put(filled.tables, keys, bearing.tables),
            filled.added | {f"{above}.{path}": value for path, value in bearing.added.items()},
            (*filled.estimated, *(f"{above}.{path}" for path in bearing.estimated)),
            (*filled.assumed, *(f"{above}.{path}" for path in bearing.assumed)),
            (*filled.left_out, *(f"{above}.{text}" for text in bearing.left_out)),
        )
    return filled


def names_a_preset(tables: object) -> bool:
    """True for tables that name a preset, or the scene of a bearing, which is not read yet and may have a preset."""
    if isinstance(tables, list):
        return any(names_a_preset(table) for table in tables)
    if not isinstance(tables, Mapping):
        return False
    return "laws" in tables or isinstance(tables.get("scene"), str) or any(map(names_a_preset, tables.values()))


def _with_means(tables: Mapping[str, object], model: type[BaseModel], file: str) -> Mapping[str, Any]:
    """The tables with the means of their distributions; unchanged if a distribution has errors."""
    with suppress(SceneError):
        return means_of(tables, model, file)[0]
    return tables


def _absence_reason(kind: str, table: str, filled: Mapping[str, Any], removed: tuple[str, ...]) -> str | None:
    """The reason why a table is left out, in words; "" if the scene itself leaves it out; `None` if it is kept."""
    if table in removed or filled.get(table) == NONE:
        return ""
    contact = filled.get("contact")
    slides = isinstance(contact, Mapping) and "traction" in contact
    if table in _OF_SLIDING[kind] and not slides and table not in filled:
        return "" if table == "kinematics" else "nothing slides without contact.traction"
    operation = filled.get("operation")
    flow = operation.get("oil_flow") if isinstance(operation, Mapping) else None
    if table == "drag" and table not in filled and flow is None:
        return "operation.oil_flow is not given"
    return None


def _unfit_fields(
    kind: str, table: str, filled: Mapping[str, Any], removed: tuple[str, ...], left_out: list[str]
) -> tuple[str, ...]:
    """Fields of the preset that do not fit the rest of the scene; the reasons are added to `left_out`."""
    if kind != "cylindrical_roller_bearing" or table != "contact":
        return ()
    if "cage" not in removed and filled.get("cage") != NONE:
        return ()
    left_out.append("contact.traction: sliding rollers need a cage")
    return ("contact.traction", "contact.traction_model")


def _fields(
    table: str,
    fields: Mapping[str, Given],
    own: Mapping[str, object],
    tables: Mapping[str, object],
    removed: tuple[str, ...],
    model: type[BaseModel],
) -> dict[str, Any]:
    """The fields that the preset adds to a table."""
    names = names_at(model, (table,))
    out = {name for name in fields if f"{table}.{name}" in removed or own.get(name) == NONE}
    # fields that have a meaning only with an omitted field are omitted too, and fields that given ones exclude
    out |= {other for name in out for other in names.about.get(name, ())}
    out |= {other for name in own for other in names.instead.get(name, ())}
    supplied = {}
    for name, entry in fields.items():
        value = entry.value(tables) if callable(entry.value) else entry.value
        if name not in own and name not in out and value is not None:
            supplied[name] = value
    return supplied


def said_of(filled: Filling) -> str:
    """Text that lists the laws and values which the preset of a scene supplies; "" without a preset."""
    if not filled.added and not filled.left_out:
        return ""
    guessed = (*filled.estimated, *filled.assumed)
    laws = [f"{path} = {_shown(value)}" for path, value in filled.added.items() if path not in guessed]
    text = f"laws = 'best' stands for {', '.join(laws)}" if laws else "laws = 'best' adds no law"
    for word, paths in (("estimated", filled.estimated), ("assumed", filled.assumed)):
        if paths:
            text += f"; {word}: {', '.join(f'{path} = {_shown(filled.added[path])}' for path in paths)}"
    if filled.left_out:
        text += f"; left out: {'; '.join(filled.left_out)}"
    return text


def _shown(value: object) -> str:
    return f"'{value}'" if isinstance(value, str) else f"{value:g}"

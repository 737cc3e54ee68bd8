"""Oil files, and the origins of the numbers of a scene's oil."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from ..data_files import oil_named, oil_text
from ..drafts import read_table
from ..errors import SceneError
from ..toml_files import parse_toml, read_text
from .grades import grade_of, grade_tables
from .schema import DOCUMENTATION, OilTable

_EXPECTED = "an oil file: the tables of [oil] in a scene, such as [viscosity], as 'jaxbearing fit --out' writes them"


class Origin(NamedTuple):
    """Origin of a law: `sources` of its parameters, in words; `note` that is repeated in solutions, or ""."""

    sources: dict[str, str]
    note: str


def read_oil(path: str) -> dict[str, object]:
    """The tables of an oil file without its `name`.

    **Raises:** `SceneError` for a file that cannot be read or is not an oil.
    """
    data = parse_toml(read_text(path, _EXPECTED), path, _EXPECTED)
    if "kind" in data:
        raise SceneError(path, "kind", "a scene", _EXPECTED)
    for name in ("file", "grade"):
        if name in data:
            actual = "another file" if name == "file" else f"the grade {data[name]!r}"
            raise SceneError(path, name, actual, "the laws themselves: an oil file stands alone")
    tables = {key: value for key, value in data.items() if key != "name"}
    read_table(OilTable, tables, path)
    return tables


def base_of(oil: Mapping[str, Any]) -> dict[str, Any] | None:
    """The tables of the oil that the `name`, the `grade` or the `file` of an oil table refers to; `None` without one of
    these, and if they are invalid, which the validation reports.

    **Raises:** `SceneError` for a file that cannot be read or is not an oil.
    """
    name, file = oil.get("name"), oil.get("file")
    if "grade" in oil:
        grade = None if name is not None or file is not None else grade_of(oil)
        return None if grade is None else grade_tables(*grade)
    if name is None and isinstance(file, str):
        return read_oil(file)
    known = oil_named(name)
    if file is None and known is not None:
        return parse_toml(oil_text(known), known, _EXPECTED)
    return None


def prior_ranges(oil: Mapping[str, Any]) -> dict[str, Any]:
    """Prior distributions that the catalogue or the oil file gives for parameters of a scene's oil, in the form of a
    scene file: {law: {parameter: {"low": ..., "high": ..., "shape": "uniform"}}}.

    Parameters that the scene itself sets have no prior. **Raises:** `SceneError` for a file that cannot be read.
    """
    priors: dict[str, Any] = {}
    for law, theirs in (base_of(oil) or {}).items():
        own = _law(oil.get(law))
        if not isinstance(theirs, Mapping) or own.get("law", theirs.get("law")) != theirs.get("law"):
            continue
        ranges = {key: span for key, span in theirs.get("ranges", {}).items() if key not in own}
        if ranges:
            priors[law] = {key: {"low": low, "high": high, "shape": "uniform"} for key, (low, high) in ranges.items()}
    return priors


def origins(oil: Mapping[str, Any], scene: str) -> dict[str, Origin]:
    """Origin of each law of a valid oil table: the sources in the catalogue or the oil file, or the scene itself for
    the values that it sets. **Arguments:** `scene`: name of the scene."""
    base = base_of(oil) or {}
    by_law = {}
    for law in dict.fromkeys([*base, *oil]):
        theirs, own = _law(base.get(law)), _law(oil.get(law))
        if law in DOCUMENTATION or not (theirs or own):
            continue
        replaced = law in oil and own.get("law", theirs.get("law")) != theirs.get("law")
        sources = {} if replaced else _sources(theirs, "")
        sources |= _sources(own, f"as in {scene}")
        note = own.get("note") or ("" if own else theirs.get("note", ""))
        by_law[law] = Origin(sources, note)
    return by_law


def _law(value: object) -> Mapping[str, Any]:
    """The table of a law. A plain value becomes the parameter `value`."""
    if value is None:
        return {}
    return value if isinstance(value, Mapping) else {"value": value}


def _sources(law: Mapping[str, Any], otherwise: str) -> dict[str, str]:
    sources = law.get("sources", {})
    named = [key for key in law if key not in DOCUMENTATION]
    texts = {key: sources.get(key) or sources.get("all") or otherwise for key in named}
    return {key: text for key, text in texts.items() if text}

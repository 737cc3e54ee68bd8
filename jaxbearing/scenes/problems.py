"""Makes a `SceneError` from errors of pydantic (`from_validation`) or of the classes of a scene (`from_class`).

A *law* is a formula that a scene chooses by its name. In some tables of a file the field `law` holds that name, and it
decides which other fields the table has.
"""

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from pydantic import BaseModel, TypeAdapter, ValidationError

from ..numerics.refusals import Refusals
from .engineers_words import usual_word
from .errors import SceneError, nearest, one_of
from .fields import is_optional, names_at, parts_of, path_of, required_names, type_at
from .kinds import kind_refused
from .words import describe, shortened

LAW_ERROR = "law_name"
"""Type of the validation error for a name that is not the name of a law."""
_CLASS_MESSAGE = re.compile(r"([a-z_0-9]+(?:\.[a-z_0-9]+)*)(:| must)")
_MUST_BE = re.compile(r"be (?P<expected>.*?)(?:, got [^:]*(?:: (?P<reason>.*))?)?")
_FOUND_EXPECTED = re.compile(r"(?:found (?P<found>.*?), )?expected (?P<expected>.*)")


def from_validation(
    error: ValidationError, model: type[BaseModel], file: str, raw: Mapping[str, object] | None = None
) -> SceneError:
    """The error for all problems that pydantic found.

    Unknown names come first and missing fields last. A missing field is not reported if another problem suggests its
    name in place of an unknown one, or if it would follow from the suggested field.

    **Arguments:** `error`: of pydantic; `model`: schema of the scene; `file`: its name for messages; `raw`: the tables.
    """
    details = sorted(_causes(error.errors(include_url=False)), key=_rank)
    absent = [detail["loc"] for detail in details if detail["type"] == "missing"]
    problems = []
    for detail in details:
        path, words = _path_and_words(detail, model)
        if detail["type"] == "extra_forbidden":
            suggestion = _absent_field(detail["loc"], model, absent, raw or {})
            words = {**words, "suggestion": suggestion or words.get("suggestion", "")}
        problems.append(in_words(file, path, words))
    meant = {meant_by(problem) for problem in problems if problem.suggestion}
    missing = [detail["type"] == "missing" for detail in details]
    left_out = lambda path: (
        path in meant or any(path.startswith(f"{field.rpartition('.')[0]}.") for field in meant if _rules(field))
    )
    kept = [problem for problem, gone in zip(problems, missing, strict=True) if not (gone and left_out(problem.path))]
    return SceneError.of_all(kept)


def _rules(path: str) -> bool:
    """True for a field that decides which other fields its table needs."""
    return path.rpartition(".")[2] in ("name", "grade", "file", "law")


def meant_by(problem: SceneError) -> str:
    """Dotted path of the field that is suggested in the place of an unknown one."""
    return ".".join([*problem.path.split(".")[:-1], problem.suggestion])


SLIP = 0.85
"""Similarity (difflib) of two names above which one is taken as a misspelling of the other."""


def _absent_field(
    location: Sequence[int | str],
    model: type[BaseModel],
    absent: Sequence[Sequence[int | str]],
    raw: Mapping[str, object],
) -> str:
    """The field that an unknown name may be meant for, e.g. the nearest absent field of its table, or the only required
    field that is absent; "" if there is none."""
    name, inside = str(location[-1]), tuple(location[:-1])
    table: object = raw
    for key in filter(None, path_of(inside).split(".")):
        table = table.get(key) if isinstance(table, Mapping) else None
    present = table if isinstance(table, Mapping) else {}
    names = names_at(model, inside).names
    valid = [field for field in names if field not in present]
    needed = [str(loc[-1]) for loc in absent if tuple(loc[:-1]) == inside]
    unknown = [field for field in present if field not in names]
    if not inside and _path_inside(name, model, names_at(model, ()).names):
        return ""
    only = needed[0] if len(needed) == len(unknown) == 1 else ""
    # a misspelling or a catalogue's word means its field even if the field is given already, as with overrides
    slip = "".join(difflib.get_close_matches(name, names, n=1, cutoff=SLIP))
    return slip or usual_word(name, names) or only or nearest(name, needed) or nearest(name, valid)


def in_words(file: str, path: str, words: Mapping[str, str]) -> SceneError:
    """The error for a problem. **Arguments:** `words`: texts `found` and `expected`, and perhaps `suggestion`."""
    return SceneError(file, path, words["found"], words["expected"], words.get("suggestion", ""))


def from_class(error: ValueError, raw: Mapping[str, object], file: str) -> SceneError:
    """The error for refusals by classes of the library.

    Their messages read "table.field must be ..., got ...: reason", "table.field: found ..., expected ...",
    "table.field: expected ..." or "table.field: reason".

    **Arguments:** `error`: of the class; `raw`: tables of the scene; `file`: its name for messages.
    """
    if isinstance(error, SceneError):
        # a file that the scene names was refused: its error is complete
        return error
    if isinstance(error, Refusals):
        return SceneError.of_all([from_class(refusal, raw, file) for refusal in error.refusals])
    text = str(error)
    match = _CLASS_MESSAGE.match(text)
    if match is None:
        return SceneError(file, "", "values that do not fit together", "a scene that can be built", reason=text)
    path, rest = match[1], text[match.end() :].strip()
    actual = describe_at(raw, path)
    expectation = (_MUST_BE if match[2] == " must" else _FOUND_EXPECTED).fullmatch(rest)
    if expectation is None:
        return SceneError(file, path, actual, "values that fit together", reason=text.removeprefix(f"{path}: "))
    words = expectation.groupdict()
    return SceneError(file, path, words.get("found") or actual, words["expected"], reason=words.get("reason") or "")


def describe_at(raw: Mapping[str, object], path: str) -> str:
    """The value of a scene at a dotted path, in words; "nothing" if there is none."""
    value: object = raw
    for name in path.split("."):
        if not isinstance(value, Mapping) or name not in value:
            return "nothing"
        value = value[name]
    return describe(value)


def _causes(details: list[Any]) -> list[Any]:
    """The problems without those that follow from a wrong `law`, such as parameters of another law."""
    wrong = {
        tuple(detail["loc"][:-1])
        for detail in details
        if detail["type"] == "literal_error" and detail["loc"][-1] == "law"
    }
    return [detail for detail in details if detail["loc"][-1:] == ("law",) or tuple(detail["loc"][:-1]) not in wrong]


def _rank(detail: Any) -> int:
    """Sorting key of a problem: unknown names come first, missing fields last."""
    return {"extra_forbidden": 0, "missing": 2}.get(detail["type"], 1)


def _path_and_words(detail: Any, model: type[BaseModel]) -> tuple[str, dict[str, str]]:
    """Dotted path of one problem of pydantic, and the words for `in_words`. Validators of the schemas raise
    problems of the type "scene", whose context holds the field and the words."""
    kind, location, context = detail["type"], detail["loc"], detail.get("ctx", {})
    path = path_of(location)
    if kind == "extra_forbidden":
        return path, unknown_name(location, model)
    if kind == "missing":
        wanted = _expected_at(model, location)
        return path, {"found": "nothing", "expected": f"a value for '{location[-1]}', which is required{wanted}"}
    if kind == "scene":
        # a check of several fields names the field to look at
        path = ".".join(part for part in (path, context.get("field", "")) if part)
        return path, {name: context.get(name, "") for name in ("found", "expected", "suggestion")}
    if kind in ("literal_error", LAW_ERROR):
        valid = re.findall(r"'([^']*)'", context["expected"])
        value = detail["input"]
        near = nearest(value, valid) if isinstance(value, str) else ""
        actual = describe(value)
        if location[-1] == "kind":
            actual, near = kind_refused(value, valid)
        expected = one_of(valid)
        further = next((note for note in parts_of(type_at(model, location)) if isinstance(note, str)), "")
        expected += f", {further}" if further else ""
        if is_optional(model, location):
            expected += f", or leave it out (--set {path}=none)"
        return path, {"found": actual, "expected": expected, "suggestion": near}
    if kind in ("model_type", "model_attributes_type", "dict_type"):
        return path, {"found": describe(detail["input"]), "expected": "a table"}
    if kind == "string_type":
        return path, {"found": describe(detail["input"]), "expected": "a text in quotes"}
    return path, {"found": describe(detail["input"]), "expected": detail["msg"]}


def _expected_at(model: type[BaseModel], location: Sequence[int | str]) -> str:
    """The accepted values of the field at a location, in the words of its messages, after ": "; "" if unknown."""
    wanted = type_at(model, location)
    if wanted is None:
        return ""
    if isinstance(wanted, type) and issubclass(wanted, BaseModel):
        return f": a table with {', '.join(repr(name) for name in required_names(wanted))}"
    try:
        TypeAdapter(wanted).validate_python(object())
    except ValidationError as error:
        refused = error.errors(include_url=False)[0]
        _, words = _path_and_words({**refused, "loc": tuple(location)}, model)
        return f": {words['expected']}"
    return ""


def unknown_name(location: Sequence[int | str], model: type[BaseModel]) -> dict[str, str]:
    """Words for `in_words` if the schema has no such name: found, expected, and the nearest name as a suggestion."""
    name, parents = str(location[-1]), location[:-1]
    owner = names_at(model, parents)
    later = owner.not_yet.get(name)
    if later:
        return {"found": f"'{name}', which is not available in this version", "expected": later}
    if name in owner.elsewhere:
        return {"found": shortened(repr(name)), "expected": owner.elsewhere[name]}
    return {
        "found": f"the unknown name {shortened(repr(name))}",
        "expected": one_of(owner.names) if owner.names else "a value, not a table",
        "suggestion": _path_inside(name, model, owner.names)
        or usual_word(name, owner.names)
        or nearest(name, owner.names),
    }


def _path_inside(name: str, model: type[BaseModel], tables: Iterable[str]) -> str:
    """The dotted path of the field with this name, if exactly one of these tables has it; otherwise ""."""
    paths = [f"{table}.{name}" for table in tables if name in names_at(model, (table,)).names]
    return paths[0] if len(paths) == 1 else ""

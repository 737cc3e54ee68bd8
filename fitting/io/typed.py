"""Options of a fit as a user types them: names, numbers with units, percentages."""

import math
from collections.abc import Iterable, Sequence

from pydantic_core import PydanticCustomError

from jaxbearing.scenes.errors import SceneError, nearest, one_of
from jaxbearing.scenes.units import INVERSE_PRESSURE, PRESSURE, TEMPERATURE_DIFFERENCE, Dimension, quantity
from jaxbearing.scenes.words import describe

from ..parameters import NAMES, POSITIVE, SYMBOLS, UNITS

_BY_SYMBOL: dict[str, str] = dict(zip(SYMBOLS, NAMES, strict=True))
_DIMENSIONS: dict[str, Dimension] = {"Pa": PRESSURE, "1/Pa": INVERSE_PRESSURE, "K": TEMPERATURE_DIFFERENCE}


def choice(option: str, word: str, known: Sequence[str]) -> str:
    """The given word, checked against the known words.

    **Raises:** `SceneError` for any other word.
    """
    if word not in known:
        raise SceneError(option, "", describe(word), one_of(known), nearest(word, known))
    return word


def parameter_name(option: str, word: str) -> str:
    """Name of a parameter, given by its name or its symbol.

    **Raises:** `SceneError`.
    """
    return _BY_SYMBOL.get(word) or choice(option, word, (*NAMES, *SYMBOLS))


def parameter_names(option: str, words: Iterable[str]) -> tuple[str, ...]:
    """Names of parameters, each once, given by names or symbols.

    **Raises:** `SceneError`.
    """
    return tuple(dict.fromkeys(parameter_name(option, name) for name in words))


def bounds(option: str, texts: Iterable[str]) -> dict[str, tuple[float | None, float | None]]:
    """Bounds in SI by name of parameter, from texts "NAME=LOW:HIGH" with units; one of the two ends may be empty.

    **Raises:** `SceneError`.
    """
    by_name = {}
    for text in texts:
        name, equals, ends = text.partition("=")
        low, colon, high = ends.partition(":")
        if not (equals and colon and (low.strip() or high.strip())):
            raise SceneError(option, "", describe(text), "NAME=LOW:HIGH, e.g. stress='1 MPa:20 MPa'")
        name = parameter_name(option, name.strip())
        pair = (_end(option, name, low), _end(option, name, high))
        if pair[0] is not None and pair[1] is not None and pair[0] >= pair[1]:
            raise SceneError(option, name, describe(ends), "a lower bound below the upper one")
        by_name[name] = pair
    return by_name


def _end(option: str, name: str, text: str) -> float | None:
    if not text.strip():
        return None
    index = NAMES.index(name)
    try:
        return quantity(text.strip(), _DIMENSIONS[UNITS[index]], "> 0" if POSITIVE[index] else "finite")
    except PydanticCustomError as error:
        context = error.context or {}
        raise SceneError(option, name, context["found"], context["expected"]) from None


def ratio(option: str, text: str, example: str, largest: float = math.inf) -> float:
    """A number from 0 to below `largest`, which may be given in per cent.

    **Raises:** `SceneError`.
    """
    number, sign, rest = text.partition("%")
    try:
        value = float(number) / (100.0 if sign else 1.0)
    except ValueError:
        value = math.nan
    if rest.strip() or not 0.0 <= value < largest:
        limit = "" if largest == math.inf else f" and < {largest:g}"
        raise SceneError(option, "", describe(text), f"a number >= 0{limit}, e.g. {example}")
    return value

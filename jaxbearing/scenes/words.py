"""Describes values of scene files in words, for messages."""

import math

_LONGEST = 60
"""Longest text of a value in a message, in characters."""


def describe(value: object) -> str:
    """A value of a scene file in words, for "found ..."."""
    if isinstance(value, bool):
        return f"the boolean {str(value).lower()}"
    if isinstance(value, int | float):
        return f"the number {short(value)}" if is_finite(value) else f"{short(value)}, which is not finite"
    if isinstance(value, str):
        return f"the text {short(value)}"
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list):
        return "an array"
    return f"{value!s} ({type(value).__name__})"


def short(value: object) -> str:
    """A value as Python code, shortened."""
    return shortened(repr(value))


def shortened(text: str) -> str:
    """A text, shortened for a message if it is long."""
    return text if len(text) <= _LONGEST else text[:_LONGEST] + "..."


def is_finite(value: int | float) -> bool:
    """True for a finite number."""
    try:
        return math.isfinite(value)
    except OverflowError:  # TOML has integers beyond the largest float
        return False

"""Results as JSON values: numbers, texts, lists and objects; numbers that are not finite become null."""

import dataclasses
import math
from typing import Any

import numpy as np

from ..._derived import derived_parts, derived_results


def names_of(part: Any) -> list[str]:
    """Names of the fields of a class and of the results derived from them."""
    kind = type(part)
    return [*(field.name for field in dataclasses.fields(part)), *derived_parts(kind), *derived_results(kind)]


def plain(value: object) -> Any:
    """Converts numbers, arrays and classes of the library to JSON values."""
    if value is None or isinstance(value, bool | str):
        return value
    if dataclasses.is_dataclass(value):
        parts = {name: getattr(value, name) for name in names_of(value)}
        return {name: plain(part) for name, part in parts.items() if part is not None}
    if isinstance(value, dict):
        return {str(key): plain(part) for key, part in value.items()}
    if isinstance(value, tuple | list):
        return [plain(part) for part in value]
    return finite(np.asarray(value).tolist())


def finite(value: object) -> Any:
    if isinstance(value, list):
        return [finite(part) for part in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value

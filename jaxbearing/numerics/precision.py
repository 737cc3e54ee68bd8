"""64-bit floats: the converter of every number that enters a scene, and the check before a solve."""

from typing import Any

import jax
import numpy as np

_HINT = "jaxbearing needs 64-bit floats: its tolerances of 1e-10 mean nothing in 32-bit"


def as_float(value: Any) -> Any:
    """The value as a float64 leaf; converter of the numeric fields of a scene.

    Python and numpy numbers become 0-d numpy arrays, so that they are traced (a new value never recompiles) and cost no
    dispatch. 64-bit arrays and tracers pass through. So do values that are no numbers, such as the placeholders of tree
    transformations, and truth values: type checker and validator judge them.

    **Raises:** `TypeError` for a float narrower than 64 bits, and for complex numbers.
    """
    dtype = getattr(value, "dtype", None)
    if isinstance(value, bool) or dtype == np.bool_:
        return value
    if dtype is None:
        return np.asarray(value, dtype=np.float64) if isinstance(value, int | float) else value
    if np.issubdtype(dtype, np.integer):
        value = value.astype(np.float64)
        dtype = value.dtype
    if np.issubdtype(dtype, np.complexfloating):
        raise TypeError(f"expected a real number, got one of type {dtype}")
    if dtype != np.float64:
        raise TypeError(f"{_HINT}; got {dtype}")
    if getattr(value, "weak_type", False):  # as jnp.asarray(1.0) is: another type to jit, a recompilation
        return jax.lax.convert_element_type(value, np.float64)
    return value


def require_x64() -> None:
    """Checks that 64-bit floats are on.

    **Raises:** `RuntimeError` if they were switched off after the import.
    """
    if not jax.config.read("jax_enable_x64"):
        raise RuntimeError(f"{_HINT}; jax_enable_x64 is off: remove what switched it off")

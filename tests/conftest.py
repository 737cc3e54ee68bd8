"""Test settings: float64, strict shapes and dtypes, run-time checked annotations, warnings are errors."""

import os

os.environ.setdefault("JAX_PLATFORMS", "cpu")

from jaxtyping import install_import_hook

with install_import_hook(["jaxbearing", "fitting"], "beartype.beartype"):
    import jaxbearing  # noqa: F401  (switches float64 on)

import jax

jax.config.update("jax_numpy_rank_promotion", "raise")
jax.config.update("jax_numpy_dtype_promotion", "strict")

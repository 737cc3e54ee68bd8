"""Test settings: float64, strict shapes and dtypes, run-time checked annotations, warnings are errors."""

import os
from pathlib import Path

os.environ.setdefault("JAX_PLATFORMS", "cpu")

from jaxtyping import install_import_hook

with install_import_hook(["jaxbearing", "fitting"], "beartype.beartype"):
    import jaxbearing  # noqa: F401  (switches float64 on)

import jax

jax.config.update("jax_numpy_rank_promotion", "raise")
jax.config.update("jax_numpy_dtype_promotion", "strict")

# Compiled programs are shared by the workers of a run and kept for the next one; they are keyed by the program itself.
_CACHE = Path(__file__).parent.parent / ".pytest_cache" / "compiled"
_CACHE.mkdir(parents=True, exist_ok=True)
jax.config.update("jax_compilation_cache_dir", str(_CACHE))
jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.5)

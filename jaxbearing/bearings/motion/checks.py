"""Range checks of a transient run: the largest excess of all its pieces."""

import jax
import jax.numpy as jnp

from ..facts import Excess

AT_SOME_TIME = "at some time of the run: "
"""First words of each check that holds for a run."""


def largest(pieces: list[Excess]) -> Excess:
    """Finds the largest number of each check among the pieces of a run; one that is not a number says nothing."""
    return jax.tree.map(lambda *values: jnp.nanmax(jnp.stack([jnp.asarray(-jnp.inf), *values])), *pieces)

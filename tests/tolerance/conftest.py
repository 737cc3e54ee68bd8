"""A mounted bearing whose clearance is all that is solved: results of its seats without those of its contacts."""

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.mounted import running_scene
from jaxbearing.numerics.checks import label
from jaxbearing.tolerance.delta import spreads_of
from jaxbearing.tolerance.derivatives import Slopes
from jaxbearing.tolerance.results import values_of


class OnlyFit(eqx.Module):
    """The seats of a solution, and a label with a unit that pint does not know."""

    fit: Any
    share: Any = eqx.field(default=None, metadata=label("1", "share"))
    converged: bool = eqx.field(default=True, static=True)
    operation: Any = None


def only_fit(scene):
    return OnlyFit(running_scene(scene)[1])


@pytest.fixture(scope="session")
def mounted():
    """The 6205 of the sheet: one steel, at rest, at 20 degC."""
    changes = {"fits.shaft_material": "52100", "fits.housing_material": "52100"}
    changes |= {"operation.inner_speed": "0 rpm", "temperatures": "none"}
    return jb.load_scene("deep_groove_6205_fitted", changes)


@pytest.fixture(scope="session")
def spread_fits():
    """Scatter of the results of the seats, from exact derivatives of them alone."""

    def spread(scatter, names=("fit.clearance",)):
        computed = (*names, "fit.clearance", "fit.interference_inner", "fit.interference_outer")

        @jax.jit
        def differentiated(numbers):
            results = lambda given: values_of(only_fit(scatter.scene.replace(given)), computed)
            return only_fit(scatter.scene.replace(numbers)), results(numbers), jax.jacrev(results)(numbers)

        at = lambda numbers: Slopes(*differentiated({path: jnp.asarray(one) for path, one in numbers.items()}))
        return spreads_of(scatter, tuple(names), at(scatter.means), at)

    return spread


@pytest.fixture(scope="session")
def sample_fits():
    """The same results of random samples."""

    def samples(scatter, count, seed, name="fit.clearance"):
        random = np.random.default_rng(seed)
        normal, uniform = random.standard_normal((count, 9)), random.random((count, 9))
        values = {
            path: jnp.asarray(one.samples(normal[:, i], uniform[:, i]))
            for i, (path, one) in enumerate(scatter.fields.items())
        }
        one = lambda numbers: values_of(only_fit(scatter.scene.replace(numbers)), (name,))[name]
        return np.asarray(jax.jit(jax.vmap(one))(values))

    return samples

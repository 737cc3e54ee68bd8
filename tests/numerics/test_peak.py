"""Highest value of a sampled function."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.numerics.peak import peak


def test_parabola_is_exact_wherever_its_top_is():
    places = np.array([-1.0, -0.7, 0.1, 0.3, 1.1])
    tops = np.linspace(-0.9, 1.0, 39)
    values = 3.0 - 2.0 * np.square(places - tops[:, None])
    np.testing.assert_allclose(peak(places, jnp.asarray(values)), 3.0, rtol=1e-14)


@pytest.mark.parametrize("values", [[1.0, 2.0, 4.0], [4.0, 2.0, 1.0], [2.0, 2.0, 2.0], [3.0, 1.0, 3.5], [1.0, 2.0]])
def test_no_peak_inside(values):
    """At an end, of a constant, of a hollow function and of two places: the highest value, with a finite gradient."""
    values = jnp.asarray(values)
    places = np.arange(float(len(values)))
    found, slopes = jax.jit(jax.value_and_grad(lambda v: peak(places, v)))(values)
    np.testing.assert_allclose(found, np.max(values), rtol=1e-15)
    assert np.all(np.isfinite(slopes))


def test_error_is_of_third_order():
    errors = []
    for count in (11, 21, 41, 81):
        places = np.linspace(-1.0, 1.0, count)
        shifts = np.linspace(0.0, places[1] - places[0], 20, endpoint=False)[:, None]
        found = jax.jit(peak)(places, jnp.asarray(np.exp(-np.square(places - shifts))))
        errors.append(np.max(np.abs(np.asarray(found) - 1.0)))
    assert np.all(np.diff(np.log(errors)) < -3 * np.log(1.9))

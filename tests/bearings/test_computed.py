"""Results that name the function which computes them."""

import dataclasses
from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import pytest
from jaxtyping import Array, Float

from jaxbearing.bearings.ball.solution import BallResults
from jaxbearing.bearings.computed import computed, computed_results
from jaxbearing.bearings.cylindrical.solution import RollerResults
from jaxbearing.bearings.tapered.solution import TaperedResults


class Found(NamedTuple):
    force: Float[Array, " element"]
    moment: Float[Array, " element"] | None = None


class Results(eqx.Module):
    load: Float[Array, " element"]
    force: Float[Array, " element"] = computed("N", "force", lambda at: at.force)
    moment: Float[Array, " element"] | None = computed("N m", "moment", lambda at: at.moment, default=None)


def test_fields_with_a_function_are_filled_and_others_are_not():
    found = computed_results(Results, Found(jnp.ones(3)))
    assert set(found) == {"force", "moment"}
    assert found["moment"] is None
    assert Results(load=jnp.zeros(3), **found).force.shape == (3,)


@pytest.mark.parametrize("kind", [BallResults, RollerResults, TaperedResults])
def test_every_result_of_an_element_has_a_unit_and_a_meaning(kind):
    for field in dataclasses.fields(kind):
        assert {"unit", "description"} <= set(field.metadata)
        assert callable(field.metadata.get("of", len))

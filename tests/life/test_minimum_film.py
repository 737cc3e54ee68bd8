"""The minimum film of the lambda ratio: shares of line and point contacts."""

from types import SimpleNamespace

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.minimum_films import minimum_films
from jaxbearing.contacts import DowsonHigginson, DowsonToyoda, LineContact, MartinBlend, Moes, PanHamrockMinimum
from jaxbearing.contacts.minimum_film import LINE_SHARE


@pytest.mark.parametrize(
    ("law", "share"),
    [
        (Moes(), LINE_SHARE),
        (MartinBlend(DowsonToyoda()), LINE_SHARE),
        (MartinBlend(DowsonHigginson()), 1.0),
        (PanHamrockMinimum(), 1.0),
    ],
    ids=lambda value: type(value).__name__,
)
def test_line_contacts(law, share):
    films = SimpleNamespace(film_inner=jnp.asarray([1e-7, jnp.nan]), film_outer=jnp.asarray([2e-7, 3e-7]))
    scene = eqx.tree_at(lambda scene: scene.contact.film, jb.load_scene("reference_roller"), law)
    inner, outer = minimum_films(scene, films)
    np.testing.assert_allclose(inner, [share * 1e-7, np.nan], rtol=1e-15)
    np.testing.assert_allclose(outer, [share * 2e-7, share * 3e-7], rtol=1e-15)


def test_share_of_a_line_against_dowson_s_laws():
    state = (LineContact(0.01, 0.01, 2.3e11), 2300.0, 2.3, 0.01, 4500.0 / 2.3e11)  # W = 1e-4, U = 1e-11
    ratio = DowsonHigginson().log_thickness(*state) - DowsonToyoda().log_thickness(*state)
    np.testing.assert_allclose(np.exp(ratio), LINE_SHARE, rtol=0.01)


def test_point_contacts():
    """A ball in a groove touches in a long ellipse across rolling: the share is about 0.8, that of a line."""
    scene = jb.load_scene("turbine_ball")
    of = lambda value: jnp.full(3, value)
    angles = {"contact_angle_inner": of(0.6), "contact_angle_outer": of(0.4)}
    loads = {"load_inner": of(1e3), "load_outer": of(1.5e3)}
    films_of = eqx.filter_jit(lambda scene, given: minimum_films(scene, SimpleNamespace(**given)))
    films = np.stack(films_of(scene, angles | loads | {"film_inner": of(1e-6), "film_outer": of(1e-6)}))
    assert films.shape == (2, 3)
    assert np.all((films > 0.65e-6) & (films < 0.95e-6))

"""What a researcher looks for first: the same laws in another form."""

import jax.numpy as jnp
import numpy as np

from jaxbearing.contacts import LineContact, Moes, NijenbanningVennerMoes, PointContact
from jaxbearing.gaps import ShortJournal

POINT = PointContact(4.0e-3, 35.0e-3, 226e9)
LINE = LineContact(5.5e-3, 12.4e-3, 222e9)
STATE = (2e3, 20.0, 4.7e-3, 11e-9)


def test_load_and_approach_of_a_point_contact():
    load = jnp.asarray([0.0, 1.0, 500.0, 2e4])
    np.testing.assert_allclose(POINT.load_at_approach(POINT.approach(load)), load, rtol=1e-13)
    np.testing.assert_allclose(POINT.approach(500.0) ** 1.5 * POINT.stiffness_constant(), 500.0, rtol=1e-13)
    assert float(POINT.load_at_approach(-1e-6)) == 0.0


def test_numbers_of_moes():
    """By their definitions, of a line and of a point contact, with the sum of the surfaces' speeds."""
    load, speed, viscosity, alpha = STATE
    for law, contact, radius, unit, power in (
        (Moes(), LINE, LINE.reduced_radius, LINE.length, 0.5),
        (NijenbanningVennerMoes(), POINT, POINT.reduced_radius_rolling, POINT.reduced_radius_rolling, 0.75),
    ):
        u = 2.0 * viscosity * speed / (contact.reduced_modulus * radius)
        numbers = law.numbers(contact, *STATE)
        np.testing.assert_allclose(
            numbers.load, load / (contact.reduced_modulus * radius * unit) * u**-power, rtol=1e-6
        )
        np.testing.assert_allclose(numbers.material, alpha * contact.reduced_modulus * u**0.25, rtol=1e-6)
        np.testing.assert_allclose(numbers.film_unit, radius * u**0.5, rtol=1e-6)
        np.testing.assert_allclose(law.thickness(contact, *STATE), jnp.exp(law.log_thickness(contact, *STATE)))


def test_reynolds_number_of_a_land():
    land = ShortJournal(radius=67.5e-3, width=4e-3, clearance=0.12e-3)
    np.testing.assert_allclose(
        land.reynolds_number(950.0, 4.7e-3, -600.0), 950.0 * 67.5e-3 * 600.0 * 0.12e-3 / 4.7e-3, rtol=1e-9
    )

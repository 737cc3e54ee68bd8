"""The laws of rolling resistance beside check rows and in their limits, and inlet heating."""

import tomllib
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from line_contacts import STEEL, by_moes
from reference_oils import mobil_jet_ii

import jaxbearing as jb
from jaxbearing.contacts import (
    BibouletHoupertRollingResistance,
    FullRangeRollingResistance,
    Gupta,
    HsuLee,
    JoinedRollingResistance,
    LineContact,
    Moes,
    NoThermalReduction,
    RollingInlet,
    aihara_factor,
    supply,
)
from jaxbearing.contacts.laws import ContactLaws
from jaxbearing.contacts.rolling import LIGHT_LOAD_CONSTANT
from jaxbearing.contacts.rolling_heating import heating_of, rolling_words
from jaxbearing.ehl import ContactBodies
from jaxbearing.lubricants import InletOil
from jaxbearing.materials import Material

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "rolling_resistance.toml").read_text())
LAWS = {"full_range": FullRangeRollingResistance(), "biboulet_houpert": BibouletHoupertRollingResistance()}
CONTACT = LineContact(0.0055, 0.0124, 2.25e11)
FORCE = {name: jax.jit(law.force) for name, law in LAWS.items()}
SLOPES = {name: jax.jit(jax.grad(lambda c, i, law=law: law.force(c, i), (0, 1))) for name, law in LAWS.items()}


def inlet(load, speed=38.0, viscosity=0.005, pressure_viscosity=1.1e-8):
    return RollingInlet(*(jnp.asarray(v, dtype=float) for v in (load, speed, viscosity, pressure_viscosity, 1e-6)))


def by_numbers(m, el):
    """The inlet of CONTACT with these Moes numbers, and the force that C is measured in."""
    number, stiffness = 2e-11, 2.25e11 * 0.0055
    alpha, speed = el / (2.25e11 * number**0.25), number * stiffness / 0.01
    unit = 0.0124 * stiffness * number**0.75
    return inlet(m * np.sqrt(number) * 0.0124 * stiffness, speed, 0.005, alpha), unit


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("row", PUBLISHED["line"], ids=lambda row: f"{row['load']:g} N")
def test_check_rows(row, law):
    contact = LineContact(row["reduced_radius"], row["length"], row["reduced_modulus"])
    given = inlet(row["load"], row["speed"], row["viscosity"], row["pressure_viscosity"])
    np.testing.assert_allclose(FORCE[law](contact, given), row[law], rtol=row["rtol"])


@pytest.mark.parametrize("el", [0.0, 4.0, 16.0])
def test_full_range_from_light_to_heavy(el):
    """Martin's force at M = 1e-3, the fitted plateau at M = 1e4; 3.89 M^-0.028 for an isoviscous oil."""
    for m, expected in (
        (1e-3, LIGHT_LOAD_CONSTANT * np.sqrt(1e-3)),
        (1e4, 4.1156 * 1e4**-0.02816 * (el**2 + 4.0) ** (-0.0821 / 2.0)),
    ):
        given, unit = by_numbers(m, el)
        np.testing.assert_allclose(FORCE["full_range"](CONTACT, given) / unit, expected, rtol=1e-5)
    np.testing.assert_allclose(LIGHT_LOAD_CONSTANT, 2.94103, rtol=2e-6)
    np.testing.assert_allclose(4.1156 * 4.0 ** (-0.0821 / 2.0), 3.89, rtol=1e-3)


def test_biboulet_and_houpert_from_light_to_heavy():
    for m, expected, rtol in ((1e-3, 2.845 * np.sqrt(1e-3), 1e-3), (1e4, 2.946, 1e-3)):
        given, unit = by_numbers(m, 8.0)
        np.testing.assert_allclose(FORCE["biboulet_houpert"](CONTACT, given) / unit, expected, rtol=rtol)


@pytest.mark.parametrize("law", LAWS)
def test_without_load_and_at_rest(law):
    """The root of the load down to 1e-8 N, nothing at rest, odd in the speed, and slopes that are finite."""
    small, smaller = (float(FORCE[law](CONTACT, inlet(load))) for load in (1e-6, 1e-8))
    np.testing.assert_allclose(small / smaller, 10.0, rtol=5e-3)
    assert float(FORCE[law](CONTACT, inlet(1000.0, 0.0))) == 0.0
    assert float(FORCE[law](CONTACT, inlet(1000.0, -3.0))) == -float(FORCE[law](CONTACT, inlet(1000.0, 3.0)))
    for m in (0.0, 1e-3, 1e4):
        for el in (0.0, 10.0):
            for speed in (0.0, -38.0, 1e-9):
                given = by_numbers(m, el)[0]._replace(speed=jnp.asarray(speed))
                assert all(np.all(np.isfinite(leaf)) for leaf in jax.tree.leaves(SLOPES[law](CONTACT, given)))


def test_aihara():
    row, still = PUBLISHED["aihara"], jnp.asarray(0.0)
    # L = viscosity * slope * u^2 / conductivity
    oil = InletOil(373.15, 0.005, 1e-8, log_slope=-0.02, conductivity=0.15)
    speed = jnp.sqrt(jnp.asarray(row["loading"]) * 0.15 / (0.005 * 0.02))
    np.testing.assert_allclose(aihara_factor(speed, oil), row["factor"], rtol=row["rtol"])
    np.testing.assert_array_equal(aihara_factor(-speed, oil), aihara_factor(speed, oil))
    assert float(aihara_factor(still, oil)) == 1.0
    assert np.isfinite(jax.grad(lambda u: aihara_factor(u, oil))(still))
    with pytest.raises(ValueError, match="Aihara's inlet heating of the rolling resistance needs the lubricant's cond"):
        aihara_factor(speed, InletOil(373.15, 0.005, 1e-8, log_slope=-0.02))


@pytest.mark.parametrize("named", ["aihara", "film_temperature", None])
def test_inlet_heating_by_name(named):
    """`aihara`: the oil at the inlet temperature and a factor; `film_temperature`: the oil that explains the film."""
    oil, law = mobil_jet_ii(), FullRangeRollingResistance()
    laws = ContactLaws(film=Moes(), thermal=Gupta(), rolling=law, rolling_heating=named)
    entering = oil.at(373.15)
    state = laws.evaluate(CONTACT, 2500.0, -30.0, 0.0, oil, entering)
    alpha = entering.pressure_viscosity
    if named == "film_temperature":
        viscosity, factor = oil.viscosity.viscosity(0.0, 373.15 + state.temperature_rise), 1.0
    else:
        viscosity, factor = entering.viscosity, aihara_factor(30.0, entering)
    expected = factor * law.force(CONTACT, inlet(2500.0, -30.0, viscosity, alpha))
    np.testing.assert_allclose(state.rolling_force, expected, rtol=1e-13)


def test_heating_that_no_scene_names():
    new, old = FullRangeRollingResistance(), JoinedRollingResistance()
    isothermal = NoThermalReduction()
    assert [heating_of(law, None, HsuLee()) for law in (new, old)] == ["aihara", "film_temperature"]
    assert heating_of(new, None, isothermal) == "film_temperature"
    assert heating_of(new, "aihara", isothermal) == "aihara"
    words = lambda law, thermal, named=None: rolling_words(ContactLaws(Moes(), thermal, None, 0.0, law, named))
    assert words(new, Gupta()) == "full_range, inlet heating aihara"
    assert words(old, Gupta()) == "ertel_grubin, inlet heating film_temperature"
    assert words(new, isothermal) == "full_range, isothermal inlet"
    assert words(new, isothermal, "aihara") == "full_range, inlet heating aihara"
    with pytest.raises(ValueError, match=r"contact\.rolling_heating must be one of"):
        ContactLaws(Moes(), rolling_heating="wilson")


@pytest.mark.slow
@pytest.mark.parametrize("row", PUBLISHED["solver"], ids=lambda row: "thick" if row["compressible"] else "plain")
def test_the_field_solver(row):
    """Pressure and film of a full solution: int h dp, the moment of the pressure, and the law beside them."""
    scene, unit = by_moes(24.0, 9.5, 401, 8.94)
    modulus = STEEL.youngs_modulus / 0.91
    if row["compressible"]:  # the same M and L with alpha = 22 1/GPa and E' = 226.4 GPa
        modulus = 206e9 / 0.91
        number, body = (9.5 / (22e-9 * modulus)) ** 4, Material(206e9, 0.3, 7850.0)
        speed = number / 1e-11 * modulus / (STEEL.youngs_modulus / 0.91)
        scene = scene.replace(
            {
                "contact.compressible": True,
                "materials": ContactBodies(body, body),
                "oil.viscosity.pressure_viscosity": jnp.asarray(22e-9),
                "oil.pressure_viscosity.value": jnp.asarray(22e-9),
                "operation.entrainment_speed": jnp.asarray(speed),
                "operation.load_per_length": jnp.asarray(24.0 * modulus * 0.01 * np.sqrt(number)),
            }
        )
        unit = 0.01 * np.sqrt(number)
    solution = jb.solve(scene)
    np.testing.assert_allclose([solution.moes_load, solution.moes_material], [24.0, 9.5], rtol=1e-9)
    np.testing.assert_allclose(solution.film.central / unit, row["central"], rtol=row["rtol"])
    x, p, h = (np.asarray(getattr(solution.profile, name)) for name in ("x", "pressure", "film"))
    force = np.sum(0.5 * (h[1:] + h[:-1]) * np.diff(p))
    scale = modulus * 0.01 * (unit / 0.01) ** 1.5
    np.testing.assert_allclose(force / scale, row["constant"], rtol=row["rtol"])
    np.testing.assert_allclose(np.trapezoid(-x * p, x) / 0.01, force, rtol=3e-3)
    if row["compressible"]:  # the oils of the fit; with the tail of an inlet without end, 12/(X sqrt(8 M/pi))
        tail = 12.0 / (8.94 * np.sqrt(8.0 * 24.0 / np.pi))
        fit = 1.0 / (LIGHT_LOAD_CONSTANT**-3.778 * 24.0**-1.889 + (4.1156 * 24.0**-0.02816 * 94.25**-0.04105) ** -3.778)
        np.testing.assert_allclose(fit ** (1.0 / 3.778), force / scale + tail, rtol=0.04)


@pytest.mark.slow
@pytest.mark.parametrize("row", PUBLISHED["starved"], ids=lambda row: f"{row['inlet']:g}")
def test_the_field_solver_with_a_short_inlet(row):
    """Film, gap at the meniscus and moment of a starved full solution beside the flooded one, whose tail counts."""
    flooded_scene, unit = by_moes(row["load"], 9.5, 401, 8.94)
    flooded, starved = jb.solve(flooded_scene), jb.solve(by_moes(row["load"], 9.5, 401, row["inlet"])[0])
    found = starved.film.central / flooded.film.central
    np.testing.assert_allclose(found, row["film"], rtol=row["rtol"])
    gap = float(starved.profile.film[0] / flooded.film.minimum)
    np.testing.assert_allclose(gap, row["gap_over_minimum"], rtol=row["rtol"])

    def moment(solution):
        p, h = (np.asarray(getattr(solution.profile, name)) for name in ("pressure", "film"))
        return np.sum(0.5 * (h[1:] + h[:-1]) * np.diff(p))

    tail = 12.0 / (8.94 * np.sqrt(8.0 * row["load"] / np.pi))
    scale = STEEL.youngs_modulus / 0.91 * 0.01 * (unit / 0.01) ** 1.5
    whole = moment(flooded) / scale + tail
    np.testing.assert_allclose(moment(starved) / scale / whole, row["constant"], rtol=row["rtol"])
    # the laws that were fitted to such solutions
    fitted = supply.starved_rolling_factor(jnp.log(gap))
    np.testing.assert_allclose(fitted, row["constant"], atol=0.046)

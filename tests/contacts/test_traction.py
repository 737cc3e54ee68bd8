"""Traction at the mean pressure: an independent transcription, limits, hard cases, gradients."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from reference_oils import mobil_jet_ii, nye_186a

from jaxbearing.contacts import (
    BairWiner,
    DistributedTraction,
    ElsharkawyHamrock,
    GecimWiner,
    LineContact,
    MaxwellEyring,
    MeanPressureTraction,
    ReeEyring,
    Resolution,
)

# new law: add a line, get the general tests
LAWS = [MaxwellEyring(), MeanPressureTraction(ElsharkawyHamrock(2.0)), MeanPressureTraction(BairWiner(), elastic=False)]
NAMES = lambda law: f"{law.viscous.name}-{law.elastic}"
MODULUS = 210e9 / 0.91
RADIUS = 1 / (1 / 0.006 + 1 / 0.065)
CONTACT = LineContact(RADIUS, 0.0124, MODULUS)
OIL = mobil_jet_ii()
VISCOSITY = 0.004867549
NOMINAL = (2500.0, 4e-7, 35.0, 0.5, 373.15)
"""load, film, entrainment speed, sliding speed, temperature"""


def transcription(load, h, u, du, temperature):
    """The reference closure of the source's roller bearing, line by line in numpy."""
    a = np.sqrt(8 * load * RADIUS / (np.pi * MODULUS * 0.0124))
    p = np.pi / 4 * np.sqrt(load * MODULUS / (2 * np.pi * RADIUS * 0.0124))
    y = (temperature - 165.75 - 171.96 * np.log(1 + 0.4294e-9 * p)) * (1 - 0.1961 * np.log(1 + 17.434e-9 * p))
    mu_p = 10 ** (12 - 16.342 * y / (29.406 + y))
    d = 1 / temperature - 1 / 300
    g = 4.82e4 * np.exp(6.11e-9 * p + 2450 * d)
    t0 = 1.56e5 * np.exp(2.41e-9 * p - 786 * d)
    mu_l = 1 / (1 / mu_p + u / (g * a))
    inlet = 2.01435 * VISCOSITY * du * 0.0124 * np.sqrt(2 * RADIUS / h)
    return t0 * np.arcsinh(mu_l * du / (h * t0)) * 2 * a * 0.0124 + inlet


@eqx.filter_jit
def compiled_force(law, lubricant, *state):
    return law.force(CONTACT, *state, lubricant, VISCOSITY)


def force(load, film, u, du, temperature, law=LAWS[0], lubricant=OIL):
    """Compiled once for each law, oil and shape."""
    return compiled_force(law, lubricant, *map(jnp.asarray, (load, film, u, du, temperature)))


def test_reference_closure():
    rng = np.random.default_rng(1)
    for _ in range(40):
        state = (
            10 ** rng.uniform(0, 4),
            10 ** rng.uniform(-7.5, -5),
            rng.uniform(1, 60),
            rng.choice([-1, 1]) * 10 ** rng.uniform(-6, 1.5),
            rng.uniform(313, 473),
        )
        # round-off through ln(viscosity); the speed floor: (1e-6/2)^2/2
        np.testing.assert_allclose(force(*state), transcription(*state), rtol=1e-10)


def test_newtonian_limit():
    """Small sliding and a stiff oil: shear stress = viscosity * rate, with the next term of asinh."""
    stiff = eqx.tree_at(lambda o: o.rheology.shear_modulus, OIL, 1e60)
    load, h, u, _, temperature = NOMINAL
    pressure = CONTACT.mean_pressure(load)
    viscosity = OIL.viscosity.viscosity(pressure, temperature)
    stress = jnp.exp(OIL.rheology.log_stress(pressure, temperature))
    du = 1e-3 * stress * h / viscosity
    newton = viscosity * du / h * 2 * CONTACT.half_width(load) * 0.0124 * (1 - 1e-6 / 6)
    inlet = 2.01435 * VISCOSITY * du * 0.0124 * np.sqrt(2 * RADIUS / h)
    np.testing.assert_allclose(force(load, h, u, du, temperature, lubricant=stiff), newton + inlet, rtol=1e-11)


def test_elastic_limit():
    """A soft oil in transit answers with G a/u whatever its viscosity."""
    soft = eqx.tree_at(lambda o: o.rheology.shear_modulus, OIL, 1e-6)
    load, h, u, _, temperature = NOMINAL
    a = CONTACT.half_width(load)
    modulus = jnp.exp(soft.rheology.log_shear_modulus(CONTACT.mean_pressure(load), temperature))
    slope = jax.jit(jax.grad(lambda du: force(load, h, u, du, temperature, lubricant=soft)))(0.0)
    inlet = 2.01435 * VISCOSITY * 0.0124 * np.sqrt(2 * RADIUS / h)
    # 1/mu_p against u/(G a): about 1e-7
    np.testing.assert_allclose(slope - inlet, modulus * a / u / h * 2 * a * 0.0124, rtol=1e-6)


def test_slope_at_rest_is_not_zero():
    load, h, u, _, temperature = NOMINAL
    slope = jax.jit(jax.grad(lambda du: force(load, h, u, du, temperature)))(0.0)
    np.testing.assert_allclose(slope, transcription(load, h, u, 1e-9, temperature) / 1e-9, rtol=1e-9)
    assert force(load, h, u, 0.0, temperature) == 0.0


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_odd_and_increasing_in_sliding(law):
    load, h, u, _, temperature = NOMINAL
    du = np.concatenate([[0.0], np.logspace(-12, 4, 81)])
    forward = np.asarray(force(load, h, u, du, temperature, law))
    np.testing.assert_array_equal(force(load, h, u, -du, temperature, law), -forward)
    assert np.all(np.diff(forward) > 0)


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_hard_cases_value_and_gradient(law):
    load = jnp.asarray([0.0, 1e-6, 1.0, 2.5e3, 5e5])[:, None, None]  # up to a Hertz pressure of 16 GPa
    u = jnp.asarray([0.0, -1e-9, 50.0])[:, None]
    du = jnp.asarray([0.0, 1e-300, -1e-9, 1.0, 1e6])
    inputs = jnp.broadcast_arrays(load, u, du)
    function = jax.jit(lambda load, h, u, du, t: force(load, h, u, du, t, law))
    derivative = jax.jit(jax.grad(lambda *a: jnp.sum(function(*a)), argnums=(0, 1, 2, 3, 4)))
    for temperature in (243.0, 473.0):
        for h in (1e-10, 1e-6, 1e-2):
            state = (inputs[0], h, inputs[1], inputs[2], temperature)
            assert jnp.all(jnp.isfinite(function(*state)))
            gradient = derivative(*state)
            assert all(jnp.all(jnp.isfinite(g)) for g in gradient)


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
@pytest.mark.parametrize("du", [1e-5, -0.5, 30.0])
def test_gradients(law, du):
    state = (*NOMINAL[:3], du, *NOMINAL[4:])
    function = jax.jit(lambda *inputs: force(*inputs, law))
    gradient = jax.jit(jax.grad(function, argnums=(0, 1, 2, 3, 4)))(*state)
    for i, value in enumerate(state):
        step = 1e-4 * abs(value) if i < 4 else 1e-2
        up, down = ((*state[:i], value + sign * step, *state[i + 1 :]) for sign in (1, -1))
        central = (function(*up) - function(*down)) / (2 * step)
        # truncation step^2 f'''/6 is a few 1e-8 relative
        np.testing.assert_allclose(gradient[i], central, rtol=1e-6)


@pytest.mark.parametrize("law", LAWS, ids=NAMES)
def test_eager_is_jit_is_vmap(law):
    du = jnp.linspace(-5.0, 5.0, 20_001)
    function = lambda du: law.force(CONTACT, 2500.0, 4e-7, 35.0, du, 373.15, OIL, VISCOSITY)
    np.testing.assert_allclose(jax.jit(function)(du), function(du), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(jax.vmap(function)(du), function(du), rtol=1e-12, atol=1e-12)


def test_two_races_of_n_rollers():
    contact = LineContact(jnp.asarray([[0.0055], [0.0062]]), 0.0124, MODULUS)
    load = jnp.linspace(1.0, 5000.0, 14).reshape(2, 7)
    one = jnp.ones((2, 7))
    run = jax.jit(lambda contact, load: LAWS[0].force(contact, load, 4e-7 * one, 35.0, one, 373.15, OIL, VISCOSITY))
    got = run(contact, load)
    assert got.shape == (2, 7)


def test_rheology_is_asked_for():
    with pytest.raises(ValueError, match="rheology"):
        force(*NOMINAL, lubricant=nye_186a())


@pytest.mark.parametrize("viscous", [BairWiner(), GecimWiner(), ElsharkawyHamrock(2.0)], ids=lambda v: v.name)
def test_viscous_limit_between_newton_and_the_limiting_stress(viscous):
    """traction sheet, eqs. (82)-(83) at the mean pressure: no shear modulus in it."""
    law = MeanPressureTraction(viscous, elastic=False)
    load, h, u, _, temperature = NOMINAL
    pressure = CONTACT.mean_pressure(load)
    viscosity = OIL.viscosity.viscosity(pressure, temperature)
    stress = jnp.exp(OIL.rheology.log_stress(pressure, temperature))
    area = 2 * CONTACT.half_width(load) * 0.0124
    inlet = 2.01435 * VISCOSITY * 0.0124 * np.sqrt(2 * RADIUS / h)
    unit = stress * h / viscosity  # sliding speed at q = 1
    limit = force(load, h, u, 100 * unit, temperature, law) - inlet * 100 * unit
    # E-H (n = 2) is short of the limit by 1/(2 q^2)
    np.testing.assert_allclose(limit, stress * area, rtol=1e-4)
    small = 1e-5 * unit
    # Bair and Winer's next term is q/2
    np.testing.assert_allclose(
        force(load, h, u, small, temperature, law), (viscosity / h * area + inlet) * small, rtol=1e-5
    )
    at = lambda q: float((force(load, h, u, q * unit, temperature, law) - inlet * q * unit) / (stress * area))
    np.testing.assert_allclose(at(0.7), viscous.stress_ratio(0.7), rtol=1e-10)
    stiff = eqx.tree_at(lambda o: o.rheology.shear_modulus, OIL, 1e60)
    elastic = force(load, h, u, unit, temperature, MeanPressureTraction(viscous), stiff)
    np.testing.assert_allclose(elastic, force(load, h, u, unit, temperature, law), rtol=1e-12)
    assert force(load, h, u, unit, temperature, MeanPressureTraction(viscous)) < elastic  # a soft oil gives less


def test_maxwell_eyring_whatever_the_oil():
    assert isinstance(MaxwellEyring().viscous, ReeEyring)
    assert MaxwellEyring().elastic


OWN = [("ree_eyring", None, ReeEyring()), ("bair_winer", None, BairWiner()), ("gecim_winer", None, GecimWiner())]
OWN += [("elsharkawy_hamrock", n, ElsharkawyHamrock(n)) for n in (1.5, 2.0)]
ANY = {
    "mean pressure": MeanPressureTraction,
    "distributed": lambda viscous=None: DistributedTraction(viscous, Resolution(8, 4)),
}


@pytest.mark.parametrize("make", ANY.values(), ids=ANY)
@pytest.mark.parametrize("fitted", OWN, ids=lambda row: f"{row[0]}-{row[1]}")
def test_default_is_the_viscous_function_of_the_oil(make, fitted):
    name, exponent, viscous = fitted
    oil = with_rheology(viscous_function=name, exponent=exponent)
    np.testing.assert_array_equal(force(*NOMINAL, make(), oil), force(*NOMINAL, make(viscous), oil))
    assert make().notes(oil) == make(viscous).notes(oil) == ()
    for other, n, law in OWN:
        if other != name:
            said = (f"contact.traction is {other}, the oil's rheology was fitted with {name}",)
        else:
            said = (
                () if n == exponent else (f"contact.traction has the exponent {n:g}, the oil's rheology {exponent:g}",)
            )
        assert make(law).notes(oil) == said


@pytest.mark.parametrize("make", ANY.values(), ids=ANY)
def test_unknown_viscous_function_is_ree_and_eyrings_with_a_note(make):
    oil = with_rheology(viscous_function=None, exponent=None)
    assert force(*NOMINAL, make(), oil) == force(*NOMINAL, make(ReeEyring()), oil)
    assert make(BairWiner()).notes(oil) == ()
    (note,) = make().notes(oil)
    assert "ree_eyring is assumed" in note


def with_rheology(**changes):
    return dataclasses.replace(OIL, rheology=dataclasses.replace(OIL.rheology, **changes))

"""Laws with a loop inside are compiled once for each shape where they are called by hand."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.contacts import (
    ContactPatch,
    DistributedTraction,
    Gupta,
    LineContact,
    Moes,
    PointContact,
    Resolution,
    Sliding,
)
from jaxbearing.contacts.heated_film import heated_film
from jaxbearing.gaps import ShortJournal
from jaxbearing.numerics.compiling import compiled_by_hand
from jaxbearing.scenes.oil.catalogue import load_oil

COMPILATION = "/jax/core/compile/backend_compile_duration"
OIL = load_oil("mobil_jet_ii")
POINT = PointContact(8e-3, 20e-3, 230e9)
LINE = LineContact(8e-3, 15e-3, 230e9)


def traction(sliding):
    law = DistributedTraction(resolution=Resolution(8, 4, False))
    patch = ContactPatch(1e-4, 4e-4, 1.2e9)
    return law.traction(patch, 0.4e-6, 20.0, Sliding(sliding), 380.0, OIL).rolling


def film(speed):
    inlet = OIL.at(380.0)
    return heated_film(Moes(), Gupta(), LINE, 800.0, speed, 0.3, OIL, inlet).log_thickness


LAWS = {
    "ellipticity": lambda x: PointContact(8e-3, 20e-3 * x, 230e9).ellipticity(),
    "warm film": lambda x: film(20.0 * x),
    "journal": lambda x: ShortJournal(60e-3, 8e-3, 100e-6).static_equilibrium(20.0 * x, 900.0, 400.0, 0.01, 1.0)[0],
    "traction": lambda x: traction(0.2 * x),
}


@pytest.mark.parametrize("name", LAWS)
def test_the_second_call_compiles_nothing(name):
    law = LAWS[name]
    compiled = []
    listener = lambda event, *_, **__: compiled.append(event) if event == COMPILATION else None
    jax.monitoring.register_event_duration_secs_listener(listener)
    try:
        jax.jit(lambda x: 2.0 * x)(1.0)
        assert compiled  # a compilation is heard of
        law(1.0)  # perhaps compiled before, by another test of this process
        compiled.clear()
        found = law(1.1)
        assert not compiled
    finally:
        jax.monitoring.unregister_event_duration_listener(listener)
    np.testing.assert_allclose(found, jax.jit(law)(1.1), rtol=1e-12)
    slope = jax.grad(lambda x: jnp.sum(law(x)))(1.1)
    np.testing.assert_allclose(slope, (law(1.1 + 1e-5) - law(1.1 - 1e-5)) / 2e-5, rtol=1e-6)


def test_structure_stays_structure():
    @compiled_by_hand
    def power(x, n, square):
        return x**2 if square is True else x * n

    assert float(power(3, 2.0, False)) == 6.0
    assert float(power(3.0, 2, True)) == 9.0

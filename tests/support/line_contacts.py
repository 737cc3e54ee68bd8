"""Line contacts of the tests: the two of the source's Table 18, and contacts by their Moes numbers."""

import jax
import jax.numpy as jnp
import numpy as np

from jaxbearing.ehl import ContactBodies, ContactGeometry, ContactOperation, EHLLineContact, FilmModel
from jaxbearing.lubricants import Barus, ConstantPressureViscosity, Lubricant
from jaxbearing.materials import Material
from jaxbearing.scenes.oil.catalogue import load_oil

STEEL = Material(np.float64(205e9), np.float64(0.3), np.float64(7850.0))
MODULUS = 205e9 / 0.91
RADIUS = 2.435e-3
CONDITIONS = {1: (76310.0, 293.15), 2: (120140.0, 313.15)}


def satellite(condition=1, nodes=201, speed=0.02, oil=None, **model):
    """A contact of Table 18, incompressible unless said otherwise."""
    load, temperature = CONDITIONS[condition]
    model = {"compressible": False} | model
    return EHLLineContact(
        ContactGeometry(RADIUS),
        ContactBodies(STEEL, STEEL),
        load_oil("pennzane_x2000") if oil is None else oil,
        FilmModel(nodes=nodes, **model),
        ContactOperation(speed, temperature, load),
    )


def by_moes(m, el, nodes=201, inlet=4.0):
    """An incompressible contact with Barus' oil and these Moes numbers; U = 1e-11."""
    u = 1e-11
    alpha = el / (MODULUS * u**0.25)
    viscosity = u * MODULUS * 0.01 / 2.0
    values = [jnp.asarray(v, dtype=float) for v in (viscosity, 300.0, alpha, 0.0)]
    oil = Lubricant(Barus(*values), ConstantPressureViscosity(values[2]))
    load = jnp.asarray(m * MODULUS * 0.01 * np.sqrt(u), dtype=float)
    scene = EHLLineContact(
        ContactGeometry(0.01),
        ContactBodies(STEEL, STEEL),
        oil,
        FilmModel(nodes=nodes, inlet=inlet, compressible=False),
        ContactOperation(1.0, 300.0, load),
    )
    return jax.tree.map(jnp.asarray, scene), 0.01 * np.sqrt(u)

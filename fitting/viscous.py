"""The viscous function that a fit is for."""

import dataclasses

import equinox as eqx
import numpy as np

from jaxbearing.contacts import BairWiner, ElsharkawyHamrock, GecimWiner, ReeEyring
from jaxbearing.lubricants import ExponentialRheology
from jaxbearing.machines import TwoDisk

from .parameters import NAMES

VISCOUS = {
    "ree_eyring": ReeEyring,
    "bair_winer": BairWiner,
    "gecim_winer": GecimWiner,
    "elsharkawy_hamrock": ElsharkawyHamrock,
}


def with_viscous_function(scene: TwoDisk, model: str | None) -> tuple[TwoDisk, str]:
    """The scene with another viscous function; the exponent of Elsharkawy and Hamrock's law is the oil's, or 2."""
    traction = scene.contact.traction
    if model is None or model == traction.viscous.name:
        return scene, traction.viscous.name
    exponent = None if scene.oil.rheology is None else scene.oil.rheology.exponent
    viscous = VISCOUS[model]()
    if model == "elsharkawy_hamrock" and exponent is not None:
        viscous = ElsharkawyHamrock(exponent)
    return eqx.tree_at(lambda s: s.contact.traction, scene, dataclasses.replace(traction, viscous=viscous)), model


def plain_rheology(rheology: ExponentialRheology, model: str, scene: TwoDisk) -> ExponentialRheology:
    """Numbers instead of arrays, with the name of the law that they were fitted with."""
    numbers = {name: np.float64(getattr(rheology, name)) for name in NAMES}
    viscous = scene.contact.traction.viscous
    exponent = float(viscous.exponent) if isinstance(viscous, ElsharkawyHamrock) else None
    return dataclasses.replace(rheology, **numbers, viscous_function=model, exponent=exponent)

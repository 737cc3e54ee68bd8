"""The viscous function of a fit."""

import dataclasses

import equinox as eqx
import numpy as np

from jaxbearing.contacts import VISCOUS_LAWS, ElsharkawyHamrock, viscous_function, viscous_function_for
from jaxbearing.lubricants import ExponentialRheology
from jaxbearing.machines import TwoDisk

from .parameters import GROUPS, NAMES, SYMBOLS

VISCOUS = VISCOUS_LAWS


def with_viscous_function(scene: TwoDisk, model: str | None) -> tuple[TwoDisk, str]:
    """The scene with the viscous function named `model` (None: its own, or that of its oil), and the name of that
    function; the exponent of Elsharkawy and Hamrock's law is the oil's, or 2."""
    traction = scene.contact.traction
    viscous = viscous_function_for(traction.viscous, scene.oil)
    if model is not None and model != viscous.name:
        viscous = viscous_function(model, scene.oil.rheology)
    traction = dataclasses.replace(traction, viscous=viscous)
    return eqx.tree_at(lambda s: s.contact.traction, scene, traction), viscous.name


def held_misfit(scene: TwoDisk, fitted: tuple[str, ...]) -> tuple[str, ...]:
    """A sentence if stress parameters are held that were fitted with another viscous function: they are meaningful with
    that function only.

    **Arguments:** `scene`: with the viscous function of the fit, and the oil before the fit; `fitted`: names of the
    parameters that are fitted.
    """
    held = [SYMBOLS[i] for i in GROUPS[1] if NAMES[i] not in fitted]
    notes = scene.contact.traction.notes(scene.oil)
    return tuple(f"{', '.join(held)} held at the oil's own: {note}." for note in notes) if held else ()


def plain_rheology(rheology: ExponentialRheology, model: str, scene: TwoDisk) -> ExponentialRheology:
    """The rheology with numbers instead of arrays, and with the viscous function and exponent of the fit."""
    numbers = {name: np.float64(getattr(rheology, name)) for name in NAMES}
    viscous = viscous_function_for(scene.contact.traction.viscous, scene.oil)
    exponent = float(viscous.exponent) if isinstance(viscous, ElsharkawyHamrock) else None
    return dataclasses.replace(rheology, **numbers, viscous_function=model, exponent=exponent)

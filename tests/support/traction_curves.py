"""Synthetic traction curves with known rheology: Mobil Jet II, 3 temperatures, 2 pressures, 10 slides."""

import dataclasses

import equinox as eqx
import numpy as np
from reference_oils import mobil_jet_ii

from fitting.parameters import NAMES
from jaxbearing.contacts import DistributedTraction, NijenbanningVennerMoes, ReeEyring, Resolution
from jaxbearing.machines import DiskGeometry, DiskMaterials, DiskOperation, TwoDisk, TwoDiskLaws
from jaxbearing.materials import Material

STEEL = Material(205e9, 0.3, 7800.0)
TEMPERATURES, PRESSURES, SPEED = (297.0, 340.0, 378.0), (1.05e9, 1.5e9), 21.175
SLIDES = 2.0 * np.geomspace(5e-4, 0.1, 10)


@dataclasses.dataclass
class Curves:
    """Columns as `fitting.io.CurveTable` has them."""

    slide_to_roll: np.ndarray
    traction_coefficient: np.ndarray
    pressure: np.ndarray
    entrainment_speed: np.ndarray
    temperature: np.ndarray
    curve: np.ndarray
    curve_names: tuple
    load: None = None


def mobil_scene():
    """Isothermal two-disk machine, coarse: what is fitted is made with the same steps."""
    return TwoDisk(
        geometry=DiskGeometry(0.02),
        materials=DiskMaterials(STEEL, STEEL),
        oil=mobil_jet_ii(),
        contact=TwoDiskLaws(NijenbanningVennerMoes(), DistributedTraction(ReeEyring(), Resolution(16, 8))),
        operation=DiskOperation(
            slide_to_roll=SLIDES, pressure=PRESSURES, entrainment_speed=[SPEED], temperature=TEMPERATURES
        ),
    )


def mobil_curves():
    """The points without noise."""
    scene = mobil_scene()
    grid = np.meshgrid(TEMPERATURES, PRESSURES, SLIDES, indexing="ij")
    temperature, pressure, slide = (axis.ravel() for axis in grid)
    state = scene.state(slide, SPEED, temperature, pressure=pressure)
    coefficient = eqx.filter_jit(lambda s, st: s.traction(st).rolling / st.load)(scene, state)
    names = tuple(f"{t:g} K, {p / 1e9:g} GPa" for t in TEMPERATURES for p in PRESSURES)
    curve = np.repeat(np.arange(len(names)), len(SLIDES))
    speed = np.full(slide.shape, SPEED)
    return Curves(slide, np.asarray(coefficient), pressure, speed, temperature, curve, names)


def wrong_start(scene):
    """Modulus and stress wrong by a factor of 3, the coefficients by 20 to 30 %."""
    rheology = scene.oil.rheology
    factors = (3.0, 0.8, 0.7, 1.0 / 3.0, 1.2, 1.3)
    wrong = {name: np.float64(getattr(rheology, name) * f) for name, f in zip(NAMES, factors, strict=True)}
    return eqx.tree_at(lambda s: s.oil.rheology, scene, dataclasses.replace(rheology, **wrong))

"""Two-disk machines that several tests share, built from the parts in Python."""

import numpy as np

from jaxbearing.contacts import DistributedTraction, NijenbanningVennerMoes, ReeEyring, Resolution
from jaxbearing.machines import DiskGeometry, DiskMaterials, DiskOperation, TwoDisk, TwoDiskLaws
from jaxbearing.materials import Material
from jaxbearing.scenes.oil.catalogue import load_oil

STEEL = Material(np.float64(205e9), np.float64(0.3), np.float64(7850.0))
COARSE = Resolution.for_accuracy(1e-2)


def mobil_jet_ii(**operation):
    """The built-in scene `two_disk_mobil_jet_ii` in Python."""
    values = {
        "slide_to_roll": np.geomspace(1e-4, 0.2, 41),
        "entrainment_speed": [21.175, 60.965],
        "temperature": [297.0, 378.0],
        "pressure": [1.05e9, 1.5e9],
    }
    return TwoDisk(
        geometry=DiskGeometry(reduced_radius_rolling=0.02),
        materials=DiskMaterials(STEEL, STEEL),
        oil=load_oil("mobil_jet_ii"),
        contact=TwoDiskLaws(
            film=NijenbanningVennerMoes(), traction=DistributedTraction(ReeEyring(), Resolution.for_accuracy(1e-4))
        ),
        operation=DiskOperation(**(values | operation)),
    )


def small(**operation):
    """One coarse curve of five points, cheap to compile."""
    values = {"slide_to_roll": [-0.05, 0.0, 0.002, 0.01, 0.05], "entrainment_speed": 20.0, "temperature": 340.0}
    values["pressure"] = None if "load" in operation else 1.2e9
    scene = mobil_jet_ii(**(values | operation))
    return scene.replace({"contact.traction.resolution": COARSE})

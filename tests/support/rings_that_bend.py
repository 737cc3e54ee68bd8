"""What tests of rings that bend, or that are not round, have in common."""

import numpy as np

import jaxbearing as jb
from jaxbearing.bearings.bearing import AbstractBearing


def lobes(kind, order, height, angle=0.0):
    return kind(lobe_order=[float(order)], lobe_height=[height], lobe_angle=[angle])


def unbalance(scene: AbstractBearing, solution: jb.Solution) -> float:
    """Largest force on an amplitude of the ring that is not balanced, over the load of all elements: written again from
    the results."""
    part, found, elements = scene.outer_ring, solution.outer_ring, solution.elements
    order, azimuth = np.asarray(found.order)[:, None], np.asarray(elements.azimuth)
    radius = 0.5 * float(scene.raceway_diameters[1]) + 0.5 * part.thickness
    modulus = float(scene.materials.rings.youngs_modulus)
    bending, axial = modulus * part.width * part.thickness**3 / 12.0, modulus * part.width * part.thickness
    each = bending / radius**4 / (1.0 + bending / (axial * radius**2)) * (order**2 - 1.0) ** 2
    each = np.where(order == 0, axial / radius**2, each) + part.housing_stiffness
    stiffness = (np.pi * radius * each * np.where(order == 0, 2.0, 1.0))[:, 0]
    names = ["", *(["_second"] if getattr(elements, "load_outer_second", None) is not None else [])]
    outward = sum(
        np.asarray(getattr(elements, f"load_outer{name}"))
        * np.cos(np.asarray(getattr(elements, f"contact_angle_outer{name}", 0.0)))
        for name in names
    )
    rows = [
        stiffness * np.asarray(amplitude) - shape(order * azimuth) @ outward
        for amplitude, shape in ((found.cosines, np.cos), (found.sines, np.sin))
    ]
    return float(np.max(np.abs(rows)) / np.sum(outward))

"""What tests of the losses of lubricated balls have in common."""

import numpy as np

from jaxbearing.contacts import DistributedTraction, HamrockDowsonCentral, NoThermalReduction, ReeEyring, Resolution

SIMPLE = {
    "contact.traction": DistributedTraction(ReeEyring(), Resolution(12, 8), elastic=False),
    "contact.film": HamrockDowsonCentral(),
    "contact.thermal": NoThermalReduction(),
}
"""Changes of a scene: forces and powers balance with any laws of the contacts."""


def check_losses(loss, drive_power, pieces):
    """The torques that drive the rings take the power that all interactions dissipate, whose parts add up; asked: 1e-8.

    **Arguments:** `loss`: losses; `pieces`: those of the raceways by kind, W.
    """
    parts = [value for field, value in vars(loss).items() if field != "total" and value is not None]
    np.testing.assert_allclose(sum(parts), loss.total, rtol=1e-14)
    np.testing.assert_allclose(drive_power, loss.total, rtol=1e-10)
    assert all(float(part) >= 0.0 for part in parts)
    for side in ("inner", "outer"):
        own = [getattr(pieces, f"{side}_{kind}") for kind in ("spin", "rolling", "transverse")]
        np.testing.assert_allclose(sum(own), getattr(loss, f"{side}_raceway"), rtol=1e-10)

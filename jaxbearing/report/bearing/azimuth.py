"""Azimuths in drawings and tables: 0 is below, on the load line, counter-clockwise."""

from typing import Any

import numpy as np

from ..display import displayed


def place_at(azimuth: Any, radius: Any) -> tuple[Any, Any]:
    """Distances from the bearing's axis on the page, to the right and upwards."""
    return radius * np.sin(azimuth), -radius * np.cos(azimuth)


def signed_degrees(azimuth: object) -> np.ndarray:
    """Above -180 and up to 180 deg."""
    degrees = displayed(1.0, "rad") * np.asarray(azimuth)
    return np.where(degrees > 180.0 + 1e-9, degrees - 360.0, degrees)

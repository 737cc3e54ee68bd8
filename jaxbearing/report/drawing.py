"""A drawing of a bearing that shows the meaning of each dimension of its scene.

The drawing is to scale except for the clearances: these are micrometres beside millimetres, so they are all drawn at
one visible size, with their true values beside them. Bore, outside diameter and width of the rings are not part of a
scene and have usual proportions.
"""

from typing import TYPE_CHECKING

from ..bearings.bearing import AbstractBearing
from ..bearings.cylindrical.scene import CylindricalRollerBearing
from .bearing.drawing.any_family import draw_in_section
from .bearing.drawing.cylindrical import draw_cylindrical

if TYPE_CHECKING:
    import matplotlib.figure


def draw_bearing(scene: object) -> "matplotlib.figure.Figure":
    """Draws a bearing seen along its axis and in a section through the axis; for a cylindrical roller bearing also one
    roller in its pocket.

    Every dimension that the scene has is marked, or listed beside the drawing, with its field name and value.

    **Raises:** `TypeError` for anything but a bearing.
    """
    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"draw_bearing draws a bearing, got a {type(scene).__name__}")
    return draw_cylindrical(scene) if isinstance(scene, CylindricalRollerBearing) else draw_in_section(scene)

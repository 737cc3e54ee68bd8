"""A drawing of a bearing that shows what each dimension of its scene is.

To scale, but for the clearances: they are micrometres beside millimetres, so each is drawn at one visible size and its
true value stands beside it. Bore, outside diameter and width of the rings are no part of a scene and are drawn at
usual proportions.
"""

from typing import TYPE_CHECKING

from ..bearings.bearing import AbstractBearing
from ..bearings.cylindrical.scene import CylindricalRollerBearing
from .bearing.drawing.any_family import draw_in_section
from .bearing.drawing.cylindrical import draw_cylindrical

if TYPE_CHECKING:
    import matplotlib.figure


def draw_bearing(scene: object) -> "matplotlib.figure.Figure":
    """A bearing seen along its axis and in a section through the axis; of a cylindrical roller bearing one roller and
    its pocket too.

    Every dimension that the scene has is marked, or listed beside the drawing, with its field name and value.

    **Raises:** `TypeError` for something else than a bearing.
    """
    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"draw_bearing draws a bearing, got a {type(scene).__name__}")
    return draw_cylindrical(scene) if isinstance(scene, CylindricalRollerBearing) else draw_in_section(scene)

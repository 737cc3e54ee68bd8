"""The verb that sets makers' friction formulas beside the physics of a scene."""

import os
from typing import TYPE_CHECKING

from ._scene import AbstractScene
from .bearings.bearing import AbstractBearing
from .makers import Catalogue, Comparison, compared
from .scenes.bearing.catalogue import load_catalogue
from .scenes.reader import load_scene
from .solve import solve

if TYPE_CHECKING:
    from .bearings.solution import Solution


def compare(
    scene: AbstractScene | str | os.PathLike[str],
    solution: "Solution | None" = None,
    *,
    catalogue: Catalogue | None = None,
) -> Comparison:
    """Makers' friction formulas beside the losses of a scene: SKF, Palmgren with the constants of INA and of Timken,
    Timken's for tapered bearings.

        found = jb.compare("tapered_example", catalogue=jb.Catalogue(designation="30206", outside_diameter=62e-3))
        found.physical.total, found["skf"].total, found["skf"].parts["rolling"], found["skf"].missing

    The formulas are fits to catalogue bearings, they differ among themselves by two to three, and nothing of them
    enters a result. A formula that does not cover the bearing, or lacks an input, has no total and says why.

    **Arguments:**
    - `scene`: a bearing, or a scene file or the name of a built-in scene, whose table [catalogue] counts.
    - `solution`: of the scene; not given: it is solved.
    - `catalogue`: the bearing as a catalogue names it; not given: that of the file, else what the scene says.

    **Raises:** `SolveError` where the solve fails; `TypeError` for a scene that is no bearing; `ValueError` for a
    solution that did not converge, or of a batch; `SceneError` for a file that cannot be read.
    """
    if not isinstance(scene, AbstractScene):
        source = os.fspath(scene)
        catalogue = load_catalogue(source) if catalogue is None else catalogue
        scene = load_scene(source)
    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"makers' formulas are of bearings, got a {type(scene).__name__}")
    return compared(scene, solve(scene) if solution is None else solution, catalogue)

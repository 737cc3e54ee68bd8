"""The verb `compare`: makers' friction formulas beside the computed losses of a scene."""

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
    """Compares makers' friction formulas with the computed losses of a scene: SKF's, Palmgren's with the constants of
    INA and of Timken, and Timken's for tapered bearings.

        found = jb.compare("tapered_example", catalogue=jb.Catalogue(designation="30206", outside_diameter=62e-3))
        found.physical.total, found["skf"].total, found["skf"].parts["rolling"], found["skf"].missing

    The formulas are fits to catalogue bearings and differ from each other by a factor of two to three. They do not
    change the solution. A formula that does not cover the bearing, or lacks an input, has no total and says why.

    **Arguments:**
    - `scene`: a bearing, a scene file or the name of a built-in scene. The table [catalogue] of the file is used.
    - `solution`: of the scene; not given: the scene is solved.
    - `catalogue`: designation and catalogue data of the bearing; not given: those of the file, else of the scene.

    **Raises:** `SolveError` where the solve fails; `TypeError` for a scene that is no bearing; `ValueError` for a
    solution that did not converge or that is a batch; `SceneError` for a file that cannot be read.
    """
    if not isinstance(scene, AbstractScene):
        source = os.fspath(scene)
        catalogue = load_catalogue(source) if catalogue is None else catalogue
        scene = load_scene(source)
    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"makers' formulas are of bearings, got a {type(scene).__name__}")
    return compared(scene, solve(scene) if solution is None else solution, catalogue)

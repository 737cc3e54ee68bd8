"""Bearings on a shaft: single bearings, matched sets, their preload and the support of their outer rings.

A bearing's own axis $e_x$ points along +X (`thrust` "+x", `<` in the picture of a set) or along -X ("-x", `>`). An
axial force on the inner ring in this direction closes the bearing. A bearing along -X is mirrored and not rotated, so
azimuths and the sense of rotation stay the same.
"""

from typing import Any, ClassVar, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._scene import label, number, optional_number
from .._types import Scalar
from ..bearings.bearing import AbstractBearing
from ..numerics.checks import Checked, array_module, demand
from ..numerics.precision import as_float
from ..numerics.ranges import CLOSURES, RANGES
from ..numerics.structure import choice

SENSES = {"+x": 1.0, "-x": -1.0, "<": 1.0, ">": -1.0}
"""Word or sign of an orientation -> 1 if the bearing's axis points along +X, -1 if it points along -X."""


def _numbers(value: object) -> Any:
    """Converts a sequence or array of numbers to a float64 array; keeps `None`."""
    if isinstance(value, list | tuple):
        traced = any(isinstance(leaf, jax.Array) for leaf in jax.tree.leaves(value))
        value = jnp.asarray(value) if traced else np.asarray(value, dtype=np.float64)
    return as_float(value)


def _array(unit: str, description: str, **kwargs: Any) -> Any:
    """Field that holds an array of numbers."""
    return eqx.field(converter=_numbers, metadata=label(unit, description), **kwargs)


class LinearBearing(eqx.Module):
    """A bearing that is given by its stiffness alone: f = K q.

    **Arguments:** `stiffness`: K in the bearing's own frame, shape (5, 5), rows and columns axial, radial, lateral,
    tilt and lateral tilt, N/m, N/rad, N m/m and N m/rad. It need not be symmetric.
    """

    kind: ClassVar[str] = "linear"

    stiffness: Float[Array | np.ndarray, "5 5"] = _array("mixed", "stiffness of a linear bearing")


class Support(Checked):
    """Elastic support of an outer ring against the ground, in the frame of the shaft.

    **Arguments:**
    - `axial`, `radial`, `tilt`: stiffness along X, across X in all directions, and about all axes across X: N/m, N/m,
      N m/rad. A degree of freedom without a stiffness is rigid.
    - `matrix`: full stiffness matrix, shape (5, 5), as in `LinearBearing`, in place of these three.
    """

    part: ClassVar[str] = "support"

    axial: Scalar | None = optional_number(bound="> 0", metadata=label("N/m", "axial stiffness of the support"))
    radial: Scalar | None = optional_number(bound="> 0", metadata=label("N/m", "radial stiffness of the support"))
    tilt: Scalar | None = optional_number(bound="> 0", metadata=label("N m/rad", "tilt stiffness of the support"))
    matrix: Float[Array | np.ndarray, "5 5"] | None = _array("mixed", "stiffness of the support", default=None)

    def __check_init__(self):
        super().__check_init__()
        if self.matrix is not None and any(stiffness is not None for stiffness in (self.axial, self.radial, self.tilt)):
            raise ValueError("support.matrix: expected none beside axial, radial and tilt")


class Preload(Checked):
    """Preload of a set, given in one of the following ways.

    - `force`: axial force between the two opposed groups of the mounted set, at rest and without load, N. The closure
      that gives it is the same for all bearings and stays fixed. For a force of 0 it is the closure at first contact.
    - `class_force`: axial force at which ONE bearing of the set reaches the closure that all bearings get, N. Makers
      define the preload classes of universally ground bearings in this way.
    - `offset`: closure of every bearing, m; a negative closure is play.
    - `spring_force`: force of springs that press the outer rings of the last group of the set, mounted and at rest, N;
      `spring_stiffness`: stiffness of these springs together, N/m, 0 for a constant force.
    """

    part: ClassVar[str] = "preload"

    force: Scalar | None = optional_number(bound=">= 0", metadata=label("N", "preload force"))
    class_force: Scalar | None = optional_number(bound=">= 0", metadata=label("N", "preload class force"))
    offset: Scalar | None = optional_number(bound=CLOSURES, metadata=label("m", "closure of each bearing"))
    spring_force: Scalar | None = optional_number(bound=">= 0", metadata=label("N", "spring force, mounted"))
    spring_stiffness: Scalar | None = optional_number(bound=">= 0", metadata=label("N/m", "stiffness of the springs"))

    def __check_init__(self):
        super().__check_init__()
        ways = ("force", "class_force", "offset", "spring_force")
        chosen = [name for name in ways if getattr(self, name) is not None]
        if len(chosen) != 1:
            raise ValueError(f"preload must have one of {', '.join(ways)}, got {' and '.join(chosen) or 'none'}")
        if self.spring_stiffness is not None and self.spring_force is None:
            raise ValueError("preload.spring_stiffness: expected none without spring_force")

    @property
    def way(self) -> str:
        """Name of the field that is given."""
        ways = ("force", "class_force", "offset", "spring_force")
        return next(name for name in ways if getattr(self, name) is not None)


class MountedBearing(Checked):
    """One bearing on a shaft.

    **Arguments:**
    - `name`: name of the bearing.
    - `scene`: the bearing. Loads and inner speed of its operating point have no effect; its outer speed has.
    - `position`: position of its row (middle of the rollers, plane of the unloaded balls), m.
    - `thrust`: direction in which an axial force on the inner ring closes the bearing, "+x" or "-x".
    - `closure`: closure of an adjusted bearing, m: it is added to the axial displacement in the bearing's own frame.
    - `expansion`: expansion of the inner raceway's radius less that of the outer raceway, m.
    - `support`: elastic support of the outer ring; `None` for a rigid support.
    """

    part: ClassVar[str] = "bearing"

    name: str = eqx.field(static=True)
    scene: AbstractBearing | LinearBearing
    position: Scalar = number(metadata=label("m", "position along the shaft"))
    thrust: Literal["+x", "-x"] = choice("bearing.thrust", ("+x", "-x"), "+x")
    closure: Scalar = number(0.0, bound=CLOSURES, metadata=label("m", "closure"))
    expansion: Scalar = number(0.0, metadata=label("m", "expansion of the inner raceway"))
    support: Support | None = None

    @property
    def sense(self) -> float:
        """Sense of the bearing: 1 if its axis points along +X, else -1."""
        return SENSES[self.thrust]


def _demand_each(name: str, values: object, bound: str) -> None:
    """Checks all numbers of an array of a set. **Raises:** `ValueError` for known numbers outside their bound."""
    if not isinstance(values, np.ndarray | np.generic | float | jax.Array):
        return
    fine = array_module(values).all(RANGES[bound].holds(values))
    demand(f"{{path}}.{name} must be {bound}", fine, lambda: f"set.{name} must be {bound}, got {np.asarray(values)}")


class MatchedSet(Checked):
    """Bearings that are matched by grinding and mounted side by side.

    **Arguments:**
    - `name`: name of the set; its bearings are called `name.1`, `name.2` ...
    - `picture`: one sign for each bearing from -X to +X, which shows the cone of its contact lines. The axis of `<`
      points along +X and that of `>` along -X. `<>` is an O arrangement, `><` an X arrangement, `<<` a tandem.
    - `scene`: the bearing, or a tuple with a bearing for each sign.
    - `position`: middle between the first and the last row, m.
    - `distance`: distance of neighbouring rows, m, or a distance for each gap, shape (n - 1,).
    - `preload`: preload of the set; with `None` all bearings touch and carry nothing.
    - `mismatch`: additional closure of each bearing, m, shape (n,); `None` for 0.
    - `expansion`: expansion of the inner raceways' radius less that of the outer raceways, m.
    - `support`: elastic support of each outer ring; `None` for rigid supports.
    """

    part: ClassVar[str] = "set"

    name: str = eqx.field(static=True)
    picture: str = eqx.field(static=True)
    scene: AbstractBearing | tuple[AbstractBearing, ...]
    position: Scalar = number(metadata=label("m", "position of the middle of the set"))
    distance: Float[Array | np.ndarray, "..."] = _array("m", "distance of neighbouring rows")
    preload: Preload | None = None
    mismatch: Float[Array | np.ndarray, " bearing"] | None = _array(
        "m", "additional closure of each bearing", default=None
    )
    expansion: Scalar = number(0.0, metadata=label("m", "expansion of the inner raceways"))
    support: Support | None = None

    def __check_init__(self):
        super().__check_init__()
        if len(self.picture) < 2 or set(self.picture) - {"<", ">"}:
            raise ValueError(f"set.picture must be two or more signs, each '<' or '>', got {self.picture!r}")
        if isinstance(self.scene, tuple) and len(self.scene) != len(self.picture):
            raise ValueError(
                f"set.scene must be one bearing or one for each sign of the picture {self.picture!r}, got "
                f"{len(self.scene)}"
            )
        if self.preload is not None and len(set(self.picture)) == 1:
            raise ValueError(f"set.preload: expected none of a tandem {self.picture!r}, which nothing opposes")
        for name, count in (("distance", len(self.picture) - 1), ("mismatch", len(self.picture))):
            value = getattr(self, name)
            shape = () if value is None else np.shape(value)
            if shape and shape != (count,):
                raise ValueError(f"set.{name} must have {count} numbers for the picture {self.picture!r}, got {shape}")
        _demand_each("distance", self.distance, "> 0")
        _demand_each("mismatch", self.mismatch, CLOSURES)

    @property
    def count(self) -> int:
        """Number of bearings."""
        return len(self.picture)

    @property
    def scenes(self) -> tuple[AbstractBearing, ...]:
        """The bearings, one for each sign."""
        return self.scene if isinstance(self.scene, tuple) else (self.scene,) * self.count

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the bearings."""
        return tuple(f"{self.name}.{place + 1}" for place in range(self.count))

    @property
    def senses(self) -> tuple[float, ...]:
        """Sense of each bearing: 1 if its axis points along +X, else -1."""
        return tuple(SENSES[sign] for sign in self.picture)

    def positions(self) -> Float[Array | np.ndarray, " bearing"]:
        """Positions of the rows, m."""
        xp = array_module(self.distance, self.position)
        gaps = xp.broadcast_to(self.distance, (self.count - 1,))
        from_first = xp.concatenate([xp.zeros(1), xp.cumsum(gaps)])
        return self.position + from_first - 0.5 * from_first[-1]

"""Stiffness over shaft speed as a file of the rotordynamics package ROSS: `ross.BearingElement.load(file)`.

**Axes.** ROSS has z along the shaft, and x and y across it, right-handed. Here (radial, lateral, axial) is right-handed
too, with radial along the load line. So z is the axial direction, and one angle, `load_direction` from x to the load
line, turns radial and lateral into x and y. The default is the usual one in ROSS: weight along -y.

**Coefficients.** Tangent stiffness of the inner ring at the shaft speeds of the table, each with all other degrees of
freedom of the ring held. The bearing element of ROSS has neither tilt nor coupling of z with x and y, so these are left
out. The damping is 0 because the model is quasi-static; rolling bearings have a little damping, so add a value if you
know it.

**Axis of the table.** The coefficients belong to a shaft speed. ROSS 3 calls this axis `speed`, and reads `frequency`
as the whirl frequency. ROSS 2 knows only `frequency`, and interpolates at the frequency of its analysis; in a
synchronous analysis (unbalance, forward line of a Campbell diagram) this is the shaft speed. A file has only one of the
two: with both, ROSS 3 expects a two-dimensional table, and without `frequency` ROSS 2 refuses the table.

**Interpolation.** ROSS 3 uses a monotone cubic between the speeds, and continues it linearly beyond the ends. ROSS 2.3
uses a line (2 speeds), a parabola (3) or a cubic smoothing spline (4 or more), which meets the values of the table to a
few N/m, and extrapolates beyond the first and the last speed without a warning.
"""

import math
import os
import re
from typing import Literal

import numpy as np
import tomli_w

from .._version import __version__
from ..bearings.solution import RING_FREEDOMS
from .files import write_whole
from .stiffness import StiffnessTable

WEIGHT_DIRECTION = -math.pi / 2
"""Default angle from x to the load line, rad: the load points along -y."""
FEWEST_SPEEDS = 2
Version = Literal[2, 3]
NEWEST: Version = 3
AXES: dict[Version, str] = {2: "frequency", 3: "speed"}
"""Major version of ROSS -> its name for the axis of shaft speeds."""
TESTED: dict[Version, str] = {2: "2.3.0", 3: "3.1.0"}
"""Major version of ROSS -> release with which reading the files was tested."""
_ZERO = ("cxx", "cxy", "cyx", "cyy", "czz")
_TAG = re.compile(r"[A-Za-z0-9_-]+")


def ross_bearing(
    table: StiffnessTable,
    *,
    load_direction: float = WEIGHT_DIRECTION,
    node: int = 0,
    tag: str = "bearing",
    version: Version = NEWEST,
) -> dict[str, object]:
    """Arguments of `ross.BearingElement`, as plain numbers and lists.

    **Arguments:**
    - `load_direction`: angle of the load line from ROSS's x axis towards its y axis, rad.
    - `node`: node of the rotor; `tag`: name of the element, of letters, digits, _ and -.
    - `version`: major version of ROSS, 2 or 3.

    **Raises:** `ValueError` for fewer than 2 speeds (ROSS reads a single one as a constant), a stiffness that is not
    finite, a table without the radial and the lateral degree of freedom, or an invalid `tag`.
    """
    if len(table.speed) < FEWEST_SPEEDS:
        raise ValueError(f"a table over speed needs at least {FEWEST_SPEEDS} speeds, got {len(table.speed)}")
    if not np.all(np.isfinite(table.stiffness)):
        raise ValueError("the stiffness is not finite: a solve failed, or the ring is free")
    if not {"radial", "lateral"} <= set(table.modelled):
        raise ValueError(f"ROSS needs the radial and the lateral stiffness, got {', '.join(table.modelled)}")
    if not _TAG.fullmatch(tag):
        raise ValueError(f"tag must be of letters, digits, _ and -, got {tag!r}")
    return element_of(table.speed, table.stiffness, load_direction, node, tag, version)


def element_of(
    speed: np.ndarray, stiffness: np.ndarray, load_direction: float, node: int, tag: str, version: Version = NEWEST
) -> dict[str, object]:
    """Arguments of `ross.BearingElement` from the 5x5 stiffness matrices; axes of `stiffness`: speed, row, column."""
    axial, *across = (RING_FREEDOMS.index(name) for name in ("axial", "radial", "lateral"))
    cosine, sine = math.cos(load_direction), math.sin(load_direction)
    # columns: unit vectors of the radial and the lateral direction in x and y
    turn = np.array([[cosine, -sine], [sine, cosine]])
    plane = turn @ stiffness[:, across][:, :, across] @ turn.T
    coefficients = {f"k{a}{b}": plane[:, i, j] for i, a in enumerate("xy") for j, b in enumerate("xy")}
    # kzz is 0 for cylindrical rollers without flanges, which carry no axial load
    coefficients |= {"kzz": stiffness[:, axial, axial]} | dict.fromkeys(_ZERO, np.zeros(len(speed)))
    lists = {name: values.tolist() for name, values in coefficients.items()}
    return {"n": node, "tag": tag, AXES[version]: speed.tolist(), **lists}


def ross_text(
    table: StiffnessTable,
    scene_label: str = "",
    *,
    load_direction: float = WEIGHT_DIRECTION,
    node: int = 0,
    tag: str = "bearing",
    version: Version = NEWEST,
) -> str:
    """The TOML file that `ross.BearingElement.load` reads. See `ross_bearing`.

    **Arguments:** `scene_label`: name of the bearing, for a comment of the file.
    """
    element = ross_bearing(table, load_direction=load_direction, node=node, tag=tag, version=version)
    lines = [
        f"Stiffness over shaft speed for ROSS {version}: rs.BearingElement.load(file). Written by jaxbearing "
        f"{__version__}.",
        *([f"Scene: {one_line(scene_label)}"] if scene_label else []),
        f"{AXES[version]}: speed of the shaft, which carries the inner ring, rad/s; ROSS 2 calls it frequency, ROSS 3 "
        "speed.",
        "k..: N/m, tangent stiffness under the scene's loads, other degrees of freedom of the ring held.",
        "n: node of the rotor, and tag: change them to yours; no two elements of a rotor may have one tag.",
        "c.. = 0: the model is quasi-static and has no damping; put in what you know.",
        f"Load line of the bearing: {math.degrees(load_direction):.6g} deg from x towards y; z along the shaft.",
        "ROSS goes on beyond the first and the last speed without a word.",
    ]
    comments = "".join(f"# {line}\n" for line in lines)
    return f"{comments}\n{tomli_w.dumps({f'BearingElement_{tag}': element})}"


def write_ross(
    table: StiffnessTable,
    file: str | os.PathLike[str],
    scene_label: str = "",
    *,
    load_direction: float = WEIGHT_DIRECTION,
    node: int = 0,
    tag: str = "bearing",
    version: Version = NEWEST,
) -> None:
    """Writes the file of `ross_text`, whole or not at all; an existing file is replaced.

    **Raises:** `ValueError` for a name that does not end in .toml, by which ROSS recognises the format, and as
    `ross_bearing`; `OSError` if the file cannot be written.
    """
    if not os.fspath(file).lower().endswith(".toml"):
        raise ValueError(f"the file must end in .toml, got {os.fspath(file)!r}")
    text = ross_text(table, scene_label, load_direction=load_direction, node=node, tag=tag, version=version)
    write_whole(file, text)


def one_line(text: str) -> str:
    """Text for a comment: in one line, with control characters escaped, which TOML does not allow there."""
    return "".join(char if char.isprintable() else repr(char)[1:-1] for char in " ".join(text.split()))

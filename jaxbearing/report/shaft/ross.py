"""A shaft on its bearings as a rotor of the rotordynamics package ROSS: `ross.Rotor.load(file)`.

Axes and simplifications of the bearing elements are those of `report.ross`; here `load_direction` is the angle from
ROSS's x axis to Y. The nodes are ends of sections, bearings and masses. Shaft elements have Cowper's shear factor, as
in the package. Masses are disks without moments of inertia, which a scene does not give. Each bearing is one element at
its node, with the full 2x2 stiffness across the axis and the axial stiffness at each speed of the table, in series with
the elastic support of its outer ring.

`ross_version` in the file is the release with which reading was tested; other releases of ROSS report the difference.
"""

import math
import os
from collections import Counter
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import tomli_w

from ..._version import __version__
from ...materials import Material
from ...shafts.forces import Mass
from ...shafts.scene import ShaftSystem
from ...shafts.shaft import Section
from ..files import write_whole
from ..ross import NEWEST, TESTED, WEIGHT_DIRECTION, Version, element_of, one_line

if TYPE_CHECKING:
    from .stiffness import ShaftStiffness
else:
    ShaftStiffness = Any

SAME = 1e-9
"""Distance up to which two positions are the same node, m."""
_COLOUR = "#525252"


def require_rotor(scene: ShaftSystem) -> None:
    """Checks that ROSS can model the shaft. **Raises:** `ValueError` for a rigid shaft and for a housing."""
    if not scene.shaft.sections:
        raise ValueError("found a rigid shaft, expected one with shaft.sections: ROSS has no rigid rotors")
    if scene.housing is not None:
        raise ValueError("found a housing, which couples the outer rings; expected supports")


def ross_rotor(
    table: ShaftStiffness,
    scene: ShaftSystem,
    *,
    load_direction: float = WEIGHT_DIRECTION,
    version: Version = NEWEST,
) -> dict[str, dict[str, object]]:
    """Elements of the rotor: class and tag -> arguments of the class.

    **Raises:** as `require_rotor`; `ValueError` as `report.ross.ross_bearing`.
    """
    nodes = rotor_nodes(scene)
    masses = [force for force in scene.forces if isinstance(force, Mass)]
    elements: dict[str, dict[str, object]] = {}
    for number, (left, right) in enumerate(pairwise(nodes)):
        elements[f"ShaftElement_shaft{number}"] = _element(scene, left, right, number)
    for mass in masses:
        tag = mass.name
        disk = {"n": _node(nodes, float(mass.position)), "m": float(mass.mass), "Id": 0.0, "Ip": 0.0, "tag": tag}
        elements[f"DiskElement_{tag}"] = disk
    flat = Counter(name.replace(".", "_") for name in table.bearings)
    for name, values in table.bearings.items():
        # the name keeps its dot where two bearings, such as `front.1` and `front_1`, would get the same tag
        tag = name if flat[name.replace(".", "_")] > 1 else name.replace(".", "_")
        node = _node(nodes, table.position[name])
        elements[f"BearingElement_{tag}"] = element_of(table.speed, values, load_direction, node, tag, version)
    return elements


def rotor_nodes(scene: ShaftSystem) -> np.ndarray:
    """Positions of the nodes, m: ends of sections, bearings and masses. **Raises:** as `require_rotor`."""
    require_rotor(scene)
    ends = _ends(scene)
    masses = [float(force.position) for force in scene.forces if force.kind == "mass"]
    return _apart(np.clip([*ends, *(float(place.position) for place in scene.places), *masses], 0.0, ends[-1]))


def section_between(scene: ShaftSystem, left: float, right: float) -> tuple[Section, Material]:
    """Section of the shaft between two neighbouring nodes, and its material."""
    ends = _ends(scene)
    place = min(int(np.searchsorted(ends, 0.5 * (left + right))) - 1, len(scene.shaft.sections) - 1)
    section = scene.shaft.sections[place]
    return section, scene.shaft.material if section.material is None else section.material


def _ends(scene: ShaftSystem) -> np.ndarray:
    return np.concatenate([[0.0], np.cumsum([float(section.length) for section in scene.shaft.sections])])


def _apart(places: np.ndarray) -> np.ndarray:
    """Positions of nodes in ascending order, each once."""
    ordered = np.sort(places)
    return ordered[np.concatenate([[True], np.diff(ordered) > SAME])]


def _node(nodes: np.ndarray, position: float) -> int:
    return int(np.argmin(np.abs(nodes - position)))


def _element(scene: ShaftSystem, left: float, right: float, number: int) -> dict[str, Any]:
    section, material = section_between(scene, left, right)
    young, poisson = float(material.youngs_modulus), float(material.poisson_ratio)
    inner, outer = float(section.inner_diameter), float(section.outer_diameter)
    return {
        "L": float(right - left),
        "idl": inner,
        "odl": outer,
        "idr": inner,
        "odr": outer,
        "n": number,
        "axial_force": 0.0,
        "torque": 0.0,
        "shear_effects": True,
        "rotary_inertia": True,
        "gyroscopic": True,
        "shear_method_calc": "cowper",
        "tag": f"shaft{number}",
        "material": {
            "name": f"shaft{number}",
            "rho": float(material.density),
            "E": young,
            "G_s": young / (2.0 * (1.0 + poisson)),
            "color": _COLOUR,
        },
    }


def write_ross_rotor(
    table: ShaftStiffness,
    scene: ShaftSystem,
    file: str | os.PathLike[str],
    scene_label: str = "",
    *,
    load_direction: float = WEIGHT_DIRECTION,
    version: Version = NEWEST,
) -> None:
    """Writes the rotor to a file, whole or not at all; an existing file is replaced.

    **Raises:** `ValueError` for a name that does not end in .toml, and as `ross_rotor`; `OSError` if the file cannot be
    written.
    """
    if not os.fspath(file).lower().endswith(".toml"):
        raise ValueError(f"the file must end in .toml, got {os.fspath(file)!r}")
    elements = ross_rotor(table, scene, load_direction=load_direction, version=version)
    lines = [
        f"A shaft on bearings for ROSS {version}: rs.Rotor.load(file). Written by jaxbearing {__version__}.",
        *([f"Scene: {one_line(scene_label)}"] if scene_label else []),
        "k..: N/m, tangent stiffness of the bearings in the shaft's equilibrium, tilts held; c.. = 0: no damping.",
        "Disks have no moments of inertia (Id, Ip): put in what you know.",
        f"Y of the shaft: {math.degrees(load_direction):.6g} deg from x towards y; z along the shaft.",
    ]
    comments = "".join(f"# {line}\n" for line in lines)
    read = {"ross_version": TESTED[version], "parameters": {}, **elements}
    write_whole(file, f"{comments}\n{tomli_w.dumps(read)}")

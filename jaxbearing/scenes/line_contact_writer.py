"""The text of a scene file from a line contact: the way back from `line_contact_build`, to the last digit."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ..ehl import EHLLineContact
from ..ehl.mesh import INLET
from . import units
from .errors import printable
from .line_contact_schema import ACCURACIES, DEFAULT_ACCURACY
from .oil_files import Origin
from .oil_writer import law_lines, quantity_text


def line_contact_text(scene: EHLLineContact, header: Iterable[str], origins: Mapping[str, Origin] | None = None) -> str:
    """A scene without a table `simulation`.

    **Arguments:** `header`: lines of comment at the top; `origins`: of the laws of the oil, by name.

    **Raises:** `ValueError` for a law of the oil that files do not know.
    """
    lines = [*(f"# {printable(' '.join(text.split()))}".rstrip() for text in header)]
    lines += ["", 'kind = "line_contact"', "", "[geometry]"]
    lines += [_quantity("reduced_radius_rolling", scene.geometry.reduced_radius_rolling, units.LENGTH)]
    for name in ("body_1", "body_2"):
        body = getattr(scene.materials, name)
        lines += ["", f"[materials.{name}]", _quantity("youngs_modulus", body.youngs_modulus, units.PRESSURE)]
        lines += [f"poisson_ratio = {_float(body.poisson_ratio)!r}"]
        lines += [_quantity("density", body.density, units.DENSITY)]
    lines += law_lines(scene.oil, origins, "oil.")
    model, operation = scene.contact, scene.operation
    lines += ["", "[contact]", f"compressible = {str(model.compressible).lower()}"]
    # the default is left to the load
    cut = {"nodes": model.nodes, "inlet": model.inlet}
    default = cut == {"nodes": ACCURACIES[DEFAULT_ACCURACY], "inlet": INLET}
    given = {"accuracy": DEFAULT_ACCURACY} if default else cut
    lines += [f"{name} = {value!r}" for name, value in given.items()]
    lines += [_quantity("film_limit", model.film_limit, units.LENGTH), "", "[operation]"]
    load = ("pressure", units.PRESSURE) if operation.load_per_length is None else ("load_per_length", units.LINE_LOAD)
    lines += [_quantity(load[0], getattr(operation, load[0]), load[1])]
    lines += [_quantity("entrainment_speed", operation.entrainment_speed, units.SURFACE_SPEED)]
    lines += [_quantity("oil_temperature", operation.oil_temperature, units.TEMPERATURE)]
    return "\n".join(lines) + "\n"


def _float(value: Any) -> float:
    return float(np.asarray(value))


def _quantity(name: str, value: Any, dimension: units.Dimension) -> str:
    return f'{name} = "{quantity_text(_float(value), dimension)}"'

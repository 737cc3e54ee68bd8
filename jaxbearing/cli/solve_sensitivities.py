"""The sensitivities of `jaxbearing solve`: which were asked for, and what is shown of them."""

from contextlib import suppress
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from .messages import refuse
from .terminal import console

if TYPE_CHECKING:
    from .._scene import AbstractScene, AbstractSolution
    from ..loss_interval import PowerInterval
    from ..sensitivity import Sensitivities, UsualTolerance

BY = ("tolerance", "percent")
"""Ways to rank inputs, the usual one first."""
SensitivitiesOption = Annotated[
    bool,
    typer.Option(
        "--sensitivities",
        help="Also by how much each input moves power loss, cage slip and life, as far as the scene models them; of a "
        "line contact its film (the first time, this compiles a second program).",
    ),
]
SensitivitiesOfOption = Annotated[
    list[str] | None,
    typer.Option(
        "--sensitivities-of",
        metavar="RESULT",
        help="The same of this result of a bearing: power_loss, slip, life, modified_life, stiffness (radial), "
        "axial_stiffness or temperature (of the hottest node). May be repeated.",
    ),
]
SensitivitiesByOption = Annotated[
    str,
    typer.Option(
        "--sensitivities-by",
        metavar="WAY",
        help="Rank inputs by their usual tolerances (tolerance), or by one per cent of each (percent).",
    ),
]


class Asked(NamedTuple):
    """Sensitivities that are wanted.

    **Arguments:** `of`: results, `None` for the usual ones; `by`: one of `BY`; `drag_prior`: whether the interval of
    the power loss has the assumed drag coefficient.
    """

    of: tuple[str, ...] | None
    by: str
    drag_prior: bool


class Moved(NamedTuple):
    """Sensitivities of a solve, and by how much the usual tolerances move its results."""

    scene: "AbstractScene"
    slopes: "Sensitivities"
    effects: dict[str, dict[str, float]]
    tolerances: "dict[str, UsualTolerance]"
    interval: "PowerInterval | None"
    by: str


def asked(wanted: bool, of: list[str] | None, by: str, drag_prior: bool) -> Asked | None:
    """The sensitivities that the options ask for; `None` for no sensitivities. **Raises:** `SceneError` for an
    unknown name."""
    from ..scenes.errors import SceneError, nearest, one_of

    if by not in BY:
        raise SceneError("--sensitivities-by", "", f"'{by}'", one_of(BY), nearest(by, BY))
    if not wanted and not of:
        return None
    from ..sensitivity import ON_DEMAND, USUAL

    known = (*USUAL, *ON_DEMAND)
    for name in of or ():
        if name not in known:
            raise SceneError("--sensitivities-of", "", f"'{name}'", one_of(known), nearest(name, known))
    return Asked(tuple(of) if of else None, by, drag_prior)


def solved(model: "AbstractScene", wanted: Asked | None) -> "tuple[AbstractSolution, Sensitivities | None]":
    """The solution, and the sensitivities that are asked for."""
    if wanted is not None:
        from ..sensitivity import NoSensitivities, sensitivities

        more: dict[str, Any] = {} if wanted.of is None else {"of": wanted.of}
        try:
            return sensitivities(model, throw=False, **more)
        except NoSensitivities as error:  # raised while the program is traced, before it is compiled
            refuse(f"{'--sensitivities' if wanted.of is None else '--sensitivities-of'}: {error}")
    from ..solve import solve_once

    return solve_once(model), None


def moved(
    model: "AbstractScene",
    solution: "AbstractSolution",
    slopes: "Sensitivities | None",
    wanted: Asked | None,
    source: str,
    changes: dict[str, str],
) -> Moved | None:
    """The results that the usual tolerances move. **Arguments:** `source`, `changes`: of the scene, for its own
    distributions."""
    if slopes is None or wanted is None:
        return None
    from ..loss_interval import power_interval
    from ..scenes.errors import SceneError
    from ..scenes.reader import load_distributions
    from ..sensitivity import effects
    from ..tolerance.usual import usual_tolerances

    own: dict[str, Any] = {}
    with suppress(SceneError):  # a pipe cannot be read twice
        own |= load_distributions(source, changes)
    tolerances = usual_tolerances(model, own)
    interval = None
    if slopes.power_loss is not None:
        numbers = {path: distribution for path, distribution in own.items() if path in slopes.power_loss}
        interval = power_interval(model, solution, given=numbers, drag_prior=wanted.drag_prior)
    return Moved(model, slopes, effects(model, slopes, tolerances), tolerances, interval, wanted.by)


def as_json(results: Moved) -> dict[str, Any]:
    """The entries of the JSON object."""
    from ..report.json_report import effects_to_dict, sensitivities_to_dict

    entries: dict[str, Any] = {
        "sensitivities": sensitivities_to_dict(results.slopes),
        "sensitivities_by_tolerance": effects_to_dict(results.effects, results.tolerances),
    }
    if results.interval is not None:
        entries["power_loss_interval"] = results.interval.as_dict()
    return entries


def print_screen(results: Moved) -> None:
    """The tables below the summary."""
    from ..report.sensitivity_table import print_effects, print_sensitivities

    if results.by == "percent":
        print_sensitivities(results.slopes, console(), results.interval)
    else:
        print_effects(results.scene, results.effects, results.tolerances, console(), results.interval)

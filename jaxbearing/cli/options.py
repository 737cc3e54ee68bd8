"""Options that several verbs have."""

from typing import TYPE_CHECKING, Annotated

import typer

from .completion import assignments, scene_names

if TYPE_CHECKING:
    from ..scenes.units import Dimension

SCENE_HELP = "A scene file (TOML), or the name of a built-in scene."
SceneArgument = Annotated[str, typer.Argument(metavar="SCENE", help=SCENE_HELP, autocompletion=scene_names)]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Change a field of the scene, e.g. --set operation.inner_speed='12000 rpm'; the value none takes an "
        "optional table or field out. May be repeated.",
        autocompletion=assignments,
    ),
]
ColumnsOption = Annotated[
    bool, typer.Option("--full", help="Every column of a table, in several tables where the terminal is too narrow.")
]
LossOption = Annotated[
    str, typer.Option("--loss", help="linear (least squares), or soft_l1 or cauchy: outliers count less.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object in SI units, and nothing else.")]

DragPriorOption = Annotated[
    bool,
    typer.Option(
        "--drag-prior/--no-drag-prior",
        help="The drag coefficient of a bearing, which nobody knows well, scatters by an assumed distribution where it "
        "has no other; or it does not.",
    ),
]


def labelled(scene: str, changes: list[str] | None) -> str:
    """Name of a scene with its changes, as it was typed; without the surrogates that stand for bytes which the locale
    cannot read, and which nothing can print."""
    label = " ".join([scene, *(f"--set {change}" for change in changes or [])])
    return label.encode("utf-8", "surrogateescape").decode("utf-8", "replace")


def option_quantity(option: str, text: str, dimension: "Dimension", bound: str = "finite") -> float:
    """The value of an option with a unit, in SI. **Raises:** `SceneError`."""
    from pydantic_core import PydanticCustomError

    from ..scenes.errors import SceneError
    from ..scenes.units import quantity

    try:
        return quantity(text.strip(), dimension, bound)
    except PydanticCustomError as error:
        context = error.context or {}
        raise SceneError(option, "", context["found"], context["expected"]) from None

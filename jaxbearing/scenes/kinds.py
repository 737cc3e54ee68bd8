"""Kinds of scenes and the further names that people use for them."""

from collections.abc import Collection
from typing import Any

from pydantic import BeforeValidator

from .errors import nearest
from .words import describe

ALIASES: dict[str, str] = {
    **dict.fromkeys(
        (
            *("ball", "deep_groove", "deep_groove_ball", "deep_groove_ball_bearing"),
            *("angular_contact", "angular_contact_ball", "angular_contact_ball_bearing"),
            *("spindle_bearing", "spindle"),
        ),
        "ball_bearing",
    ),
    **dict.fromkeys(("cylindrical", "cylindrical_roller"), "cylindrical_roller_bearing"),
    **dict.fromkeys(
        ("tapered_roller", "taper_roller_bearing", "tapered_bearing", "taper_roller"), "tapered_roller_bearing"
    ),
    "two_disc": "two_disk",
}
"""Further names of kinds of scenes, in lower case with underscores."""


def kind_named(value: object) -> Any:
    """The kind for a name as a person may write it, such as "deep groove ball bearing"; other values are unchanged."""
    if not isinstance(value, str):
        return value
    plain = "_".join(value.lower().replace("-", " ").replace("_", " ").split())
    return ALIASES.get(plain, plain if plain in ALIASES.values() else value)


_OTHERS = (
    "needle",
    "spherical",
    "self_align",
    "toroidal",
    "carb",
    "thrust",
    "crossed",
    "plain",
    "journal",
    "sleeve",
    "foil",
)
"""Words in the names of bearings that are not modelled."""


def kind_refused(value: object, kinds: Collection[str]) -> tuple[str, str]:
    """Description of an unknown kind of scene, and the kind with the nearest name, or "". For a bearing type that is
    not modelled no kind is suggested, however similar the names are."""
    plain = value.lower().replace("-", "_").replace(" ", "_") if isinstance(value, str) else ""
    if any(word in plain for word in _OTHERS):
        return f"{describe(value)}, which is not modelled", ""
    return describe(value), nearest(plain, kinds) if plain else ""


KIND = BeforeValidator(kind_named)
"""Reads the field `kind` of a scene file."""

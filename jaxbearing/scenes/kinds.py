"""Kinds of scenes by the names that people give them."""

from typing import Any

from pydantic import BeforeValidator

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


def kind_named(given: object) -> Any:
    """The name in scene files of a kind that a person may call "deep groove ball bearing"; anything else as it is."""
    if not isinstance(given, str):
        return given
    plain = "_".join(given.lower().replace("-", " ").replace("_", " ").split())
    return ALIASES.get(plain, plain if plain in ALIASES.values() else given)


KIND = BeforeValidator(kind_named)
"""Reads the field `kind` of a scene file."""

"""Symbols and words of catalogues for fields of scenes. Messages suggest the field; files do not accept the words."""

from collections.abc import Collection

_FIELDS = {
    "dynamic_capacity": ("c", "cr", "dynamic_load_rating"),
    "static_capacity": ("c0", "c0r", "static_load_rating"),
    "fatigue_load_limit": ("pu", "cu"),
    "viscosity_ratio": ("kappa",),
    "contamination_factor": ("eta_c", "e_c", "contamination"),
    "radial_load": ("load", "force", "fr", "radial_force"),
    "axial_load": ("fa", "axial_force", "thrust_load"),
    "inner_speed": ("speed", "rpm", "n", "shaft_speed"),
    "oil_temperature": ("temperature", "t"),
    "grade": ("vg", "iso_vg", "viscosity_grade"),
    "diametral_clearance": ("radial_clearance", "internal_clearance"),
    "n_balls": ("z", "balls"),
    "n_rollers": ("z", "rollers"),
    "ball_diameter": ("dw", "d_w"),
    "roller_diameter": ("dw", "d_w", "dwe"),
    "roller_length": ("lw", "lwe"),
    "pitch_diameter": ("dpw", "dm", "d_m"),
    "outside_diameter": ("od", "outer_diameter"),
}


def usual_word(name: str, valid: Collection[str]) -> str:
    """The field that engineers call by this name; "" if there is none. **Arguments:** `valid`: fields of a table."""
    return next((field for field, words in _FIELDS.items() if field in valid and name.lower() in words), "")

"""All structures of the campaign."""

import math

from campaign import balls, bent_rings, contacts, four_point, rollers, tapered

STRUCTURES = [
    *rollers.STRUCTURES,
    *bent_rings.STRUCTURES,
    *balls.STRUCTURES,
    *four_point.STRUCTURES,
    *tapered.STRUCTURES,
    *contacts.STRUCTURES,
]


def shares(cases: int) -> dict[str, int]:
    """Structure -> scenes of a run of so many, all together at least."""
    weights = {structure.name: 1.0 if structure.dear else 4.0 for structure in STRUCTURES}
    total = sum(weights.values())
    return {name: math.ceil(cases * weight / total) for name, weight in weights.items()}

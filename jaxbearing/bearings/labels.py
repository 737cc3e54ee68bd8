"""The label of a field: its unit and what it is, written once, where the field is defined."""


def label(unit: str, description: str) -> dict[str, str]:
    """Metadata of a field: its SI unit and what it is."""
    return {"unit": unit, "description": description}

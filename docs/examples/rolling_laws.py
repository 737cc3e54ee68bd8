"""Losses of `turbine_roller` by law of rolling resistance and by its inlet heating, W.

python docs/examples/rolling_laws.py
"""

import jaxbearing as jb

LOCATIONS = ("total", "rolling_resistance", "outer_raceway", "cage_pilot", "flange", "drag")
LAWS = (
    (None, None),
    ("rigid_isoviscous", "film_temperature"),
    ("ertel_grubin", "film_temperature"),
    ("biboulet_houpert", "film_temperature"),
    ("biboulet_houpert", "aihara"),
    ("full_range", "film_temperature"),
    ("full_range", "aihara"),
)


def losses(law: str | None, heating: str | None) -> list[str]:
    """Losses by location, W, and the slip of the cage; "-" where nothing is modelled."""
    named = {"rolling_resistance": law, "rolling_heating": heating}
    changes = {f"contact.{name}": word for name, word in named.items() if word is not None}
    solution = jb.solve(jb.load_scene("turbine_roller", changes))
    watts = [getattr(solution.power_loss, name) for name in LOCATIONS]
    return [*("-" if value is None else f"{float(value):.1f}" for value in watts), f"{float(solution.cage.slip):.1e}"]


print(f"{'law':18s}{'inlet heating':18s}", *(f"{name:>20s}" for name in (*LOCATIONS, "slip")), sep="")
for law, heating in LAWS:
    row = losses(law, heating)
    print(f"{law or 'none':18s}{heating or '-':18s}", *(f"{entry:>20s}" for entry in row), sep="", flush=True)

"""Outer races with two lobes against skidding: cage slip, loads and losses of `turbine_roller` under a light load.

python docs/examples/oval_race.py
"""

import jaxbearing as jb

HEIGHTS = (0, 20, 30)
"""Heights of the lobes, micrometres: the radius is larger by this along the load and smaller across it."""
LIGHT = {
    "operation.radial_load": "500 N",
    # a fifth of the time of the march through the pressure, and the same trend
    "contact.traction_model": "mean_pressure",
    "contact.traction_accuracy": "none",
}
BENT = {"outer_ring.thickness": "8 mm", "outer_ring.width": "20 mm", "outer_ring.housing_stiffness": "1e10 N/m^2"}
RINGS = {"rigid": {}, "8 mm on 1e10 N/m2": BENT}


def oval(height: float, ring: str = "rigid") -> jb.bearings.solution.Solution:
    """The solution with lobes of a height, micrometres, in one of `RINGS`."""
    lobe = {"lobe_order": "2", "lobe_height": f"{height} um", "lobe_angle": "0 deg"}
    race = {f"outer_roundness.{name}": value for name, value in lobe.items()}
    return jb.solve(jb.load_scene("turbine_roller", {**LIGHT, **RINGS[ring], **race}))


def row(height: float, ring: str) -> tuple[float, int, float, float]:
    """Cage slip, loaded rollers, largest load on the inner race, N, and losses, W.

    A roller counts as loaded from a hundredth of the largest load on: between films all carry a little.
    """
    solution = oval(height, ring)
    loads, most = solution.elements.load_inner, float(solution.elements.load_inner.max())
    loaded = int((loads > 0.01 * most).sum())
    return float(solution.cage.slip), loaded, most, float(solution.power_loss.total)


if __name__ == "__main__":
    print("| ring | lobes, µm | cage slip | loaded rollers | largest load, N | losses, W |\n|---|---|---|---|---|---|")
    for ring in RINGS:
        for height in HEIGHTS:
            slip, loaded, most, watts = row(height, ring)
            print(f"| {ring} | {height} | {100 * slip:.3g} % | {loaded} | {most:.0f} | {watts:.0f} |", flush=True)

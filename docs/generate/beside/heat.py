"""Heat of ball bearings at high speed (NASA TP-2275)."""

import jaxbearing as jb

from .common import MEASURED, Comparison, Found, beside, rows_of, script

FLOW_120 = 2280e-6 / 60.0
"""Oil flow of the 120-mm bearing, m^3/s."""
INLET = 394.0
"""Temperature of the oil at the inlet, K."""


def heat_35() -> Found:
    """The script of the 35-mm bearing: three thermal models beside the heat that was read off."""
    example = script("nasa_35mm")
    rows, deviations = [], {}
    for row in rows_of(MEASURED / "nasa_tp2275.csv"):
        if row["bearing"] != "35mm":
            continue
        rpm, measured = int(row["n_rpm"]), float(row["heat_W"])
        cells = [f"{rpm}", f"{measured:.0f}"]
        for nodes in (None, 1, 4):
            total, temperatures = example.heat(nodes, rpm)
            cells += [beside(total, measured)] + ([temperatures] if temperatures else [])
        deviations[f"{rpm} rpm"] = total / measured - 1.0
        rows.append([*cells, f"{row['T_inner_K']} / {row['T_outer_K']}"])
    headings = ["rpm", "measured, W", "all at oil inlet", "one node", "T, K", "four nodes", "T_i / T_o, K"]
    return Found([*headings, "T_i / T_o said, unverified"], rows, deviations)


def heat_120() -> Found:
    """The rise of the oil's temperature that the heat of the 120-mm bearing would need."""
    oil = jb.scene_from_mapping(script("nasa_35mm").SCENE).oil
    capacity = FLOW_120 * float(oil.density.density(INLET)) * float(oil.heat_capacity.heat_capacity(INLET))
    rows = [
        [row["n_rpm"], row["heat_W"], f"{float(row['heat_W']) / capacity:.0f}"]
        for row in rows_of(MEASURED / "nasa_tp2275.csv")
        if row["bearing"] == "120mm"
    ]
    largest = max(float(row[2]) for row in rows)
    said = f"not compared: the oil would have to warm by {largest:.0f} K"
    return Found(["rpm", "heat said, W", "rise of the oil's temperature, K"], rows, {}, said)


COMPARISONS = (
    Comparison(
        name="nasa_35",
        quantity="heat of a fast ball bearing",
        data="35-mm bearing, 28 000 to 72 000 rpm, NASA TP-2275",
        free="nothing",
        assumed="conformities, cage, its clearances and guidance, the oil, its heat capacity; no heat to the ambient",
        believe=25.0,
        data_error=3.0,
        verdict="Believe the heat of a fast ball bearing with oil through it to about {believe} per cent where "
        "`[thermal]` finds the temperatures; with all oil at its inlet temperature it is 50 per cent too high at "
        "the highest speeds.",
        compute=heat_35,
    ),
    Comparison(
        name="nasa_120",
        quantity="the same, larger bearing",
        data="120-mm bearing, 5000 to 12 000 rpm, the same report",
        free="nothing",
        assumed="nothing",
        believe=None,
        data_error=100.0,
        verdict="Do not use these rows: as they are labelled, heat and oil flow contradict each other.",
        compute=heat_120,
        dear=False,
    ),
)

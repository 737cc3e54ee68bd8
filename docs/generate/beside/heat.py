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
    headings = ["rpm", "measured, W", "all oil at inlet temperature, W", "one temperature, W", "its value, K"]
    headings += ["four temperatures, W", "inner / outer ring, K", "inner / outer ring by a third party, unverified, K"]
    return Found(headings, rows, deviations)


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
        quantity="heat of a fast ball bearing with oil flowing through it",
        data="35-mm bearing, 28 000 to 72 000 rpm, NASA TP-2275",
        kind="measured",
        conditions="The bore is 35 mm, with 16 balls of 7.14 mm and a contact angle of 24°. The axial load is 667 N. "
        "760 cm³/min of oil enter at 394 K (121 °C). Mobil Jet II is our assumption.",
        free="No number was fitted. The drag coefficient is the law of a lone ball, which holds where a scene has no "
        "`drag.coefficient`, not the package's estimate for balls in a row; the heat with that estimate is not "
        "computed here. Whether this law was chosen "
        "before these data were seen is not on record. The fraction of oil in the bearing is Parker's law. "
        "The same author probably fitted it to bearings of this size, so this is not a fully independent "
        "test.",
        assumed="Conformities, cage, its clearances and its guidance, the oil and its heat capacity are assumed. No "
        "heat goes to the ambient. A cage guided by the outer ring would change the heat at the highest speed by up "
        "to 18 %.",
        missed="The measured heat rises less steeply with the speed than the computed one. The computed inner "
        "ring is up to 40 K hotter than the temperature that a third party gives. Three times the heat "
        "transfer from ring to oil would remove the 40 K. But that temperature is unverified, so it counts "
        "neither for nor against the model. Neither reason is known.",
        believe=25.0,
        data_error=3.0,
        verdict="One bearing, four speeds. Between 28 000 and 72 000 rpm believe the heat to about {believe} per "
        "cent, if the temperatures are computed from the losses (table `[thermal]` of the scene file) and "
        "the balls' drag is that of a lone ball: the scene has no `drag.coefficient`. With the package's estimate "
        'for balls in a row, which `laws = "best"` sets, the error is not computed here. If all oil is taken at its '
        "inlet temperature, the heat is "
        "between 9 per cent too low and 53 per cent too high. Do not extrapolate to lower speeds: the error has a "
        "slope. No data say whether bore times speed carries it to another bore.",
        compute=heat_35,
    ),
    Comparison(
        name="nasa_120",
        quantity="heat of a larger ball bearing",
        data="120-mm bearing, 5000 to 12 000 rpm, NASA TP-2275",
        kind="measured",
        conditions="The bore is 120 mm. The axial load is said to be 2224 N. 2280 cm³/min of oil are said to enter at "
        "394 K (121 °C).",
        free="Nothing was fitted.",
        assumed="Density and heat capacity of the oil are those of the 35-mm bearing's scene. The geometry plays no "
        "part in the rise of the temperature.",
        missed="The bearing was not solved. The oil would leave at 511 K (238 °C), and such oils are used up to about "
        "200 °C. The reason is probably a wrong label in the copy that we have.",
        believe=None,
        data_error=100.0,
        verdict="Do not use these rows. Their heat and their oil flow contradict each other.",
        compute=heat_120,
        dear=False,
    ),
)

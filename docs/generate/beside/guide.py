"""The table of the page: what to believe of each quantity that a user of a bearing may want."""

from typing import NamedTuple

NOWHERE = ""
"""Stands for the name of a comparison where there is none."""
BELIEVE, UNKNOWN, NO = "believe", "not checked", "do not trust"
"""Beginnings of all answers."""
WORKED = "worked_examples.md"


class Row(NamedTuple):
    """One answer.

    **Arguments:**
    - `quantity`, `case`: the result, and the bearing, lubrication and range, in words.
    - `belief`: begins with `BELIEVE`, `UNKNOWN` or `NO`; `{name}` stands for the number of a comparison's verdict.
    - `comparison`: name of the comparison on which the answer rests; `NOWHERE`: there is none.
    """

    quantity: str
    case: str
    belief: str
    comparison: str = NOWHERE


ROWS = (
    Row(
        "fatigue life",
        "all bearings",
        f"{UNKNOWN}: no measured life. One maker's catalogue life is met to 2 % "
        f"([pump]({WORKED}#bearings-of-a-pump-nu-311-and-7312-b))",
    ),
    Row(
        "loads on balls",
        "dry, rigid rings, low speed: integrals of the loaded zone",
        f"{BELIEVE} to {{load_distribution}}; no single ball was compared",
        "load_distribution",
    ),
    Row(
        "loads on balls",
        "one bearing at 24 000 rpm and 13.3 kN axially, known orbit",
        f"{BELIEVE} to {{harris_mindel}}; three inputs were fitted, about three numbers are checks",
        "harris_mindel",
    ),
    Row(
        "loads on rollers",
        "cylindrical and tapered",
        f"{UNKNOWN}; Stribeck's number is met to 0.1 % ([number]({WORKED}#load-distribution-stribecks-numbers))",
    ),
    Row(
        "contact pressure", "dry point contact under a given load", f"{BELIEVE} to {{hertz}} of Hertz's theory", "hertz"
    ),
    Row(
        "film thickness",
        "line contact, smooth, flooded, isothermal; 20 mm/s, 1.06 and 1.33 GPa",
        f"{BELIEVE} to {{films}} of two calculations, on the low side",
        "films",
    ),
    Row(
        "traction coefficient",
        "an oil whose own curve was fitted; one curve, 25 mm/s, 40 °C",
        f"{BELIEVE} to {{traction}} at each point. It is a fit; fit the curve of your own oil",
        "traction",
    ),
    Row(
        "loss, ball bearing",
        "oil flowing through; 35 mm bore, 667 N, 28 000 to 72 000 rpm; temperatures computed (`[thermal]`); no "
        "`drag.coefficient`",
        f"{BELIEVE} to {{nasa_35}}: 22 % too low at 28 000 rpm, right at 72 000. The error has a slope: not for lower "
        "speeds, nor for other bores",
        "nasa_35",
    ),
    Row(
        "loss, ball bearing",
        "the same, all oil at its inlet temperature",
        f"{NO}: between 9 % too low and 53 % too high",
        "nasa_35",
    ),
    Row("loss, ball bearing", "120 mm bore", f"{UNKNOWN}: the only data contradict themselves", "nasa_120"),
    Row(
        "loss, ball or cylindrical roller bearing",
        "oil bath; three bearings with balls and one NU at 70 °C",
        f"{NO}: at the printed reference speed it is 2.1 to 3.6 times the heat that leaves",
        "reference_model",
    ),
    Row(
        "loss, cylindrical roller bearing",
        "circulating or jet oil",
        f"{UNKNOWN}. Our estimate for `turbine_roller` with `contact.rolling_resistance = true` and "
        '`contact.supply.level = "jet"` is 5.1 kW, and the truth between 3.0 and 10.3 kW. The scene as it stands '
        "prints 1.4 kW, without the largest loss",
        "turbine_roller",
    ),
    Row(
        "trends of that loss",
        "with speed, oil flow, oil temperature",
        f"{BELIEVE} the sign. Do not trust the trend with the load, nor the heat of flanges",
        "claims",
    ),
    Row(
        "torque, tapered roller bearing",
        "forced oil, no `contact.supply`; a 32008, 12.85 kN axially, 400 to 2200 rpm",
        f"{BELIEVE} to {{trb_32008}}: 5 to 26 % too low at 400 rpm, 14 to 32 % too high at 2200 rpm",
        "trb_32008",
    ),
    Row("torque, tapered roller bearing", "the same at 200 rpm", f"{NO}: 44 to 77 % too low", "trb_32008"),
    Row(
        "torque, tapered roller bearing",
        'oil bath, `contact.supply.level = "bath"`; a 32216, 6 to 6.5 kN axially, 500 to 4000 rpm',
        f"{BELIEVE} to a factor of 2.8, on the high side: the truth is between 0.36 and 0.83 of the result. Twelve "
        "points are within {trb_32216}; at five more it is 2.6 to 2.8 times the measured one. Palmgren's formula is "
        "within 28 % at the twelve",
        "trb_32216",
    ),
    Row(
        "torque, tapered roller bearing",
        "the same, flooded",
        f"{NO}: it is 1.9 to 2.6 times the measured one, at the five 4.3",
        "trb_32216",
    ),
    Row(
        "torque of pairs, with grease",
        "LM12700, HM801349, HH926749",
        f"{UNKNOWN}: the data lack what a solve needs",
        "trb_others",
    ),
    Row(
        "cage slip, skidding",
        "cylindrical roller bearing",
        f"{NO}: the source's program has less slip; no measurement",
        "claims",
    ),
    Row(
        "cage speed",
        "fast ball bearing under axial load",
        f"{NO}: that of the program of 1973 is not reproduced; no measurement",
        "harris_mindel",
    ),
    Row(
        "axial stiffness",
        "257 angular contact bearings at rest; conformity fitted to one printed rigidity of the same bearing",
        f"{BELIEVE} to {{rigidity}}, four bearings of five",
        "rigidity",
    ),
    Row(
        "axial stiffness",
        "one conformity fitted for a whole series",
        f"{BELIEVE} to 15 %, four bearings of five. The fitted conformities of four of five lie between 0.518 and "
        "0.543; with a guessed one, or at speed: not checked",
        "rigidity",
    ),
    Row(
        "shock between roller and cage",
        "cylindrical roller bearing; four points of a program",
        f"{NO}: single loads are off up to 20 times",
        "shocks",
    ),
    Row(
        "thermal reference speed",
        "losses of the model, oil bath; four bearings",
        f"{BELIEVE} to {{reference_model}}, on the low side; flooded to 60 % (54 % is the largest)",
        "reference_model",
    ),
    Row(
        "thermal reference speed",
        "formula of ISO 15312; 269 deep groove and NU bearings",
        f"{BELIEVE} to {{reference_formula}}, on the low side but for NU 4 (up to 4 % high); four bearings of five",
        "reference_formula",
    ),
    Row("loads, pressures", "flexible rings or housing; profiles, edges, misalignment of rollers", UNKNOWN),
    Row("film thickness", "ball contact; starved, rough or heated inlet; any measured film", UNKNOWN),
    Row("traction coefficient", "oil of the catalogue, not fitted", UNKNOWN),
    Row(
        "loss and torque",
        'grease, oil-air, mixed friction, churning of a bath, seals; drag of balls in a row (`laws = "best"`)',
        UNKNOWN,
    ),
    Row(
        "temperatures of rings, elements and oil",
        "all bearings",
        f"{UNKNOWN}: the only ring temperatures at hand are of unknown origin",
    ),
    Row(
        "radial and moment stiffness, damping",
        "all bearings; every stiffness of roller bearings",
        UNKNOWN,
    ),
    Row(
        "preload",
        "for a wanted axial stiffness of balls",
        f"{UNKNOWN}: 5 % in stiffness is about 15 % in preload",
    ),
    Row(
        "impacts, other speed limits",
        "shocks from outside, cage strength, mechanical limit, critical speeds of a shaft",
        UNKNOWN,
    ),
    Row("clearance and fits", "in operation", UNKNOWN),
)

"""The table at the top of the page: what to believe of each quantity that a user of a bearing may want."""

from typing import NamedTuple

NOWHERE = ""
"""Stands for the name of a comparison where there is none."""
UNCHECKED = "what-is-not-checked-by-any-of-these"
"""Anchor of the section that lists what is not checked."""
BELIEVE, UNKNOWN, NO = "believe", "not checked here", "do not trust"
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
        f"{UNKNOWN}; no measured life is among the data. One maker's catalogue life is met to 2 % "
        f"([Worked examples]({WORKED}#bearings-of-a-pump-nu-311-and-7312-b))",
    ),
    Row(
        "loads on balls",
        "dry, rigid rings, low speed; 13 widths of the loaded zone",
        f"{BELIEVE} to {{load_distribution}}: the integrals Jr and Ja, with one misprint left out; no single ball's "
        "load was compared",
        "load_distribution",
    ),
    Row(
        "loads on balls",
        "high speed, known orbit; one bearing, 24 000 rpm, 13.3 kN axially",
        f"{BELIEVE} to {{harris_mindel}} at this one point; three inputs fitted, about three numbers are checks. "
        "Unfitted inputs: not computed here",
        "harris_mindel",
    ),
    Row(
        "loads on rollers",
        "cylindrical and tapered",
        f"{UNKNOWN}; Stribeck's number is met to 0.1 % "
        f"([Worked examples]({WORKED}#load-distribution-stribecks-numbers))",
    ),
    Row("loads on rolling elements", "flexible rings or housing", UNKNOWN),
    Row(
        "contact pressure",
        "balls, dry point contact, given load; 22 ellipses",
        f"{BELIEVE} to {{hertz}} of Hertz's theory; no measurement",
        "hertz",
    ),
    Row("contact pressure", "rollers: line contact, profile, edges, misalignment", UNKNOWN),
    Row(
        "film thickness",
        "line contact: smooth, flooded, isothermal; two conditions, 20 mm/s, 20 and 40 °C, 1.06 and 1.33 GPa",
        f"{BELIEVE} to {{films}}, on the low side; against calculations, with two readings of the print chosen to fit",
        "films",
    ),
    Row("film thickness", "ball contact; starved, rough or heated inlet; any measured film", UNKNOWN),
    Row(
        "traction coefficient",
        "oil whose curve was measured and fitted; one curve, 18 points, 25 mm/s, 40 °C",
        f"{BELIEVE} to {{traction}} at each point of that curve; it is a fit. Other oils: not computed here",
        "traction",
    ),
    Row("traction coefficient", "oil of the catalogue, not fitted", UNKNOWN),
    Row(
        "loss, ball bearing",
        "760 cm³/min of oil flowing through at 121 °C, 35 mm bore, 667 N axially, 28 000 to 72 000 rpm, temperatures "
        "computed (`[thermal]`), drag law of a lone ball (no `drag.coefficient` in the scene); one bearing, four "
        "speeds",
        f"{BELIEVE} to {{nasa_35}}; 22 % too low at 28 000 rpm, right at 72 000 rpm. The oil fraction was probably "
        "fitted to such bearings; whether the drag law was chosen before these data were seen is not on record",
        "nasa_35",
    ),
    Row(
        "loss, ball bearing",
        "the same, but all oil taken at its inlet temperature",
        f"{NO}; it is between 9 % too low and 53 % too high",
        "nasa_35",
    ),
    Row(
        "loss, ball bearing",
        'the same, with the package\'s estimate of drag for balls in a row (`laws = "best"` sets it)',
        f"{UNKNOWN}, nor computed",
    ),
    Row(
        "loss, ball bearing",
        "oil flowing through, below 28 000 rpm at 35 mm bore (1 million mm/min of bore times speed), or another bore",
        f"{UNKNOWN}; the error has a slope with the speed, so the 25 % do not carry over",
    ),
    Row(
        "loss, ball bearing",
        "oil flowing through, 120 mm bore",
        f"{UNKNOWN}; the only data contradict themselves",
        "nasa_120",
    ),
    Row(
        "loss, ball or cylindrical roller bearing",
        "oil bath; four bearings, three with balls and one NU, at 70 °C and 12 mm²/s",
        f"{NO}; at the printed reference speed it is 2.1 to 3.6 times the heat that leaves",
        "reference_model",
    ),
    Row(
        "loss, cylindrical roller bearing",
        "circulating or jet oil",
        f"{UNKNOWN}; we have an estimate for one bearing at one point (`turbine_roller`): 5.1 kW, and the truth "
        "between 3.0 and 10.3 kW. It needs `contact.rolling_resistance = true` and "
        '`contact.supply.level = "jet"`. The built-in scene as it stands has neither and prints 1.4 kW: do not '
        "believe that number as a total",
        "turbine_roller",
    ),
    Row(
        "trends of the loss, cylindrical roller bearing",
        "with speed, oil flow and oil temperature; two scenes of one bearing",
        f"{BELIEVE} the sign, not the size. Do not trust the trend with the load, nor the heat of flanges and of "
        "sliding at light load. No measurement",
        "claims",
    ),
    Row(
        "torque, tapered roller bearing",
        "forced oil, called flooded; scene without `contact.supply`; one bearing (32008), 12.85 kN axially, 400 to "
        "2200 rpm, 55 and 65 °C",
        f"{BELIEVE} to {{trb_32008}}; 5 to 26 % too low at 400 rpm, 14 to 32 % too high at 2200 rpm. With "
        '`contact.supply.level = "jet"`: not computed here',
        "trb_32008",
    ),
    Row(
        "torque, tapered roller bearing",
        "the same at 200 rpm",
        f"{NO}; it is 44 to 77 % too low",
        "trb_32008",
    ),
    Row(
        "torque, tapered roller bearing",
        'oil bath, with `contact.supply.level = "bath"`; one bearing (32216), 6 to 6.5 kN axially, '
        "500 to 4000 rpm, 42 and 50 °C",
        f"{BELIEVE} to a factor of 2.8, on the high side: the truth is between 0.36 and 0.83 of the result. Twelve "
        "points are within {trb_32216}; at five of Figure 7 it is 2.6 to 2.8 times the measured one. The "
        "default layer was chosen with knowledge of these torques. Palmgren's formula is the better choice: within "
        "28 % at the twelve points; with Figure 7 it was not compared",
        "trb_32216",
    ),
    Row(
        "torque, tapered roller bearing",
        "oil bath, without a supply (flooded)",
        f"{NO}; it is 1.9 to 2.6 times the measured one, in Figure 7 up to 4.3 times",
        "trb_32216",
    ),
    Row("torque and loss, all bearings", "grease, oil-air, mixed friction, churning of a bath, seals", UNKNOWN),
    Row(
        "temperatures of rings, elements and oil",
        "all bearings",
        f"{UNKNOWN}; the only ring temperatures at hand are of unknown origin and decide nothing",
    ),
    Row(
        "cage slip; load below which elements skid",
        "cylindrical roller bearing; two scenes of one bearing",
        f"{NO}; the source's program has less slip. No measurement",
        "claims",
    ),
    Row(
        "cage speed, slip",
        "fast ball bearing under axial load; one point",
        f"{NO}; those of the program of 1973 are not reproduced. No measurement",
        "harris_mindel",
    ),
    Row("cage speed, slip, skidding", "all other bearings", UNKNOWN),
    Row(
        "axial stiffness",
        "angular contact balls at rest, 257 bearings, bores of 5 to 120 mm; conformity fitted to one printed rigidity "
        "of the bearing",
        f"{BELIEVE} to {{rigidity}}; four bearings of five",
        "rigidity",
    ),
    Row(
        "axial stiffness",
        "the same; one conformity fitted to the printed rigidities of all bearings of its series (medium preload)",
        f"{BELIEVE} to 15 %; four bearings of five",
        "rigidity",
    ),
    Row(
        "axial stiffness",
        "conformity not fitted (a guess or a default), or the shaft turns",
        f"{UNKNOWN}, nor computed; the fitted conformities of four bearings of five lie between 0.518 and 0.543",
    ),
    Row("radial and moment stiffness, damping", "all bearings", UNKNOWN),
    Row("stiffness", "roller bearings", UNKNOWN),
    Row(
        "preload",
        "for a wanted axial stiffness of angular contact balls",
        f"{UNKNOWN}. Stiffness grows only as the cube root of preload, so an error of 5 % in stiffness is about 15 % "
        "in preload",
    ),
    Row(
        "shock between roller and cage",
        "cylindrical roller bearing; four points of one bearing, no measurement",
        f"{NO}; single loads are off up to 20 times",
        "shocks",
    ),
    Row("shock or impact load from outside", "all bearings", UNKNOWN),
    Row(
        "speed limit: thermal reference speed",
        "losses of the model, oil bath; four bearings, three deep groove and one NU",
        f"{BELIEVE} to {{reference_model}}, on the low, cautious side; flooded to 60 % (54 % is the largest of "
        "these four)",
        "reference_model",
    ),
    Row(
        "speed limit: thermal reference speed",
        "formula of ISO 15312; 269 deep groove and NU bearings, bores of 10 to 480 mm",
        f"{BELIEVE} to {{reference_formula}}, on the low, cautious side but for NU 4 (up to 4 % high); four bearings "
        "of five, and of the fifth no number is here",
        "reference_formula",
    ),
    Row("other speed limits", "mechanical limit, cage strength, critical speeds of a shaft", UNKNOWN),
    Row("clearance and fits in operation", "all bearings", UNKNOWN),
)

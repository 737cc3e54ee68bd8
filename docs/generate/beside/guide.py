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
    Row("loads on balls", "dry, rigid rings, low speed", f"{BELIEVE} to {{load_distribution}}", "load_distribution"),
    Row("loads on balls", "high speed, known orbit", f"{BELIEVE} to {{harris_mindel}}; one point", "harris_mindel"),
    Row(
        "loads on rollers",
        "cylindrical and tapered",
        f"{UNKNOWN}; Stribeck's number is met to 0.1 % "
        f"([Worked examples]({WORKED}#load-distribution-stribecks-numbers))",
    ),
    Row("loads on rolling elements", "flexible rings or housing", UNKNOWN),
    Row("contact pressure", "balls, dry point contact, given load", f"{BELIEVE} to {{hertz}}", "hertz"),
    Row("contact pressure", "rollers: line contact, profile, edges, misalignment", UNKNOWN),
    Row(
        "film thickness",
        "line contact: smooth, flooded, isothermal",
        f"{BELIEVE} to {{films}}, on the low side; against calculations",
        "films",
    ),
    Row("film thickness", "ball contact; starved, rough or heated inlet; any measured film", UNKNOWN),
    Row(
        "traction coefficient",
        "oil whose curve was measured and fitted",
        f"{BELIEVE} to {{traction}} at each point of that curve; it is a fit",
        "traction",
    ),
    Row("traction coefficient", "oil of the catalogue, not fitted", UNKNOWN),
    Row(
        "loss, ball bearing",
        "oil flowing through, 28 000 to 72 000 rpm, 35 mm bore, temperatures computed",
        f"{BELIEVE} to {{nasa_35}}",
        "nasa_35",
    ),
    Row(
        "loss, ball bearing",
        "the same, but all oil taken at its inlet temperature",
        f"{NO}; it is up to 53 % too high",
        "nasa_35",
    ),
    Row("loss, ball bearing", "oil flowing through, ordinary speeds", UNKNOWN),
    Row(
        "loss, ball bearing",
        "oil flowing through, 120 mm bore",
        f"{UNKNOWN}; the data contradict themselves",
        "nasa_120",
    ),
    Row(
        "loss, ball or cylindrical roller bearing",
        "oil bath",
        f"{NO}; at the printed reference speed it is 2.1 to 3.6 times the heat that leaves, for four bearings",
        "reference_model",
    ),
    Row(
        "loss, cylindrical roller bearing",
        "circulating or jet oil",
        f"{UNKNOWN}; our estimate is uncertain by about 50 %. The built-in scenes leave out the rolling resistance, "
        "and their total is 3.7 times smaller",
        "turbine_roller",
    ),
    Row(
        "trends of the loss, cylindrical roller bearing",
        "with speed, oil flow and oil temperature",
        f"{BELIEVE} the sign, not the size. Do not trust the trend with the load",
        "claims",
    ),
    Row(
        "torque, tapered roller bearing",
        "flooded by forced oil, 400 to 2200 rpm",
        f"{BELIEVE} to {{trb_32008}}; too high at the upper end",
        "trb_32008",
    ),
    Row(
        "torque, tapered roller bearing",
        "flooded by forced oil, 200 rpm",
        f"{NO}; it is 44 to 77 % too low",
        "trb_32008",
    ),
    Row(
        "torque, tapered roller bearing",
        'oil bath, with `contact.supply.level = "bath"`',
        f"{BELIEVE} to {{trb_32216}}, on the high side",
        "trb_32216",
    ),
    Row(
        "torque, tapered roller bearing",
        "oil bath, without a supply (flooded)",
        f"{NO}; it is 1.9 to 2.6 times the measured one",
        "trb_32216",
    ),
    Row("torque and loss, all bearings", "grease, oil-air, mixed friction, churning of a bath, seals", UNKNOWN),
    Row(
        "temperatures of rings, elements and oil",
        "all bearings",
        f"{UNKNOWN}; beside unverified ring temperatures the inner ring is 4 K too cold to 40 K too hot",
    ),
    Row("cage speed, slip, skidding", "all bearings", UNKNOWN),
    Row("load below which elements skid", "cylindrical roller bearing", f"{NO}; the source has less slip", "claims"),
    Row(
        "axial stiffness",
        "angular contact balls at rest; conformity fitted to one printed rigidity of the bearing",
        f"{BELIEVE} to {{rigidity}}; four bearings of five",
        "rigidity",
    ),
    Row(
        "axial stiffness",
        "the same; one conformity for a whole series",
        f"{BELIEVE} to 15 %; four bearings of five",
        "rigidity",
    ),
    Row("radial and moment stiffness, damping", "all bearings", UNKNOWN),
    Row("stiffness", "roller bearings", UNKNOWN),
    Row(
        "preload",
        "for a wanted axial stiffness of angular contact balls",
        f"{UNKNOWN}; it follows with about three times the per cent of the stiffness, which grows as the cube root of "
        "the preload",
    ),
    Row(
        "shock between roller and cage",
        "cylindrical roller bearing",
        f"{NO}; single loads are off up to 20 times",
        "shocks",
    ),
    Row("shock or impact load from outside", "all bearings", UNKNOWN),
    Row(
        "speed limit: thermal reference speed",
        "deep groove and NU, losses of the model, oil bath",
        f"{BELIEVE} to {{reference_model}}, on the low, cautious side; flooded 54 %",
        "reference_model",
    ),
    Row(
        "speed limit: thermal reference speed",
        "deep groove and NU, formula of ISO 15312",
        f"{BELIEVE} to {{reference_formula}}, on the low, cautious side; four bearings of five",
        "reference_formula",
    ),
    Row("other speed limits", "mechanical limit, cage strength, critical speeds of a shaft", UNKNOWN),
    Row("clearance and fits in operation", "all bearings", UNKNOWN),
)

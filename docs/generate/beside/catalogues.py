"""Numbers that makers print: reference speeds and the rigidity of spindle bearings."""

import math
import warnings

import numpy as np

import jaxbearing as jb
from jaxbearing.catalogue import find
from jaxbearing.makers.designation import read_designation
from jaxbearing.makers.palmgren_constants import INA
from jaxbearing.thermal import reference_speed as iso

from .common import MEASURED, Comparison, Found, beside, ends, rows_of, script

RPM = math.pi / 30.0
WITH_MODEL = ("6205", "6210", "6310", "NU 210 ECP")
"""Bearings whose reference speed is also searched with the losses of the model."""
HOT = 343.15
"""Temperature of the bearing in the reference conditions, K."""
STEPS, CLOSE = 12, 1e-4
"""Steps of that search, and the relative difference of loss and heat at which it ends."""
WIDTHS, ENDS = (0.1, 0.9), ("low", "high")
"""Quantiles between which 80 % of the bearings lie, and their names."""


def constants_of(designation: str) -> tuple[float, float] | None:
    """f0 of an oil bath and f1 at the reference load by INA; `None` where the series has none."""
    said = read_designation(designation)
    for series, one in INA.get(said.family, {}).items():
        if said.series in series:
            return one.bath, one.size * iso.RADIAL_LOAD**one.exponent
    return None


def printed_rows() -> list[dict[str, str]]:
    """Bearings of the catalogue whose series has factors."""
    return [row for row in rows_of(MEASURED / "skf_reference_speeds.csv") if constants_of(row["designation"])]


def heat_of(rows: list[dict[str, str]]) -> np.ndarray:
    """Heat that leaves each bearing in the reference conditions, W."""
    area = iso.radial_seat_area(*(1e-3 * column(rows, name) for name in ("d", "D", "B")))
    return np.asarray(iso.reference_heat_flow(area) * area)


def column(rows: list[dict[str, str]], name: str) -> np.ndarray:
    """Numbers of a column."""
    return np.array([float(row[name]) for row in rows])


def by_formula(rows: list[dict[str, str]]) -> np.ndarray:
    """Reference speeds by ISO 15312 with INA's factors, rpm."""
    factors = np.array([constants_of(row["designation"]) for row in rows], dtype=float)
    load = iso.RADIAL_LOAD * 1e3 * column(rows, "C0_kN")
    mean = 0.5e-3 * (column(rows, "d") + column(rows, "D"))
    viscosity = np.full(len(rows), iso.RADIAL_VISCOSITY)
    return np.asarray(iso.reference_speed(heat_of(rows), viscosity, load, mean, *factors.T)) / RPM


def reference_speeds() -> Found:
    """The formula beside all printed speeds, by series."""
    groups: dict[str, list[float]] = {}
    bearings = printed_rows()
    for row, ratio in zip(bearings, by_formula(bearings) / column(bearings, "n_ref"), strict=True):
        said = read_designation(row["designation"])
        series = f"NU {said.series}" if said.family == "cylindrical" else said.series
        groups.setdefault(series, []).append(float(ratio))
    rows, deviations = [], {}
    for series, ratios in groups.items():
        limits = quantiles(np.array(ratios))
        middle, low, high = (100.0 * (float(one) - 1.0) for one in (np.median(ratios), *limits))
        rows.append([series, f"{len(ratios)}", f"{middle:+.0f} %", f"{low:+.0f} to {high:+.0f} %"])
        deviations |= {f"{series}, {end}": one - 1.0 for end, one in zip(ENDS, limits, strict=True)}
    headings = ["series", "bearings", "deviation of the formula, median", "four bearings of five"]
    return Found(headings, rows, deviations)


def losses_at(designation: str, capacity: float, level: str | None):
    """The total loss of a catalogue bearing at a speed, rad/s, in the reference conditions; ISO VG 32 has 12 mm²/s."""
    load = iso.RADIAL_LOAD * capacity
    given = {"static_capacity": capacity, "radial_load": load, "oil": "ISO VG 32", "oil_temperature": HOT}
    tables = find(designation, **given).tables()
    if level is not None:
        tables["contact"] = {**tables.get("contact", {}), "supply": {"level": level}}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", jb.PresetUsedWarning)
        scene = jb.scene_from_mapping(tables)
    return lambda speed: float(jb.solve(scene.replace({"operation.inner_speed": speed})).power_loss.total)


def by_model(row: dict[str, str], level: str | None) -> tuple[float, float]:
    """The losses of the model: the speed at which they are the heat that leaves, rpm, by secants of the logarithms, and
    at the printed speed their ratio to that heat."""
    (heat,) = heat_of([row])
    losses, printed = losses_at(row["designation"], 1e3 * float(row["C0_kN"]), level), RPM * float(row["n_ref"])
    excess = lambda place: math.log(losses(math.exp(place)) / heat)
    tried = [math.log(printed * factor) for factor in (0.5, 0.8)]
    values = [excess(place) for place in tried]
    for _ in range(STEPS):
        if abs(values[-1]) < CLOSE:
            return math.exp(tried[-1]) / RPM, losses(printed) / heat
        slope = (values[-1] - values[-2]) / (tried[-1] - tried[-2])
        tried.append(tried[-1] - values[-1] / slope)
        values.append(excess(tried[-1]))
    raise RuntimeError(f"{row['designation']}: found no reference speed in {STEPS} steps")


def model_speeds() -> Found:
    """Reference speeds by the losses of the model: flooded, and with the supply of an oil bath."""
    printed = {row["designation"]: row for row in rows_of(MEASURED / "skf_reference_speeds.csv")}
    rows, off = [], {level: {} for level in (None, "bath")}
    for name in WITH_MODEL:
        row = printed[name]
        own, formula = float(row["n_ref"]), float(by_formula([row])[0])
        cells, parts = [name, f"{own:.0f}", beside(formula, own)], []
        for level, of_level in off.items():
            found, part = by_model(row, level)
            cells.append(beside(found, own))
            parts.append(f"{part:.1f}")
            of_level[name] = found / own - 1.0
        rows.append([*cells, parts[-1]])
    headings = ["bearing", "printed, rpm", "formula of the standard, rpm", "model, flooded, rpm"]
    headings += ["model, oil bath, rpm", "oil bath: loss at the printed speed over the heat that leaves"]
    flooded, bath = (ends(list(of_level.values())) for of_level in off.values())
    return Found(headings, rows, off["bath"], f"{bath} in an oil bath; {flooded} flooded")


def rigidity() -> Found:
    """All pairs of a catalogue of spindle bearings: conformities are fitted at the medium preload, one for each series
    and one for each bearing; the two other preloads are predicted."""
    example = script("gmn_rigidity")
    data = example.printed()
    medium, names = data.level == "M", np.unique(data.series)
    common = example.fit(data, np.unique(data.series, return_inverse=True)[1], medium)
    own = example.fit(data, data.bearing, medium)
    rows, deviations = [], {}
    for number, name in enumerate(names):
        mine = data.series == name
        conformities = own.conformity[np.unique(data.bearing[mine])]
        cells = [str(name), f"{int(np.sum(mine)) // 3}", f"{common.conformity[number]:.3f}"]
        cells += [spread_of(common.deviation[mine & ~medium])[0], "{:.3f} to {:.3f}".format(*quantiles(conformities))]
        for level, said in (("L", "light"), ("S", "heavy")):
            text, limits = spread_of(own.deviation[mine & (data.level == level)])
            cells.append(text)
            deviations |= {f"{name}, {said}, {end}": one for end, one in zip(ENDS, limits, strict=True)}
        rows.append(cells)
    headings = ["series, contact angle", "bearings", "conformity of the series", "with it: light and heavy preload"]
    headings += ["conformities of the bearings", "with these: light preload", "with these: heavy preload"]
    return Found(headings, rows, deviations)


def quantiles(values: np.ndarray) -> tuple[float, float]:
    """Ends between which 80 % of the values lie."""
    low, high = np.quantile(values, WIDTHS)
    return float(low), float(high)


def spread_of(deviations: np.ndarray) -> tuple[str, tuple[float, float]]:
    """The same of deviations, in per cent as a text, and as numbers."""
    limits = quantiles(deviations)
    return "{:+.1f} to {:+.1f} %".format(*(100.0 * one for one in limits)), limits


COMPARISONS = (
    Comparison(
        name="reference_formula",
        quantity="thermal reference speed, formula of ISO 15312",
        data="269 deep groove and NU bearings of a catalogue (SKF); deviations of four bearings of five in each series",
        kind="catalogue",
        conditions="The radial load is 5 % of C0. The oil has 12 mm²/s at 70 °C, the temperature of the bearing. The "
        "ambient is at 20 °C. Bores are 10 to 480 mm.",
        free="Nothing was fitted.",
        assumed="The factors f0 (part of the speed) and f1 (part of the load) are those of another maker (INA), for "
        "an oil bath.",
        missed="The formula is too low: the median of every series but NU 4 lies below the print. NU 4 has three "
        "bearings, of which four in five means nothing; they are up to 4 % too high. The maker uses its "
        "own law of friction, as far as we know. Whether this is the whole reason is not known.",
        believe=60.0,
        data_error=10.0,
        verdict="Believe the standard's formula to about {believe} per cent; four bearings of five lie within. It "
        "is on the low and thus cautious side, but for NU 4, whose three bearings are up to 4 per cent too "
        "high. This checks a formula against a maker's calculation, and no measured temperature.",
        compute=reference_speeds,
        dear=False,
    ),
    Comparison(
        name="reference_model",
        quantity="thermal reference speed, losses of the model",
        data="6205, 6210, 6310 and NU 210 of the same catalogue (SKF)",
        kind="catalogue",
        conditions="The conditions are those of the standard, as above.",
        free="Nothing was fitted. The deviation that counts is that of the column `model, oil bath`, since the "
        "standard means an oil bath.",
        assumed="The internal geometry is estimated from C0. The oil is ISO VG 32. The column `oil bath` only has "
        "less oil at the contacts; churning is left out, because no oil level is known.",
        missed="The computed speeds are too low, and the computed losses too high. The standard's formula is too "
        "low too. The maker's own law of friction may be a reason; this was not checked. For the NU 210 the model "
        "is farther off than the formula, and the reason is not known.",
        believe=50.0,
        data_error=10.0,
        verdict='Four bearings, three with balls and one NU. With `contact.supply.level = "bath"` believe a '
        "thermal reference speed to about {believe} per cent, on the low and thus cautious side. Of these "
        "four, flooded it is up to 54 per cent too low; so flooded believe it to 60 per cent. The loss at "
        "the printed speed is 2.1 to 3.6 times the heat that leaves there, so do not trust an absolute "
        "loss in an oil bath.",
        compute=model_speeds,
    ),
    Comparison(
        name="rigidity",
        quantity="axial rigidity of pairs of spindle bearings",
        data="257 spindle bearings (GMN), light and heavy preload; deviations of four bearings of five in each series",
        kind="catalogue",
        conditions="The contact angle is 15, 17 or 25°. Bores are 5 to 120 mm. Steel balls are at rest under three "
        "printed preloads, without any other load.",
        free="One conformity a bearing is fitted to the printed rigidity at the medium preload. The deviations are "
        "those of the two other preloads.",
        assumed="Young's modulus is 208 GPa. Both grooves have the same conformity.",
        missed="One conformity a series misses the S 15 and S 25 bearings by up to 11 %. The reason is that GMN "
        "prints no conformity, and that one number does not fit all sizes.",
        believe=5.0,
        data_error=2.0,
        verdict="Believe an axial stiffness at rest to about {believe} per cent, if the conformity was fitted to "
        "one printed rigidity of the same bearing. Believe it to about 15 per cent, if one conformity was "
        "fitted to all printed rigidities of its series. Four bearings of five lie within. With a "
        "conformity that was not fitted, or at speed, the error is not computed here. The smallest "
        "bearings are no check, since their print is rounded by up to 10 per cent. A preload was not "
        "compared: it is an input here. Stiffness grows only as the cube root of preload, so an error of 5 "
        "per cent in stiffness is about 15 per cent in preload.",
        compute=rigidity,
    ),
)

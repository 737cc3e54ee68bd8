"""Numbers that makers print: reference speeds and the rigidity of spindle bearings."""

import math
import warnings

import numpy as np

import jaxbearing as jb
from jaxbearing.catalogue import find
from jaxbearing.makers.designation import read_designation
from jaxbearing.makers.palmgren_constants import INA
from jaxbearing.thermal import reference_speed as iso

from .common import MEASURED, Comparison, Found, rows_of, script

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
        ends = quantiles(np.array(ratios))
        rows.append([series, f"{len(ratios)}", f"{np.median(ratios):.2f}", "{:.2f} to {:.2f}".format(*ends)])
        deviations |= {f"{series}, {end}": one - 1.0 for end, one in zip(ENDS, ends, strict=True)}
    return Found(["series", "bearings", "formula over print, median", "80 % of the bearings"], rows, deviations)


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


def by_model(row: dict[str, str], level: str | None) -> float:
    """Speed at which the losses of the model are the heat that leaves, rpm: secants of the logarithms."""
    (heat,) = heat_of([row])
    losses = losses_at(row["designation"], 1e3 * float(row["C0_kN"]), level)
    excess = lambda place: math.log(losses(math.exp(place)) / heat)
    ends = [math.log(RPM * float(row["n_ref"]) * factor) for factor in (0.5, 0.8)]
    values = [excess(place) for place in ends]
    for _ in range(STEPS):
        if abs(values[-1]) < CLOSE:
            return math.exp(ends[-1]) / RPM
        slope = (values[-1] - values[-2]) / (ends[-1] - ends[-2])
        ends.append(ends[-1] - values[-1] / slope)
        values.append(excess(ends[-1]))
    raise RuntimeError(f"{row['designation']}: found no reference speed in {STEPS} steps")


def model_speeds() -> Found:
    """Reference speeds by the losses of the model: flooded, and with the supply of an oil bath."""
    printed = {row["designation"]: row for row in rows_of(MEASURED / "skf_reference_speeds.csv")}
    rows, deviations = [], {}
    for name in WITH_MODEL:
        row = printed[name]
        own, formula = float(row["n_ref"]), float(by_formula([row])[0])
        cells = [name, f"{own:.0f}", f"{formula:.0f} ({formula / own:.2f})"]
        for level in (None, "bath"):
            found = by_model(row, level)
            cells.append(f"{found:.0f} ({found / own:.2f})")
            if level is not None:
                deviations[name] = found / own - 1.0
        rows.append(cells)
    headings = ["bearing", "printed, rpm", "formula (over print)", "model, flooded", "model, oil bath"]
    return Found(headings, rows, deviations)


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
            text, ends = spread_of(own.deviation[mine & (data.level == level)])
            cells.append(text)
            deviations |= {f"{name}, {said}, {end}": one for end, one in zip(ENDS, ends, strict=True)}
        rows.append(cells)
    headings = ["series, contact angle", "bearings", "conformity of the series", "light and heavy with it"]
    headings += ["conformities of the bearings", "light with these", "heavy with these"]
    return Found(headings, rows, deviations)


def quantiles(values: np.ndarray) -> tuple[float, float]:
    """Ends between which 80 % of the values lie."""
    low, high = np.quantile(values, WIDTHS)
    return float(low), float(high)


def spread_of(deviations: np.ndarray) -> tuple[str, tuple[float, float]]:
    """The same of deviations, in per cent as a text, and as numbers."""
    ends = quantiles(deviations)
    return "{:+.1f} to {:+.1f} %".format(*(100.0 * one for one in ends)), ends


COMPARISONS = (
    Comparison(
        name="reference_formula",
        quantity="thermal reference speed, formula of ISO 15312",
        data="269 deep groove and NU bearings of a catalogue (SKF); deviations of 80 % of each series",
        free="nothing",
        assumed="factors f0 and f1 of another maker (INA)",
        believe=60.0,
        data_error=10.0,
        verdict="Believe the standard's formula to about {believe} per cent, on the low side for ball bearings: the "
        "printed speeds come from the maker's own law of friction, so this checks a formula and no truth.",
        compute=reference_speeds,
        dear=False,
    ),
    Comparison(
        name="reference_model",
        quantity="thermal reference speed, losses of the model",
        data="four bearings of the same catalogue",
        free="nothing",
        assumed="internal geometry estimated from C0; oil ISO VG 32; no drag, since no oil level is known",
        believe=50.0,
        data_error=10.0,
        verdict="Believe a reference speed that the model's losses give to about {believe} per cent, on the low side: "
        "as with the formula, the printed speeds come from the maker's own law of friction.",
        compute=model_speeds,
    ),
    Comparison(
        name="rigidity",
        quantity="axial rigidity of pairs of spindle bearings",
        data="257 spindle bearings (GMN): light and heavy preload; deviations of 80 % of each series",
        free="one conformity a bearing, at the medium preload; the deviations are those of the two other preloads",
        assumed="Young's modulus 208 GPa; equal conformity of both grooves",
        believe=5.0,
        data_error=2.0,
        verdict="Believe a stiffness and a preload to about {believe} per cent where the bearing's conformity is "
        "known, and to about 15 per cent where one stands for a whole series.",
        compute=rigidity,
    ),
)

"""The page of results: every key with its unit and meaning, from the labels that the result classes carry."""

import dataclasses
from pathlib import Path

from jaxbearing._derived import derived_results
from jaxbearing.bearings import frequencies, growth, ring_deflection, solution, supplied
from jaxbearing.bearings.ball import solution as ball_solution
from jaxbearing.bearings.cylindrical import solution as cylindrical_solution
from jaxbearing.bearings.cylindrical.motion import results as roller_motion
from jaxbearing.bearings.motion import history
from jaxbearing.bearings.tapered import solution as tapered_solution
from jaxbearing.bearings.warming import history as warming
from jaxbearing.ehl import history as film_history
from jaxbearing.ehl import solution as film
from jaxbearing.life.duty import SpectrumLife
from jaxbearing.life.result import CatalogueLife, Life
from jaxbearing.machines import two_disk
from jaxbearing.numerics.status import Status
from jaxbearing.report.labels import udunits
from jaxbearing.shafts import solution as shafts
from jaxbearing.thermal import result as thermal_result
from jaxbearing.thermal.shares import OilTemperatures

FILE = Path(__file__).parents[1] / "results.md"
"""The page is kept in the repository; `python docs/generate/result_pages.py` writes it anew."""

SECTIONS = {
    "Steady state of a bearing": {
        "": solution.Solution,
        "ring": solution.RingDisplacement,
        "cage": solution.CageState,
        "rolling_by_race": solution.RollingByRace,
        "boundary_power": solution.BoundaryPower,
        "supply": supplied.SupplyResult,
        "outer_ring": ring_deflection.RingDeflection,
        "inner_ring": ring_deflection.InnerRingDeflection,
        "fit": growth.FitResult,
        "thermal": thermal_result.ThermalResult,
        "thermal.temperatures": thermal_result.NodeTemperatures,
        "thermal.oil": OilTemperatures,
        "thermal.flows": thermal_result.HeatPaths,
        "frequencies": frequencies.KinematicFrequencies,
        "textbook_frequencies": frequencies.KinematicFrequencies,
        "life": Life,
        "catalogue_life": CatalogueLife,
    },
    "Load spectrum": {"life": SpectrumLife},
    "Rolling elements and power: cylindrical rollers": {
        "elements": cylindrical_solution.RollerResults,
        "power_loss": cylindrical_solution.PowerLoss,
    },
    "Rolling elements and power: balls": {
        "elements": ball_solution.BallResults,
        "power_loss": ball_solution.BallPowerLoss,
        "raceway_power": solution.RacewayPower,
    },
    "Rolling elements and power: tapered rollers": {
        "elements": tapered_solution.TaperedResults,
        "power_loss": tapered_solution.TaperedPowerLoss,
    },
    "Motion of rollers and cage": {
        "": history.History,
        "instants": roller_motion.RollerInstant,
        "instants.cage": history.CageMotion,
        "pocket_peaks": history.PocketPeaks,
        "energy": roller_motion.RollerEnergy,
        "last": history.LastState,
    },
    "Temperatures of a bearing in time": {
        "": warming.WarmUpHistory,
        "instants": warming.WarmInstant,
        "energy": warming.WarmEnergy,
        "peaks": warming.WarmPeaks,
    },
    "Line contact": {
        "": film.LineContactSolution,
        "film": film.FilmResult,
        "hertz": film.HertzResult,
        "profile": film.Profile,
        "formula": film.FormulaResult,
    },
    "Line contact in time": {
        "": film_history.LineContactHistory,
        "film": film_history.FilmHistory,
        "pressure": film_history.PressureHistory,
        "profile": film_history.ProfileHistory,
    },
    "Two-disk machine": {"": two_disk.TwoDiskSolution},
    "Shaft on bearings": {
        "": shafts.ShaftSolution,
        "bearings.NAME": shafts.BearingOnShaft,
        "shaft": shafts.ShaftNodes,
        "sets.NAME": shafts.SetResult,
        "torque": shafts.TorqueBalance,
        "life": shafts.SystemLifeResult,
        "duty": shafts.DutyResult,
    },
}

HEAD = """# Results

Names are those of the Python result (`solution.power_loss.total`). Variables of NetCDF files carry the same unit and
description as attributes, with the dotted path; `--json` prints SI numbers under the names of the interface. What a
scene does not model is absent (`None` in Python). A failed solve is NaN throughout and says why. This page is made
from the labels of the result classes.

## Status

"""


def page():
    """Markdown."""
    status = "| value | name |\n|---|---|\n" + "".join(f"| {int(one)} | `{one.text}` |\n" for one in Status)
    parts = [HEAD + status.rstrip("\n")]
    earlier = {}
    for title, classes in SECTIONS.items():
        rows = [row for path, one in classes.items() for row in rows_of(one, path)]
        table = [f"| `{path}` | {unit} | {text} |" for path, unit, text in rows if (path, unit, text) not in earlier]
        again = {}
        for row in rows:
            if row in earlier:
                again.setdefault(earlier[row], []).append(f"`{row[0]}`")
        parts += [f"## {title}", *(f'As under "{other}": {", ".join(names)}.' for other, names in again.items())]
        if table:
            parts.append("\n".join(["| result | unit | what it is |", "|---|---|---|", *table]))
        earlier |= {row: earlier.get(row, title) for row in rows}
    return "\n\n".join(parts) + "\n"


def rows_of(one, path):
    """Path, unit and meaning of each labelled field of a result class, and of each result that follows from them."""
    labels = {field.name: field.metadata for field in dataclasses.fields(one) if "unit" in field.metadata}
    labels |= {name: result.metadata for name, result in derived_results(one).items()}
    for name, found in labels.items():
        text = found["description"].replace("|", "\\|")
        yield f"{path}.{name}" if path else name, udunits(found["unit"]), text


if __name__ == "__main__":
    FILE.write_text(page(), encoding="utf-8")

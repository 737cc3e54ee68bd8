"""Single contacts and dry bearings: Hertz, load distribution, films, a program of 1973, traction curves."""

import math
import tomllib

import numpy as np

import jaxbearing as jb
from fitting import FitOptions, Measurements, fit, read_curves
from jaxbearing.contacts import DowsonHigginson, LineContact, Moes, PointContact

from .common import MEASURED, TOP, Comparison, Found, rows_of, table_of_page

PUBLISHED = TOP / "tests" / "published"
CURVE = TOP / "tests" / "fitting" / "data" / "traction_etm_median.csv"
CONTRADICTION = 0.01
"""Relative difference of a printed ratio from that of its own integrals beyond which it is taken for a misprint."""
DEEPEST = 1e-6
"""Approach at the most loaded ball of the load distributions, m: small beside the distance of the groove centres, so
that all contact angles are the free one within 0.2 %."""


def hertz() -> Found:
    """Semi-axes and approach of 22 ellipses: the largest deviation of each quantity."""
    rows_printed = rows_of(PUBLISHED / "harris_table_6_1.csv")
    difference, *printed = (np.array([float(row[name]) for row in rows_printed]) for name in rows_printed[0])
    contact = PointContact(2.0 / (1.0 + difference), 2.0 / (1.0 - difference), 2.0)
    ellipse, size = contact.ellipse(1e3), 1500.0 ** (1.0 / 3.0)
    found = ellipse.transverse / size, ellipse.rolling / size, 2.0 * contact.approach(1e3) / size**2
    rows, deviations = [], {}
    for name, ours, theirs in zip(("a*", "b*", "delta*"), found, printed, strict=True):
        off = np.asarray(ours) / theirs - 1.0
        worst = int(np.argmax(np.abs(off)))
        rows.append([name, f"{off.size}", f"{100.0 * off[worst]:+.3f} %", f"{difference[worst]:g}"])
        deviations[name] = float(off[worst])
    return Found(["coefficient", "rows", "largest deviation", "at F"], rows, deviations)


def load_distribution() -> Found:
    """Integrals of the load distribution, from the reactions of a dry bearing that is displaced."""
    scene = jb.load_scene("angular_contact_218", {"operation.inner_speed": "1 rpm", "operation.axial_load": "50 N"})
    angle, balls = float(scene.geometry.contact_angle), int(scene.geometry.n_balls)
    rows, deviations = [], {}
    for row in rows_of(MEASURED / "harris_table_7_4.csv"):
        zone, ratio, radial_integral, axial_integral = (float(value) for value in row.values())
        radial = DEEPEST / (2.0 * zone * math.cos(angle))
        axial = (2.0 * zone - 1.0) * radial / math.tan(angle)
        found = jb.reaction(scene, [axial, radial, 0.0, 0.0, 0.0], tilt="linear")
        along, across = (float(found.force[place]) for place in (0, 1))
        largest = float(np.max(np.asarray(found.elements.load_inner)))
        ours = (
            across * math.tan(angle) / along,
            across / (balls * largest * math.cos(angle)),
            along / (balls * largest * math.sin(angle)),
        )
        theirs = ratio, radial_integral, axial_integral
        off = [one / other - 1.0 for one, other in zip(ours, theirs, strict=True)]
        pairs = [f"{one:.4f} ({100.0 * part:+.1f} %)" for one, part in zip(ours, off, strict=True)]
        own = radial_integral / axial_integral
        contradicts = abs(ratio / own - 1.0) > CONTRADICTION
        printed = [f"{ratio:.4f}{f' (Jr/Ja is {own:.4f})' if contradicts else ''}"]
        rows.append([f"{zone:g}", *printed, *(f"{one:.4f}" for one in theirs[1:]), *pairs])
        deviations[f"{zone:g}"] = max(off[1:] if contradicts else off, key=abs)
    names = ["Fr tan alpha/Fa", "Jr", "Ja"]
    return Found(
        ["epsilon", *(f"{name}, printed" for name in names), *(f"{name}, here" for name in names)], rows, deviations
    )


def films() -> Found:
    """Films of the source's Table 18: the field solver, and Moes' and Dowson and Higginson's formulas."""
    oil = jb.load_oil("pennzane_x2000")
    contact = LineContact(0.002435, 1.0, 2.25275e11)
    printed = tomllib.loads((PUBLISHED / "line_contact.toml").read_text(encoding="utf-8"))["full_solution"][0]
    rows, deviations = [], {}
    for place, (temperature, load) in enumerate(zip(printed["temperature"], printed["load_per_length"], strict=True)):
        field = jb.solve(jb.load_scene(f"satellite_contact_{place + 1}")).film
        inlet = oil.at(temperature)
        inputs = load, 0.02, inlet.viscosity, inlet.pressure_viscosity
        formulas = {"central": Moes(), "minimum": DowsonHigginson()}
        for name, law in formulas.items():
            theirs = printed[name][place]
            solved, formula = float(getattr(field, name)), float(np.exp(law.log_thickness(contact, *inputs)))
            cells = [f"{1e9 * one:.1f} ({100.0 * (one / theirs - 1.0):+.1f} %)" for one in (solved, formula)]
            rows.append([f"{place + 1}", name, f"{1e9 * theirs:.1f}", *cells])
            deviations[f"{place + 1}, {name}"] = formula / theirs - 1.0
    return Found(["condition", "film", "printed, nm", "field solver", "formula of bearing scenes"], rows, deviations)


def harris_mindel() -> Found:
    """A program's output of 1973, from the page of worked examples, whose test solves for it."""
    rows = [row for row in table_of_page("worked_examples.md", "quantity") if row[0].startswith(("outer ", "inner "))]
    deviations = {row[0]: float(row[2]) / float(row[1]) - 1.0 for row in rows}
    return Found(["quantity", "printed", "here", "deviation"], rows, deviations)


def traction() -> Found:
    """The fit of shear modulus and stress to the median of a measured curve."""
    scene = jb.load_scene("two_disk_etm")
    result = fit(Measurements.of(read_curves(CURVE), scene), scene, FitOptions(starts=1))
    measured = np.asarray(result.measurements.traction_coefficient)
    off = np.asarray(result.predicted) - measured
    slides = 100.0 * np.asarray(result.measurements.slide_to_roll)
    rows = [
        [f"{slide:.3g}", f"{one:.4f}", f"{one + part:.4f}", f"{100.0 * part / one:+.0f} %"]
        for slide, one, part in zip(slides, measured, off, strict=True)
    ]
    plateau = float(np.max(measured))
    deviations = {f"{slide:.3g} %": float(part) / plateau for slide, part in zip(slides, off, strict=True)}
    return Found(["slide-to-roll, %", "measured", "fitted", "deviation"], rows, deviations)


COMPARISONS = (
    Comparison(
        name="hertz",
        quantity="Hertz ellipses",
        data="Harris and Kotzalas, Table 6.1, 66 numbers",
        free="nothing",
        assumed="nothing",
        believe=0.05,
        data_error=0.02,
        verdict="Believe contact sizes, pressures and approaches to {believe} per cent: the table's own rounding.",
        compute=hertz,
        dear=False,
    ),
    Comparison(
        name="load_distribution",
        quantity="load distribution of ball bearings",
        data="Harris and Kotzalas, Table 7.4, 39 numbers",
        free="nothing",
        assumed="a bearing of 16 balls stands for one of many",
        believe=1.0,
        data_error=0.5,
        verdict="Believe the distribution of the load over the balls to {believe} per cent; one printed number "
        "contradicts its own row and is left out.",
        compute=load_distribution,
        dear=False,
    ),
    Comparison(
        name="harris_mindel",
        quantity="contact angles, loads and pressures at high speed",
        data="program of Harris and Mindel, 1973, 24 000 rpm",
        free="nothing",
        assumed="free contact angle, modulus and density of the balls follow from the printed outputs",
        believe=0.2,
        data_error=0.01,
        verdict="Believe the balance of forces at high speed to {believe} per cent; it does not check cage speed "
        "and slip.",
        compute=harris_mindel,
        dear=False,
    ),
    Comparison(
        name="films",
        quantity="film of a line contact",
        data="full solutions of the source, Table 18",
        free="nothing",
        assumed="nothing",
        believe=5.0,
        data_error=0.5,
        verdict="Believe the film formulas of smooth, flooded contacts to about {believe} per cent, on the low side; "
        "these are calculations, no measured film is among the data.",
        compute=films,
    ),
    Comparison(
        name="traction",
        quantity="traction curve of a two-disk machine",
        data="median of 300 sweeps on an ETM machine, 18 points; deviation over the largest coefficient",
        free="shear modulus and stress",
        assumed="oil, ball and steel are not named; the film is thinner than usual roughness",
        believe=25.0,
        data_error=10.0,
        verdict="Believe a curve that was fitted to its own machine to about {believe} per cent of its plateau; the "
        "fitted numbers are no property of an oil here, because the machine's oil and film are not known.",
        compute=traction,
    ),
)

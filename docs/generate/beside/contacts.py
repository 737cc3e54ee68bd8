"""Single contacts and dry bearings: Hertz, load distribution, films, a program of 1973, traction curves."""

import math
import tomllib

import numpy as np

import jaxbearing as jb
from fitting import FitOptions, Measurements, fit, read_curves
from jaxbearing.contacts import DowsonHigginson, LineContact, Moes, PointContact

from .common import MEASURED, TOP, Comparison, Found, ends, rows_of, table_of_page

PUBLISHED = TOP / "tests" / "published"
CURVE = TOP / "tests" / "fitting" / "data" / "traction_etm_median.csv"
CONTRADICTION = 0.01
"""Relative difference of a printed ratio from that of its own integrals beyond which it is taken for a misprint."""
HERTZ = ("semi-axis a*", "semi-axis b*", "approach delta*")
DEEPEST = 1e-6
"""Approach at the most loaded ball of the load distributions, m: small beside the distance of the groove centres, so
that all contact angles are the free one within 0.2 %."""


def hertz() -> Found:
    """Semi-axes and approach of 22 ellipses: the least and the largest deviation of each quantity."""
    rows_printed = rows_of(PUBLISHED / "harris_table_6_1.csv")
    difference, *printed = (np.array([float(row[name]) for row in rows_printed]) for name in rows_printed[0])
    contact = PointContact(2.0 / (1.0 + difference), 2.0 / (1.0 - difference), 2.0)
    ellipse, size = contact.ellipse(1e3), 1500.0 ** (1.0 / 3.0)
    found = ellipse.transverse / size, ellipse.rolling / size, 2.0 * contact.approach(1e3) / size**2
    rows, deviations = [], {}
    for name, ours, theirs in zip(HERTZ, found, printed, strict=True):
        off = np.asarray(ours) / theirs - 1.0
        worst = int(np.argmax(np.abs(off)))
        low, high = float(np.min(off)), float(np.max(off))
        rows.append([name, f"{off.size}", ends([low, high]), f"{difference[worst]:g}"])
        deviations |= {f"{name}, least": low, f"{name}, largest": high}
    return Found(["dimensionless coefficient", "rows", "deviation", "largest deviation at F"], rows, deviations)


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
    return Found(
        ["condition", "film", "printed, nm", "numerical solution, nm", "formula of bearing scenes, nm"],
        rows,
        deviations,
    )


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
    deviations = {f"{slide:.3g} %": float(part / one) for slide, one, part in zip(slides, measured, off, strict=True)}
    return Found(["slide-to-roll, %", "measured", "fitted", "deviation"], rows, deviations)


COMPARISONS = (
    Comparison(
        name="hertz",
        quantity="Hertz ellipses of point contacts",
        data="Harris and Kotzalas, Table 6.1, 66 numbers",
        kind="computed",
        conditions="The contacts are dry, smooth and elastic. F(rho), the difference of curvatures, is 0 to 0.99985.",
        free="Nothing was fitted.",
        assumed="Nothing was assumed.",
        missed="All numbers are reproduced within the rounding of the table.",
        believe=0.05,
        data_error=0.02,
        verdict="Believe size, pressure and approach of a dry point contact (ball bearings) to {believe} per cent of "
        "Hertz's theory, for a given load. Line contacts of rollers are not checked by it.",
        compute=hertz,
        dear=False,
    ),
    Comparison(
        name="load_distribution",
        quantity="load distribution of ball bearings at low speed",
        data="Harris and Kotzalas, Table 7.4, 38 of its 39 numbers",
        kind="computed",
        conditions="The bearing is dry, its rings are rigid, and its speed is almost 0. Axial and radial load act "
        "together.",
        free="Nothing was fitted. One printed number contradicts its own row (0.4338 against Jr/Ja = 0.4538) and "
        "was left out after we had seen it.",
        assumed="A bearing of 16 balls stands for one with many balls, as the table supposes.",
        missed="The one number that was left out is missed by 4.4 %. It is probably a misprint.",
        believe=1.0,
        data_error=0.5,
        verdict="Believe the integrals of the load over the balls, Jr and Ja, and their ratio to {believe} per "
        "cent of the classical theory with rigid rings. One printed ratio, probably a misprint, is left "
        "out of this number. The load of a single ball was not compared, and a flexible housing is not "
        "checked by it.",
        compute=load_distribution,
        dear=False,
    ),
    Comparison(
        name="harris_mindel",
        quantity="contact angles, loads and pressures of balls at high speed",
        data="program of Harris and Mindel, 1973, one operating point, six numbers",
        kind="computed",
        conditions="The shaft turns at 24 000 rpm under 3000 lbf (13.3 kN) axially. There are 21 balls of 0.8125 in "
        "on a pitch diameter of 6.2 in.",
        free="Three inputs were fitted to the printed results: free contact angle, modulus, and density of the balls. "
        "So only about three of the six numbers are independent checks.",
        assumed="Outer race control gives the orbit of the balls.",
        missed="Cage speed and slip of the printed point are not reproduced: its centrifugal force needs a much slower "
        "orbit or lighter balls. The reason is not known.",
        believe=0.2,
        data_error=0.01,
        verdict="At this one point believe contact angles, loads and pressures to {believe} per cent, for a known "
        "orbit and with three inputs fitted to the print, the density of the balls among them. Half of it "
        "is a fit, and about three numbers are checks. With inputs that are not fitted the error is not "
        "computed here. Do not trust cage speed and slip: those of the print are not reproduced.",
        compute=harris_mindel,
        dear=False,
    ),
    Comparison(
        name="films",
        quantity="film of a line contact",
        data="the source's Table 18, its numerical solutions of two conditions",
        kind="computed",
        conditions="The contact is smooth, flooded and isothermal. The oil is Pennzane X2000, the reduced radius "
        "2.435 mm, the mean surface speed 20 mm/s. Condition 1 has 76.3 N/mm, 20 °C and 1.06 GPa, condition 2 120.1 "
        "N/mm, 40 °C and 1.33 GPa.",
        free="No number was fitted. Two readings were chosen because the printed films come out only so: 20 mm/s is "
        "the mean and not the sum of both surface speeds, and the numerical solution takes the oil as "
        "incompressible.",
        assumed="Nothing else was assumed.",
        missed="The formulas are 3 to 5 % too low. This is the known error of such fitted formulas.",
        believe=5.0,
        data_error=0.5,
        verdict="Believe the formulas of smooth, flooded, isothermal line contacts to about {believe} per cent, on "
        "the low side. They were compared with four numbers of two calculations, and two readings of the "
        "print were chosen to fit. No measured film and no film of a ball contact is among the data.",
        compute=films,
    ),
    Comparison(
        name="traction",
        quantity="traction curve of a ball on a disc",
        data="medians of 300 sweeps on one machine (PCS ETM, an extreme traction machine), 18 points",
        kind="measured",
        conditions="The load is 1647 N, the mean rolling speed 25 mm/s, the oil at 39 to 41 °C. Ball, oil and steel "
        "are not named. With a steel ball of 19.05 mm the Hertz pressure is 3.6 GPa. These are machine data, not "
        "read off a figure.",
        free="Shear modulus and shear stress of the oil were fitted to these 18 points. So this is a fit and no "
        "prediction.",
        assumed="Ball, disc and the viscosity of the oil are assumed. The film is thinner than usual roughness, and "
        "roughness is left out.",
        missed="The measured curve has a sharp knee at a slide-to-roll ratio of about 2 %. The fitted one bends "
        "gradually. Mixed lubrication and errors of the slide-to-roll ratio of 1 % of the rolling speed are "
        "possible reasons. The true one is not known.",
        believe=35.0,
        data_error=10.0,
        verdict="Measure the traction curve of your own oil. One curve of an unnamed oil was fitted, and the law "
        "follows it to about {believe} per cent at each point. How well it follows the curve of another "
        "oil is not computed here. Do not take a traction coefficient of an oil that was not measured as a "
        "prediction: nothing here checks one.",
        compute=traction,
    ),
)

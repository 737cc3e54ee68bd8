"""Results of fits made by hand, without a fit: for what writes and shows them."""

import dataclasses
from pathlib import Path

import numpy as np

import jaxbearing as jb
from fitting import FitOptions, FitResult, Measurements, Parameter, read_curves
from fitting.parameters import NAMES
from fitting.result import CurveFit

DATA = Path(__file__).parents[1] / "fitting" / "data"
MEDIAN, SWEEPS = DATA / "traction_etm_median.csv", DATA / "traction_etm_sweeps.csv"
VALUES = (1.0 / 3.0 * 1e5, 6.11e-9, 2450.0, 5362.815555151545, 2.0 / 3.0 * 1e-9, -786.0)
HELD = {
    "shear_modulus_pressure": "one pressure only",
    "shear_modulus_temperature": "one temperature only",
    "stress_temperature": "held at the scene's value",
}
"""By rule, by rule, and as asked."""
UNCLEAR = "its effect on the data is uncertain by a factor of 17 to either side"
"""Of stress_pressure, which is fitted all the same."""


def made_up(scene="two_disk_etm", file=MEDIAN, converged=True, model="ree_eyring", oil=None, bic=78.6) -> FitResult:
    """Two parameters with intervals, three held, one fitted that the data cannot tell."""
    scene = jb.load_scene(scene) if isinstance(scene, str) else scene
    measurements = Measurements.of(read_curves(file), scene)
    coefficient = np.asarray(measurements.traction_coefficient)
    parameters = {}
    for name, value in zip(NAMES, VALUES, strict=True):
        if name in HELD:
            parameters[name] = Parameter(value, None, None, None, True, HELD[name])
        elif name == "stress_pressure":
            parameters[name] = Parameter(value, None, None, None, False, UNCLEAR)
        else:
            parameters[name] = Parameter(value, 0.11 * value, 0.8 * value, 1.25 * value, False)
    oil = scene.oil if oil is None else oil
    exponent = 2.0 if model == "elsharkawy_hamrock" else None
    numbers = {name: np.float64(value) for name, value in zip(NAMES, VALUES, strict=True)}
    rheology = dataclasses.replace(scene.oil.rheology, **numbers, viscous_function=model, exponent=exponent)
    oil = dataclasses.replace(oil, rheology=rheology)
    number = np.asarray(measurements.curve)
    curves = tuple(
        CurveFit(name, int(np.sum(number == i)), 3.6e9 * (1 + 0.1 * i), 0.025, 313.15, 5e7, 0.0066)
        for i, name in enumerate(measurements.curve_names)
    )
    correlation = np.array([[1.0, -0.97, 0.1], [-0.97, 1.0, np.inf], [0.1, np.inf, 1.0]])
    return FitResult(
        converged=converged,
        model=model,
        method="levenberg_marquardt",
        rms=0.00662,
        parameters=parameters,
        unidentifiable=("shear_modulus_pressure", "shear_modulus_temperature", "stress_pressure"),
        fitted=("shear_modulus", "stress", "stress_pressure"),
        correlation=correlation,
        covariance=correlation,
        condition=float("inf"),
        curves=curves,
        loss=1.25,
        steps=36,
        starts=(2, 3),
        aic=76.0,
        bic=bic,
        oil=oil,
        measurements=measurements,
        predicted=0.9 * coefficient,
        deviation=0.02 * np.ones_like(coefficient),
        outlier=np.arange(len(coefficient)) == 2,
        level=0.95,
        notes=("alpha_G cannot be determined: one pressure only.", "Lack of fit: neighbouring residuals are alike."),
        scene=dataclasses.replace(scene, oil=oil),
        options=FitOptions(),
    )

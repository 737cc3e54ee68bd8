"""First values of stress and shear modulus, without an optimisation: from another law of the oil, and from the shape
of the curves."""

import dataclasses

import jax
import numpy as np

from jaxbearing.contacts import elastic_slope
from jaxbearing.lubricants import AbstractRheology, ExponentialRheology, Lubricant
from jaxbearing.machines import DiskState

ELASTIC = 3.0
"""Deborah number above which the initial slope of a curve is taken to be elastic."""
SMALL_SLIDE = 0.25
"""Part of the largest coefficient of a curve below which its points belong to the initial slope."""
NEWTON_STEPS = 60
MIN_STRESS, MAX_STRESS = 1e3, 1e9
"""Range of the characteristic stress, Pa."""


def mean_stress_estimate(stress: np.ndarray, newtonian: np.ndarray) -> np.ndarray:
    r"""Eyring stress from $\tau_m = \tau_0\,\mathrm{asinh}(\mu\gamma/\tau_0)$; NaN where there is none
    ($\tau_m\ge\mu\gamma$).

    **Arguments:** `stress`: mean shear stress of a contact; `newtonian`: stress of Newtonian flow, mu gamma; both Pa,
    > 0. The solution is by bisection in ln tau_0: with tau_0 the right side grows from 0 to mu gamma.

    **Reference:** source eq. (85).
    """
    low, high = np.full(stress.shape, np.log(MIN_STRESS)), np.full(stress.shape, np.log(MAX_STRESS))
    for _ in range(NEWTON_STEPS):
        middle = 0.5 * (low + high)
        value = np.exp(middle) * np.arcsinh(newtonian / np.exp(middle))
        low, high = np.where(value < stress, middle, low), np.where(value < stress, high, middle)
    return np.where(stress < newtonian, np.exp(0.5 * (low + high)), np.nan)


def exponential_about(rheology: AbstractRheology, pressure: float, temperature: float) -> ExponentialRheology:
    r"""The exponential law that is tangent to another law at a pressure, Pa, and a temperature, K.

    $\alpha = \partial\ln G/\partial p$, $\beta = \partial\ln G/\partial(1/T) = -T^2\,\partial\ln G/\partial T$ and
    $\ln G_0 = \ln G - \alpha p$ with $T_0 = T$; likewise for the stress. For a modulus proportional to pressure,
    $\alpha = 1/p$ and $\beta = 0$.
    """
    numbers = {}
    for name, law in (("shear_modulus", rheology.log_shear_modulus), ("stress", rheology.log_stress)):
        value, (by_pressure, by_temperature) = jax.value_and_grad(law, argnums=(0, 1))(pressure, temperature)
        numbers[name] = np.float64(np.exp(value - by_pressure * pressure))
        numbers[f"{name}_pressure"] = np.float64(by_pressure)
        numbers[f"{name}_temperature"] = np.float64(0.0 - temperature**2 * by_temperature)
    return ExponentialRheology(
        reference_temperature=np.float64(temperature),
        viscous_function=rheology.viscous_function,
        exponent=rheology.exponent,
        **numbers,
    )


def estimated_start(
    rheology: ExponentialRheology,
    limiting: bool,
    oil: Lubricant,
    state: DiskState,
    coefficient: np.ndarray,
    deborah: np.ndarray,
    curve: np.ndarray,
) -> ExponentialRheology:
    """The rheology with stress and modulus scaled to agree with the curves in the median.

    Stress: from the largest coefficient of every curve. For an Eyring stress it is that of `mean_stress_estimate`; if
    the viscous function of the fit has a `limiting` stress, it is the mean stress itself. Modulus: from the initial
    slope of curves with a Deborah number > 3, by `elastic_slope`. Pressure and temperature coefficients stay.
    """
    area, load = np.asarray(state.patch.area), np.asarray(state.load)
    pressure, temperature = np.asarray(state.patch.mean_pressure), np.asarray(state.temperature)
    sliding = np.abs(np.asarray(state.sliding_speed))
    stress = np.abs(coefficient) * load / area
    viscosity = np.exp(np.asarray(oil.viscosity.log_viscosity(pressure, temperature)))
    newtonian = viscosity * sliding / np.asarray(state.film)
    shifts, stiffer = [], []
    for number in np.unique(curve):
        points = np.flatnonzero(curve == number)
        top = points[np.argmax(np.abs(coefficient[points]))]
        estimate = stress[top] if limiting else mean_stress_estimate(stress[top : top + 1], newtonian[top : top + 1])[0]
        if np.isfinite(estimate) and estimate > 0:
            shifts.append(np.log(estimate) - float(rheology.log_stress(pressure[top], temperature[top])))
        first = points[(np.abs(coefficient[points]) < SMALL_SLIDE * np.abs(coefficient[top])) & (sliding[points] > 0)]
        if len(first) and np.median(deborah[points]) > ELASTIC:
            slope = elastic_slope(state.patch, state.film, state.temperature, rheology)
            ratio = np.asarray(state.sliding_speed) / np.asarray(state.entrainment_speed)
            seen = coefficient[first] / ratio[first] / np.asarray(slope)[first]
            stiffer += [float(np.log(s)) for s in seen if s > 0]
    change = lambda value, logs: float(value) * float(np.exp(np.median(logs))) if logs else float(value)
    return _with_values(rheology, change(rheology.stress, shifts), change(rheology.shear_modulus, stiffer))


def _with_values(rheology: ExponentialRheology, stress: float, modulus: float) -> ExponentialRheology:
    return dataclasses.replace(rheology, stress=np.float64(stress), shear_modulus=np.float64(modulus))

"""Facts about the temperatures of a bearing, as text."""

from collections.abc import Iterator

import numpy as np

from ...thermal.result import ThermalResult
from ..display import ZERO_CELSIUS, digits, with_unit


def thermal_facts(thermal: ThermalResult) -> Iterator[tuple[str, str]]:
    """Name and text of each fact: temperatures of the nodes, heat flows, and the margin to the fold beyond which no
    steady state exists."""
    texts = [f"{name.replace('_', ' ')} {_degrees(getattr(thermal.temperatures, name))}" for name in thermal.nodes]
    yield "Temperatures", f"{', '.join(texts)} degC"
    solves = int(thermal.solves)
    leaves = "" if thermal.oil_out is None else f", which leaves with {_degrees(thermal.oil_out)} degC"
    ambient = f"{_watts(thermal.heat_to_ambient)} to the ambient; balanced in {solves} solves"
    yield "Heat", ambient if thermal.oil_out is None else f"{_watts(thermal.heat_to_oil)} to the oil{leaves}, {ambient}"
    if thermal.margin is not None:
        rate = "" if thermal.rate is None else f", rate {digits(float(thermal.rate), 3)} 1/s"
        yield "Thermal margin", f"{digits(float(thermal.margin), 3)} (0: no steady state beyond){rate}"


def _degrees(value: object) -> str:
    return f"{float(np.asarray(value)) - ZERO_CELSIUS:.1f}"


def _watts(value: object) -> str:
    return with_unit(float(np.asarray(value)), "W")

"""The operating point of a line contact in words."""

from ...ehl import LineContactSolution
from ..display import ZERO_CELSIUS


def operating_text(solution: LineContactSolution) -> str:
    """Load, speed, temperature."""
    operation = solution.operation
    speed, temperature = 1e3 * float(operation.entrainment_speed), float(operation.oil_temperature) - ZERO_CELSIUS
    return f"{1e-3 * float(solution.load_per_length):.5g} N/mm, {speed:.5g} mm/s, {temperature:.5g} degC"


def inlet_side(solution: LineContactSolution) -> str:
    """Side of the inlet."""
    return "from the left" if float(solution.operation.entrainment_speed) > 0 else "from the right"

"""Ranges in which the oil laws were fitted: beyond, they are extrapolated and a solution says so."""

FITTED_TEMPERATURES = (253.15, 473.15)
"""K."""
FITTED_PRESSURE = 1.8e9
"""Highest pressure of the traction measurements behind the rheology laws, Pa."""

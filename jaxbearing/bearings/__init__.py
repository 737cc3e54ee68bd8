"""Bearing families: geometry, kinematics, unknowns, residual, power."""

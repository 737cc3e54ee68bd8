"""Bearing families: geometry, kinematics, unknowns, residual, power."""

from .._forwarding import attributes_of

_LAZY = {
    "BallAttitude": "ball.scene",
    "BallBearing": "ball.scene",
    "BallCage": "ball.scene",
    "BallDragSettings": "ball.scene",
    "BallGeometry": "ball.geometry",
    "BallMaterials": "ball.scene",
    "BallOperation": "ball.scene",
    "BallSolution": "ball.solution",
    "CappedCouple": "ball.gyroscopic",
    "CylindricalRollerBearing": "cylindrical.scene",
    "Drag": "parts",
    "DragSettings": "parts",
    "FlexibleInnerRing": "ring_shape",
    "FlexibleRing": "ring_shape",
    "HeldDisplacement": "operation",
    "InnerRoundness": "ring_shape",
    "Materials": "parts",
    "Operation": "operation",
    "OuterRoundness": "ring_shape",
    "Rating": "rating",
    "RingDisplacement": "solution",
    "RollerCage": "cylindrical.geometry",
    "RollerFlange": "cylindrical.geometry",
    "RollerGeometry": "cylindrical.geometry",
    "RollerProfile": "profile",
    "RollerSolution": "cylindrical.solution",
    "SharedCouple": "ball.gyroscopic",
    "Simulation": "motion.settings",
    "Solution": "solution",
    "TaperedCage": "tapered.geometry",
    "TaperedGeometry": "tapered.geometry",
    "TaperedOperation": "tapered.scene",
    "TaperedRollerBearing": "tapered.scene",
    "TaperedSolution": "tapered.solution",
    "WarmUpSimulation": "warming.settings",
}
"""Scenes, geometry, parts and solutions of all families; imported on first use."""
__all__ = [*_LAZY]  # pyright: ignore[reportUnsupportedDunderAll]
__getattr__ = attributes_of(__name__, _LAZY)

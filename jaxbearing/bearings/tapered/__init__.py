"""Tapered roller bearings: scene, geometry, equations, friction, results."""

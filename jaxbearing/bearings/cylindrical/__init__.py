"""Cylindrical roller bearings: scene, equations of rolling, sliding and tilting rollers, results."""

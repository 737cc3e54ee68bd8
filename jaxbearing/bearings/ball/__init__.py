"""Ball bearings: scene, geometry, kinematics, equations, results."""

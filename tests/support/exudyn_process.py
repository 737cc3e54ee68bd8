"""Dry ball bearings in EXUDYN, in a process of its own: a question as JSON in, the answer as JSON out.

    python tests/support/exudyn_process.py < question.json

It needs `exudyn` and numpy alone, so that it may run in another environment than the benchmark does. EXUDYN prints
while it works: the answer stands behind the line `ANSWER`.
"""

import json
import sys
import time
from typing import Any

import numpy as np

ANSWER = "ANSWER"
UNTURNED = 1e6
"""Moments of inertia of the inner ring, kg m^2: it turns evenly and does not tilt, without the constraints that
explicit solvers of EXUDYN do not take."""
TOUCHING = (-1e-9, 0.0, 0.0, 0.0)
"""State of a contact at the start: its gap, m, its sliding speed and its speed of impact, m/s; the last is unused."""
LONG = 3.0
"""A run that takes longer is not repeated, s."""
LAW = ("dynamicFriction", "frictionProportionalZone", "contactStiffness")
DAMPING = ("restitutionCoefficient", "minimumImpactVelocity")


def contact(system: Any, ball: Any, race: Any, circle: float, case: dict[str, Any], law: dict[str, Any]) -> Any:
    """A ball in the groove of a race. **Arguments:** `circle`: radius of the circle of groove centres, m."""
    from exudyn.itemInterface import NodeGenericData, ObjectContactSphereTorus

    state = system.AddNode(NodeGenericData(initialCoordinates=list(TOUCHING), numberOfDataCoordinates=len(TOUCHING)))
    return system.AddObject(
        ObjectContactSphereTorus(
            markerNumbers=[ball, race],
            nodeNumber=state,
            sphereRadius=case["ball_radius"],
            torusMajorRadius=circle,
            torusMinorRadius=case["groove_radius"],
            torusAxis=[1.0, 0.0, 0.0],
            **law,
        )
    )


def bearing(exudyn: Any, case: dict[str, Any]) -> tuple[Any, Any, list[Any]]:
    """The system, its inner ring and its balls. The outer ring is the ground."""
    from exudyn.itemInterface import MarkerBodyRigid
    from exudyn.rigidBodyUtilities import InertiaSphere, RigidBodyInertia

    system = exudyn.SystemContainer().AddSystem()
    free = {"nodeType": exudyn.NodeType.RotationRotationVector}
    outer = system.AddMarker(MarkerBodyRigid(bodyNumber=system.CreateGround()))
    ring = system.CreateRigidBody(
        inertia=RigidBodyInertia(mass=case["ring_mass"], inertiaTensor=UNTURNED * np.eye(3)),
        initialAngularVelocity=[case["inner_speed"], 0.0, 0.0],
        **free,
    )
    inner = system.AddMarker(MarkerBodyRigid(bodyNumber=ring))
    system.CreateForce(bodyNumber=ring, loadVector=[0.0, case["radial_load"], 0.0])
    # Hunt and Crossley's model, whose damping is constant below the smallest speed of impact
    law = {name: case[name] for name in LAW + DAMPING} | {"impactModel": 1}
    balls = []
    for place, speed, turning in zip(case["places"], case["speeds"], case["turning"], strict=True):
        ball = system.CreateRigidBody(
            referencePosition=place,
            initialVelocity=speed,
            initialAngularVelocity=turning,
            inertia=InertiaSphere(mass=case["ball_mass"], radius=case["ball_radius"]),
            **free,
        )
        marker = system.AddMarker(MarkerBodyRigid(bodyNumber=ball))
        contact(system, marker, inner, case["inner_circle"], case, law)
        contact(system, marker, outer, case["outer_circle"], case, law)
        balls.append(ball)
    system.Assemble()
    return system, ring, balls


def settings_of(exudyn: Any, method: dict[str, Any], duration: float) -> Any:
    """One thread, nothing written. `method`: solver, steps, and for one that controls its steps a tolerance."""
    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.active = False
    settings.parallel.numberOfThreads = 1
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    integration = settings.timeIntegration
    integration.endTime = duration
    integration.numberOfSteps = method["steps"]
    integration.verboseMode = 0
    integration.solverType = getattr(exudyn.DynamicSolverType, method["solver"])
    integration.explicit.useLieGroupIntegration = True
    integration.automaticStepSize = "tolerance" in method
    if "tolerance" in method:
        integration.relativeTolerance = integration.absoluteTolerance = method["tolerance"]
        integration.initialStepSize = method["first_step"]
    return settings


def run(case: dict[str, Any], method: dict[str, Any], repeats: int) -> dict[str, Any]:
    """Places at the end, m, and the least CPU and wall time of the solver, s."""
    import exudyn

    runs = []
    for _ in range(repeats):
        system, ring, balls = bearing(exudyn, case)
        settings = settings_of(exudyn, method, case["duration"])
        begin, used = time.perf_counter(), time.process_time()
        success = system.SolveDynamic(settings, showHints=False)
        wall, spent = time.perf_counter() - begin, time.process_time() - used
        place = exudyn.OutputVariableType.Position
        at = [np.asarray(system.GetObjectOutputBody(body, place, [0.0, 0.0, 0.0])).tolist() for body in (*balls, ring)]
        runs.append({"success": bool(success), "cpu": spent, "wall": wall, "balls": at[:-1], "ring": at[-1]})
        if wall > LONG:
            break
    least = {name: min(each[name] for each in runs) for name in ("cpu", "wall")}
    return runs[-1] | least | {"version": exudyn.__version__}


def lean(case: dict[str, Any], offset: float, azimuths: list[float]) -> list[list[float]]:
    """Force on a ball at rest in the outer groove without friction, `offset` m beside its middle: outward, along the
    orbit and axial, N, at each azimuth, rad."""
    import exudyn
    from exudyn.itemInterface import MarkerBodyRigid
    from exudyn.rigidBodyUtilities import InertiaSphere

    found = []
    for azimuth in azimuths:
        system = exudyn.SystemContainer().AddSystem()
        outer = system.AddMarker(MarkerBodyRigid(bodyNumber=system.CreateGround()))
        outward = np.array([0.0, np.cos(azimuth), np.sin(azimuth)])
        ball = system.CreateRigidBody(
            referencePosition=np.array([offset, 0.0, 0.0]) + case["pitch_radius"] * outward,
            inertia=InertiaSphere(mass=case["ball_mass"], radius=case["ball_radius"]),
        )
        law = {"contactStiffness": case["contactStiffness"]}
        marker = system.AddMarker(MarkerBodyRigid(bodyNumber=ball))
        pressed = contact(system, marker, outer, case["outer_circle"], case, law)
        system.Assemble()
        force = np.asarray(system.GetObjectOutput(pressed, exudyn.OutputVariableType.Force))
        along = np.array([0.0, -np.sin(azimuth), np.cos(azimuth)])
        found.append([float(force @ outward), float(force @ along), float(force[0])])
    return found


if __name__ == "__main__":
    sys.exudynFast = True  # type: ignore[attr-defined]  # its version without checks of ranges
    question = json.load(sys.stdin)
    answer = {"run": run, "lean": lean}[question.pop("asked")](**question)
    print(ANSWER)
    print(json.dumps(answer))

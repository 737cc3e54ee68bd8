"""Equivalent line contact of a ball on a race, to compute the film of one contact of a ball bearing."""

from typing import Literal

import jax.numpy as jnp

from ...ehl import ContactBodies, ContactGeometry, ContactOperation, EHLLineContact, FilmModel, FilmSimulation
from ...materials import reduced_modulus
from ...numerics.arguments import require_choice
from ...numerics.checks import known
from ..inlet import oil_temperature
from ..solution import Solution
from .kinematics import BallKinematics, BallMotion
from .scene import BallBearing
from .solution import BallResults


def line_contact_of(
    scene: BallBearing,
    solution: Solution,
    *,
    race: Literal["inner", "outer"] = "inner",
    ball: int = 0,
    model: FilmModel | None = None,
    simulation: FilmSimulation | None = None,
) -> EHLLineContact:
    r"""The line contact equivalent to the contact of a ball with a race, as in the source's Table 18: it has the same
    Hertz (peak) pressure and the same half width in the direction of rolling.

    The contact ellipse of a ball on a race is many times longer across rolling than along it, and oil enters its middle
    as it enters a line contact. With the semi-axis a along rolling, the peak pressure p_h and the reduced modulus E',
    Hertz's relations for a line contact give the reduced radius R' and the load per length F,

    $R' = \frac{a E'}{4 p_h}$, $F = \frac{\pi}{2} a p_h$.

    For a long ellipse R' tends to the reduced radius along rolling, 1/R = 1/R1 + 1/R2; for a short ellipse it is
    larger. The entrainment speed is the mean of the speeds of ball and race along rolling, relative to the contact. At
    the inner race, the speed of the race is $(\Omega_i - \omega_m)(d_m - D\cos\alpha)/2$ and that of the ball
    $\omega_R D\cos(\alpha - \beta)/2$. Left out: side leakage, spin, speeds across rolling, heating of the inlet.

    **Arguments:** `scene`, `solution`: a scene and its converged solution; `race`: "inner" or "outer"; `ball`: index of
    the ball, from 0; `model`: model of the film and its mesh; `simulation`: settings of a transient run.

    **Raises:** `ValueError` if the scene has no oil, the solve failed, or the ball does not exist or is not loaded.
    """
    require_choice("race", race, ("inner", "outer"))
    if scene.oil is None:
        raise ValueError("oil: found nothing, expected the oil of the line contact")
    solution.raise_if_failed()
    elements: BallResults = solution.elements
    geometry = scene.geometry
    if not 0 <= ball < geometry.n_balls:
        raise ValueError(f"ball: found {ball}, expected a number from 0 to {geometry.n_balls - 1}")
    side = 0 if race == "inner" else 1
    operation = scene.operation
    modulus = reduced_modulus(scene.materials.of_rings[side], scene.materials.balls)
    angles = (elements.contact_angle_inner, elements.contact_angle_outer)
    loads = jnp.stack([elements.load_inner, elements.load_outer])
    load = known(loads[side, ball])
    if load is not None and not load[0] > 0:
        raise ValueError(f"ball: found {ball}, which the {race} race does not load; expected a loaded one")
    contact = geometry.contacts(jnp.cos(angles[0]), jnp.cos(angles[1]), modulus)
    half_width, pressure = contact.semi_axis_rolling(loads)[side, ball], contact.hertz_pressure(loads)[side, ball]
    kinematics = BallKinematics(
        *(
            jnp.asarray(value)
            for value in (
                operation.inner_speed,
                operation.outer_speed,
                geometry.pitch_diameter,
                geometry.ball_diameter,
            )
        )
    )
    across = jnp.zeros_like(loads[0]) if elements.transverse_spin is None else elements.transverse_spin
    motion = BallMotion(elements.orbital_speed, elements.spin_speed, elements.attitude_angle, across)
    surfaces = (kinematics.inner_race if race == "inner" else kinematics.outer_race)(motion, angles[side])
    return EHLLineContact(
        geometry=ContactGeometry(half_width * modulus / (4.0 * pressure)),
        materials=ContactBodies(scene.materials.of_rings[side], scene.materials.balls),
        oil=scene.oil,
        contact=FilmModel() if model is None else model,
        operation=ContactOperation(
            entrainment_speed=surfaces.mean_speed[ball],
            oil_temperature=oil_temperature(scene.settled(solution), f"{race}_raceway"),
            load_per_length=0.5 * jnp.pi * half_width * pressure,
        ),
        simulation=simulation,
    )

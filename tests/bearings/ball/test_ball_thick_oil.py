"""Ball bearings found by random scenes. Combined load under which half of the balls slide with hardly any load: the
last bits of a speed make forces there, and the balls reach their speeds only by a long walk. Axial load in thick oil:
found from slower sliding only, by a long walk too."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb

SMALL = {
    "cage.inner_diameter": "none",
    "cage.outer_diameter": "none",
    "geometry.n_balls": "8",
    "operation.radial_load": "1 kN",
    "operation.moment": "0 N*m",
    "contact.traction_accuracy": "1e-2",
}
NUMBERS = {
    "geometry.pitch_diameter": (28.883e-3, 31.284e-3, 20.18e-3, 40.025e-3),
    "geometry.ball_diameter": (6.8666e-3, 8.0657e-3, 6.9254e-3, 12.897e-3),
    "geometry.conformity_inner": (0.52854, 0.53979, 0.51037, 0.52808),
    "geometry.conformity_outer": (0.51183, 0.53234, 0.51411, 0.53622),
    "geometry.contact_angle": (0.49717, 0.44571, 0.53552, 0.23226),
    "materials.rings.youngs_modulus": (211.78e9, 196.76e9, 208.5e9, 215.49e9),
    "materials.balls.youngs_modulus": (201.41e9, 237.1e9, 311.65e9, 254.37e9),
    "materials.balls.poisson_ratio": (0.27161, 0.2734, 0.24493, 0.29712),
    "materials.balls.density": (7392.9, 5798.8, 5817.2, 4740.4),
    "operation.inner_speed": (-420.92, 854.64, -107.64, -132.06),
    "operation.outer_speed": (0.0, 0.0, 39.184, -115.68),
    "operation.axial_load": (1953.8, 1934.0, 56.064, 2502.1),
    "operation.radial_load": (2738.0, 3029.9, 56.624, 4588.2),
    "operation.moment": (-0.62736, 2.1299, -0.045497, -7.9464),
    "operation.oil_temperature": (357.06, 277.93, 302.04, 329.05),
    "operation.oil_flow": (7.119e-5, 6.6769e-5, 2.8965e-6, 5.5446e-5),
    "oil.viscosity.glass_viscosity": (3.7742e12, 7.4117e11, 1.9175e12, 6.8526e11),
    "oil.rheology.stress": (225540.0, 78033.0, 242370.0, 229680.0),
    "oil.rheology.shear_modulus": (85723.0, 67636.0, 33906.0, 39371.0),
    "cage.guiding_clearance": (1.982e-5, 1.2991e-4, 8.548e-5, 8.9398e-5),
    "cage.pocket_clearance": (3.4333e-4, 4.0328e-4, 1.5039e-4, 6.4483e-4),
    "cage.land_width": (3.4976e-4, 9.7337e-4, 4.9242e-4, 1.5171e-3),
}
AXIAL = {
    "geometry.n_balls": "15",
    "contact.heathcote": "true",
    "contact.film": "hamrock_dowson",
    "contact.thermal": "none",
    "cage": "none",
    "drag": "none",
}
AXIAL_NUMBERS = {
    "geometry.pitch_diameter": (32.741e-3, 23.935e-3),
    "geometry.ball_diameter": (4.7478e-3, 3.2408e-3),
    "geometry.conformity_inner": (0.5072, 0.53519),
    "geometry.conformity_outer": (0.53041, 0.52972),
    "geometry.contact_angle": (0.22355, 0.32327),
    "materials.rings.youngs_modulus": (192.11e9, 198.46e9),
    "materials.balls.youngs_modulus": (302.95e9, 307.6e9),
    "materials.balls.poisson_ratio": (0.29073, 0.31508),
    "materials.balls.density": (5583.5, 7766.1),
    "operation.inner_speed": (2286.3, 4268.8),
    "operation.outer_speed": (0.0, -3227.2),
    "operation.axial_load": (1311.0, 503.42),
    "operation.oil_temperature": (289.13, 255.75),
    "oil.viscosity.glass_viscosity": (1.7493e12, 6.0601e11),
    "oil.rheology.stress": (121220.0, 143240.0),
    "oil.rheology.shear_modulus": (64567.0, 42044.0),
}


def in_turn(scene, numbers):
    one = lambda numbers: jb.solve(scene.replace(numbers), throw=False)
    return jax.jit(lambda batch: jax.lax.map(one, batch))({key: jnp.asarray(value) for key, value in numbers.items()})


@pytest.mark.slow
def test_thick_oil_under_axial_load():
    found = in_turn(jb.load_scene("turbine_ball", AXIAL), AXIAL_NUMBERS)
    assert np.all(found.converged), found.status
    np.testing.assert_allclose(found.drive_power, found.power_loss.total, rtol=1e-8)


@pytest.mark.slow
def test_converge_and_close():
    scene = jb.load_scene("turbine_ball", SMALL)
    found = in_turn(scene, NUMBERS)
    assert np.all(found.converged), found.status
    # what rounding leaves of the balance of forces, in 1 % of the load, does work
    number = {name.split(".")[1]: np.asarray(values) for name, values in NUMBERS.items()}
    speed = (np.abs(number["inner_speed"]) + np.abs(number["outer_speed"])) * number["pitch_diameter"]
    left = found.residual_norm * 0.01 * np.hypot(number["axial_load"], number["radial_load"]) * speed
    loss = np.asarray(found.power_loss.total)
    assert np.all(np.abs(found.drive_power - loss) <= 1e-8 * loss + left)


@pytest.mark.slow
@pytest.mark.parametrize("film", ["nijenbanning", "hamrock_dowson"])
def test_films_under_too_little_thrust(film):
    """Most balls of an angular contact bearing lose contact, and those opposite the load lie beyond the centre of their
    inner groove: the ring is where it is without films, but for the films of the loaded balls."""
    oil = {"oil.name": "mobil_jet_ii", "operation.oil_temperature": "60 degC", "contact.film": film}
    scene = jb.load_scene("angular_contact_218", {**oil, "operation.radial_load": "10 kN"})
    dry = jb.jit_solver(scene.replace({"contact": None, "oil": None}))
    lubricated = jb.jit_solver(scene)
    for load in (1e3, 1e4, 5e4):
        for part in (0.0, 0.005, 0.02, 0.1, 0.2):
            point = {"radial_load": load, "axial_load": part * load}
            found, bare = lubricated(**point), dry(**point)
            assert bool(found.converged), (load, part)
            # films are about 1 um thick
            np.testing.assert_allclose(found.ring.radial, bare.ring.radial, atol=5e-6)
            np.testing.assert_allclose(found.force[:2], [part * load, load], rtol=1e-8, atol=1e-6 * load)

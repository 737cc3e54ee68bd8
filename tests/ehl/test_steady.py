"""The steady film: published numbers, order of convergence, derivatives, refusals, batches."""

import dataclasses
import tomllib
from pathlib import Path

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from line_contacts import CONDITIONS, MODULUS, RADIUS, STEEL, by_moes, satellite
from numpy.testing import assert_allclose

import jaxbearing as jb
from jaxbearing.ehl import ContactBodies, ContactGeometry, ContactOperation, EHLLineContact, FilmModel
from jaxbearing.ehl.mesh import mesh
from jaxbearing.ehl.solution import solve_line_contact
from jaxbearing.numerics.status import SolveError, Status
from jaxbearing.scenes.oil.catalogue import load_oil

PUBLISHED = tomllib.loads((Path(__file__).parents[1] / "published" / "line_contact_field.toml").read_text())


def solved(scene):
    solution = jb.solve(scene)
    assert float(solution.last_step) < 1e-9
    return solution


@pytest.mark.parametrize("row", PUBLISHED["table18"], ids=lambda row: str(row["condition"]))
def test_built_in_scenes_give_table_18(row):
    """All printed digits, and the films within 0.5 %, at the resolution that the scene asks for."""
    solution = solved(jb.load_scene(f"satellite_contact_{row['condition']}"))
    for value, printed in ((solution.film.central, row["central"]), (solution.film.minimum, row["minimum"])):
        assert_allclose(float(value), printed, rtol=5e-3)
        assert f"{1e6 * float(value):.4f}" == f"{1e6 * printed:.4f}"
    assert f"{1e3 * float(solution.hertz.half_width):.4f}" == f"{1e3 * row['half_width']:.4f}"
    assert f"{1e-9 * float(solution.hertz.pressure):.2f}" == f"{1e-9 * row['pressure']:.2f}"


def constant_of_the_film(scene):
    """H00."""
    solution, scales, grid = solved(scene), scene.scales(), mesh(scene.steady_mesh)
    pressure = np.asarray(solution.profile.pressure) / float(scales.hertz_pressure)
    film = np.asarray(solution.profile.film) / float(scales.film)
    offsets = film - 0.5 * grid.x**2 - grid.kernel @ pressure[1:-1]
    assert_allclose(offsets, offsets[0], atol=1e-12)
    return offsets[0]


@pytest.mark.slow
@pytest.mark.usefixtures("optimized")  # as users run it; elsewhere quickly compiled
@pytest.mark.parametrize("row", PUBLISHED["steady"], ids=lambda row: str(row["condition"]))
def test_check_values(row):
    films = [solved(satellite(row["condition"], nodes)) for nodes in (201, 401)]
    central, minimum = (
        (4 * float(getattr(films[1].film, name)) - float(getattr(films[0].film, name))) / 3
        for name in ("central", "minimum")
    )
    assert_allclose([central, minimum], [row["central"], row["minimum"]], rtol=row["rtol"])
    offsets = [constant_of_the_film(satellite(row["condition"], nodes)) for nodes in (201, 401)]
    assert_allclose((4 * offsets[1] - offsets[0]) / 3, row["offset"], rtol=row["rtol"])
    place = float(films[1].film.minimum_position / films[1].hertz.half_width)
    assert_allclose(place, row["place"], rtol=1e-3)
    assert_allclose(float(films[1].speed_number), row["wedge"], rtol=2e-5)


@pytest.mark.slow
def test_order_two_on_four_meshes_and_monotone_to_1601():
    for condition in CONDITIONS:
        meshes = (101, 201, 401, 801, 1601)[: 5 if condition == 1 else 4]
        films = [solved(satellite(condition, nodes)).film for nodes in meshes]
        for name in ("central", "minimum"):
            values = np.asarray([float(getattr(film, name)) for film in films])
            steps = np.diff(values)
            assert np.all(steps > 0)  # always from below
            orders = np.log2(steps[:-1] / steps[1:])
            print(condition, name, 1e6 * values, orders)
            assert_allclose(orders[1:], 2.0, atol=0.15)
            assert_allclose(orders[0], 2.0, atol=0.35)


def logarithm_of_central(v, nodes=401):
    radius, modulus, load, speed, temperature = v
    body = STEEL
    scene = EHLLineContact(
        ContactGeometry(radius),
        ContactBodies(body, body),
        load_oil("pennzane_x2000"),
        FilmModel(nodes=nodes, compressible=False),
        ContactOperation(speed, temperature, load),
    )
    young = {f"materials.body_{i}.youngs_modulus": 0.91 * modulus for i in (1, 2)}
    return jnp.log(jb.solve(scene.replace(young), throw=False).film.central)


@pytest.mark.slow
def test_sensitivities():
    v = jnp.array([RADIUS, MODULUS, 76310.0, 0.02, 293.15])
    slope = jax.jit(jax.grad(logarithm_of_central))(v)
    expected = PUBLISHED["sensitivities"]
    assert_allclose((slope * v)[:4], expected["logarithmic"], atol=expected["atol"])
    assert_allclose(slope[4], expected["temperature"], atol=1e-6)


def test_gradients_of_every_number():
    """Both modes, central and minimum film, against central differences (their own error is some 1e-9)."""
    scene = jax.tree.map(jnp.asarray, satellite(1, 61, compressible=True))
    paths = {
        "operation.entrainment_speed": scene.operation.entrainment_speed,
        "operation.load_per_length": scene.operation.load_per_length,
        "operation.oil_temperature": scene.operation.oil_temperature,
        "geometry.reduced_radius_rolling": scene.geometry.reduced_radius_rolling,
        "materials.body_1.youngs_modulus": scene.materials.body_1.youngs_modulus,
    }
    paths |= {f"oil.viscosity.{name}": value for name, value in vars(scene.oil.viscosity).items()}
    names, start = list(paths), jnp.stack([jnp.asarray(value) for value in paths.values()])

    def films(logs):
        changed = scene.replace(dict(zip(names, start * jnp.exp(logs), strict=True)))
        film = solve_line_contact(changed).film
        found = jnp.log(jnp.stack([film.central, film.minimum]))
        return found, found

    @jax.jit
    def both_modes(logs):
        reverse, found = jax.jacrev(films, has_aux=True)(logs)
        return found, reverse, jax.jacfwd(films, has_aux=True)(logs)[0]

    zero, step = jnp.zeros(len(names)), 1e-5
    _, reverse, forward = both_modes(zero)
    assert_allclose(forward, reverse, rtol=1e-9, atol=1e-12)
    for i, name in enumerate(names):
        h = step * jnp.eye(len(names))[i] * (0.01 if "temperature" in name or name.endswith("c1") else 1.0)
        difference = (both_modes(h)[0] - both_modes(-h)[0]) / (2 * h[i])
        assert_allclose(reverse[:, i], difference, rtol=1e-6, atol=1e-6 * float(jnp.max(jnp.abs(reverse[:, i]))))


@pytest.mark.parametrize("row", PUBLISHED["moes"], ids=lambda row: f"M{row['M']}-L{row['L']}")
@pytest.mark.slow
def test_moes_rows(row):
    values = []
    for nodes in (401, 801):
        scene, unit = by_moes(row["M"], row["L"], nodes, float(row["inlet"]))
        film = solved(scene).film
        values.append([float(film.central) / unit, float(film.minimum) / unit])
    extrapolated = (4 * np.asarray(values[1]) - np.asarray(values[0])) / 3
    print(row["M"], row["L"], extrapolated)
    assert_allclose(extrapolated, [row["central"], row["minimum"]], rtol=2e-3)


@pytest.mark.slow
def test_envelope_converges_from_cold():
    """40 points, M 5 to 1000 and L 0 to 25; at the largest alpha p_h is about 220."""
    numbers = [(m, el) for m in (5, 10, 20, 50, 100, 200, 500, 1000) for el in (0.0, 2.5, 5.0, 10.0, 25.0)]
    solver, ratios = {}, {}
    for m, el in numbers:
        inlet = 16.0 if m < 8 else 8.0 if m < 25 else 4.0
        scene, _ = by_moes(m, max(el, 1e-9), 401, inlet)
        run = solver.setdefault(inlet, eqx.filter_jit(solve_line_contact))
        solution = run(scene)
        assert bool(solution.converged), (m, el, solution.failure())
        ratios[m, el] = float(solution.film.central / solution.formulas.moes_central)
    for m in (5, 10, 20, 50, 100, 200, 500, 1000):
        print(m, " ".join(f"{ratios[m, el]:.3f}" for el in (0.0, 2.5, 5.0, 10.0, 25.0)))
    # the spec's range, found here too; M = 500 and 1000 at 401 nodes are low by their meshes (0.919 -> 0.951, 0.837 ->
    # 0.946 at 1601 nodes), not by the formula
    elastic = [ratio for (m, el), ratio in ratios.items() if m <= 200 and el >= 2.5]
    assert 0.96 < min(elastic) < max(elastic) < 1.07
    isoviscous = [ratio for (m, el), ratio in ratios.items() if m <= 200 and el == 0.0]
    assert 0.94 < min(isoviscous) < max(isoviscous) < 1.05
    finer = [solved(by_moes(m, 1e-9, 801)[0]) for m in (500, 1000)]
    assert all(0.92 < float(one.film.central / one.formulas.moes_central) < 0.96 for one in finer)


def test_compression_thins_the_centre_only():
    thick, thin = solved(satellite(1, 101)).film, solved(satellite(1, 101, compressible=True)).film
    assert_allclose(float(thin.central / thick.central), 0.84, atol=0.02)
    assert_allclose(float(thin.minimum / thick.minimum), 0.99, atol=0.01)


def test_flow_from_the_other_side_is_the_mirror_image():
    forth, back = solved(satellite(1, 101)), solved(satellite(1, 101, speed=-0.02))
    for name in ("pressure", "film"):
        assert_allclose(getattr(back.profile, name), getattr(forth.profile, name)[::-1], rtol=1e-12)
    assert_allclose(back.profile.x, -forth.profile.x[::-1], rtol=1e-12)
    assert_allclose(back.film.minimum_position, -forth.film.minimum_position, rtol=1e-12)


@pytest.mark.parametrize("speed", [0.0, 1e-12])
def test_at_rest_there_is_no_steady_film(speed):
    solution = jb.solve(satellite(1, 101, speed=speed), throw=False)
    assert int(solution.status) == Status.NO_EQUILIBRIUM
    assert np.isnan(float(solution.film.central))
    with pytest.raises(SolveError, match="no_equilibrium: the surfaces do not carry oil"):
        jb.solve(satellite(1, 101, speed=speed))


def test_light_loads_are_refused():
    scene, _ = by_moes(2.0, 5.0, 101)
    assert int(jb.solve(scene, throw=False).status) == Status.OUTSIDE_VALIDITY
    with pytest.raises(SolveError, match=r"outside_validity: load number M = 2 is below 3.*rigid"):
        jb.solve(scene)
    still = scene.at_operation(entrainment_speed=0.0)  # no film at all is said first
    assert int(jb.solve(still, throw=False).status) == Status.NO_EQUILIBRIUM
    scene, _ = by_moes(5.0, 5.0, 101, 4.0)
    assert any("contact.inlet" in text for text in jb.solve(scene).warnings)


def test_a_failing_lane_harms_no_neighbour_and_compiles_once():
    scene = jax.tree.map(jnp.asarray, satellite(1, 101))
    traces = []

    @jax.jit
    @jax.vmap
    def film(speed):
        traces.append(1)

        def central(speed):
            solution = jb.solve(scene.at_operation(entrainment_speed=speed), throw=False)
            return solution.film.central, solution.status

        return jax.value_and_grad(central, has_aux=True)(speed)

    (central, status), slope = film(jnp.array([0.02, 0.0, 0.04]))
    assert list(status) == [Status.CONVERGED, Status.NO_EQUILIBRIUM, Status.CONVERGED]
    assert np.isnan(central[1])
    assert np.all(np.isfinite(central[::2]))
    assert np.all(np.isfinite(slope))
    assert_allclose(central[0], solved(satellite(1, 101)).film.central, rtol=1e-10)
    film(jnp.array([0.01, 0.03, 0.05]))
    assert len(traces) == 1


@pytest.mark.slow
def test_shared_parameters_have_gradients_beside_a_failed_lane():
    scene = jax.tree.map(jnp.asarray, satellite(1, 101))

    def total(temperature):
        one = lambda u: jb.solve(scene.at_operation(entrainment_speed=u, oil_temperature=temperature), throw=False)
        solutions = jax.vmap(one)(jnp.array([0.02, 0.0]))
        return jnp.sum(jnp.where(solutions.converged, solutions.film.central, 0.0))

    alone = jax.grad(lambda t: jb.solve(scene.at_operation(oil_temperature=t), throw=False).film.central)(293.15)
    assert_allclose(jax.grad(total)(293.15), alone, rtol=1e-9)


@pytest.mark.parametrize("oil", ["mobil_jet_ii", "nye_186a", "fomblin_z25"])
def test_other_oils(oil):
    laws = {name: getattr(load_oil(oil), name) for name in ("viscosity", "pressure_viscosity")}
    scene = satellite(1, 101, oil=dataclasses.replace(load_oil("pennzane_x2000"), **laws), speed=1.0)
    solution = solved(scene)
    ratio = float(solution.film.central / solution.formulas.moes_central)
    assert 0.9 < ratio < 1.1
    assert np.all(np.isfinite(solution.profile.pressure))
    assert float(jnp.min(solution.profile.pressure)) == 0.0


def test_load_is_carried():
    solution = solved(satellite(1, 101))
    carried = np.trapezoid(np.asarray(solution.profile.pressure), np.asarray(solution.profile.x))
    assert_allclose(carried, 76310.0, rtol=1e-12)

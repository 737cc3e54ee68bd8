"""Stiffness over speed and its file for ROSS: axes, refusals, what is read back."""

import tomllib

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.report.ross import ross_bearing, write_ross
from jaxbearing.report.stiffness import StiffnessTable, stiffness_over_speed, stiffness_to_dict

RPM = 2.0 * np.pi / 60.0
FREEDOM = ("axial", "radial", "lateral", "tilt", "tilt_lateral")
SPEEDS = np.array([0.0, 4000.0, 8000.0, 12000.0]) * RPM


def plane(element, i=0):
    return np.array([[element["kxx"][i], element["kxy"][i]], [element["kyx"][i], element["kyy"][i]]])


def made_up(speeds=(100.0, 200.0), modelled=FREEDOM):
    """A table with a different number in every place."""
    size = len(FREEDOM)
    matrices = 1e8 * np.arange(1.0, 1.0 + len(speeds) * size**2).reshape(len(speeds), size, size)
    return StiffnessTable(np.array(speeds), matrices, FREEDOM, modelled, ())


@pytest.fixture(scope="module")
def axial():
    """Dry, under axial load only."""
    return stiffness_over_speed(jb.load_scene("angular_contact_218"), SPEEDS)


def test_turned_by_hand():
    radial, lateral, along, across = 4e8, 1e8, 3e7, 2e7
    matrix = np.zeros((5, 5))
    matrix[1:3, 1:3] = [[radial, along], [across, lateral]]
    table = StiffnessTable(np.array([0.0, 1.0]), np.stack([matrix, 2.0 * matrix]), FREEDOM, ("radial", "lateral"), ())
    cases = {
        0.0: [[radial, along], [across, lateral]],
        # the load line on y, lateral on -x: x x = lateral lateral, x y = -(lateral radial)
        np.pi / 2: [[lateral, -across], [-along, radial]],
        # the load line on -y, lateral on +x
        -np.pi / 2: [[lateral, -across], [-along, radial]],
        np.pi: [[radial, along], [across, lateral]],
        # half way: the sums and differences of the four, over 2
        np.pi / 4: 0.5
        * np.array(
            [
                [radial + lateral - along - across, radial - lateral + along - across],
                [radial - lateral - along + across, radial + lateral + along + across],
            ]
        ),
    }
    for angle, expected in cases.items():
        element = ross_bearing(table, load_direction=angle)
        np.testing.assert_allclose(plane(element, 0), expected, rtol=1e-12)
        np.testing.assert_allclose(plane(element, 1), 2.0 * np.asarray(expected), rtol=1e-12)


def test_force_along_the_load_line_is_the_radial_one():
    """A displacement along the load line in x and y gives the force of the radial column."""
    table = made_up()
    for angle in (-np.pi / 2, 0.3, 2.0):
        element = ross_bearing(table, load_direction=angle)
        radial, lateral = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        force = plane(element) @ radial
        np.testing.assert_allclose([radial @ force, lateral @ force], table.stiffness[0, 1:3, 1], rtol=1e-12)
        assert element["kzz"] == table.stiffness[:, 0, 0].tolist()


def test_axial_load_is_the_same_all_round(axial):
    for i in range(len(SPEEDS)):
        elements = [ross_bearing(axial, load_direction=angle) for angle in (-np.pi / 2, 0.7)]
        stiffness = elements[0]["kxx"][i]
        for element in elements:
            np.testing.assert_allclose(plane(element, i), stiffness * np.eye(2), rtol=1e-10, atol=1e-10 * stiffness)
    assert np.all(np.diff(elements[0]["kzz"]) < 0.0)  # the contact angles part with speed, and the inner one grows


def test_each_speed_is_a_solve_of_its_own(axial):
    alone = jb.solve(jb.load_scene("angular_contact_218").at_operation(inner_speed=SPEEDS[2]))
    assert axial.freedom == FREEDOM
    np.testing.assert_allclose(axial.stiffness[2], alone.stiffness, rtol=1e-12)
    assert stiffness_to_dict(axial)["speed"] == SPEEDS.tolist()


def test_file_is_what_it_was_made_from(axial, tmp_path):
    file = tmp_path / "bearing.toml"
    write_ross(axial, file, "my\nscene \x1b", load_direction=0.3, node=4, tag="drive_end")
    read = tomllib.loads(file.read_text(encoding="utf-8"))
    assert list(read) == ["BearingElement_drive_end"]
    (element,) = read.values()
    assert element == ross_bearing(axial, load_direction=0.3, node=4, tag="drive_end")
    assert (element["n"], element["tag"]) == (4, "drive_end")
    for name in ("kxx", "kxy", "kyx", "kyy", "kzz", "cxx", "cxy", "cyx", "cyy", "czz"):
        assert len(element[name]) == len(SPEEDS)
        assert all(isinstance(value, float) for value in element[name])
        assert name[0] == "k" or not any(element[name])
    # shaft speeds: `speed` of ROSS 3, whose `frequency` is that of the whirl, and `frequency` of ROSS 2
    assert element["speed"] == SPEEDS.tolist()
    assert "frequency" not in element
    older = ross_bearing(axial, load_direction=0.3, node=4, tag="drive_end", version=2)
    assert older.pop("frequency") == element.pop("speed")
    assert older == element
    write_ross(axial, file)
    assert list(tomllib.loads(file.read_text(encoding="utf-8"))) == ["BearingElement_bearing"]


def test_roller_bearing_has_both_directions_and_nothing_along_the_axis():
    scene = jb.load_scene("reference_roller", {"contact": "none"})
    assert scene.ring_freedom == ("radial",)
    table = stiffness_over_speed(scene, SPEEDS[1:3])
    assert (table.freedom, table.modelled) == (FREEDOM, ("radial", "lateral"))
    told = np.array(stiffness_to_dict(table)["stiffness"], dtype=object)
    assert [place.tolist() for place in np.nonzero(told[0] != None)] == [[1, 1, 2, 2], [1, 2, 1, 2]]  # noqa: E711
    element = ross_bearing(table)
    assert element["kzz"] == [0.0, 0.0]
    # the load is along -y: stiffer there
    np.testing.assert_allclose(element["kyy"], table.stiffness[:, 1, 1], rtol=1e-12)
    np.testing.assert_allclose(element["kxx"], table.stiffness[:, 2, 2], rtol=1e-12)
    assert np.all(np.array(element["kyy"]) > np.array(element["kxx"]))
    assert min(element["kxx"]) > 0.0


def test_a_failed_speed_is_named_and_nothing_comes_out():
    scene = jb.load_scene("reference_roller", {"contact": "none"})
    fast = jb.jit_solver(scene)
    stopped = jb.jit_solver(scene, options=jb.NewtonOptions(max_steps=1))
    solver = lambda one: (stopped if one.operation.inner_speed > 500.0 else fast)(one)
    with pytest.raises(jb.SolveError, match=r"at 837\.758 rad/s \(8000\.0 rpm\): .* after "):
        stiffness_over_speed(scene, SPEEDS[[0, 2, 3]], solver=solver)


@pytest.mark.parametrize(
    "speeds", [[2.0, 1.0], [1.0, 1.0], [-1.0, 1.0], [0.0, np.nan], [0.0, np.inf], 100.0, [[1.0, 2.0]], []]
)
def test_speeds_that_are_no_axis_of_a_table(speeds):
    with pytest.raises(ValueError, match="speeds must"):
        stiffness_over_speed(jb.load_scene("angular_contact_218"), speeds, solver=lambda one: pytest.fail("solved"))


def test_what_cannot_be_written_is_refused(tmp_path):
    file = tmp_path / "a.toml"
    free = made_up()
    free.stiffness[1, 0, 0] = np.nan
    cases = [
        ("at least 2 speeds, got 1", made_up((100.0,)), {}),
        ("not finite", free, {}),
        ("radial and the lateral", made_up(modelled=("radial",)), {}),
        ("tag", made_up(), {"tag": "a]b"}),
    ]
    for message, table, changes in cases:
        with pytest.raises(ValueError, match=message):
            write_ross(table, file, **changes)
    with pytest.raises(ValueError, match=r"\.toml"):
        write_ross(made_up(), tmp_path / "a.txt")
    with pytest.raises(TypeError, match="TwoDisk has no stiffness"):
        stiffness_over_speed(jb.load_scene("two_disk_etm"), [1.0, 2.0])
    assert not list(tmp_path.iterdir())


def test_lubricated_bearing_at_rest_is_refused_before_any_solve():
    scene = jb.load_scene("turbine_roller")
    with pytest.raises(ValueError, match="turn against each other"):
        stiffness_over_speed(scene, [0.0, 100.0], solver=lambda one: pytest.fail("solved"))

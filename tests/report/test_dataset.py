"""The labelled data set and its NetCDF file: every variable has its unit, and nothing changes on the way."""

import os

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr
from roller_cases import dry_roller, turbine_roller

import jaxbearing as jb
from jaxbearing.numerics.status import Status
from jaxbearing.report.dataset import solution_to_dataset, write_netcdf
from jaxbearing.report.json_report import solution_to_dict
from jaxbearing.report.labels import label_unit, udunits


@pytest.fixture(scope="module")
def solution():
    return jb.solve(turbine_roller())


@pytest.fixture(scope="module")
def dry():
    return jb.solve(dry_roller())


@pytest.fixture(scope="module")
def batch(dry):
    """Three loads; the second solve has failed."""
    numbers, rest = eqx.partition(dry, eqx.is_array)
    three = jax.tree.map(lambda leaf: jnp.stack([jnp.asarray(leaf)] * 3), numbers)
    three = eqx.tree_at(lambda s: s.operation.radial_load, three, jnp.asarray([1e3, 2e3, 3e3]))
    three = eqx.tree_at(lambda s: s.status, three, jnp.asarray([0, int(Status.DIVERGED), 0]))
    failed = lambda leaf: leaf.at[1].set(jnp.nan)
    three = eqx.tree_at(lambda s: s.elements, three, jax.tree.map(failed, three.elements))
    return eqx.combine(three, rest)


def written(dataset, path):
    write_netcdf(dataset, path)
    with xr.open_dataset(path) as file:
        return file.load()


def test_every_variable_is_labelled_and_written_to_the_bit(solution, tmp_path):
    dataset = solution_to_dataset(solution)
    back = written(dataset, tmp_path / "turbine.nc")
    assert set(back.variables) == set(dataset.variables)
    for name, variable in back.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name
        assert variable.dims == dataset[name].dims
        np.testing.assert_array_equal(variable.values.astype(str), dataset[name].values.astype(str))
        if variable.dtype.kind in "if":
            assert variable.values.tobytes() == dataset[name].values.tobytes()
    assert back.attrs == dataset.attrs
    assert back.attrs["jaxbearing_version"] == jb.__version__
    assert back.attrs["not_modelled"] == ", ".join(solution.not_modelled) == "rolling_resistance"
    assert back.attrs["Conventions"].startswith("CF-")


def test_the_data_set_holds_what_the_json_holds(solution):
    dataset, json = solution_to_dataset(solution), solution_to_dict(solution)
    for part in ("power_loss", "cage", "ring", "operation"):
        for name, value in json[part].items():
            assert float(dataset[f"{part}_{name}"]) == value
            assert dataset[f"{part}_{name}"].attrs["path"] == f"{part}.{name}"
    for name, values in json["elements"].items():
        assert dataset[name].dims == ("element",)
        assert dataset[name].values.tolist() == values
    assert float(dataset["drive_power"]) == json["drive_power"]
    assert int(dataset["unknowns"]) == json["unknowns"]
    assert float(dataset["stiffness"].sel(freedom="radial", freedom_displaced="radial")) == json["stiffness"][1][1]
    assert [*dataset.attrs["warnings"].splitlines(), *dataset.attrs["notes"].splitlines()] == json["warnings"]


def test_units_are_those_of_the_conventions(solution):
    dataset = solution_to_dataset(solution)
    units = {name: dataset[name].attrs["units"] for name in dataset.variables}
    assert units["operation_oil_flow"] == "m3 s-1"
    assert units["cage_speed"] == "rad s-1"
    assert units["stiffness"] == "mixed"
    assert units["inner_torque"] == "N m"
    assert units["cage_slip"] == "1"
    assert dataset["azimuth"].attrs["units"] == "rad"


@pytest.mark.parametrize("unit", ["m^3/s/", "W/(m*K)", "N*m", "m^-1", "", "N  m"])
def test_units_that_are_not_understood_are_refused(unit):
    with pytest.raises(ValueError, match="unit"):
        udunits(unit)


def test_status_and_checks_have_their_meanings(solution):
    broken = eqx.tree_at(lambda s: next(iter(s.range_checks.values())), solution, jnp.asarray(True))
    dataset = solution_to_dataset(broken)
    assert dataset["status"].attrs["flag_meanings"].split() == [status.text for status in Status]
    assert dataset["status"].attrs["flag_values"].tolist() == [int(status) for status in Status]
    assert dataset["status"].attrs["flag_values"].dtype == dataset["status"].dtype
    equations = dataset["worst_equation"].attrs
    assert len(equations["flag_meanings"].split()) == len(solution.equation_names) == len(equations["flag_values"])
    first = next(iter(solution.range_checks))
    assert int(dataset["out_of_range"].sel(check=first)) == 1
    assert dataset.attrs["warnings"] == first


def test_what_is_not_modelled_is_left_out(dry, tmp_path):
    back = written(solution_to_dataset(dry), tmp_path / "dry.nc")
    assert "load_inner" in back
    for name in (
        "film_inner",
        "cage_speed",
        "power_loss_drag",
        "power_loss_total",
        "drive_power",
        "operation_oil_flow",
    ):
        assert name not in back.variables


def test_batch(batch, dry, tmp_path):
    dataset = solution_to_dataset(batch, dims=("case",))
    back = written(dataset.swap_dims(case="operation_radial_load"), tmp_path / "batch.nc")
    assert back["operation_radial_load"].values.tolist() == [1e3, 2e3, 3e3]
    assert dataset["load_inner"].dims == ("case", "element")
    assert dataset["azimuth"].dims == ("element",)
    np.testing.assert_array_equal(dataset["azimuth"], dry.elements.azimuth)
    assert dataset["stiffness"].dims == ("case", "freedom", "freedom_displaced")
    assert dataset["unknowns"].dims == ()
    assert np.isnan(back["load_inner"].values).all(axis=1).tolist() == [False, True, False]
    assert back["status"].values.tolist() == [0, 2, 0]
    assert (
        back["load_inner"].sel(operation_radial_load=3e3).values.tolist()
        == np.asarray(dry.elements.load_inner).tolist()
    )


def test_batch_of_two_dimensions(dry):
    numbers, rest = eqx.partition(dry, eqx.is_array)
    grid = eqx.combine(jax.tree.map(lambda leaf: jnp.broadcast_to(leaf, (2, 3, *leaf.shape)), numbers), rest)
    dataset = solution_to_dataset(grid, ("load", "speed"))
    assert dict(dataset["load_outer"].sizes) == {"load": 2, "speed": 3, "element": dry.elements.azimuth.size}
    with pytest.raises(ValueError, match="2 leading dimensions"):
        solution_to_dataset(grid, ("load",))


def test_warnings_of_a_batch_count_the_cases(solution):
    numbers, rest = eqx.partition(solution, eqx.is_array)
    two = eqx.combine(jax.tree.map(lambda leaf: jnp.stack([jnp.asarray(leaf)] * 2), numbers), rest)
    two = eqx.tree_at(lambda s: next(iter(s.range_checks.values())), two, jnp.asarray([True, False]))
    dataset = solution_to_dataset(two, ("case",))
    assert dataset.attrs["warnings"].endswith("(1 of 2 cases)")
    assert int(dataset["out_of_range"].sum()) == 1


def test_a_failed_solve_is_refused(dry):
    failed = eqx.tree_at(lambda s: s.status, dry, jnp.asarray(int(Status.NOT_CONVERGED)))
    with pytest.raises(ValueError, match="not_converged"):
        solution_to_dataset(failed)


def test_nothing_is_written_halfway(dry, tmp_path, monkeypatch):
    path = tmp_path / "file.nc"
    path.write_text("before")
    dataset = solution_to_dataset(dry)
    monkeypatch.setattr(os, "replace", lambda *names: (_ for _ in ()).throw(OSError("disk full")))
    with pytest.raises(OSError, match="disk full"):
        write_netcdf(dataset, path)
    with pytest.raises(ValueError, match="cannot serialize"):
        write_netcdf(dataset.assign(bad=("x", [object()])), path)
    assert [file.name for file in tmp_path.iterdir()] == ["file.nc"]
    assert path.read_text() == "before"


@pytest.mark.parametrize("place", ["missing/file.nc", "", "/dev/null", "file.txt/file.nc"])
def test_places_that_cannot_be_written(dry, tmp_path, place):
    (tmp_path / "file.txt").write_text("")
    with pytest.raises(OSError, match=r".+") as refused:
        write_netcdf(solution_to_dataset(dry), tmp_path / place)
    assert refused.value.filename == str(tmp_path / place)
    assert [file.name for file in tmp_path.iterdir()] == ["file.txt"]


def test_an_existing_file_keeps_its_mode_and_a_link_stays_one(dry, tmp_path):
    file, link = tmp_path / "file.nc", tmp_path / "link.nc"
    file.write_text("before")
    file.chmod(0o640)
    link.symlink_to(file)
    write_netcdf(solution_to_dataset(dry), link)
    assert link.is_symlink()
    assert file.stat().st_mode & 0o777 == 0o640
    assert file.stat().st_size > 1000


@pytest.mark.parametrize("unit", ["1", "m", "m^3/s", "N m", "rad/s", "1/s", "W/m/K", "kg/m^3", "percent", "N/m^(10/9)"])
def test_units_there_and_back(unit):
    assert label_unit(udunits(unit)) == unit

"""NetCDF files on a disk that fills up: an error, where HDF5 by itself crashes the process, at once or when it ends."""

import subprocess
import sys

import numpy as np
import pytest
import xarray as xr
from full_places import limited

from jaxbearing.report.backends.netcdf import NetcdfStream, netcdf_image

SLOW = pytest.mark.slow
DATA = xr.Dataset({"a": ("x", np.arange(5_000.0), {"units": "m"}), "b": ("word", ["one", "other"])})
MORE = xr.Dataset({f"c{i}": ("x", np.full(5_000, float(i))) for i in range(3)})
_IN_A_PROCESS = """
import sys
from pathlib import Path
from full_places import limited
from test_netcdf import DATA, MORE
from jaxbearing.report.backends.netcdf import NetcdfStream
try:
    with limited(int(sys.argv[2])), NetcdfStream(Path(sys.argv[1])) as stream:
        stream.add(DATA)
        stream.add(MORE)
except OSError as error:
    print(error.errno)
"""


@pytest.mark.parametrize("limit", [0, pytest.param(100, marks=SLOW), 45_000, pytest.param(100_000, marks=SLOW)])
def test_a_limit_at_any_place_is_an_error(limit, tmp_path):
    """At once, in the middle of the first or of the second data set; both the writing and the end of the process."""
    command = [sys.executable, "-B", "-c", _IN_A_PROCESS, str(tmp_path / "a.nc"), str(limit)]
    paths = {"PYTHONPATH": ":".join(filter(None, sys.path)) + f":{__file__.rpartition('/')[0]}"}
    done = subprocess.run(command, capture_output=True, text=True, env=paths, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "27\n", "")


def test_a_stream_holds_what_was_added(tmp_path):
    with NetcdfStream(tmp_path / "a.nc") as stream:
        stream.add(DATA)
        stream.add(MORE)
    with xr.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as found:
        xr.testing.assert_identical(found.load(), xr.merge([DATA, MORE]))


def test_an_image_has_its_groups_and_checksums(tmp_path):
    (tmp_path / "a.nc").write_bytes(netcdf_image({"/": DATA, "/more": MORE}))
    with xr.open_datatree(tmp_path / "a.nc", engine="h5netcdf") as tree:
        xr.testing.assert_identical(tree.to_dataset().load(), DATA)
        xr.testing.assert_identical(tree["more"].to_dataset(inherit=False).load(), MORE)
        assert tree["a"].encoding["fletcher32"]


def test_the_limit_of_these_tests_limits(tmp_path):
    with pytest.raises(OSError, match="File too large"), limited(10):
        (tmp_path / "a").write_bytes(bytes(11))

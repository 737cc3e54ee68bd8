"""NetCDF-4 files, written so that a full disk does not crash the process.

HDF5 does not survive a failed write: it tries again when the file is closed and when the process ends, and crashes.
Files are therefore built in memory (`netcdf_image`) or, if they may be larger than memory, through a file object whose
writes never fail (`NetcdfStream`).
"""

import io
import os
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import h5netcdf
import xarray as xr
from xarray.backends import H5NetCDFStore


def netcdf_image(groups: Mapping[str, xr.Dataset]) -> memoryview:
    """The bytes of a NetCDF-4 file with checksums, so that reading damaged arrays raises an error.

    **Arguments:** `groups`: path of a group -> its data set; "/" is the root.
    """
    buffer = io.BytesIO()
    with h5netcdf.File(buffer, "w") as file:
        for path, dataset in groups.items():
            _dump(_checked(dataset), file, path)
    return buffer.getbuffer()


def _checked(dataset: xr.Dataset) -> xr.Dataset:
    checked = dataset.copy()
    for variable in checked.variables.values():
        if variable.ndim and variable.size and variable.dtype.kind in "fiu":
            variable.encoding["fletcher32"] = True
    return checked


def _dump(dataset: xr.Dataset, file: Any, group: str) -> None:
    # xarray's own `to_netcdf` does not accept a file object that stays open
    store = H5NetCDFStore(file, group=None if group == "/" else group, mode="a")
    dataset.dump_to_store(store)


class NetcdfStream:
    """A NetCDF-4 file on disk to which data sets are added one by one; to be used in a `with` block.

    **Raises:** `OSError` from `add`, or at the end of the block, if the disk did not store everything that was written.
    """

    def __init__(self, path: Path):
        self._target = _TakesAll(path)
        self._file: Any = h5netcdf.File(self._target, "w")

    def __enter__(self) -> Self:
        return self

    def add(self, dataset: xr.Dataset) -> None:
        """Adds variables to the root group and sets its attributes."""
        _dump(dataset, self._file, "/")
        self._file.flush()
        self._target.raise_if_failed()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            self._file.close()
        finally:
            self._target.close()
        if error is None:
            self._target.raise_if_failed()


class _TakesAll(io.RawIOBase):
    """A file for HDF5 whose writes never fail. After the first failure, further data stay in memory and the error is
    kept; the writer has to call `raise_if_failed` after each piece."""

    def __init__(self, path: Path):
        self._descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_TRUNC, 0o666)
        self._position, self._size = 0, 0
        self._failed: OSError | None = None
        self._kept: list[tuple[int, bytes]] = []

    def raise_if_failed(self) -> None:
        if self._failed is not None:
            raise self._failed

    def readable(self) -> bool:
        return True

    def writable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        base = {io.SEEK_SET: 0, io.SEEK_CUR: self._position, io.SEEK_END: self._size}[whence]
        self._position = base + offset
        return self._position

    def tell(self) -> int:
        return self._position

    def write(self, data: Any) -> int:
        content = bytes(data)
        if self._failed is None:
            try:
                written = 0
                while written < len(content):
                    written += os.pwrite(self._descriptor, content[written:], self._position + written)
            except OSError as error:
                self._failed = error
        if self._failed is not None:
            self._kept.append((self._position, content))
        self._position += len(content)
        self._size = max(self._size, self._position)
        return len(content)

    def readinto(self, buffer: Any) -> int:
        view = memoryview(buffer).cast("B")
        begin = self._position
        count = max(0, min(len(view), self._size - begin))
        stored = os.pread(self._descriptor, count, begin)
        view[: len(stored)] = stored
        view[len(stored) : count] = bytes(count - len(stored))
        for place, content in self._kept:
            first, last = max(place, begin), min(place + len(content), begin + count)
            if first < last:
                view[first - begin : last - begin] = content[first - place : last - place]
        self._position += count
        return count

    def truncate(self, size: int | None = None) -> int:
        self._size = self._position if size is None else size
        if self._failed is None:
            try:
                os.ftruncate(self._descriptor, self._size)
            except OSError as error:
                self._failed = error
        return self._size

    def close(self) -> None:
        if self.closed:
            return
        try:
            if self._failed is None:
                os.fsync(self._descriptor)
        except OSError as error:
            self._failed = error
        finally:
            os.close(self._descriptor)
            super().close()

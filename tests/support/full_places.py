"""Places in which a file cannot grow: a small file system that is full, and a limit of the process."""

import contextlib
import os
import resource
import signal
import subprocess

import pytest

from jaxbearing.report import files

KINDS = ("full disk", "limit")
REASONS = ("No space left on device", "File too large")


@contextlib.contextmanager
def small_folder(folder, size=16):
    """A file system of so many KiB; skips where the test may not mount one."""
    if not mounted(folder, size):
        pytest.skip("file systems cannot be mounted here")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def mounted(folder, size):
    """Whether a file system of so many KiB is there now."""
    folder.mkdir(exist_ok=True)
    mount = ["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", str(folder)]
    try:
        return subprocess.run(mount, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


@contextlib.contextmanager
def limited(size=0):
    """No file of this process may grow beyond a size, bytes."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)


@contextlib.contextmanager
def no_room(kind, folder, monkeypatch):
    """Inside the block files in this folder cannot be written, although the folder can. Where the test may not mount a
    file system, a limit stands for the full disk."""
    if kind == "full disk" and mounted(folder, 16):
        try:
            (folder / "filler").write_bytes(bytes(16_384))
            yield
        finally:
            subprocess.run(["umount", "-l", str(folder)], check=True)
        return
    whole = files.atomic_file

    @contextlib.contextmanager
    def atomic_file(path):
        with whole(path) as temporary, limited():
            yield temporary

    monkeypatch.setattr(files, "atomic_file", atomic_file)
    folder.mkdir(exist_ok=True)
    yield


def left(folder):
    """Names of what is in the folder beside the filler."""
    return sorted(set(os.listdir(folder)) - {"filler"})

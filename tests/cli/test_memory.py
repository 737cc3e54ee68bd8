"""Memory of long runs: what has been computed is on the disk and not in the process."""

import os
import subprocess
import sys

import pytest
from command_process import environment

CASES = ("sweep", "reference_roller", "--set", "contact=none", "--chunk", "64")
WARM_UP = ("simulate", "deep_groove_6205_mounted")


def peak(folder, *arguments):
    """Largest memory of a command, MB, whose programs are kept in the folder."""
    command = [sys.executable, "-m", "jaxbearing", *arguments]
    variables = environment(JAXBEARING_CACHE=str(folder / "cache"))
    with subprocess.Popen(command, cwd=folder, env=variables, stdout=subprocess.DEVNULL) as process:
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    return used.ru_maxrss / (1024.0 if sys.platform == "linux" else 1048576.0)


@pytest.mark.slow
def test_sixteen_times_the_cases_take_the_memory_of_few(tmp_path):
    """The first run compiles the program, which takes memory too, and keeps it for the others."""
    runs = (("compiled", 256), ("few", 256), ("many", 4096))
    over = {name: ("--over", f"operation.radial_load=1 kN:20 kN:{cases}") for name, cases in runs}
    memory = {name: peak(tmp_path, *CASES, *one, "--out", f"{name}.nc") for name, one in over.items()}
    assert memory["many"] < memory["few"] + 60.0


@pytest.mark.slow
def test_two_weeks_take_the_memory_of_two_hours(tmp_path):
    memory = [peak(tmp_path, *WARM_UP, "--duration", f"{hours} h", "--out", f"{hours}.nc") for hours in (2, 336)]
    assert memory[1] < memory[0] + 60.0

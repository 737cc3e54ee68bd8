"""`--within`: what has not begun in time is skipped and counted."""

import subprocess
import sys
from pathlib import Path

import pytest
from command_process import environment

TESTS = Path(__file__).parent


@pytest.mark.parametrize(("seconds", "said"), [("-1", "1 skipped"), ("1000", "1 passed")])
def test_tests_that_begin_too_late_are_skipped(seconds, said):
    """A test that has had less than no time is skipped; one that has a quarter of an hour runs."""
    one = f"{TESTS / 'test_readme.py'}::test_readme_is_short"
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--within", seconds, one]
    ran = subprocess.run(command, cwd=TESTS.parent, env=environment(), capture_output=True, text=True, timeout=300)
    assert ran.returncode == 0, ran.stdout
    assert said in ran.stdout
    assert ("not begun within -1 s" in ran.stdout) == (seconds == "-1")

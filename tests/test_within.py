"""`--within`: what has not begun in time is skipped and counted."""

from pathlib import Path

import pytest

TESTS = Path(__file__).parent


class Reports:
    """A plugin that keeps what became of each test."""

    def __init__(self):
        self.found = []

    def pytest_runtest_logreport(self, report):
        if report.when == "call" or report.skipped:
            self.found.append((report.outcome, str(report.longrepr or "")))


@pytest.mark.parametrize(("seconds", "outcome"), [("-1", "skipped"), ("1000", "passed")])
def test_tests_that_begin_too_late_are_skipped(seconds, outcome, tmp_path, request, capsys):
    """A test that has had less than no time is skipped before its fixtures; one that has a quarter of an hour runs."""
    file = tmp_path / "test_one.py"
    file.write_text(
        "import pytest\n\n@pytest.fixture\ndef made():\n    open('made', 'w').close()\n\ndef test_one(made): pass\n"
    )
    conftest = request.config.pluginmanager.getplugin(str(TESTS / "conftest.py"))
    # the rest of it is of a whole process
    hooks = {name: staticmethod(getattr(conftest, name)) for name in ("pytest_addoption", "pytest_runtest_setup")}
    options, reports = type("Options", (), hooks)(), Reports()
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path)
        arguments = ["-q", "-p", "no:cacheprovider", "--import-mode=importlib", f"--rootdir={tmp_path}"]
        code = pytest.main([*arguments, "-c", "/dev/null", "--within", seconds, str(file)], plugins=[options, reports])
    assert code == 0
    ((found, why),) = reports.found
    assert found == outcome
    assert ("not begun within -1 s" in why) == (seconds == "-1")
    assert (tmp_path / "made").exists() == (seconds == "1000")
    assert f"1 {outcome}" in capsys.readouterr().out

"""The report of all benchmarks: it is written whole, and what must hold on any machine holds; times are not looked at.

The whole report (17 to 20 minutes on two cores) is made where `tests/benchmarks` is named on the command line and no
marker:

    python -m pytest tests/benchmarks [--report-to FOLDER]
"""

import json
from pathlib import Path

import benchmark_report as report
import pytest
from section_shape import Section, Table

from jaxbearing.contacts import PRESETS


def made_up(name, quick, folder):
    if name == "broken":
        return {"failed": "ValueError: no such bearing"}
    table = Table("Rows:", ("name", "number"), (("a|b", 1.23456), (name, None)))
    section = Section("A title", f"quick: {quick}", (table,), {"answer": 42.0})
    shown = {"tables": [table._asdict()], "seconds": 2.0, "memory": 2**30, "devices": "1 x cpu"}
    return {"title": section.title, "text": section.text, "facts": section.facts, **shown}


def test_the_report_is_written_and_a_failed_section_is_said(tmp_path, capsys):
    found = report.write_report(["good", "broken", "other"], tmp_path, True, run=made_up)
    text = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert json.loads((tmp_path / "report.json").read_text(encoding="utf-8")) == json.loads(json.dumps(found))
    assert "| a\\|b | 1.23 |\n| good |  |\n" in text
    assert "| name | number |\n|---|---|\n" in text
    assert "## broken: FAILED\n\nValueError: no such bearing" in text
    assert text.count("## A title") == 2
    assert "- commit: " in text
    assert report.facts_of(found) == {"good: answer": 42.0, "other: answer": 42.0}
    assert "broken: FAILED" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("said", "line"),
    [
        (
            "Traceback:\n  f()\nValueError: no property 'a'\n\n    Valid:\n        b\n^^^^\n",
            "ValueError: no property 'a'",
        ),
        ("pkg.TooLongError: first\n\nDuring handling:\n\nKeyError: 'second'\n", "KeyError: 'second'"),
        ("  assert found\nAssertionError\n", "AssertionError"),
        ("killed\nout of memory\n", "out of memory"),
        ("", "it said nothing"),
    ],
)
def test_the_line_of_the_exception_is_said(said, line):
    assert report.error_line(said, "it said nothing") == line


@pytest.mark.slow
def test_a_section_runs_in_a_process_of_its_own(tmp_path):
    found = report.run_apart("public", True, tmp_path)
    assert "failed" not in found, found
    assert found["tables"][0]["rows"][0][0] == "closed ellipse"
    assert found["memory"] > 2**26
    assert "no_such_section" in report.run_apart("no_such_section", True, tmp_path)["failed"]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.report
def test_the_whole_report(request):
    names = report.section_names()
    assert set(report.FIRST) <= set(names)
    found = report.write_report(names, Path(request.config.getoption("--report-to")), False)
    assert [name for name, section in found["sections"].items() if "failed" in section] == []
    facts = report.facts_of(found)
    # what is left out would be looked at by none of the loops
    counted = ("roller", "ball", "scaling", "dynamics", "film", "sweep", "shaft")
    assert {name for name in facts if name.endswith(": failed")} == {f"{name}: failed" for name in counted}
    assert sum(name.endswith("reference off scipy's DOP853, um") for name in facts) == 1
    for name, value in facts.items():
        if name.endswith(": failed"):
            assert value == 0, name
    for accuracy in PRESETS:
        assert facts[f"traction: error at accuracy {accuracy:g}"] < accuracy
        assert facts[f"roller: error at accuracy {accuracy:g}"] < accuracy
        # spinning contacts are beyond what the accuracies promise
        assert facts[f"ball: error at accuracy {accuracy:g}"] < 10 * accuracy
    assert facts["traction: finest march off Radau"] < 1e-7
    assert all(value < 1e-3 for name, value in facts.items() if name.endswith("reference off scipy's DOP853, um"))
    assert facts["roller: power closure"] < 1e-10
    # where tamaas is installed
    assert all(value < 2e-3 for name, value in facts.items() if name.endswith("off by"))
    assert facts["roller: error of Newton"] < 1e-9
    assert facts["ball: error of the core"] < 1e-9
    assert facts["tapered: error with 30 laminae"] < 1e-6
    assert facts["shaft: error, four bearings"] < 1e-9
    assert facts["shaft: exponent over bearings"] < 1.2
    assert 1.8 < facts["film: order of the error"] < 2.2
    assert facts["film: mass balance"] < 1e-8
    assert facts["fit: noise-free recovery"] < 1e-6
    assert facts["fit: error of a march over its accuracy"] < 3
    assert facts["fit: largest loss over the least, ours"] < 1e-6
    assert facts["sweep: same bits on any number of devices"] == 1.0
    assert facts["sweep: largest error"] < 1e-9
    assert facts["first_answer: quick and optimised differ by"] < 1e-6
    assert facts["first_answer: processes that failed"] == 0
    # times, but of one machine over its own: growth, not speed
    for kind in ("lubricated roller bearing", "core of a ball bearing"):
        assert facts[f"scaling: exponent over elements, {kind}"] < 1.15
    assert facts["scaling: exponent over batches"] < 1.15
    assert facts["scaling: cost a lane over the best chunk"] < 1.5

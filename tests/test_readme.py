"""README and the pages that it leads to are true: their Python runs, their tables are what the commands give."""

import re
from pathlib import Path

import numpy as np
import pytest

import jaxbearing as jb
from fitting import Measurements, fit, read_curves
from jaxbearing.scenes.data_files import builtin_text

TOP = Path(__file__).parents[1]
README, USING, INSTALLING, FITTING, LAWS = (
    (TOP / name).read_text(encoding="utf-8")
    for name in ("README.md", "docs/using.md", "docs/installing.md", "docs/fitting.md", "docs/laws.md")
)
LONGEST = 700
"""Words of the README."""


def blocks(text, language):
    return re.findall(rf"```{language}\n(.*?)```", text, flags=re.DOTALL)


def test_python_blocks_run(capsys):
    for block in blocks(README, "python"):
        exec(compile(block, "README.md", "exec"), {})
    assert "1389" in capsys.readouterr().out


@pytest.mark.parametrize(
    "block",
    [
        # the first compiles solves, derivatives and batches of a lubricated bearing
        pytest.param(block, id=str(number), marks=() if number else pytest.mark.slow)
        for number, block in enumerate(blocks(USING, "python"))
    ],
)
def test_python_blocks_of_using_it_run(block, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # one writes a file
    exec(compile(block, "using.md", "exec"), {})
    assert capsys.readouterr().out


@pytest.mark.parametrize("block", blocks(LAWS, "python"), ids=range(len(blocks(LAWS, "python"))))
def test_laws_can_be_called_as_the_page_says(block, capsys):
    exec(compile(block, "laws.md", "exec"), {})
    assert "nan" not in capsys.readouterr().out


def test_readme_is_short():
    """What is more stands in docs/."""
    assert len(README.split()) <= LONGEST


def test_power_loss_table_is_ours():
    losses = jb.solve(jb.load_scene("turbine_roller")).power_loss
    rows = re.findall(r"^\| \**(\w+)\** \| \**([\d.]+)\** \|", README, flags=re.MULTILINE)
    printed = {name: float(value) for name, value in rows if hasattr(losses, name)}
    modelled = {name for name, value in vars(losses).items() if value is not None}
    assert set(printed) == modelled
    for name, value in printed.items():
        assert float(getattr(losses, name)) == pytest.approx(value, abs=0.051)  # printed to 0.1 W
    high = jb.solve(jb.load_scene("turbine_roller", {"drag.coefficient": "1.2"})).power_loss.total
    assert f"{float(high):.0f} W" in README


@pytest.mark.slow
def test_rolling_resistance_adds_what_is_said():
    rolling = jb.load_scene("turbine_roller", {"contact.rolling_resistance": "true"})
    assert all(f"{float(jb.solve(rolling).power_loss.total):.0f} W" in page for page in (README, INSTALLING))


def test_oil_table_is_a_scene(tmp_path):
    """The oil of the page in a scene without traction, which would need a rheology."""
    (block,) = (one for one in blocks(USING, "toml") if "two_viscosities" in one)
    text = builtin_text("turbine_roller").replace("[oil]", "[unused]")
    head = text[: text.index("[unused]")]
    rest = re.sub(r"(?m)^traction", "# traction", text[text.index("[contact]") :])
    file = tmp_path / "scene.toml"
    file.write_text(head + block + rest, encoding="utf-8")
    scene = jb.load_scene(str(file))
    assert any("estimated" in note for note in scene.assumptions())
    nu = float(scene.oil.viscosity.viscosity(0.0, 313.15)) / 870.0
    assert nu == pytest.approx(68e-6, rel=1e-12)


@pytest.fixture
def curve(tmp_path):
    """The points of the page, and the scene that its command names."""
    (block,) = blocks(FITTING, "csv")
    file = tmp_path / "curves.csv"
    file.write_text(block, encoding="utf-8")
    ((name, path, value),) = re.findall(r"jaxbearing fit .*? --scene (\w+) --set ([\w.]+)=\"(.*?)\"", FITTING)
    scene = jb.load_scene(name, {path: value})
    return Measurements.of(read_curves(file), scene), scene


def test_curve_file_is_that_of_the_oil_of_the_scene(curve):
    """With errors of up to 2 %."""
    measured, scene = curve
    assert measured.slide_to_roll.tolist() == [0.001, 0.002, 0.005, 0.01, 0.02, 0.05]
    scene = scene.at_operation(
        slide_to_roll=np.asarray(measured.slide_to_roll), pressure=1.5e9, temperature=313.15, entrainment_speed=20.0
    )
    found = jb.solve(scene).traction_coefficient.ravel()
    np.testing.assert_allclose(found, measured.traction_coefficient, rtol=0.02)


@pytest.mark.slow
def test_curve_file_is_fitted(curve):
    """As all noise free curves are: tests/fitting/test_fit.py."""
    measured, scene = curve
    result = fit(measured, scene)
    assert result.converged
    assert result.fitted == ("shear_modulus", "stress")
    # the fit has nothing to remark on the values of the scene's own oil
    assert not [note for note in result.notes if "not that of an oil" in note or "stands for something else" in note]
    for name in result.fitted:
        assert float(getattr(result.oil.rheology, name)) == pytest.approx(
            float(getattr(scene.oil.rheology, name)), rel=0.1
        )


def test_commands_are_one_line_each():
    lines = [line for line in README.splitlines() if line.startswith("python3 -m venv")]
    assert len(lines) == 2
    assert lines[0].endswith("jaxbearing solve turbine_roller")
    assert "-m pytest" in lines[1]

"""The README is true: its Python runs, its table is what the main job gives, its commands are there."""

import re
from pathlib import Path

import pytest

import jaxbearing as jb

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")


def test_python_blocks_run(capsys):
    blocks = re.findall(r"```python\n(.*?)```", README, flags=re.DOTALL)
    assert blocks
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})
    assert "1384" in capsys.readouterr().out


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


def test_commands_are_one_line_each():
    lines = [line for line in README.splitlines() if line.startswith("python3 -m venv")]
    assert len(lines) == 2
    assert lines[0].endswith("jaxbearing solve turbine_roller")
    assert "-m pytest" in lines[1]

"""What docs/life.md shows, as a reader has it."""

import contextlib
import io
import re
import tempfile
from pathlib import Path

import jaxbearing as jb

PAGE = (Path(__file__).parents[2] / "docs" / "life.md").read_text(encoding="utf-8")
(PAGE_SCENE,) = re.findall(r"```toml\n(.*?)```", PAGE, flags=re.DOTALL)


def page_scene(changes=None):
    """The scene file of the page, with other values."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "misaligned.toml"
        file.write_text(PAGE_SCENE, encoding="utf-8")
        return jb.load_scene(str(file), changes or {})


def optimisation_example():
    """Names and printed lines: a profile optimised for life under misalignment."""
    (block,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    names, printed = {}, io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block, "life.md", "exec"), names)
    return names, printed.getvalue()

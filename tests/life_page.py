"""The Python of docs/life.md, as a reader runs it."""

import contextlib
import io
import re
from pathlib import Path

PAGE = (Path(__file__).parents[1] / "docs" / "life.md").read_text(encoding="utf-8")


def optimisation_example():
    """Names and printed lines: a profile optimised for life under misalignment."""
    (block,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    names, printed = {}, io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block, "life.md", "exec"), names)
    return names, printed.getvalue()

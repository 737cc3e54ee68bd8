"""A docstring says what something is or does: none begins as half a sentence does."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HALF = {"Of", "What", "Whether", "Where", "How", "Those", "That", "As", "To"}


def docstrings(path):
    """Line and text of the docstrings of a module, of its classes and functions, and of the constants in it."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        # the body of a lambda is an expression
        for one in node.body if isinstance(getattr(node, "body", None), list) else []:
            text = one.value.value if isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant) else None
            if isinstance(text, str):
                yield one.lineno, text.strip()


@pytest.mark.parametrize("package", ["jaxbearing", "fitting"])
def test_no_docstring_begins_as_half_a_sentence(package):
    modules = sorted((ROOT / package).rglob("*.py"))
    assert modules
    found = [
        f"{path.relative_to(ROOT)}:{line}: {text[:60]}"
        for path in modules
        for line, text in docstrings(path)
        if text.split(" ")[0].strip(",.:") in HALF
    ]
    assert not found

"""The page of public names: `python docs/generate/name_pages.py` writes it."""

import ast
import importlib
import inspect
from pathlib import Path

import jaxbearing

FILE = Path(__file__).parents[1] / "names.md"
HEAD = """# Public names

Everything that this page lists is public: `jb.solve`, `jb.thermal.solve_network`, or
`from jaxbearing.thermal import solve_network`. A public name that moves stays where it was for one release, with a
`DeprecationWarning` that says where it is now. Other names may change at any time. The pages of the API describe each
name; this page is made from the packages.
"""


def names_of(module):
    """Names that a module offers: its `__all__`, and what its source imports under its own name."""
    found = set(getattr(module, "__all__", ()))
    found |= set(getattr(module, "_LAZY", ()))
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if isinstance(node, ast.ImportFrom):
            found |= {one.name for one in node.names if one.asname == one.name}
    return sorted(name for name in found if not name.startswith("_"))


def public_names():
    """Public module -> its names."""
    modules = {"jaxbearing": jaxbearing}
    modules |= {f"jaxbearing.{name}": importlib.import_module(f"jaxbearing.{name}") for name in jaxbearing._MODULES}
    return {path: names_of(module) for path, module in modules.items()}


def page():
    """Markdown."""
    parts = [HEAD]
    for path, names in public_names().items():
        parts.append(f"## {path}\n\n" + ", ".join(f"`{name}`" for name in names) + "\n")
    return "\n".join(parts)


if __name__ == "__main__":
    FILE.write_text(page(), encoding="utf-8")

"""What griffe cannot see of our docstrings: arguments that are written below a class, `Law.__init__.__doc__ = ...`."""

import ast

import griffe


def init_docstrings(tree):
    """Class name -> text assigned to the docstring of its `__init__`, in a module."""
    found = {}
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant):
            name = ast.unparse(node.targets[0])
            if name.endswith(".__init__.__doc__"):
                found[name.partition(".")[0]] = node.value.value
    return found


class InitDocstrings(griffe.Extension):
    def on_module_members(self, *, node, mod, agent, **kwargs):
        if not isinstance(node, ast.Module):
            return
        for name, text in init_docstrings(node).items():
            one = mod.members.get(name)
            if isinstance(one, griffe.Class):
                above = one.docstring.value if one.docstring else ""
                one.docstring = griffe.Docstring(f"{above}\n\n{text.strip()}", parent=one)

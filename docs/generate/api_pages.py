"""One page of the API a package, made of the docstrings of its public modules."""

PACKAGES = ("jaxbearing", "fitting")
LEFT_OUT = {"cli"}
"""What is not called from Python."""


def packages(top):
    """Folders of the public packages, the outer before the inner."""
    for name in PACKAGES:
        for init in sorted((top / name).rglob("__init__.py")):
            folder = init.parent.relative_to(top)
            if not LEFT_OUT & set(folder.parts):
                yield folder


def modules(top, folder):
    """Dotted names of the public modules of a package, without those of its subpackages."""
    package = ".".join(folder.parts)
    found = (path.stem for path in sorted((top / folder).glob("*.py")))
    return [package, *(f"{package}.{name}" for name in found if not name.startswith("_"))]


def pages(top):
    """Path on the site -> Markdown."""
    made = {}
    for folder in packages(top):
        names = modules(top, folder)
        blocks = [f"::: {name}\n{_OPTIONS[name == names[0]]}" for name in names]
        made[f"api/{names[0]}.md"] = f"# {names[0]}\n\n" + "\n".join(blocks)
    return made


_OPTIONS = {
    # a package: what it is; its names are documented where they are defined
    True: "    options:\n      members: false\n      show_root_heading: false\n",
    False: "",
}

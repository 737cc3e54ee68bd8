"""The data files that ship inside the package: built-in scenes, oils, grades of standard oils. Names are file names
without ".toml"."""

import functools
from importlib import resources
from importlib.resources.abc import Traversable

_FIRST = "turbine_roller"


@functools.cache
def builtin_names() -> tuple[str, ...]:
    """Names of the built-in scenes; the first is recommended for beginners."""
    return tuple(sorted(_names(_scenes()), key=lambda name: (name != _FIRST, name)))


def builtin_text(name: str) -> str:
    """Text of a built-in scene, as `jaxbearing scenes --copy` writes it.

    **Raises:** `KeyError` for a name that is not in `builtin_names()`.
    """
    return _text(_scenes(), name, builtin_names())


def builtin_summary(name: str) -> str:
    """First comment line of a built-in scene, up to its last whole sentence."""
    line = builtin_text(name).splitlines()[0].lstrip("# ").rstrip()
    return line if line.endswith(".") or ". " not in line else line[: line.rindex(". ") + 1]


@functools.cache
def oil_names() -> tuple[str, ...]:
    """Names of the oils of the catalogue."""
    return _names(_oils())


def oil_named(value: object) -> str | None:
    """Catalogue name of an oil that a person may write as "FVA3" or "Mobil Jet II"; `None` if there is no such oil."""
    name = value.strip().lower().replace(" ", "_").replace("-", "_") if isinstance(value, str) else ""
    return name if name in oil_names() else None


def oil_text(name: str) -> str:
    """Text of the data file of an oil.

    **Raises:** `KeyError` for a name that is not in `oil_names()`.
    """
    return _text(_oils(), name, oil_names())


def grades_text() -> str:
    """Text of the data file of the standard oils."""
    return (_lubricants() / "grades.toml").read_text(encoding="utf-8")


def _scenes() -> Traversable:
    return resources.files("jaxbearing.scenes") / "builtin"


def _oils() -> Traversable:
    return _lubricants() / "oils"


def _lubricants() -> Traversable:
    # `files("jaxbearing.lubricants")` would import that package, and with it JAX
    return resources.files("jaxbearing") / "lubricants"


def _names(folder: Traversable) -> tuple[str, ...]:
    files = (entry.name for entry in folder.iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in files if name.endswith(".toml")))


def _text(folder: Traversable, name: str, names: tuple[str, ...]) -> str:
    if name not in names:
        raise KeyError(name)
    return (folder / f"{name}.toml").read_text(encoding="utf-8")

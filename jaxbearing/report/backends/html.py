"""The content of a report as one HTML page that needs no network."""

import dataclasses
import platform
from collections.abc import Mapping, Sequence
from datetime import datetime
from importlib.metadata import version
from typing import Any

from ..._checks import Information
from ..._version import __version__
from ..display import typeset
from ..page_content import Content
from ..panels import Bars, Curves, Numbers, Panel, Polar
from .plotly import chart_of, library
from .svg import diagram_markup

_OF_PACKAGES = ("jax", "jaxlib", "plotly")


def page(
    content: Content, title: str, inputs: Mapping[str, Sequence[Any]], results: Mapping[str, object], when: datetime
) -> str:
    """The whole page as HTML.

    **Arguments:**
    - `title`: name of the scene.
    - `inputs`: fields of the scene by table, as `scenes.inputs.scene_inputs` gives them.
    - `results`: all results, ready for `json.dumps`.
    - `when`: date printed on the page.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape
    from markupsafe import Markup

    # warnings that need action come before mere information
    ordered = sorted(content.checks, key=lambda check: isinstance(check[0], Information))
    loader = PackageLoader("jaxbearing.report.backends", "templates")
    escaped = select_autoescape(default=True, default_for_string=True)
    environment = Environment(
        loader=loader, autoescape=escaped, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters["typeset"] = typeset
    return environment.get_template("report.html").render(
        title=title,
        page=dataclasses.replace(content, checks=ordered),
        inputs=inputs,
        results=results,
        sketches=[(sketch.title, Markup(sketch.markup), sketch.caption) for sketch in content.sketches],
        diagrams=[(diagram.title, Markup(diagram_markup(diagram)), diagram.caption) for diagram in content.diagrams],
        panels=[_panel(panel) for panel in content.charts],
        library=Markup(library()) if any(isinstance(panel, Polar | Curves) for panel in content.charts) else "",
        versions=versions(),
        when=when.strftime("%Y-%m-%d %H:%M %Z").strip(),
    )


def _panel(panel: Panel) -> tuple[str, object]:
    """Kind of a panel on the page and the object shown: bars and numbers become tables, curves become charts."""
    match panel:
        case Bars():
            return "bars", panel
        case Numbers():
            return "numbers", panel
        case _:
            return "chart", chart_of(panel)


def versions() -> dict[str, str]:
    """Versions of the packages and the system on which the results depend."""
    packages = {"jaxbearing": __version__} | {name: version(name) for name in _OF_PACKAGES}
    return packages | {"Python": platform.python_version(), "system": f"{platform.system()} {platform.machine()}"}

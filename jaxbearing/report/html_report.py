"""A solve as one HTML page that needs no network: drawing, tables, charts, notes, versions."""

import functools
import platform
from collections.abc import Mapping, Sequence
from datetime import datetime
from importlib.metadata import version
from typing import Any

from .. import __version__
from ..bearings.solution import Solution
from ..ehl import LineContactSolution
from ..machines import TwoDiskSolution
from ..scenes.inputs import SceneInput
from .bearing.page_content import bearing_content
from .charts import library
from .json_report import solution_to_dict
from .line_contact.page_content import line_contact_content
from .page_content import Content
from .sheet import typeset
from .two_disk.page_content import two_disk_content

_OF_PACKAGES = ("jax", "jaxlib", "plotly")


@functools.singledispatch
def _content(solution: Any, scene: Any) -> Content:
    raise TypeError(f"no report of a {type(solution).__name__}")


_content.register(Solution, lambda solution, scene: bearing_content(scene, solution))
_content.register(LineContactSolution, lambda solution, scene: line_contact_content(solution))
_content.register(TwoDiskSolution, lambda solution, scene: two_disk_content(solution))


def html_report(
    scene: Any, solution: Any, title: str, inputs: Mapping[str, Sequence[SceneInput]], when: datetime
) -> str:
    """The page of one solve, with all results as JSON in it.

    **Arguments:**
    - `scene`, `solution`: what was solved, and one solution of it that converged.
    - `title`: name of the scene.
    - `inputs`: fields of the scene by table, of `scenes.inputs.scene_inputs`.
    - `when`: the date that the page bears.

    **Raises:** `ValueError` for a solution that did not converge: it has no results; `TypeError` for another kind of
    solution.
    """
    if not bool(solution.converged):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape
    from markupsafe import Markup

    content = _content(solution, scene)
    loader = PackageLoader("jaxbearing.report", "templates")
    escaped = select_autoescape(default=True, default_for_string=True)
    environment = Environment(
        loader=loader, autoescape=escaped, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters["typeset"] = typeset
    return environment.get_template("report.html").render(
        title=title,
        page=content,
        inputs=inputs,
        results=solution_to_dict(solution),
        sketches=[(one.title, Markup(one.markup), one.caption) for one in content.sketches],
        charts=[(chart, chart.data()) for chart in content.charts],
        library=Markup(library()) if content.charts else "",
        versions=versions(),
        when=when.strftime("%Y-%m-%d %H:%M %Z").strip(),
    )


def versions() -> dict[str, str]:
    """Versions of everything that the results depend on."""
    found = {"jaxbearing": __version__} | {name: version(name) for name in _OF_PACKAGES}
    return found | {"Python": platform.python_version(), "system": f"{platform.system()} {platform.machine()}"}

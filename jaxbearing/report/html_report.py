"""A solve as one HTML page that needs no network: drawing, tables, charts, notes, versions."""

import dataclasses
from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any

from ..loss_interval import PowerInterval
from ..makers import Catalogue, compared
from ..scenes.inputs import SceneInput
from .backends.html import page
from .interval_listing import interval_headline, interval_listing
from .json_report import solution_to_dict
from .makers_table import comparison_listing
from .page_content import Listing
from .registry import check_converged, output
from .round_off import without_round_off


def html_report(
    scene: Any,
    solution: Any,
    title: str,
    inputs: Mapping[str, Sequence[SceneInput]],
    when: datetime,
    catalogue: Catalogue | None = None,
    listings: Sequence[Listing] = (),
    interval: PowerInterval | None = None,
) -> str:
    """The HTML page of one solve, with all results embedded as JSON.

    **Arguments:**
    - `scene`, `solution`: the scene, and one converged solution of it.
    - `title`: name of the scene.
    - `inputs`: fields of the scene by table, as `scenes.inputs.scene_inputs` gives them.
    - `when`: date printed on the page.
    - `catalogue`: catalogue data of a bearing; if given, makers' formulas are compared with its losses, as far as one
      of them gives a total.
    - `listings`: further tables, shown before the makers' formulas.
    - `interval`: interval of the power loss due to the inputs given by a distribution; not shown if `None`.

    **Raises:** `ValueError` for a solution that did not converge and so has no results; `TypeError` for another kind of
    solution.
    """
    content = output(solution, "page_content", "report")
    check_converged(solution)
    shown = content(scene, without_round_off(solution))
    if interval is not None:
        first, *others = shown.headlines
        shown = dataclasses.replace(
            shown,
            headlines=[first, interval_headline(interval), *others],
            listings=(*shown.listings, interval_listing(interval)),
        )
    shown = dataclasses.replace(shown, listings=(*shown.listings, *listings))
    if catalogue is not None:
        beside = compared(scene, solution, catalogue)
        # for a scene without an oil the formulas give no total
        if any(law.total is not None for law in beside.laws):
            shown = dataclasses.replace(shown, listings=(*shown.listings, comparison_listing(beside)))
    return page(shown, title, inputs, solution_to_dict(solution), when)

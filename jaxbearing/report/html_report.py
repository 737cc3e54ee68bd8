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
    """The page of one solve, with all results as JSON in it.

    **Arguments:**
    - `scene`, `solution`: what was solved, and one solution of it that converged.
    - `title`: name of the scene.
    - `inputs`: fields of the scene by table, of `scenes.inputs.scene_inputs`.
    - `when`: the date that the page bears.
    - `catalogue`: of a bearing, with which makers' formulas stand beside its losses where one has a total; not given:
      they do not.
    - `listings`: further tables, which come before the makers' formulas.
    - `interval`: of the power loss, by the inputs that are known by a distribution only; `None`: it is not shown.

    **Raises:** `ValueError` for a solution that did not converge: it has no results; `TypeError` for another kind of
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
        # of a scene without an oil the formulas have no total
        if any(law.total is not None for law in beside.laws):
            shown = dataclasses.replace(shown, listings=(*shown.listings, comparison_listing(beside)))
    return page(shown, title, inputs, solution_to_dict(solution), when)

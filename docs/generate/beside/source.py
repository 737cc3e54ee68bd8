"""The source's own numbers and statements: shocks of Table 17 and the twelve claims, from the pages that keep them."""

import math

from .common import Comparison, Found, table_of_page

DRAGS = ("0.3", "0.6", "1.2")
"""Drag coefficients of the columns of the page on motion."""
YES, NO = "**yes**", "**no**"


def shocks() -> Found:
    """Front and rear loads over the one printed load: ratios of their geometric mean."""
    rows, factors = [], []
    for point, printed, *columns in table_of_page("cage_dynamics.md", "load, speed"):
        cells = [point, printed]
        for drag, pair in zip(DRAGS, columns, strict=True):
            front, rear = (float(one) for one in pair.split(" / "))
            factors.append((drag, math.sqrt(front * rear) / float(printed)))
            cells.append(f"{pair} ({factors[-1][1]:.2f})")
        rows.append(cells)
    least, largest = (end(factor for _, factor in factors) for end in (min, max))
    middle = [factor for drag, factor in factors if drag == "0.6"]
    said = (
        f"a factor of {least:.2f} to {largest:.1f}; at the drag coefficient 0.6: {min(middle):.2f} to {max(middle):.1f}"
    )
    headings = ["load, speed", "Table 17, N", *(f"drag {drag}: front / rear, N (mean over print)" for drag in DRAGS)]
    return Found(headings, rows, {}, said)


def claims() -> Found:
    """Verdicts on the twelve statements, for both scenes."""
    rows = [
        [number, statement, *("yes" if one.startswith(YES) else "no" for one in (reference, turbine))]
        for number, statement, _, reference, turbine, _ in table_of_page("claims.md", "", "")
    ]
    counts = [sum(row[place] == "yes" for row in rows) for place in (2, 3)]
    said = f"{counts[0]} of {len(rows)} hold for `reference_roller`, {counts[1]} for `turbine_roller`"
    return Found(["", "the source says", "`reference_roller`", "`turbine_roller`"], rows, {}, said)


COMPARISONS = (
    Comparison(
        name="shocks",
        quantity="shocks between rollers and cage",
        data="the source's Table 17, four points",
        free="nothing; three drag coefficients were tried",
        assumed="drag coefficient, laws of the pocket",
        believe=None,
        data_error=100.0,
        verdict="Believe the order of magnitude of a shock, a factor of ten, and not its trend with the load.",
        compute=shocks,
        dear=False,
    ),
    Comparison(
        name="claims",
        quantity="statements on the loss of a roller bearing",
        data="the source's section 4.2, twelve statements",
        free="nothing",
        assumed="drag coefficient 1.2 and 0.3",
        believe=None,
        data_error=100.0,
        verdict="Believe the trends with speed, oil flow, temperature and clearance; what hangs on the drag "
        "coefficient (slip, share of the lands) can come out either way.",
        compute=claims,
        dear=False,
    ),
)

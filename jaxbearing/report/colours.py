"""Colours of drawings, charts and pages. Every backend uses the same."""

INK, FAINT = "#222222", "#9A9A9A"
"""`INK`: texts and outlines. `FAINT`: axes, side notes and reference curves behind the results."""
GRID = "#E4E4E4"
CENTRE_LINE = "#8A8A8A"
RING, ROLLER, CAGE = "#CDD3DB", "#F6F7F9", "#E6CB8B"
"""Surfaces of the parts in the drawing of a bearing."""

# colours of Okabe and Ito, which people with colour blindness can tell apart
CURVES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", INK)
"""Colours of the curves of one chart, in this order."""
INNER, OUTER, RIB = CURVES[:3]
"""Results at the inner raceway, the outer raceway and the rib."""
INNER_SECOND, OUTER_SECOND = CURVES[4:6]
"""Results at the second flanks of the raceways, of rings with two groove arcs."""
LOSS = "#56789A"
"""Bars of power losses, and single curves of a transient run."""

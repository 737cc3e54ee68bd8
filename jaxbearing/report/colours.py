"""Colours of drawings, charts and pages, the same in every backend."""

INK, FAINT = "#222222", "#9A9A9A"
"""Texts and outlines; what stands behind the results."""
GRID = "#E4E4E4"
CENTRE_LINE = "#8A8A8A"
RING, ROLLER, CAGE = "#CDD3DB", "#F6F7F9", "#E6CB8B"
"""Surfaces in the drawing of a bearing."""

# Okabe and Ito's colours, which all kinds of colour vision tell apart
CURVES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", INK)
"""Curves of one chart, one after the other."""
INNER, OUTER, RIB = CURVES[:3]
"""What belongs to the inner race, the outer race, the rib."""
LOSS = "#56789A"

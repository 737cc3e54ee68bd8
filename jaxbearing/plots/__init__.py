"""Figures: one function each, with axes in engineer's units and a caption; `jb.plots`.

Each returns a matplotlib `Figure`, which a notebook shows by itself and `savefig` writes; with `axes=` it draws into
axes that are there, without the caption.
"""

from .losses import line_against as line_against
from .losses import power_loss_against as power_loss_against

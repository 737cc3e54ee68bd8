"""Standard bearings: from a designation, such as 6207 or NU 311, to dimensions and an estimated internal geometry."""

from .bearing import Bearing as Bearing
from .bearing import find as find
from .designation import Designation as Designation
from .designation import known_designations as known_designations
from .designation import parse as parse
from .geometry import Estimate as Estimate
from .geometry import Geometry as Geometry

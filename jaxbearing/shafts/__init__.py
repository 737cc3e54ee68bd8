"""Several bearings together: matched sets, and shafts on bearings."""

from .forces import Belt as Belt
from .forces import Gear as Gear
from .forces import Mass as Mass
from .forces import PointLoad as PointLoad
from .heat import ShaftThermal as ShaftThermal
from .heat import ShaftThermalResult as ShaftThermalResult
from .mounting import LinearBearing as LinearBearing
from .mounting import MatchedSet as MatchedSet
from .mounting import MountedBearing as MountedBearing
from .mounting import Preload as Preload
from .mounting import Support as Support
from .scene import ShaftState as ShaftState
from .scene import ShaftSystem as ShaftSystem
from .scene import SystemLife as SystemLife
from .shaft import Gravity as Gravity
from .shaft import Section as Section
from .shaft import Shaft as Shaft
from .solution import BearingOnShaft as BearingOnShaft
from .solution import DutyResult as DutyResult
from .solution import SetResult as SetResult
from .solution import ShaftNodes as ShaftNodes
from .solution import ShaftSolution as ShaftSolution
from .solution import SystemLifeResult as SystemLifeResult
from .solution import TorqueBalance as TorqueBalance

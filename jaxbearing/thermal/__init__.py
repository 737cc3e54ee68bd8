"""Temperatures of a bearing's parts: network, losses by node, conductances, reference speed, warm-up."""

from typing import TYPE_CHECKING

from .._forwarding import attributes_of
from .conductances import ContactHeat as ContactHeat
from .conductances import CylindricalHousing as CylindricalHousing
from .conductances import Solid as Solid
from .conductances import air_convection as air_convection
from .conductances import elements_surface as elements_surface
from .conductances import ellipse_contact_heat as ellipse_contact_heat
from .conductances import line_contact_heat as line_contact_heat
from .conductances import oil_capacity as oil_capacity
from .conductances import oil_filling_conductance as oil_filling_conductance
from .conductances import oil_heat_transfer as oil_heat_transfer
from .conductances import radiation as radiation
from .conductances import ring_capacity as ring_capacity
from .conductances import ring_surface as ring_surface
from .conductances import seat_conductance as seat_conductance
from .network import NODES as NODES
from .network import HeatFlows as HeatFlows
from .network import Network as Network
from .network import NodeHeat as NodeHeat
from .network import OilFlow as OilFlow
from .network import Slopes as Slopes
from .network import conductances_between as conductances_between
from .network import network_of as network_of
from .network import slopes_at as slopes_at
from .network import thermal_margin as thermal_margin
from .network import thermal_rate as thermal_rate
from .point import ThermalOptions as ThermalOptions
from .reference_speed import palmgren_torque as palmgren_torque
from .reference_speed import radial_seat_area as radial_seat_area
from .reference_speed import reference_conductance as reference_conductance
from .reference_speed import reference_heat_flow as reference_heat_flow
from .reference_speed import safe_speed as safe_speed
from .reference_speed import safe_speed_ratio as safe_speed_ratio
from .reference_speed import speed_of_heat as speed_of_heat
from .result import HeatPaths as HeatPaths
from .result import NodeTemperatures as NodeTemperatures
from .result import ThermalResult as ThermalResult
from .settings import Capacities as Capacities
from .settings import ConductanceFactors as ConductanceFactors
from .settings import Conductances as Conductances
from .settings import Shares as Shares
from .settings import Thermal as Thermal
from .shares import OilTemperatures as OilTemperatures
from .shares import loss_shares as loss_shares
from .shares import node_heat as node_heat
from .shares import oil_temperatures as oil_temperatures
from .solve import ThermalState as ThermalState
from .solve import solve_network as solve_network

if TYPE_CHECKING:
    from .warming_up import WarmUp as WarmUp
    from .warming_up import warm_up as warm_up

# the integrators of the warm-up are large, and few need them
_LAZY = {"WarmUp": "warming_up", "warm_up": "warming_up"}
__getattr__ = attributes_of(__name__, _LAZY)

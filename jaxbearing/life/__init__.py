"""Formulas of fatigue life (ISO 281, ISO 16281) and of the ratings that it needs.

The standards themselves were not at hand. Each formula states the evidence for its constants:
[T] they reproduce well-known values of the standard's tables, [D] they are derived here by computation, [C] they pass
a check of consistency, [M] they come from memory only.
"""

from .basic import basic_life as basic_life
from .basic import deep_groove_equivalent_load as deep_groove_equivalent_load
from .basic import tapered_equivalent_load as tapered_equivalent_load
from .capacity import ball_capacity as ball_capacity
from .capacity import roller_capacity as roller_capacity
from .duty import SpectrumLife as SpectrumLife
from .duty import mean_load as mean_load
from .duty import miner_rate as miner_rate
from .duty import revolution_shares as revolution_shares
from .duty import spectrum_life as spectrum_life
from .equivalent import ball_equivalent_load as ball_equivalent_load
from .equivalent import ball_static_load as ball_static_load
from .equivalent import roller_static_load as roller_static_load
from .modification import contamination_factor as contamination_factor
from .modification import fatigue_load_limit as fatigue_load_limit
from .modification import film_ratio as film_ratio
from .modification import modification_factor as modification_factor
from .modification import reference_viscosity as reference_viscosity
from .reference import ball_contact_capacities as ball_contact_capacities
from .reference import ball_damage_rate as ball_damage_rate
from .reference import edge_factors as edge_factors
from .reference import roller_contact_capacities as roller_contact_capacities
from .reference import roller_damage_rate as roller_damage_rate
from .result import Life as Life
from .static import ball_static_capacity as ball_static_capacity
from .static import contact_safety as contact_safety
from .static import roller_static_capacity as roller_static_capacity

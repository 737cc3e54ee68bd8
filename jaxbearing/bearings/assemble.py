"""Builds the `Solution` of any bearing from its solved equations."""

from typing import Any, Generic, NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Int

from .._checks import Information
from ..contacts.rolling_heating import rolling_words
from ..numerics.newton import NewtonResult
from .bearing import AbstractBearing
from .checks import input_excess, result_excess
from .facts import Facts
from .frequencies import textbook_frequencies
from .interactions import FrictionTotals
from .ring import Port
from .ring_deflection import InnerRingDeflection, RingDeflection
from .solution import (
    RING_FREEDOMS,
    BoundaryPower,
    CageState,
    Elements,
    FailureCause,
    LaminaLoads,
    Losses,
    RacewayPower,
    RingDisplacement,
    RollingByRace,
    Solution,
)
from .supplied import supply_result


class Results(NamedTuple, Generic[Elements, Losses]):
    """Results that a family computes. `totals` holds the losses and torques, and `facts` the quantities that the range
    checks need; all other fields have the names that they have in `Solution`. `assemble` sets the numbers to NaN if the
    solve failed."""

    elements: Elements
    totals: FrictionTotals[Losses]
    facts: Facts
    cage: CageState | None = None
    raceway_power: RacewayPower | None = None
    laminae: LaminaLoads | None = None
    boundary_power: BoundaryPower | None = None
    outer_ring: RingDeflection | None = None
    inner_ring: InnerRingDeflection | None = None


def assemble(
    scene: AbstractBearing,
    result: NewtonResult,
    results: Results[Elements, Losses],
    ring: RingDisplacement,
    port: Port,
    iterations: Int[Array, ""] | None = None,
    failure_causes: dict[str, FailureCause] | None = None,
    **names: Any,
) -> Solution:
    """Builds the `Solution` from the solved equations. If the solve failed, every result is NaN and no check of results
    applies. The operating point, the checks of inputs, the notes, and the data on how the solve ended remain.

    **Arguments:**
    - `scene`: the bearing; `result`: result of Newton's iteration; `results`: results that the family computed.
    - `ring`: displacement of the inner ring to be shown in the results.
    - `port`: load and stiffness of the ring in all five degrees of freedom, and the names of the degrees of freedom
      that were unknowns.
    - `iterations`: number of steps of all solves that this bearing needed; by default that of `result`.
    - `failure_causes`: possible causes of a failed solve (`Solution.failure_causes`).
    - `names`: further fields of the `Solution`: always `ring_freedom` and `equation_names`, and `stiffness_freedom` if
      it differs from `ring_freedom`.
    """
    good, nan = result.converged, jnp.asarray(jnp.nan)
    # the ring is held if no degree of freedom was an unknown; `held_freedom` lists the modelled ones that were not
    held = not port.free
    modelled = names.get("stiffness_freedom") or names["ring_freedom"]
    names["held_freedom"] = tuple(name for name in RING_FREEDOMS if name in modelled and name not in port.free)
    own = results._asdict()
    facts, totals = own.pop("facts"), own.pop("totals")
    # the first contacts are those of the raceways, and the supply is that of their oil
    own["supply"] = supply_result(scene, facts.contacts[0].load, facts.contacts[0].starved)
    shown = own | totals._asdict() | {"ring": ring, "force": port.force, "stiffness": port.stiffness}
    by_race = totals.rolling_by_race
    if by_race is not None:
        shown["rolling_by_race"] = RollingByRace(by_race[0], by_race[1], rolling_words(scene.contact))
    shown["textbook_frequencies"] = textbook_frequencies(scene)
    checks = {text: value > 0 for text, value in input_excess(scene, held).items()}
    checks |= {
        text: good & (value > 0) for text, value in result_excess(scene, facts, ring, results.cage, held).items()
    }
    notes = scene.assumptions()
    if scene.unused_parts():
        unused = ", ".join(scene.unused_parts())
        text = Information(f"without {scene.required_part} these tables have no effect: {unused}")
        notes = (*notes, text)
    return Solution(
        status=result.status,
        iterations=result.iterations if iterations is None else iterations,
        residual_norm=result.residual_norm,
        inner_residual=result.inner_residual,
        worst_equation=result.worst_equation,
        worst_element=result.worst_element,
        operation=scene.operation,
        checks=checks,
        global_equations=result.point.globals.shape[0],
        unknowns=result.point.elements.size + result.point.globals.size,
        notes=notes,
        element_name=scene.element,
        failure_causes={
            text: FailureCause(~good & cause.applies, cause.numbers) for text, cause in (failure_causes or {}).items()
        },
        **jax.tree.map(lambda leaf: jnp.where(good, leaf, nan), shown),
        **names,
    )

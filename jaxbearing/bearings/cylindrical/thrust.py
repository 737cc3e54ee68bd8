r"""Flanges that hold the inner ring of a cylindrical roller bearing along its axis.

The force is $F = \pm k(|x| - g)_+^{10/9}$, with the axial displacement x of the inner ring from the middle of its play
and the gap g of a flange. The user gives the stiffness k, because the geometry of the flanges is not modelled. The
axial degree of freedom is not coupled with the others: force and displacement follow from each other in closed form,
after the solve.
"""

import dataclasses
from typing import TYPE_CHECKING

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.checks import demand, numbers_or_none
from ...numerics.safe import positive_power, power
from ..operation import Operation
from ..ring import InnerRing
from ..solution import RING_FREEDOMS, Solution

if TYPE_CHECKING:
    from .geometry import RollerGeometry

EXPONENT = 10.0 / 9.0
"""Exponent of the displacement in the force of a flange, as in a line contact."""
SIDES = {"both": (1.0, -1.0), "+x": (1.0,), "-x": (-1.0,)}
"""Value of `geometry.thrust` -> signs of the axial loads that the flanges carry."""
NO_AXIAL_FREEDOM = (
    "a cylindrical roller bearing without geometry.flange_stiffness has no axial freedom: nothing holds its inner ring "
    "along the axis"
)
NOT_MODELLED = (
    "the flanges (geometry.flange_stiffness) hold the inner ring along the axis and do nothing else: rib geometry, "
    "friction of the ribs under the axial load, the tilt that it gives the rollers and its effect on the life are not "
    "modelled; without an axial load the ring stands at 0, inside its play"
)
"""Note in the solution of a bearing with flanges."""


class ThrustFlanges(eqx.Module):
    """Flanges that hold the inner ring along its axis (see the module).

    **Arguments:**
    - `stiffness`: k, N/m^(10/9).
    - `gap`: axial displacement, from the middle of the play, at which the ring touches a flange, m.
    - `sides`: signs of the axial loads that the flanges carry.
    """

    stiffness: Float[Array, ""]
    gap: Float[Array, ""]
    sides: tuple[float, ...] = eqx.field(static=True)

    def force(self, displacement: Array) -> Array:
        """Axial load that holds the ring at a displacement, N.

        It is differentiable everywhere; its derivative inside the play is 0. The second derivative is unbounded where
        the ring begins to touch a flange; exactly there, this function has the second derivative 0.
        """
        pressed = [side * positive_power(side * displacement - self.gap, EXPONENT) for side in self.sides]
        return self.stiffness * sum(pressed)

    def under(self, load: Array) -> tuple[Array, Array]:
        """Displacement, m, and stiffness, N/m, under an axial load, N, towards a flange.

        Without load the ring may stand anywhere in its play; the result is then displacement 0 and stiffness 0. The
        derivatives of both with respect to the load are unbounded as the load approaches 0, and are set to 0 at load 0.
        """
        loaded = load != 0
        size = jnp.abs(jnp.where(loaded, load, 1.0))
        pressed = power(size / self.stiffness, 1.0 / EXPONENT)
        displacement = jnp.where(loaded, jnp.sign(load) * (self.gap + pressed), 0.0)
        return displacement, jnp.where(loaded, EXPONENT * size / pressed, 0.0)

    def hold(self, solution: Solution, operation: Operation, ring: InnerRing | None) -> Solution:
        """Adds the axial force, displacement and stiffness to a solution.

        **Arguments:** `ring`: the held ring that was used instead of the ring at the operating point, or `None`.
        """
        held = operation.held_at("axial") if ring is None else ring.held[0]
        load, place = operation.load("axial"), solution.ring.axial
        if held is None:
            load = jnp.zeros(()) if load is None else jnp.asarray(load)
            place, stiffness = self.under(load)
        else:
            load, stiffness = jax.value_and_grad(self.force)(jnp.asarray(held))
        load, place, stiffness = (jnp.where(solution.converged, value, jnp.nan) for value in (load, place, stiffness))
        named = lambda names: tuple(name for name in RING_FREEDOMS if name == "axial" or name in names)
        holds, stiff = solution.held_freedom, solution.stiffness_freedom
        return dataclasses.replace(
            solution,
            ring=dataclasses.replace(solution.ring, axial=place),
            force=solution.force.at[0].set(load),
            stiffness=solution.stiffness.at[0, 0].set(stiffness),
            ring_freedom=named(solution.ring_freedom),
            stiffness_freedom=None if stiff is None else named(stiff),
            held_freedom=tuple(name for name in holds if name != "axial") if held is None else named(holds),
        )


def check_flanges(geometry: "RollerGeometry") -> None:
    """Checks that the flanges are fully described.

    **Raises:** `ValueError` if `flange_stiffness` is given without `flange_gap`, or other flange data without it.
    """
    if geometry.flange_stiffness is not None and geometry.flange_gap is None:
        raise ValueError(
            "geometry.flange_gap: found nothing, expected a length, which geometry.flange_stiffness needs, e.g. '50 um'"
        )
    for name in ("flange_gap", "thrust"):
        if geometry.flange_stiffness is None and getattr(geometry, name) is not None:
            raise ValueError(f"geometry.{name}: expected none without geometry.flange_stiffness")


def check_axial(geometry: "RollerGeometry", operation: Operation) -> None:
    """Checks that the flanges can carry the axial load.

    **Raises:** `ValueError` for an axial load or displacement without flanges, and for a known axial load that the
    only flange cannot carry because of its direction.
    """
    load = operation.load("axial")
    if geometry.flange_stiffness is None:
        for name, value in (("axial_load", load), ("displacement.axial", operation.held_at("axial"))):
            if value is not None:
                raise ValueError(f"operation.{name}: expected none: {NO_AXIAL_FREEDOM}")
    elif load is not None and numbers_or_none(load) is not None:
        sides = SIDES[geometry.thrust or "both"]
        word = "a force >= 0" if sides == (1.0,) else "a force <= 0"
        where = f"the flange carries no load the other way (geometry.thrust = '{geometry.thrust}')"
        if len(sides) == 1:
            demand(
                f"operation.axial_load must be {word}: {where}",
                sides[0] * load >= 0,
                lambda: f"operation.axial_load must be {word}, got {float(load):g} N: {where}",
            )

"""Turbulent film factors of a journal land: flow factor k_z and friction factor C_f."""

import abc

import equinox as eqx
import jax.numpy as jnp

from .._types import Batch, Values
from ..numerics.safe import smoothstep

FLOW_GAIN, FLOW_EXPONENT = 0.00430, 0.96
FRICTION_GAIN, FRICTION_EXPONENT = 0.0012, 0.94


def _regular_reynolds_power(reynolds: Values, exponent: float) -> Batch:
    """Smoothed power Re^m, (Re^2 + 1)^(m/2): 1 with slope 0 at Re = 0; relative error m/(2 Re^2)."""
    return (jnp.square(reynolds) + 1.0) ** (0.5 * exponent)


def _fully_turbulent_excess(reynolds: Values) -> tuple[Batch, Batch]:
    """Excess of the turbulent factors over the laminar ones, k_z - 12 and C_f - 1."""
    return (
        FLOW_GAIN * _regular_reynolds_power(reynolds, FLOW_EXPONENT),
        FRICTION_GAIN * _regular_reynolds_power(reynolds, FRICTION_EXPONENT),
    )


class AbstractTurbulence(eqx.Module):
    """Effect of turbulence on a thin film: effective viscosity mu k_z/12 and friction factor C_f."""

    @abc.abstractmethod
    def factors(self, reynolds: Values, critical_reynolds: Values) -> tuple[Batch, Batch]:
        r"""Flow factor k_z (12 if laminar) and friction factor C_f (1 if laminar).

        **Arguments:**
        - `reynolds`: Re = rho R |relative speed| c / mu, >= 0.
        - `critical_reynolds`: onset of Taylor vortices, $41.2\sqrt{R/c}$, > 0.
        """


class Laminar(AbstractTurbulence):
    """Laminar film: k_z = 12, C_f = 1 at every Reynolds number; the land torque is monotone in the clearance."""

    def factors(self, reynolds: Values, critical_reynolds: Values) -> tuple[Batch, Batch]:
        zero = jnp.zeros_like(reynolds * critical_reynolds)
        return 12.0 + zero, 1.0 + zero


class FullTurbulence(AbstractTurbulence):
    r"""Turbulent factors at every Reynolds number (scene name "pure").

    $k_z = 12 + 0.00430\,Re^{0.96}$, $C_f = 1 + 0.0012\,Re^{0.94}$.

    **Limits:** smooth; at Re = 0 the factors are 12.0043 and 1.0012 (see `_regular_reynolds_power`).
    **Validity:** fitted above about 2 Re_c; below the onset of turbulence it overstates C_f (by 56 % at Re = 691).
    **Reference:** Constantinescu (1959, 1967), mean-film form; the constants are textbook values,
    not checked against the original paper.
    """

    def factors(self, reynolds: Values, critical_reynolds: Values) -> tuple[Batch, Batch]:
        flow, friction = _fully_turbulent_excess(reynolds)
        zero = jnp.zeros_like(reynolds * critical_reynolds)
        return 12.0 + flow + zero, 1.0 + friction + zero


class BlendedTurbulence(AbstractTurbulence):
    r"""Laminar below Re_c, turbulent above 2 Re_c, with a smooth transition between them.

    The excess factors of `FullTurbulence` times $t^2(3-2t)$, $t = (Re-Re_c)/Re_c$ clipped to [0, 1].

    Unlike with `Laminar` and `FullTurbulence`, the land torque is *not* monotone in the clearance: a wider film has a
    lower shear rate but may become turbulent.
    **Reference:** as `FullTurbulence`; the interval of the blend is our decision.
    """

    def factors(self, reynolds: Values, critical_reynolds: Values) -> tuple[Batch, Batch]:
        flow, friction = _fully_turbulent_excess(reynolds)
        share = smoothstep((reynolds - critical_reynolds) / critical_reynolds)
        return 12.0 + share * flow, 1.0 + share * friction

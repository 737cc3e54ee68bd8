"""Long journal bearing with half Sommerfeld cavitation, for a ball in its cage pocket."""

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.checks import Checked, bounded
from .journal import saturated_eccentricity


class LongJournal(Checked):
    r"""Film of a long journal bearing with pressure on the fixed arc 0 to pi (half Sommerfeld), isoviscous and rigid.

    Signs as in `ShortJournal`; $k = 1-\epsilon^2$, $K = \mu R^3L/c^2$,
    $\bar\omega = (\omega_j+\omega_b)/2 - \dot\phi$:

    $F_r = -K[24\epsilon^2\bar\omega/((2+\epsilon^2)k) + 12\dot\epsilon(\pi/2 - 8/(\pi(2+\epsilon^2)))k^{-3/2}]$,
    $F_t = K[12\pi\epsilon\bar\omega/((2+\epsilon^2)\sqrt k) + 24\epsilon\dot\epsilon/((2+\epsilon^2)k)]$.

    **Limits:** concentric and steady: no force; eps -> 1: finite, eps saturates smoothly at 0.995.
    **Validity:** width of several radii. The squeeze part includes negative pressure and holds for small approach
    speeds only; steady calculations use the wedge part alone (rate 0).
    **Reference:** Sommerfeld (1904); Pinkus and Sternlicht (1961), *Theory of Hydrodynamic
    Lubrication*; the source names the contact in Table 3 without a formula.

    **Arguments:**
    - `radius`: of the journal, R, m, > 0.
    - `width`: L, m, > 0.
    - `clearance`: c, RADIAL: half of the diametral clearance, m, > 0.
    """

    radius: Scalar = bounded("> 0")
    width: Scalar = bounded("> 0")
    clearance: Scalar = bounded("> 0")

    def force_on_journal(
        self,
        eccentricity_ratio: Values,
        eccentricity_rate: Values,
        journal_speed: Values,
        bush_speed: Values,
        whirl_speed: Values,
        viscosity: Values,
    ) -> tuple[Batch, Batch]:
        """Forces (F_r, F_t) on the journal along e_r and e_t, N.

        **Arguments:** `eccentricity_rate`, d eps/dt, 1/s; `journal_speed`, `bush_speed`, and `whirl_speed` of the line
        of centres, rad/s; `viscosity`, Pa s.
        """
        eps = saturated_eccentricity(eccentricity_ratio)
        complement = 1.0 - jnp.square(eps)
        two = 2.0 + jnp.square(eps)
        speed = 0.5 * (journal_speed + bush_speed) - whirl_speed
        scale = viscosity * (self.radius**3 * self.width / self.clearance**2)
        squeeze = 12.0 * (0.5 * jnp.pi - 8.0 / (jnp.pi * two)) / complement**1.5
        f_r = -scale * (24.0 * jnp.square(eps) * speed / (two * complement) + squeeze * eccentricity_rate)
        f_t = scale * (
            12.0 * jnp.pi * eps * speed / (two * jnp.sqrt(complement))
            + 24.0 * eps * eccentricity_rate / (two * complement)
        )
        return f_r, f_t

    def friction_torque(
        self, eccentricity_ratio: Values, journal_speed: Values, bush_speed: Values, viscosity: Values
    ) -> Batch:
        r"""Shear torque $4\pi\mu(\omega_j-\omega_b)R^3L(1+2\epsilon^2)/(c(2+\epsilon^2)\sqrt k)$, N m, both arcs wet.

        In a concentric gap it is Petroff's $2\pi\mu\,\Delta\omega R^3L/c$.
        """
        eps2 = jnp.square(saturated_eccentricity(eccentricity_ratio))
        scale = 4.0 * jnp.pi * viscosity * (self.radius**3 * self.width / self.clearance)
        return scale * (journal_speed - bush_speed) * (1.0 + 2.0 * eps2) / ((2.0 + eps2) * jnp.sqrt(1.0 - eps2))

    def torques(
        self,
        eccentricity_ratio: Values,
        tangential_force: Values,
        journal_speed: Values,
        bush_speed: Values,
        viscosity: Values,
    ) -> tuple[Batch, Batch]:
        r"""Torques on the journal and on the bush, N m, $\mp T_c - \epsilon cF_t/2$ as in `ShortJournal.torques`."""
        shear = self.friction_torque(eccentricity_ratio, journal_speed, bush_speed, viscosity)
        couple = 0.5 * eccentricity_ratio * self.clearance * tangential_force
        return -shear - couple, shear - couple

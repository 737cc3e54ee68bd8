r"""SKF's friction model: rolling and sliding moments, seals, drag of an oil bath.

$M = \phi_{ish}\phi_{rs}\,G_{rr}(\nu n)^{0.6} + G_{sl}\mu_{sl} + M_{seal} + M_{drag}$

Arguments and moments are in SI units; the catalogue's units (N mm, mm, rpm, mm^2/s), to which its constants belong, are
used inside only. $G_{rr}$ and $G_{sl}$ are in the catalogue's units.

**Validity:** loads from the minimum load on, oils from ISO VG 15 to 320, normal clearance, no shocks; accuracy 20 to
30 % (from a secondary source).
**Reference:** SKF general catalogue, chapter on friction; the later form of the drag in its later edition.
"""

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.safe import positive_power, power, regular_power
from .skf_constants import BALL_DRAG_VARIABLE, DRAG_LEVELS, ROLLER_DRAG_VARIABLE, SealConstants

MM = 1e3
"""Number of millimetres in a metre, and of N mm in an N m."""
MM2 = 1e6
"""Number of mm^2/s in one m^2/s."""
RPM = 30.0 / jnp.pi
"""Number of rpm in one rad/s."""
STILL = 1e-3
"""Value of nu n, mm^2/s rpm, and of a load, N, below which their powers become linear, for a finite slope at zero."""

Moments = tuple[Batch, Batch]
"""Rolling variable G_rr and sliding variable G_sl, in the catalogue's units."""


def speed_in_rpm(speed: Values) -> Batch:
    """Magnitude of the relative speed of the rings, rpm. **Arguments:** `speed`, rad/s."""
    return jnp.abs(speed) * RPM


def rolled(viscosity: Values, speed: Values) -> Batch:
    """Product nu n, mm^2/s rpm. **Arguments:** `viscosity`, kinematic, m^2/s; `speed`, rad/s."""
    return jnp.asarray(viscosity) * MM2 * speed_in_rpm(speed)


def deep_groove_variables(
    constants: tuple[float, ...], mean_diameter: Scalar, radial: Values, axial: Values, static_capacity: Values
) -> Moments:
    r"""$G_{rr}$, $G_{sl}$ of deep groove ball bearings.

    Without axial load $R_1d_m^{1.96}F_r^{0.54}$ and $S_1d_m^{-0.26}F_r^{5/3}$; with it,
    $\alpha_F = 24.6(F_a/C_0)^{0.24}$ degrees, $R_1d_m^{1.96}(F_r + R_2F_a/\sin\alpha_F)^{0.54}$ and
    $S_1d_m^{-0.145}(F_r^5 + S_2d_m^{1.5}F_a^4/\sin\alpha_F)^{1/3}$.

    **Limits:** at the transition from zero to small axial load the sliding variable jumps by the factor $d_m^{0.115}$,
    as the printed formula does. The derivative by the axial load at 0 is that of the first form: 0.

    **Arguments:** `constants`: R1, R2, S1, S2; `mean_diameter` (d + D)/2, m; loads >= 0, N; `static_capacity` C0, N.
    """
    r1, r2, s1, s2 = constants
    dm, fr, fa = jnp.asarray(mean_diameter) * MM, jnp.asarray(radial), jnp.asarray(axial)
    pushed = fa > 0.0
    push = jnp.where(pushed, fa, 1.0)
    across = jnp.sin(jnp.deg2rad(24.6 * power(push / static_capacity, 0.24)))
    rolling = jnp.where(pushed, fr + r2 * push / across, fr)
    fifth = positive_power(fr, 5.0) + s2 * power(dm, 1.5) * push**4 / across
    combined = power(dm, -0.145) * positive_power(fifth, 1.0 / 3.0)
    sliding = jnp.where(pushed, combined, power(dm, -0.26) * positive_power(fr, 5.0 / 3.0))
    return r1 * power(dm, 1.96) * regular_power(rolling, 0.54, STILL), s1 * sliding


def angular_contact_variables(
    constants: tuple[float, ...], mean_diameter: Scalar, radial: Values, axial: Values, speed: Values
) -> Moments:
    r"""$G_{rr} = R_1d_m^{1.97}(F_r + F_g + R_2F_a)^{0.54}$, $F_g = R_3d_m^4n^2$;
    $G_{sl} = S_1d_m^{0.26}[(F_r + F_g)^{4/3} + S_2F_a^{4/3}]$, $F_g = S_3d_m^4n^2$.

    Angular contact and four-point contact ball bearings.

    **Arguments:** `constants`: R1, R2, R3, S1, S2, S3; `mean_diameter`, m; loads >= 0, N; `speed`, rad/s.
    """
    r1, r2, r3, s1, s2, s3 = constants
    dm, fr, fa = jnp.asarray(mean_diameter) * MM, jnp.asarray(radial), jnp.asarray(axial)
    turning = dm**4 * speed_in_rpm(speed) ** 2
    rolling = regular_power(fr + r3 * turning + r2 * fa, 0.54, STILL)
    sliding = positive_power(fr + s3 * turning, 4.0 / 3.0) + s2 * positive_power(fa, 4.0 / 3.0)
    return r1 * power(dm, 1.97) * rolling, s1 * power(dm, 0.26) * sliding


def cylindrical_variables(
    constants: tuple[float, ...], mean_diameter: Scalar, radial: Values, axial: Values
) -> Moments:
    r"""$G_{rr} = R_1d_m^{2.41}F_r^{0.31}$, $G_{sl} = S_1d_m^{0.9}F_a + S_2d_mF_r$ of cylindrical roller bearings.

    **Arguments:** `constants`: R1, S1, S2; `mean_diameter`, m; loads >= 0, N.
    """
    r1, s1, s2 = constants
    dm, fr = jnp.asarray(mean_diameter) * MM, jnp.asarray(radial)
    rolling = r1 * power(dm, 2.41) * regular_power(fr, 0.31, STILL)
    return rolling, s1 * power(dm, 0.9) * axial + s2 * dm * fr


def tapered_variables(
    constants: tuple[float, ...], mean_diameter: Scalar, radial: Values, axial: Values, axial_factor: Values
) -> Moments:
    r"""$G_{rr} = R_1d_m^{2.38}(F_r + R_2YF_a)^{0.31}$, $G_{sl} = S_1d_m^{0.82}(F_r + S_2YF_a)$ of tapered bearings.

    **Arguments:** `constants`: R1, R2, S1, S2; `mean_diameter`, m; loads >= 0, N; `axial_factor` Y.
    """
    r1, r2, s1, s2 = constants
    dm, fr, pushed = jnp.asarray(mean_diameter) * MM, jnp.asarray(radial), jnp.asarray(axial_factor) * axial
    rolling = r1 * power(dm, 2.38) * regular_power(fr + r2 * pushed, 0.31, STILL)
    return rolling, s1 * power(dm, 0.82) * (fr + s2 * pushed)


def heating_factor(speed: Values, mean_diameter: Scalar, viscosity: Values) -> Batch:
    r"""$\phi_{ish} = 1/(1 + 1.84\cdot10^{-9}(nd_m)^{1.28}\nu^{0.64})$: shear heats the oil at the inlets.

    **Arguments:** `speed`, rad/s; `mean_diameter`, m; `viscosity`, kinematic, m^2/s, > 0.
    """
    turning = positive_power(speed_in_rpm(speed) * jnp.asarray(mean_diameter) * MM, 1.28)
    return 1.0 / (1.0 + 1.84e-9 * turning * power(jnp.asarray(viscosity) * MM2, 0.64))


def starvation_factor(
    speed: Values, viscosity: Values, bore: Scalar, outside: Scalar, constant: Values, geometry: Scalar
) -> Batch:
    r"""$\phi_{rs} = \exp(-K_{rs}\nu n(d + D)\sqrt{K_z/(2(D - d))})$: rolling elements push the oil off their tracks.

    **Arguments:** `speed`, rad/s; `viscosity`, kinematic, m^2/s; `bore` d and `outside` D, m; `constant` K_rs: 0 for
    flooded inlets, 3e-8 with a low oil level or a jet, 6e-8 with grease or oil and air; `geometry` K_z.
    """
    d, big = jnp.asarray(bore) * MM, jnp.asarray(outside) * MM
    return jnp.exp(-constant * rolled(viscosity, speed) * (d + big) * jnp.sqrt(geometry / (2.0 * (big - d))))


def sliding_friction(speed: Values, viscosity: Values, mean_diameter: Scalar, boundary: Values, film: Values) -> Batch:
    r"""$\mu_{sl} = \phi_{bl}\mu_{bl} + (1 - \phi_{bl})\mu_{EHL}$, $\phi_{bl} = \exp(-2.6\cdot10^{-8}(n\nu)^{1.4}d_m)$.

    **Limits:** $\mu_{bl}$ at rest, $\mu_{EHL}$ at high speed.
    **Arguments:** `speed`, rad/s; `viscosity`, kinematic, m^2/s; `mean_diameter`, m; `boundary`, `film`: mu_bl, mu_EHL.
    """
    dm = jnp.asarray(mean_diameter) * MM
    share = jnp.exp(-2.6e-8 * positive_power(rolled(viscosity, speed), 1.4) * dm)
    return share * boundary + (1.0 - share) * film


def rolling_moment(
    rolling_variable: Values, speed: Values, viscosity: Values, mean_diameter: Scalar, starvation: Values = 1.0
) -> Batch:
    r"""$M_{rr} = \phi_{ish}\phi_{rs}G_{rr}(\nu n)^{0.6}$, N m.

    **Arguments:** `rolling_variable` G_rr; `speed`, rad/s; `viscosity`, kinematic, m^2/s; `mean_diameter`, m;
    `starvation`: phi_rs.
    """
    moved = regular_power(rolled(viscosity, speed), 0.6, STILL)
    return heating_factor(speed, mean_diameter, viscosity) * starvation * rolling_variable * moved / MM


def sliding_moment(sliding_variable: Values, friction: Values) -> Batch:
    r"""$M_{sl} = G_{sl}\mu_{sl}$, N m. **Arguments:** `sliding_variable` G_sl; `friction` mu_sl."""
    return jnp.asarray(sliding_variable) * friction / MM


def seal_moment(constants: SealConstants, seal_diameter: Scalar) -> Batch:
    r"""$M_{seal} = K_{S1}d_s^\beta + K_{S2}$ of both seals, N m.

    **Arguments:** `seal_diameter`: d_s, on which they run, m.
    """
    return (constants.k1 * power(jnp.asarray(seal_diameter) * MM, constants.beta) + constants.k2) / MM


def drag_variable(level: Values, mean_diameter: Scalar, rollers: bool) -> Batch:
    """Drag variable V_M, linear between points read from the graph; constant beyond H = 1.4 d_m.

    **Arguments:** `level` H above the lowest point of the outer raceway, m, >= 0; `mean_diameter`, m; `rollers`: of
    roller bearings, else of balls.
    """
    known = ROLLER_DRAG_VARIABLE if rollers else BALL_DRAG_VARIABLE
    return jnp.interp(jnp.asarray(level) / mean_diameter, jnp.array(DRAG_LEVELS), jnp.array(known))


def older_ball_drag(
    speed: Values, bore: Scalar, outside: Scalar, level: Values, geometry: Scalar, rows: float = 1.0
) -> Batch:
    r"""$V_MK_{ball}d_m^5n^2$, $K_{ball} = i_{rw}K_z\frac{d + D}{D - d}10^{-12}$, N m: the older form for ball bearings.

    **Arguments:** `speed`, rad/s; `bore`, `outside`, `level`, m; `geometry` K_z; `rows` i_rw.
    """
    dm = 0.5 * (jnp.asarray(bore) + outside)
    size = rows * geometry * (jnp.asarray(bore) + outside) / (jnp.asarray(outside) - bore) * 1e-12
    return drag_variable(level, dm, False) * size * (dm * MM) ** 5 * speed_in_rpm(speed) ** 2 / MM


def ball_drag(
    speed: Values, viscosity: Values, bore: Scalar, outside: Scalar, level: Values, geometry: Scalar, rows: float = 1.0
) -> Batch:
    r"""$0.4V_MK_{ball}d_m^5n^2 + 1.093\cdot10^{-7}n^2d_m^3(nd_m^2f_t/\nu)^{-1.379}R_s$, N m: the newer form for balls.

    $R_s = 0.36d_m^2(t - \sin t)f_A$, $f_A = 0.05K_z\frac{D + d}{D - d}$,
    $t = 2\arccos\frac{0.6d_m - H}{0.6d_m}$, $f_t = \sin(t/2)$ up to $t = \pi$, 1 beyond.

    **Limits:** 0 without oil (H = 0) and at rest. The bearing is full from H = 1.2 d_m on, where t = 2 pi.
    **Arguments:** as `older_ball_drag`; `viscosity`, kinematic, m^2/s.
    """
    first = 0.4 * older_ball_drag(speed, bore, outside, level, geometry, rows)
    dm, nu, n = 0.5 * (jnp.asarray(bore) + outside) * MM, jnp.asarray(viscosity) * MM2, speed_in_rpm(speed)
    wet = (jnp.asarray(level) > 0.0) & (n > 0.0)
    height = jnp.where(wet, jnp.asarray(level) * MM / (0.6 * dm), 1.0)
    partly = height < 2.0
    angle = jnp.where(partly, 2.0 * jnp.arccos(1.0 - jnp.where(partly, height, 1.0)), 2.0 * jnp.pi)
    low = angle <= jnp.pi
    f_t = jnp.where(low, jnp.sin(0.5 * jnp.where(low, angle, 1.0)), 1.0)
    f_a = 0.05 * geometry * (jnp.asarray(bore) + outside) / (jnp.asarray(outside) - bore)
    r_s = 0.36 * dm**2 * (angle - jnp.sin(angle)) * f_a
    turning = jnp.where(wet, n, 1.0)
    second = 1.093e-7 * turning**2 * dm**3 * power(turning * dm**2 * f_t / nu, -1.379) * r_s
    return first + jnp.where(wet, second, 0.0) / MM


def roller_drag(
    speed: Values,
    bore: Scalar,
    outside: Scalar,
    width: Scalar,
    level: Values,
    geometry: Scalar,
    length: Scalar,
) -> Batch:
    r"""$10V_MK_{roll}Bd_m^4n^2$, $K_{roll} = K_LK_z\frac{d + D}{D - d}10^{-12}$, N m: the older form for rollers.

    **Arguments:** `speed`, rad/s; `bore`, `outside`, `width` B and `level`, m; `geometry` K_z; `length` K_L. Unlike
    that of balls, the formula has no number of rows.
    """
    dm = 0.5 * (jnp.asarray(bore) + outside)
    size = length * geometry * (jnp.asarray(bore) + outside) / (jnp.asarray(outside) - bore) * 1e-12
    moved = jnp.asarray(width) * MM * (dm * MM) ** 4 * speed_in_rpm(speed) ** 2
    return 10.0 * drag_variable(level, dm, True) * size * moved / MM

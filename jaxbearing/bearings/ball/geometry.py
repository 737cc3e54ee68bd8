"""Geometry of a ball bearing: grooves, contact angle, groove centres."""

from collections.abc import Iterator, Sequence
from typing import ClassVar

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..._scene import number, optional_number
from ..._types import Scalar, Values
from ...contacts import PointContact
from ...materials import check_interference
from ...numerics.checks import demand, numbers_or_none
from ...numerics.refusals import refusals_of, refuse_all
from ...numerics.structure import count
from ..parts import FIRST_ELEMENT, AbstractGeometry, check_row_fits
from .arcs import Arcs, added

LEAST_SHIM = 1.0
"""Smallest shim angle of a ring with two arcs, degrees. Below it the two contacts of a ring coincide and would be
counted twice."""


class BallGeometry(AbstractGeometry):
    """Main dimensions of a single-row ball bearing. Either the contact angle or the clearance is given; the other
    follows from it.

    **Arguments:**
    - `n_balls`: number of balls (structure: another number recompiles).
    - `pitch_diameter`, `ball_diameter`: m, > 0.
    - `conformity_inner`, `conformity_outer`: groove radius over ball diameter, > 0.5.
    - `contact_angle`: contact angle of the unloaded bearing, rad, at least 0 and below pi/2.
    - `diametral_clearance`: DIAMETRAL internal clearance of the unloaded bearing, m; negative: radial preload.
    - `shim_inner`, `shim_outer`: shim angle of a ring with two groove arcs, rad, at least 1 degree: the contact angle
      of a ball that touches both arcs of the ring; not given: one arc. With a shim angle, `contact_angle` is that of
      balls with two contacts, and `diametral_clearance` that of balls that lie in all arcs.
    - `shoulder_angle_inner`, `shoulder_angle_outer`: angle at which the groove ends, rad; not given: no check.
    - `first_element_angle`: azimuth of the first ball, rad; not given: 0, and the load line is a line of symmetry.
    - `bore`, `outside_diameter`, `width`: boundary dimensions of the bearing, m, used for fits, thermal networks and
      flexible rings.
    """

    part: ClassVar[str] = "geometry"

    n_balls: int = count("geometry.n_balls")
    pitch_diameter: Scalar = number(bound="> 0", unit="m")
    ball_diameter: Scalar = number(bound="> 0", unit="m")
    conformity_inner: Scalar = number(bound="above 0.5 and at most 1", unit="1")
    conformity_outer: Scalar = number(bound="above 0.5 and at most 1", unit="1")
    contact_angle: Scalar | None = optional_number(bound=">= 0 and below 90 degrees", unit="rad")
    diametral_clearance: Scalar | None = optional_number(unit="m")
    shim_inner: Scalar | None = optional_number(bound="above 0 and below 90 degrees", unit="rad")
    shim_outer: Scalar | None = optional_number(bound="above 0 and below 90 degrees", unit="rad")
    shoulder_angle_inner: Scalar | None = optional_number(bound="above 0 and below 90 degrees", unit="rad")
    shoulder_angle_outer: Scalar | None = optional_number(bound="above 0 and below 90 degrees", unit="rad")
    first_element_angle: Scalar | None = optional_number(metadata=FIRST_ELEMENT)
    bore: Scalar | None = optional_number(bound="> 0", unit="m")
    outside_diameter: Scalar | None = optional_number(bound="> 0", unit="m")
    width: Scalar | None = optional_number(bound="> 0", unit="m")

    @property
    def n_elements(self) -> int:
        return self.n_balls

    @property
    def element_diameter(self) -> Scalar:
        return self.ball_diameter

    def __check_init__(self):
        super().__check_init__()
        refuse_all(self._problems())

    def _problems(self) -> Iterator[str | ValueError]:
        yield from refusals_of(check_row_fits, self.n_balls, self.ball_diameter, self.pitch_diameter, "ball")
        clearance = numbers_or_none(self.diametral_clearance)
        if clearance is not None:
            name = "geometry.diametral_clearance"
            yield from refusals_of(check_interference, name, -clearance[0], self.pitch_diameter)
        if (self.contact_angle is None) == (self.diametral_clearance is None):
            words = "neither contact_angle nor" if self.contact_angle is None else "both contact_angle and"
            yield (
                f"geometry.contact_angle: found {words} diametral_clearance, expected one of the two: each follows "
                "from the other"
            )
        for name in ("shim_inner", "shim_outer"):
            yield from self._shim_problems(name)
        sizes = numbers_or_none(
            self.diametral_clearance, self.ball_diameter, self.conformity_inner, self.conformity_outer
        )
        if sizes is not None:
            yield from refusals_of(
                demand,
                "geometry.diametral_clearance must be less than that of balls that leave the grooves",
                sizes[0] < 2.0 * (sizes[2] + sizes[3] - 1.0) * sizes[1],
                lambda: f"geometry.diametral_clearance: {float(sizes[0]):g} m is more than the grooves hold",
            )

    def _shim_problems(self, name: str) -> Iterator[str | ValueError]:
        shim = numbers_or_none(getattr(self, name))
        if shim is not None:
            angle = shim[0]
            yield from refusals_of(
                demand,
                f"geometry.{name} must be at least {LEAST_SHIM:g} degree",
                angle >= np.radians(LEAST_SHIM),
                lambda: (
                    f"geometry.{name}: found {np.degrees(float(angle)):.3g} degrees, expected at least "
                    f"{LEAST_SHIM:g}, or no shim angle: both contacts of this ring would be one"
                ),
            )

    @property
    def centre_distance(self) -> Array:
        """Distance BD = (f_i + f_o - 1) D between the groove centres when unloaded balls touch both races, m."""
        return (self.conformity_inner + self.conformity_outer - 1.0) * jnp.asarray(self.ball_diameter)

    @property
    def inner_offset(self) -> Array:
        """Distance from the inner groove centre to the centre of a ball that touches the groove without load, m."""
        return (self.conformity_inner - 0.5) * jnp.asarray(self.ball_diameter)

    @property
    def outer_offset(self) -> Array:
        """Distance from the outer groove centre to the centre of a ball that touches the groove without load, m."""
        return (self.conformity_outer - 0.5) * jnp.asarray(self.ball_diameter)

    @property
    def has_arcs(self) -> bool:
        """True if at least one ring has two groove arcs."""
        return self.shim_inner is not None or self.shim_outer is not None

    @property
    def arcs(self) -> Arcs:
        r"""Distances $e = g\sin a$ of the circles of groove centres from the middle planes of their rings, m."""
        inner = None if self.shim_inner is None else self.inner_offset * jnp.sin(self.shim_inner)
        outer = None if self.shim_outer is None else self.outer_offset * jnp.sin(self.shim_outer)
        return Arcs(inner, outer)

    @property
    def lift(self) -> Array | None:
        r"""The radial distance of `Arcs.lift`, $\sum 2g\sin^2(a/2)$, m; `None` if each ring has one arc."""
        shims = ((self.inner_offset, self.shim_inner), (self.outer_offset, self.shim_outer))
        parts = [2.0 * g * jnp.square(jnp.sin(0.5 * a)) for g, a in shims if a is not None]
        return added(parts) if parts else None

    @property
    def free_clearance(self) -> Scalar | None:
        """Diametral clearance from which the contact angle follows, m; `None`: the contact angle is given. For rings
        with two arcs it is the diametral clearance of the bearing with one arc on each ring that has the same radial
        distance between its circles of groove centres."""
        if self.diametral_clearance is None or self.lift is None:
            return self.diametral_clearance
        return self.diametral_clearance + 2.0 * self.lift

    @property
    def free_cosine(self) -> Array:
        """Cosine of the contact angle of the unloaded bearing. With radial preload it is the radial distance between
        the circles of groove centres over `centre_distance`, and is above 1."""
        clearance = self.free_clearance
        if clearance is None:
            return jnp.cos(jnp.asarray(self.contact_angle))
        return 1.0 - clearance / (2.0 * self.centre_distance)

    @property
    def free_sine(self) -> Array:
        """Sine of the contact angle of the unloaded bearing; without clearance it is 0, with derivative 0."""
        clearance = self.free_clearance
        if clearance is None:
            return jnp.sin(jnp.asarray(self.contact_angle))
        lift = clearance / (2.0 * self.centre_distance)
        open_ = lift > 0
        return jnp.where(open_, jnp.sqrt(jnp.where(open_, lift * (2.0 - lift), 1.0)), 0.0)

    @property
    def nominal_angle(self) -> Scalar:
        """Nominal contact angle, rad: the given one; else, if a ring has two arcs, that of balls with two contacts;
        else 0 (a bearing given by its clearance)."""
        if self.contact_angle is None and self.has_arcs:
            return jnp.arctan2(self.free_sine, self.free_cosine)
        return 0.0 if self.contact_angle is None else self.contact_angle

    @property
    def aligned(self) -> Array:
        """Axial displacement of the inner ring at which the middle planes of the grooves coincide, m.

        In a bearing given by its clearance, or with two arcs on a ring, axial displacements count from there, the
        middle of the axial play. In other bearings, given by their contact angle, they count from the first contact of
        balls and races, with the inner ring pushed along $+e_x$.
        """
        if self.contact_angle is None or self.has_arcs:
            return jnp.zeros(())
        return -self.centre_distance * self.free_sine

    @property
    def groove_circle_radius(self) -> Array:
        """Radius R_i of the circle of inner groove centres, m."""
        radius, cosine = 0.5 * self.pitch_diameter, self.free_cosine
        if self.free_clearance is None:
            return radius + self.inner_offset * cosine
        # with radial preload the balls touch the bottoms of the grooves, and the inner ring is larger by the overlap
        pressed = self.centre_distance * jnp.maximum(cosine - 1.0, 0.0)
        return radius + self.inner_offset * jnp.minimum(cosine, 1.0) + pressed

    def contacts(self, inner_cosine: Values, outer_cosine: Values, reduced_modulus: Values) -> PointContact:
        """Both contacts of a ball at given contact angles, shape (2, ...), inner race first."""
        return self.contacts_on((inner_cosine, outer_cosine), (0, 1), reduced_modulus)

    def contacts_on(
        self, cosines: Sequence[Values] | Array, races: tuple[int, ...], reduced_modulus: Values
    ) -> PointContact:
        """Contacts at given contact angles, shape (contact, ...).

        **Arguments:** `cosines`: cosines of the contact angles; `races`: race of each contact, 0 inner, 1 outer;
        `reduced_modulus`: reduced modulus, Pa: one number, or shape (2, 1), inner race first."""
        ratio = self.ball_diameter / self.pitch_diameter
        half = 0.5 * jnp.asarray(self.ball_diameter)
        rolling = jnp.stack(
            [
                half * (1.0 - ratio * cosine) if race == 0 else half * (1.0 + ratio * cosine)
                for cosine, race in zip(cosines, races, strict=True)
            ]
        )
        groove = lambda f: f * self.ball_diameter / (2.0 * f - 1.0)
        conformities = (self.conformity_inner, self.conformity_outer)
        transverse = jnp.stack([jnp.asarray(groove(conformities[race])) for race in races])
        shape = (len(races),) + (1,) * (rolling.ndim - 1)
        if jnp.ndim(reduced_modulus):
            reduced_modulus = jnp.asarray(reduced_modulus)[np.asarray(races)].reshape(shape)
        return PointContact(rolling, transverse.reshape(shape), reduced_modulus)

    def free_contacts(self, reduced_modulus: Values) -> PointContact:
        """Both contacts of a ball at the contact angle of the unloaded bearing, shape (2,), inner race first."""
        cosine = self.free_cosine
        if self.free_clearance is not None:
            cosine = jnp.minimum(cosine, 1.0)
        return self.contacts(cosine, cosine, reduced_modulus)

    def mass(self, density: Values) -> Float[Array, ""]:
        """Mass of a ball, kg."""
        return density * jnp.pi / 6.0 * jnp.asarray(self.ball_diameter) ** 3

    def inertia(self, density: Values) -> Float[Array, ""]:
        """Moment of inertia of a ball, kg m^2."""
        return density * jnp.pi / 60.0 * jnp.asarray(self.ball_diameter) ** 5

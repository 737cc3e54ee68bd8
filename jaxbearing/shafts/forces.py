r"""Forces on a shaft beside those of its bearings: points, gears, belts and masses.

A force at azimuth $\varphi$ and radius r with the parts $F_x$ (along +X), $F_r$ (outwards) and $F_t$ (in the sense of
rotation) has on the axis $F_Y = F_r\cos\varphi - F_t\sin\varphi$, $F_Z = F_r\sin\varphi + F_t\cos\varphi$, the moments
$rF_x\cos\varphi$ about the tilt and $rF_x\sin\varphi$ about the lateral tilt, and the torque $rF_t$.
"""

import abc
from typing import ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._scene import label, number
from .._types import Scalar
from ..numerics.checks import Checked
from ..numerics.structure import switch


class ActingForce(NamedTuple):
    """Loads on the five degrees of freedom of a point of the shaft, N and N m, and the torque, N m, in the sense of
    positive speed."""

    load: Float[Array, "5"]
    torque: Float[Array, ""]


class AbstractForce(Checked):
    """Something that acts on the shaft at one position. `kind` is its word in scene files."""

    part: ClassVar[str] = "force"
    kind: ClassVar[str]

    name: eqx.AbstractVar[str]
    position: eqx.AbstractVar[Scalar]

    @property
    @abc.abstractmethod
    def torque_given(self) -> Array:
        """Torque on the shaft as it is given, N m."""

    @abc.abstractmethod
    def acting(self, torque: Array, gravity: Float[Array, "2"]) -> ActingForce:
        """Loads on the shaft.

        **Arguments:**
        - `torque`: on the shaft, N m: the given one, or that which balances the others.
        - `gravity`: acceleration along Y and Z, m/s^2.
        """

    @property
    def balances(self) -> bool:
        """True if its torque is the one that the other forces leave."""
        return False


class AbstractDrive(AbstractForce):
    """A part that turns the shaft or is turned by it. Its torque is given, or is what the other forces leave."""

    torque: eqx.AbstractVar[Scalar]
    balance: eqx.AbstractVar[bool]

    @property
    def torque_given(self) -> Array:
        return jnp.asarray(self.torque)

    @property
    def balances(self) -> bool:
        return self.balance


def resolved(axial: Scalar, radial: Scalar, tangential: Scalar, azimuth: Scalar, radius: Scalar) -> Float[Array, "5"]:
    """Loads on the axis of a force at an azimuth, rad, and a radius, m; see the module."""
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    across = (radial * cosine - tangential * sine, radial * sine + tangential * cosine)
    return jnp.stack([jnp.asarray(axial), *across, radius * axial * cosine, radius * axial * sine])


def _position() -> float:
    return number(metadata=label("m", "position along the shaft"))


class PointLoad(AbstractForce):
    """A force, and where given a moment, at a point of the shaft.

    **Arguments:**
    - `name`: its name.
    - `position`: along the shaft, m.
    - `axial`, `radial`, `tangential`: parts of the force along +X, outwards, and in the sense of rotation, N.
    - `azimuth`: of the point where it acts, rad.
    - `radius`: distance of that point from the axis, m, >= 0.
    - `moment`, `moment_lateral`: moments on the tilt and on the lateral tilt, N m: a positive one moves azimuth 0, or
      azimuth 90 degrees, along +X. The vector of the moment is (0, moment_lateral, -moment).
    - `torque`: about the axis, beside that of the tangential force, N m.
    """

    kind: ClassVar[str] = "point"

    name: str = eqx.field(static=True)
    position: Scalar = _position()
    axial: Scalar = number(0.0, metadata=label("N", "axial force"))
    radial: Scalar = number(0.0, metadata=label("N", "radial force"))
    tangential: Scalar = number(0.0, metadata=label("N", "tangential force"))
    azimuth: Scalar = number(0.0, metadata=label("rad", "azimuth"))
    radius: Scalar = number(0.0, bound=">= 0", metadata=label("m", "radius"))
    moment: Scalar = number(0.0, metadata=label("N m", "moment"))
    moment_lateral: Scalar = number(0.0, metadata=label("N m", "lateral moment"))
    torque: Scalar = number(0.0, metadata=label("N m", "torque"))

    @property
    def torque_given(self) -> Array:
        return jnp.asarray(self.torque + self.radius * self.tangential)

    def acting(self, torque: Array, gravity: Float[Array, "2"]) -> ActingForce:
        del gravity
        load = resolved(self.axial, self.radial, self.tangential, self.azimuth, self.radius)
        return ActingForce(load.at[3:].add(jnp.stack([jnp.asarray(self.moment), self.moment_lateral])), torque)


class Gear(AbstractDrive):
    r"""A spur or helical gear in mesh at one azimuth.

    $F_t = T/r$, separating force $|F_t|\tan\alpha_n/\cos\beta$ towards the axis, axial force $F_t\tan\beta$.

    **Arguments:**
    - `name`: its name.
    - `position`: of the middle of the teeth, m.
    - `torque`: on the shaft, N m, in the sense of positive speed: positive of the driven gear of a shaft that turns in
      this sense.
    - `pitch_radius`: r, m, > 0.
    - `azimuth`: of the mesh, rad.
    - `pressure_angle`: $\alpha_n$ in the normal section, rad.
    - `helix_angle`: $\beta$, rad; its sign is the hand: with a positive one a positive torque presses the gear along
      +X.
    - `balance`: whether its torque is the one that the other forces leave, in place of `torque`.
    """

    kind: ClassVar[str] = "gear"

    name: str = eqx.field(static=True)
    position: Scalar = _position()
    pitch_radius: Scalar = number(bound="> 0", metadata=label("m", "pitch radius"))
    torque: Scalar = number(0.0, metadata=label("N m", "torque"))
    azimuth: Scalar = number(0.0, metadata=label("rad", "azimuth of the mesh"))
    pressure_angle: Scalar = number(0.3490658503988659, metadata=label("rad", "pressure angle"))
    helix_angle: Scalar = number(0.0, metadata=label("rad", "helix angle"))
    balance: bool = switch("force.balance", False)

    def acting(self, torque: Array, gravity: Float[Array, "2"]) -> ActingForce:
        del gravity
        tangential = torque / self.pitch_radius
        radial = -jnp.abs(tangential) * jnp.tan(self.pressure_angle) / jnp.cos(self.helix_angle)
        axial = tangential * jnp.tan(self.helix_angle)
        return ActingForce(resolved(axial, radial, tangential, self.azimuth, self.pitch_radius), torque)


class Belt(AbstractDrive):
    """The pull of a belt.

    **Arguments:**
    - `name`: its name.
    - `position`: m.
    - `force`: sum of the pulls of both strands, N.
    - `azimuth`: of the direction of the pull, rad.
    - `torque`: on the shaft, N m.
    - `balance`: whether its torque is the one that the other forces leave, in place of `torque`.
    """

    kind: ClassVar[str] = "belt"

    name: str = eqx.field(static=True)
    position: Scalar = _position()
    force: Scalar = number(metadata=label("N", "pull of the belt"))
    azimuth: Scalar = number(0.0, metadata=label("rad", "azimuth of the pull"))
    torque: Scalar = number(0.0, metadata=label("N m", "torque"))
    balance: bool = switch("force.balance", False)

    def acting(self, torque: Array, gravity: Float[Array, "2"]) -> ActingForce:
        del gravity
        return ActingForce(resolved(0.0, self.force, 0.0, self.azimuth, 0.0), torque)


class Mass(AbstractForce):
    """A disk whose weight acts; it needs `shaft.gravity`.

    **Arguments:** `name`: its name; `position`: m; `mass`: kg, >= 0.
    """

    kind: ClassVar[str] = "mass"

    name: str = eqx.field(static=True)
    position: Scalar = _position()
    mass: Scalar = number(bound=">= 0", metadata=label("kg", "mass"))

    @property
    def torque_given(self) -> Array:
        return jnp.zeros(())

    def acting(self, torque: Array, gravity: Float[Array, "2"]) -> ActingForce:
        load = jnp.concatenate([jnp.zeros(1), self.mass * gravity, jnp.zeros(2)])
        return ActingForce(load, torque)


FORCES = {force.kind: force for force in (PointLoad, Gear, Belt, Mass)}
"""Word of a scene file -> class of the force."""

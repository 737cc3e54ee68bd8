r"""Given forces on a shaft: point loads, gears, belts and masses.

A force with the components $F_x$ (along +X), $F_r$ (outwards) and $F_t$ (in the sense of rotation) acts at azimuth
$\varphi$ and radius r. It is equivalent to a load on the axis: the forces $F_x$, $F_Y = F_r\cos\varphi -
F_t\sin\varphi$ and $F_Z = F_r\sin\varphi + F_t\cos\varphi$, the moment $rF_x\cos\varphi$ on the tilt, the moment
$rF_x\sin\varphi$ on the lateral tilt, and the torque $rF_t$.
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
    """A force that acts on the shaft at one position. `kind` is its name in scene files."""

    part: ClassVar[str] = "force"
    kind: ClassVar[str]

    name: eqx.AbstractVar[str]
    position: eqx.AbstractVar[Scalar]

    @property
    @abc.abstractmethod
    def torque_given(self) -> Array:
        """Given torque on the shaft, N m."""

    @abc.abstractmethod
    def acting(self, torque: Array, gravity: Float[Array, "2"]) -> ActingForce:
        """Loads on the shaft.

        **Arguments:**
        - `torque`: torque on the shaft, N m: the given torque, or the one that balances the other forces.
        - `gravity`: acceleration along Y and Z, m/s^2.
        """

    @property
    def balances(self) -> bool:
        """True if its torque balances the torques of the other forces."""
        return False


class AbstractDrive(AbstractForce):
    """A part that drives the shaft or is driven by it. Its torque is given or balances the other forces."""

    torque: eqx.AbstractVar[Scalar]
    balance: eqx.AbstractVar[bool]

    @property
    def torque_given(self) -> Array:
        return jnp.asarray(self.torque)

    @property
    def balances(self) -> bool:
        return self.balance


def resolved(axial: Scalar, radial: Scalar, tangential: Scalar, azimuth: Scalar, radius: Scalar) -> Float[Array, "5"]:
    """Load on the axis that is equivalent to a force at an azimuth, rad, and a radius, m (see the module)."""
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    across = (radial * cosine - tangential * sine, radial * sine + tangential * cosine)
    return jnp.stack([jnp.asarray(axial), *across, radius * axial * cosine, radius * axial * sine])


def _position() -> float:
    return number(metadata=label("m", "position along the shaft"))


class PointLoad(AbstractForce):
    """A force and a moment at a point of the shaft.

    **Arguments:**
    - `name`: name of the force.
    - `position`: position along the shaft, m.
    - `axial`, `radial`, `tangential`: components of the force along +X, outwards, and in the sense of rotation, N.
    - `azimuth`: azimuth of the point where the force acts, rad.
    - `radius`: distance of that point from the axis, m, >= 0.
    - `moment`, `moment_lateral`: moments on the tilt and on the lateral tilt, N m. If positive, they move azimuth 0 and
      azimuth 90 degrees along +X. The moment vector is (0, moment_lateral, -moment).
    - `torque`: torque about the axis in addition to that of the tangential force, N m.
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
    - `name`: name of the gear.
    - `position`: position of the middle of the teeth, m.
    - `torque`: torque on the shaft, N m, positive in the sense of positive speed. It is positive for a gear that drives
      the shaft, if the shaft turns in this sense.
    - `pitch_radius`: r, m, > 0.
    - `azimuth`: azimuth of the mesh, rad.
    - `pressure_angle`: $\alpha_n$ in the normal section, rad.
    - `helix_angle`: $\beta$, rad. Its sign is the hand of the helix: if it is positive, a positive torque pushes the
      gear along +X.
    - `balance`: true for a torque that balances the other forces, in place of `torque`.
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
    - `name`: name of the belt.
    - `position`: position along the shaft, m.
    - `force`: sum of the pulls of both strands, N.
    - `azimuth`: azimuth of the direction of the pull, rad.
    - `torque`: torque on the shaft, N m.
    - `balance`: true for a torque that balances the other forces, in place of `torque`.
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
    """A disk whose weight acts on the shaft; without `shaft.gravity` it has no effect.

    **Arguments:** `name`: name of the disk; `position`: position along the shaft, m; `mass`: kg, >= 0.
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
"""Kind of a force in scene files -> its class."""

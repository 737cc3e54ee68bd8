"""Bearings and shafts of the check values of the sheet "several bearings together"."""

import jax.numpy as jnp
import numpy as np

import jaxbearing as jb
from jaxbearing.bearings.ball.scene import BallAttitude, BallBearing, BallMaterials, BallOperation
from jaxbearing.bearings.cylindrical.geometry import RollerGeometry
from jaxbearing.bearings.cylindrical.scene import CylindricalRollerBearing
from jaxbearing.bearings.operation import Operation
from jaxbearing.bearings.parts import Materials
from jaxbearing.bearings.rating import Rating
from jaxbearing.bearings.ring import shift_matrix
from jaxbearing.materials import Material
from jaxbearing.shafts import (
    Gear,
    Gravity,
    Mass,
    MatchedSet,
    MountedBearing,
    PointLoad,
    Preload,
    Section,
    Shaft,
    ShaftSystem,
)

RPM = np.pi / 30.0


def steel(modulus=207e9):
    return Material(modulus, 0.3, 7850.0)


def balls(*geometry, modulus=207e9, rating=None, **more):
    materials = BallMaterials(steel(modulus), steel(modulus))
    operation = BallOperation(inner_speed=0.0, axial_load=1e3)
    return BallBearing(jb.BallGeometry(*geometry, **more), materials, operation, BallAttitude("outer"), rating=rating)


def rollers(*geometry, rating=None):
    materials = Materials(steel(), steel())
    operation = Operation(0.0, radial_load=1e3)
    return CylindricalRollerBearing(RollerGeometry(*geometry), materials, operation, rating=rating)


P = balls(20, 65e-3, 6.35e-3, 0.5388, 0.5388, np.radians(17.0), modulus=208e9)
DEEP_GROOVE = balls(9, 38.5e-3, 7.938e-3, 0.515, 0.525, diametral_clearance=12e-6)
AC = balls(13, 53.5e-3, 11.112e-3, 0.515, 0.525, np.radians(40.0), rating=Rating())
NU = rollers(13, 54e-3, 10e-3, 10e-3, 25e-6, rating=Rating())


def pair(picture="<>", rpm=0.0, distance=16e-3, preload=None, scene=P, **load):
    """A set on a rigid shaft, loaded in its middle."""
    one = MatchedSet("set", picture, scene, 0.0, distance, preload)
    return ShaftSystem(Shaft(rpm * RPM), sets=[one], forces=[PointLoad("load", 0.0, **load)])


def pair_stiffness(solution):
    """Diagonal of the stiffness of all bearings together about x = 0."""
    total = np.zeros((5, 5))
    for one in solution.bearings.values():
        mirror = np.array([one.sense, 1.0, 1.0, one.sense, one.sense])
        shift = np.asarray(shift_matrix(jnp.asarray(one.position)))
        total += shift.T @ (mirror[:, None] * np.asarray(one.stiffness) * mirror) @ shift
    return np.diag(total)


def axial_forces(solution):
    return np.asarray([one.force[0] for one in solution.bearings.values()])


def gear_shaft(picture="<>", strain=0.0, expansion=0.0, support=None, states=()):
    """Section 8 of the sheet."""
    sections = [Section(60e-3, 35e-3), Section(80e-3, 45e-3), Section(60e-3, 35e-3)]
    pinion = Gear("pinion", 100e-3, 50e-3, 100.0, np.radians(30.0), np.radians(20.0), np.radians(15.0))
    front = MatchedSet("front", picture, AC, 28.5e-3, 17e-3, Preload(force=200.0), expansion=expansion, support=support)
    return ShaftSystem(
        Shaft(6000 * RPM, sections, gravity=Gravity(9.81), thermal_strain=strain),
        sets=[front],
        bearings=[MountedBearing("rear", NU, 180e-3, support=support)],
        forces=[pinion, Mass("wheel", 100e-3, 4.0)],
        states=states,
    )


def two_deep_grooves(axial=0.0, clearance=12e-6, modulus=206e9, rigid=False):
    """C4a of the sheet."""
    scene = DEEP_GROOVE.replace_geometry(diametral_clearance=clearance)
    sections = [] if rigid else [Section(200e-3, 25e-3)]
    return ShaftSystem(
        Shaft(6000 * RPM, sections, steel(modulus)),
        bearings=[MountedBearing("A", scene, 20e-3), MountedBearing("B", scene, 180e-3)],
        forces=[PointLoad("load", 80e-3, axial=axial, radial=2000.0)],
    )

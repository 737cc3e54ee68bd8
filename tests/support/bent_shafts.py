"""Bearings with flexible rings and races that are not round, on shafts."""

import dataclasses

import jax.numpy as jnp
import numpy as np
from rings_that_bend import lobes
from shaft_cases import DEEP_GROOVE, NU

import jaxbearing as jb
from jaxbearing.bearings.bearing import AbstractBearing
from jaxbearing.bearings.ring_shape import FlexibleInnerRing, FlexibleRing, InnerRoundness, OuterRoundness
from jaxbearing.bearings.row import AbstractRow
from jaxbearing.shafts import LinearBearing, MountedBearing, PointLoad, Shaft, ShaftSystem
from jaxbearing.shafts.batches import on_shaft

SPEED = 300.0
"""Of all shafts here, rad/s."""
HOUSING = {"thickness": 4e-3, "width": 14e-3, "harmonics": 3, "housing_stiffness": 5e9}
SUPPORTS = {
    **{"thickness": 4e-3, "width": 14e-3, "harmonics": 3, "support_angle": [-0.7, 0.7, 3.1]},
    **{"support_stiffness": [2e8, 2e8, 2e8], "support_gap": [0.0, -2e-6, 5e-6]},
}
SHAFT = {"thickness": 4e-3, "width": 14e-3, "harmonics": 2, "shaft_stiffness": 8e9}
"""Of an inner ring."""
FOUR_POINT = jb.load_scene("four_point_qj", {"contact": "none", "kinematics.attitude": "linear_slip"})
TAPERED = jb.load_scene("tapered_example", {"contact": "none"})
BEARINGS = {"ball": DEEP_GROOVE, "four_point": FOUR_POINT, "cylindrical": NU, "tapered": TAPERED}


def bent(scene: AbstractBearing, height=3e-6, inner=None, **ring) -> AbstractBearing:
    """A bearing whose outer ring bends, whose inner ring bends where `inner` says how, and whose races have lobes
    beside the load line."""
    return dataclasses.replace(
        scene,
        outer_ring=FlexibleRing(**(ring or HOUSING)),
        inner_ring=None if inner is None else FlexibleInnerRing(**inner),
        inner_roundness=lobes(InnerRoundness, 2, 2e-6, 0.3),
        outer_roundness=lobes(OuterRoundness, 3, height, 0.1),
        rating=None,
    )


def straight(scene: AbstractBearing, axial=0.0, radial=2e3) -> ShaftSystem:
    """A rigid shaft on one bearing, that something else keeps from tilting."""
    # a cylindrical bearing carries nothing along the axis
    hold = np.diag([0.0 if axial else 1e6, 0.0, 0.0, 1e13, 1e13])
    bearings = [MountedBearing("bearing", scene, 0.0), MountedBearing("guide", LinearBearing(hold), 0.0)]
    return ShaftSystem(Shaft(SPEED), bearings=bearings, forces=[PointLoad("load", 0.0, axial=axial, radial=radial)])


def alone(scene: AbstractBearing, axial=0.0, radial=2e3) -> AbstractBearing:
    """The bearing of `straight` under these loads, without a shaft; its ring may move sideways."""
    changes = {"operation.inner_speed": SPEED, "operation.radial_load": radial, "operation.radial_load_lateral": 0.0}
    return scene.replace(changes | ({"operation.axial_load": axial} if axial else {}))


def row_of(scene: AbstractBearing) -> AbstractRow:
    """The row of a bearing on a shaft; its inner raceway has grown by 1 um."""
    return on_shaft(scene, jnp.asarray(SPEED)).row(jnp.asarray(1e-6))

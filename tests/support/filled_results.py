"""Results without a solve: their structure comes from tracing, which takes seconds, their numbers are made up.

For tests of what is done with results: whatever the solution of a scene holds is in them.
"""

import dataclasses
import itertools
import typing

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from life_page import page_scene
from warm_cases import warm

import jaxbearing as jb
from jaxbearing.bearings.ball.motion.results import BallEnergy, BallInstant, LooseBallPowerLoss
from jaxbearing.bearings.cylindrical.motion.results import RollerEnergy, RollerInstant
from jaxbearing.bearings.motion.history import History
from jaxbearing.bearings.ring_shape import FlexibleInnerRing, FlexibleRing
from jaxbearing.bearings.warming.history import WarmUpHistory
from jaxbearing.bearings.warming.programs import instants_at
from jaxbearing.ehl import LineContactHistory
from jaxbearing.numerics.newton import NewtonOptions
from jaxbearing.numerics.precision import as_float
from jaxbearing.report.labels import dimensions
from jaxbearing.solve import _solve_any
from jaxbearing.tolerance.derivatives import Slopes, computed
from jaxbearing.tolerance.results import values_of

NODES, INSTANTS = 41, 6
"""Sizes of a run of a line contact."""
_RATING = {
    "rating.roughness_rings": "0.1 um",
    "rating.roughness_elements": "0.2 um",
    "rating.cleanliness": "online_filter_15",
}
_ROUGH = {"contact.mixed.roughness": "0.2 um"}
_CAGE = {
    "cage.guidance": "inner_ring",
    "cage.guiding_clearance": "0.3 mm",
    "cage.pocket_clearance": "0.3 mm",
    "cage.land_width": "2 mm",
}

SCENES = {
    "ball": lambda: jb.load_scene(
        "turbine_ball_mounted", {"kinematics.gyroscopic": "resolved", "contact.heathcote": "true", **_ROUGH, **_RATING}
    ),
    "ball with four contacts": lambda: jb.load_scene(
        "turbine_ball_mounted",
        {"geometry.shim_inner": "10 deg", "geometry.shim_outer": "10 deg", "contact.heathcote": "true"}
        | _ROUGH
        | _RATING,
    ),
    "dry ball": lambda: jb.load_scene("deep_groove_6205", {"operation.axial_load": "none"}),
    "roller": lambda: jb.load_scene(
        "turbine_roller", {"contact.rolling_resistance": "ertel_grubin", **_ROUGH, **_RATING}
    ),
    "dry roller": lambda: jb.load_scene("turbine_roller", dict.fromkeys(("contact", "cage", "flange", "drag"), "none")),
    "flexible roller": lambda: flexible_roller(),
    "misaligned roller": lambda: page_scene(),
    "tapered": lambda: jb.load_scene("tapered_example", {"contact.supply.layer": "2 um", **_CAGE, **_ROUGH, **_RATING}),
    "one temperature": lambda: warm("roller", 1),
    "four temperatures": lambda: warm("roller", 4, stability="true"),
    "six temperatures": lambda: warm(
        "roller", 6, fits__shaft_interference="30 um", capacity__shaft="800 J/K", capacity__housing="4000 J/K"
    ),
    "two-disk": lambda: jb.load_scene("two_disk_etm"),
    "warm two-disk": lambda: jb.load_scene("two_disk_mobil_jet_ii", {"contact.film_heating": "true"}),
    "line contact": lambda: jb.load_scene("satellite_contact_1"),
}
"""Every kind of scene, with all of its optional parts (several where parts exclude each other) and with none."""


def flexible_roller():
    """Dry rollers between a ring on a housing and a support, and a ring on a soft shaft."""
    ring = FlexibleRing(
        thickness=8e-3,
        harmonics=3,
        housing_stiffness=1e10,
        support_angle=[0.0],
        support_stiffness=[1e8],
        support_gap=[0.0],
    )
    inner = FlexibleInnerRing(thickness=6e-3, harmonics=2, shaft_stiffness=1e10)
    return dataclasses.replace(SCENES["dry roller"](), outer_ring=ring, inner_ring=inner)


_traced: list[tuple[typing.Any, typing.Any]] = []


def structure_of(scene):
    """The solution of a scene with shapes for arrays; traced once for each structure of a scene."""
    scene = jax.tree.map(as_float, scene)
    key = jax.tree.structure(scene), [np.shape(leaf) for leaf in jax.tree.leaves(scene)]
    found = next((one for known, one in _traced if known == key), None)
    if found is None:
        found = jax.eval_shape(lambda one: _solve_any(one, NewtonOptions()), scene)
        _traced.append((key, found))
    return found


def filled(structure, lanes=()):
    """A result of this structure that converged, every number another one; unloaded contacts have no film.

    **Arguments:** `lanes`: shape of a batch of them.
    """
    count = itertools.count(1)

    def number(path, leaf):
        name = jax.tree_util.keystr(path, simple=True, separator=".")
        shape = (*lanes, *leaf.shape)
        if not jnp.issubdtype(leaf.dtype, jnp.floating):
            return jnp.zeros(shape, leaf.dtype)
        values = np.full(shape, 1.0 + 0.25 / next(count)) * np.linspace(1.0, 1.01, int(np.prod(shape))).reshape(shape)
        last = name.rpartition(".")[2]
        if last == "azimuth" and shape:
            values = np.broadcast_to(2.0 * np.pi * np.arange(shape[-1]) / shape[-1], shape)
        elif last in ("x", "time"):
            values = np.broadcast_to(np.linspace(-2.0 if last == "x" else 0.0, 2.0, shape[-1]), shape) if shape else 2.0
        elif "film_" in last and leaf.ndim == 1:
            values = np.where(np.arange(shape[-1]) == shape[-1] - 1, np.nan, values)
        return jnp.asarray(values)

    return jax.tree_util.tree_map_with_path(number, structure)


def solution_of(scene, lanes=()):
    """A solution of a scene. The operating point is the scene's."""
    found = filled(structure_of(scene), lanes)
    point = getattr(scene, scene.operating_point)
    operation = jax.tree.map(lambda leaf: jnp.broadcast_to(as_float(leaf), (*lanes, *np.shape(leaf))), point)
    return eqx.tree_at(lambda one: one.operation, found, operation, is_leaf=lambda leaf: leaf is None)


def history_of(scene, duration=1e-3):
    """A run of a scene, with every field that its classes have; of temperatures, those that its scene has."""
    if getattr(scene, "thermal", None) is not None:
        return _warm_history(scene, duration)
    if isinstance(scene, jb.CylindricalRollerBearing | jb.BallBearing):
        rollers = isinstance(scene, jb.CylindricalRollerBearing)
        instant, energy = (RollerInstant, RollerEnergy) if rollers else (BallInstant, BallEnergy)
        parts = {"element_state": len(instant.element_state), "cage_state": len(instant.cage_state)}
        sizes = {"element": scene.n_elements, "land": 2, "groove_angle": len(instant.groove_angles)} | parts
        given = {} if rollers else {"power_loss": _by_annotation(LooseBallPowerLoss, sizes)}
        instants = filled(_by_annotation(instant, sizes, **given), (INSTANTS,))
        found = filled(
            _by_annotation(
                History,
                sizes | {"time": INSTANTS},
                instants=None,
                energy=_by_annotation(energy, sizes),
                solver="dopri5",
            )
        )
        found = eqx.tree_at(lambda run: run.instants, found, instants, is_leaf=lambda leaf: leaf is None)
    else:
        sizes = {"time": INSTANTS, "node": NODES, "last_time": 3, "last_step": 2}
        found = filled(_by_annotation(LineContactHistory, sizes))
    time = jnp.linspace(0.0, duration, INSTANTS)
    return eqx.tree_at(
        lambda run: (run.time, run.stop, run.operation),
        found,
        (time, time[-1], scene.operation),
        is_leaf=lambda leaf: leaf is None,
    )


def _warm_history(scene, duration):
    """A run of the temperatures of a scene."""
    scene = jax.tree.map(as_float, scene)
    time = jnp.linspace(0.0, duration, INSTANTS)
    nodes = jnp.full((INSTANTS, scene.thermal.nodes), 300.0)
    seen = jax.eval_shape(instants_at, scene, jb.WarmUpSimulation(), time, nodes)
    given = {"nodes": scene.thermal.node_names, "notes": ("a note",), "element_name": scene.element}
    found = filled(_by_annotation(WarmUpHistory, {"time": INSTANTS}, instants=seen.instant, **given))
    if scene.fits is None:
        peaks = dataclasses.replace(found.peaks, least_play=None, least_play_time=None)
        found = dataclasses.replace(found, peaks=peaks)
    return dataclasses.replace(found, time=time, stop=time[-1], operation=scene.operation)


def _by_annotation(kind, sizes, **given):
    """A part of a result with shapes for arrays, as the annotations of its fields say."""
    made = object.__new__(kind)  # its own checks would want numbers
    for field in dataclasses.fields(kind):
        object.__setattr__(made, field.name, given[field.name] if field.name in given else _field(field, sizes))
    return made


def _field(field, sizes):
    if field.name == "identity":
        return None  # made of the scene, not of annotations; tests/bearings/motion/test_restart.py has it
    parts = [one for one in (field.type, *typing.get_args(field.type)) if dataclasses.is_dataclass(one)]
    if parts:
        return _by_annotation(parts[0], sizes)
    if field.name == "checks":
        return {"beyond a range": jax.ShapeDtypeStruct((), bool)}
    if field.metadata.get("static", False) or field.type is typing.Any:
        return None if field.default is dataclasses.MISSING else field.default
    whole = "int64" in getattr(field.type, "dtypes", ())
    shape = tuple(sizes[name] for name in dimensions(field.type))
    return jax.ShapeDtypeStruct(shape, jnp.int64 if whole else jnp.float64)


def slopes_of(scene, numbers, wanted, options):
    """Stands for `tolerance.derivatives.slopes_at`: made up results, each with a slope by each number."""
    solution = solution_of(scene.replace(dict(numbers)))
    values = values_of(solution, computed(solution, wanted))
    slopes = {path: jnp.asarray(0.1 * place) for place, path in enumerate(numbers, 1)}
    return Slopes(solution, values, dict.fromkeys(values, slopes))


class MadeUpProgram:
    """Stands for `lanes.LaneProgram`: made up results of every lane."""

    def __init__(self, make, base, example, **_):
        self.scene = make(base, example)
        self.structure = structure_of(self.scene)

    def __call__(self, inputs, active, progress=lambda lanes: None):
        progress(len(active))
        return solution_of(self.scene, (len(active),))

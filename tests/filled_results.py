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

import jaxbearing as jb
from jaxbearing.bearings.roller_simulation import _lane
from jaxbearing.ehl import LineContactHistory
from jaxbearing.numerics.newton import NewtonOptions
from jaxbearing.numerics.precision import as_float
from jaxbearing.report.labelled import dimensions
from jaxbearing.solve import _solve_any

NODES, INSTANTS = 41, 6
"""Sizes of a run of a line contact."""
_RATING = {
    "rating.roughness_rings": "0.1 um",
    "rating.roughness_elements": "0.2 um",
    "rating.cleanliness": "online_filter_15",
}

SCENES = {
    "ball": lambda: jb.load_scene("turbine_ball", _RATING),
    "ball with all of its motion": lambda: jb.load_scene(
        "turbine_ball", {"kinematics.gyroscopic": "resolved", "contact.heathcote": "true"}
    ),
    "radial ball": lambda: jb.load_scene("deep_groove_6205", {"operation.axial_load": "none", **_RATING}),
    "roller": lambda: jb.load_scene("turbine_roller", {"contact.rolling_resistance": "ertel_grubin", **_RATING}),
    "dry roller": lambda: jb.load_scene("turbine_roller", dict.fromkeys(("contact", "cage", "flange", "drag"), "none")),
    "misaligned roller": lambda: page_scene(),
    "tilting roller": lambda: page_scene({"operation.misalignment": "none", "operation.moment": "0 N*m"}),
    "tapered": lambda: jb.load_scene("tapered_example", _RATING),
    "dry tapered": lambda: jb.load_scene("tapered_example", {"contact": "none", "rating": "none", "drag": "none"}),
    "two-disk": lambda: jb.load_scene("two_disk_etm"),
    "warm two-disk": lambda: jb.load_scene("two_disk_mobil_jet_ii", {"contact.film_heating": "true"}),
    "line contact": lambda: jb.load_scene("satellite_contact_1"),
}
"""Every kind of scene, with all of its optional parts (several where parts exclude each other) and with none."""

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
        values = np.full(shape, 1.0 + 0.25 / next(count)) * np.linspace(1.0, 1.01, max(1, int(np.prod(shape)))).reshape(
            shape
        )
        last = name.rpartition(".")[2]
        if last == "azimuth":
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
    operation = jax.tree.map(lambda leaf: jnp.broadcast_to(as_float(leaf), (*lanes, *np.shape(leaf))), scene.operation)
    return eqx.tree_at(lambda one: one.operation, found, operation, is_leaf=lambda leaf: leaf is None)


def history_of(scene, duration=1e-3):
    """A run of a scene."""
    if isinstance(scene, jb.CylindricalRollerBearing):
        times = jnp.linspace(0.0, duration, INSTANTS)
        structure = jax.eval_shape(lambda one: _lane(one, None, times), jax.tree.map(as_float, scene))
    else:
        structure = _by_annotation(LineContactHistory)
    time = jnp.linspace(0.0, duration, structure.time.shape[0])
    where = lambda run: (run.time, run.stop, run.operation)
    return eqx.tree_at(where, filled(structure), (time, time[-1], scene.operation))


def _by_annotation(annotation):
    """A part of a result with shapes for arrays, as the annotations of its fields say."""
    sizes = {"time": INSTANTS, "node": NODES, "last_time": 3, "last_step": 2}
    fields = {}
    for field in dataclasses.fields(annotation):
        if dataclasses.is_dataclass(field.type):
            fields[field.name] = _by_annotation(field.type)
        elif field.name == "checks":
            fields[field.name] = {"beyond a range": jax.ShapeDtypeStruct((), bool)}
        elif not field.metadata.get("static", False):
            whole = field.name in ("status", "accepted", "rejected", "newton_steps", "known")
            shape = tuple(sizes[name] for name in dimensions(field.type))
            fields[field.name] = jax.ShapeDtypeStruct(shape, jnp.int64 if whole else jnp.float64)
    return _unchecked(annotation, fields)


def _unchecked(kind, fields):
    """An instance that holds shapes where its class wants numbers."""
    made = object.__new__(kind)
    for field in dataclasses.fields(kind):
        default = None if field.default is dataclasses.MISSING else field.default
        object.__setattr__(made, field.name, fields.get(field.name, default))
    return made

"""A whole bearing by the accuracy of the traction that its scene names."""

import dataclasses
import time

import equinox as eqx
import jax
import numpy as np
from benchmark_tools import best_time, error_of

import jaxbearing as jb
from jaxbearing.contacts.resolution import PRESETS, Resolution

FINEST = Resolution(2400, 96, extrapolate=True)
"""What the errors are against: twice the steps of the finest preset, and extrapolated."""


def rows(name, results, accuracies=tuple(PRESETS), repeats=5):
    """Accuracy asked, largest relative error, seconds of the first and milliseconds of a warm solve of a scene.

    `results(solution)` are the numbers compared.
    """
    exact = np.asarray(results(jb.jit_solver(with_resolution(jb.load_scene(name), FINEST))()))
    return tuple(_row(name, results, accuracy, exact, repeats) for accuracy in accuracies)


def with_resolution(scene, resolution):
    """The same scene with another march."""
    traction = dataclasses.replace(scene.contact.traction, resolution=resolution)
    return eqx.tree_at(lambda s: s.contact.traction, scene, traction)


def _row(name, results, accuracy, exact, repeats):
    fast = jb.jit_solver(jb.load_scene(name, {"contact.traction_accuracy": f"{accuracy:g}"}))
    begin = time.perf_counter()
    found = np.asarray(results(jax.block_until_ready(fast())))
    first = time.perf_counter() - begin
    return accuracy, error_of(found, exact), first, 1e3 * best_time(fast, repeats)

"""A whole bearing by the accuracy of the traction that its scene names."""

import dataclasses
import time
from concurrent.futures import ThreadPoolExecutor

import equinox as eqx
import jax
import numpy as np
from benchmark_tools import best_time, error_of

import jaxbearing as jb
from jaxbearing.contacts.resolution import PRESETS, Resolution

FINEST = Resolution(2400, 288, extrapolate=True)
"""What the errors are against: twice the steps and half as many strips again as the finest preset, and extrapolated."""


def rows(name, results, accuracies=tuple(PRESETS), repeats=5):
    """Accuracy asked, largest relative error, seconds of the first and milliseconds of a warm solve of a scene.

    `results(solution)` are the numbers compared. The first accuracy is compiled alone and its first solve timed; the
    others, whose programs differ in the length of a loop, two at a time.
    """
    solvers = [jb.jit_solver(jb.load_scene(name, {"contact.traction_accuracy": f"{one:g}"})) for one in accuracies]
    finest = jb.jit_solver(with_resolution(jb.load_scene(name), FINEST))
    begin = time.perf_counter()
    jax.block_until_ready(solvers[0]())
    first = time.perf_counter() - begin
    with ThreadPoolExecutor(2) as pool:
        exact, *_ = [np.asarray(results(found)) for found in pool.map(lambda solve: solve(), [finest, *solvers[1:]])]
    return tuple(
        (
            accuracy,
            error_of(results(fast()), exact),
            first if fast is solvers[0] else None,
            1e3 * best_time(fast, repeats),
        )
        for accuracy, fast in zip(accuracies, solvers, strict=True)
    )


def with_resolution(scene, resolution):
    """The same scene with another march."""
    traction = dataclasses.replace(scene.contact.traction, resolution=resolution)
    return eqx.tree_at(lambda s: s.contact.traction, scene, traction)

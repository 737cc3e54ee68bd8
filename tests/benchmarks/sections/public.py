"""Public packages that do a part of the same job: tamaas (boundary elements) and ROSS (stiffness for rotordynamics).

They come with the extra `rivals`; where one is not installed its rows say so.
"""

import importlib.util

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from benchmark_tools import best_time
from section_shape import Section, Table

import jaxbearing as jb
from jaxbearing.contacts.point import PointContact

BALL, RACE = 3.97e-3, 4.13e-3
"""Radius of a ball of the 6205 and of its groove, m."""
ROLLING = 1.0 / (1.0 / BALL + 1.0 / 15.53e-3)
TRANSVERSE = 1.0 / (1.0 / BALL - 1.0 / RACE)
MODULUS, LOAD = 2.2e11, 500.0
"""E', Pa, and N."""
MESHES = (32, 64, 128)
MARGIN = 1.25
"""Length of the mesh over that of the ellipse."""
LOADS = (200.0, 1e3, 5e3)
"""Radial loads of the 6205, N."""


def section(quick=False):
    contact = PointContact(jnp.asarray(ROLLING), jnp.asarray(TRANSVERSE), jnp.asarray(MODULUS))
    solve = eqx.filter_jit(lambda contact, load: contact.ellipse(load))
    load = jnp.asarray(LOAD)
    exact = solve(contact, load)
    seconds = best_time(lambda: solve(contact, load), 20)
    contacts: list[tuple] = [("closed ellipse", None, 0.0, 1e3 * seconds, 1.0)]
    facts = {}
    if importlib.util.find_spec("tamaas"):
        for n in MESHES[:2] if quick else MESHES:
            pressure, theirs = boundary_elements(exact, n)
            error = abs(pressure / float(exact.pressure) - 1.0)
            contacts.append(("tamaas", n, error, 1e3 * theirs, theirs / seconds))
            facts[f"Hertz pressure of tamaas, {n} x {n}, off by"] = error
            facts[f"tamaas, {n} x {n}, times our time"] = theirs / seconds
    else:
        contacts.append(("tamaas: not installed", None, None, None, None))
    stiffness = []
    for force in LOADS[:1] if quick else LOADS:
        ours, solving = radial_stiffness(force)
        row: tuple = (force, ours, 1e3 * solving, None, None, None)
        if importlib.util.find_spec("ross"):
            theirs, making = ross_stiffness(force)
            row = (*row[:3], theirs, 1e3 * making, theirs / ours)
            facts[f"stiffness of ROSS over ours at {force:g} N"] = theirs / ours
        stiffness.append(row)
    return Section(
        "Public packages",
        "tamaas solves the contact of a ball of the 6205 with its inner groove by boundary elements on n x n nodes "
        "that cover 1.25 times the ellipse; the ellipse of Hertz has a closed form. ROSS takes the stiffness of a ball "
        "bearing from an empirical formula of load, number and size of the balls; ours is that of the equilibrium, "
        "without clearance. EXUDYN moves ball bearings in time: tests/benchmarks/exudyn_rival.py compares it.",
        (
            Table(
                f"Peak pressure under {LOAD:g} N:",
                ("", "n", "error of the pressure", "ms", "times ours"),
                tuple(contacts),
            ),
            Table(
                "Radial stiffness of the 6205, N/m:",
                ("radial load, N", "ours", "ms a solve", "ROSS", "ms", "ROSS over ours"),
                tuple(stiffness),
            ),
        ),
        facts,
    )


def boundary_elements(ellipse, n):
    """Peak pressure, Pa, and seconds, by tamaas on n x n nodes, not periodic."""
    import tamaas

    tamaas.set_log_level(tamaas.LogLevel.error)
    size = [2.0 * MARGIN * float(axis) for axis in (ellipse.rolling, ellipse.transverse)]
    x, y = (((np.arange(n) + 0.5) / n - 0.5) * length for length in size)
    surface = -(x[:, None] ** 2 / (2.0 * ROLLING) + y[None, :] ** 2 / (2.0 * TRANSVERSE))

    def run():
        model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, size, [n, n])
        model.E, model.nu = 0.5 * MODULUS, 0.0
        tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver = tamaas.PolonskyKeerRey(model, surface, 1e-12)
        solver.setIntegralOperator("dcfft")
        solver.solve(LOAD / (size[0] * size[1]))
        return float(np.max(model.traction))

    return run(), best_time(run, 2)


def radial_stiffness(force):
    """Of the dry 6205 under a radial load alone, N/m, and seconds a solve."""
    scene = jb.load_scene(
        "deep_groove_6205",
        {
            "operation.axial_load": "none",
            "operation.moment": "none",
            "geometry.diametral_clearance": "0 um",
            "operation.inner_speed": "0 rpm",
            "rating": "none",
        },
    )
    solver = jb.jit_solver(scene)
    found = solver(radial_load=force)
    assert bool(found.converged)
    return float(found.stiffness[1, 1]), best_time(lambda: solver(radial_load=force), 20)


def ross_stiffness(force):
    """Along the load, N/m, and seconds."""
    import ross

    geometry = jb.load_scene("deep_groove_6205").geometry
    make = lambda: ross.BallBearingElement(
        n=0, n_balls=int(geometry.n_balls), d_balls=float(geometry.ball_diameter), fs=force, alpha=0.0
    )
    return float(np.asarray(make().kyy).ravel()[0]), best_time(make, 5)

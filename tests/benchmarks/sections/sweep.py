"""Sweeps: throughput on one device and on all, beside single solves."""

import numpy as np
from benchmark_report import HERE, load
from section_shape import Section, Table

import jaxbearing as jb
from jaxbearing.sweeps.plan import LANES as DEFAULT_LANES

SCENES = ("reference_roller", "tapered_example")


def section(quick=False):
    script = load(HERE / "sweep.py")
    rows, errors, failed, alike = [], [], 0, True
    for name in SCENES[: 1 if quick else None]:
        _, ranges, result = script.CASES[name]
        count = 60 if quick else 500
        figures = script.row(jb.load_scene(name), name, ranges, result, count, (DEFAULT_LANES,), files=False)
        alike = alike and figures["same bits"]
        for (devices, lanes), one in figures["lanes"].items():
            failed += one["failed"]
            errors.append(one["error"])
            speed = figures["single"] / one["seconds"]
            rows.append((name, devices, lanes, 1.0 / one["seconds"], one["first"], one["error"], one["failed"], speed))
    return Section(
        "Sweeps",
        "Cases a second of `jaxbearing.sweep`'s engine, errors against single solves, which 'times' compares with too.",
        (
            Table(
                "500 cases (60 in the quick report):",
                ("scene", "devices", "lanes", "cases a second", "first call, s", "error", "failed", "times"),
                tuple(rows),
            ),
        ),
        {
            "failed": float(failed),
            "largest error": float(np.max(errors)),
            "same bits on any number of devices": float(alike),
        },
    )

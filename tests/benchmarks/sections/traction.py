"""Traction of one contact: the march through the Hertz pressure against Radau on each strip."""

import jax.numpy as jnp
import numpy as np
from benchmark_report import HERE, load
from benchmark_tools import time_at
from section_shape import Section, Table

from jaxbearing.contacts import PRESETS
from jaxbearing.contacts.resolution import Resolution


def section(quick=False):
    script = load(HERE / "traction.py")
    cases = jnp.asarray(script.CASES)
    exact = np.asarray(script.batched(script.coefficient, Resolution(2048, 64, True), len(cases))(cases))
    presets = dict(list(PRESETS.items())[: 2 if quick else None])
    ours = script.our_rows(list(presets.values()), exact, (1, 1000), 0.3)
    settings = [(8, 1e-2)] if quick else [(8, 1e-2), (8, 1e-3), (12, 1e-4), (16, 1e-5), (24, 1e-6)]
    rival = script.radau_rows(settings, exact, 1)
    # what errors are counted from
    facts = {"finest march off Radau": script.radau_rows([(32, 1e-9)], exact, 1)[32, 1e-9][0]}
    rows = []
    for accuracy, resolution in presets.items():
        row = ours[resolution]
        its = time_at(row["error"], list(rival.values()))
        batch = row["seconds"].get(1000)
        ratio = None if its is None or batch is None else its / batch
        facts[f"error at accuracy {accuracy:g}"] = row["error"]
        if ratio is not None:
            facts[f"times Radau at accuracy {accuracy:g}"] = ratio
        single = 1e6 * row["seconds"][1]
        rows.append(
            (accuracy, str(tuple(resolution)), row["error"], row["compile"], single, batch and 1e6 * batch, ratio)
        )
    columns = (
        "accuracy asked",
        "steps, strips, extrapolated",
        "largest error",
        "compile, s",
        "alone, us",
        "of 1000, us",
    )
    return Section(
        "Traction of a contact",
        "Elliptical contacts of the cases in `traction.py`, oil with pressure-dependent modulus and Eyring stress. The "
        "rival solves each strip with scipy's Radau; times compares batches of 1000 with Radau at the same error, "
        "interpolated between its tolerances, or with its fastest run where all are more exact.",
        (
            Table("The presets:", (*columns, "times"), tuple(rows)),
            Table(
                "Radau:",
                ("strips", "tolerance", "largest error", "us a contact"),
                tuple((strips, tolerance, error, 1e6 * s) for (strips, tolerance), (error, s) in rival.items()),
            ),
        ),
        facts,
    )

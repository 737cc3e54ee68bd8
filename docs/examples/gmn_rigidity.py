"""Axial rigidity of spindle bearing pairs at 771 printed preloads, with one fitted conformity for each series.

    python docs/examples/gmn_rigidity.py

Of 257 spindle bearings GMN prints the number and size of the balls, the pitch diameter, the contact angle and the axial
rigidity of a pair at three preloads, but no conformity. One conformity of both grooves is fitted to each series, by
Gauss and Newton's method with the exact derivative of every rigidity. Young's modulus is 208 GPa.

Two equal bearings that press each other with the force F have twice the axial stiffness of one under the axial load F.
All balls of a bearing carry the same, so that Z balls under F are as three under 3F/Z: with three balls in each bearing
all of them are one program, and one batched call solves them.
"""

import csv
from pathlib import Path
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

import jaxbearing as jb

FILE = Path(__file__).parent / "gmn_spindle_bearings.csv"
LEVELS = ("L", "M", "S")
"""Light, medium and heavy preload."""
BALLS = 3
FIRST, STEPS = 0.53, 6
"""First conformity, and steps of the fit."""
STEEL = {"youngs_modulus": 208e9, "poisson_ratio": 0.3, "density": 7850.0}
BEARING = {
    "kind": "ball_bearing",
    "geometry": {
        "n_balls": BALLS,
        "ball_diameter": 6.35e-3,
        "pitch_diameter": 65e-3,
        "contact_angle": 0.3,
        "conformity_inner": FIRST,
        "conformity_outer": FIRST,
    },
    "materials": {"rings": STEEL, "balls": STEEL},
    "kinematics": {"attitude": "outer"},
    "operation": {"inner_speed": 0.0, "axial_load": 180.0},
}
"""A bearing at rest; its sizes and load are those of the catalogue."""


class Printed(NamedTuple):
    """One number a preload: 3 for each bearing. SI."""

    bearing: np.ndarray
    """Number of the bearing in the catalogue."""
    series: np.ndarray
    """Name of its series with the contact angle, such as "KH 17"."""
    level: np.ndarray
    ball: np.ndarray
    pitch: np.ndarray
    angle: np.ndarray
    balls: np.ndarray
    preload: np.ndarray
    rigidity: np.ndarray


def printed() -> Printed:
    """The catalogue."""
    lines = FILE.read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    each = [(number, row, level) for number, row in enumerate(rows) for level in LEVELS]
    column = lambda of: np.asarray([of(row) for _, row, _ in each])
    value = lambda name: column(lambda row: float(row[name]))
    return Printed(
        bearing=np.asarray([number for number, _, _ in each]),
        series=column(lambda row: f"{row['designation'].split()[0]} {float(row['alpha0_deg']):g}"),
        level=np.asarray([level for _, _, level in each]),
        ball=1e-3 * value("Dw"),
        pitch=1e-3 * value("dm"),
        angle=np.radians(value("alpha0_deg")),
        balls=value("Z"),
        preload=np.asarray([float(row[f"Fv_{level}"]) for _, row, level in each]),
        rigidity=1e6 * np.asarray([float(row[f"Cax_{level}"]) for _, row, level in each]),
    )


SCENE = jb.scene_from_mapping(BEARING)


def rigidity(conformity, ball, pitch, angle, balls, preload):
    """Axial rigidity of a pair, N/m. **Arguments:** one number each, SI."""
    geometry = {
        "ball_diameter": ball,
        "pitch_diameter": pitch,
        "contact_angle": angle,
        "conformity_inner": conformity,
        "conformity_outer": conformity,
    }
    changes = {f"geometry.{name}": value for name, value in geometry.items()}
    one = jb.solve(SCENE.replace(changes | {"operation.axial_load": preload * BALLS / balls}), throw=False)
    return 2.0 * balls / BALLS * one.stiffness[0, 0]


@jax.jit
def rigidities(conformity, *given):
    """Axial rigidities of all pairs, N/m, and their derivatives by the conformity: one batched call."""
    of_one = lambda conformity, *given: jax.jvp(lambda f: rigidity(f, *given), (conformity,), (1.0,))
    return jax.vmap(of_one)(conformity, *given)


class Fit(NamedTuple):
    """Conformity of each group, and the rigidity of every row over the printed one, less 1."""

    conformity: np.ndarray
    deviation: np.ndarray


def fit(data: Printed, group: np.ndarray, used: np.ndarray) -> Fit:
    """One conformity for each group of rows, by least squares of the relative deviations.

    **Arguments:** `group`: number of each row's group; `used`: which rows are fitted; the others are predicted.
    """
    given = [jnp.asarray(one) for one in (data.ball, data.pitch, data.angle, data.balls, data.preload)]
    conformity = np.full(group.max() + 1, FIRST)
    total = lambda values: np.bincount(group, np.where(used, values, 0.0))
    for _ in range(STEPS):
        found, slope = (np.asarray(one) / data.rigidity for one in rigidities(jnp.asarray(conformity[group]), *given))
        deviation = found - 1.0
        conformity = conformity - total(deviation * slope) / total(slope**2)
    found, _ = rigidities(jnp.asarray(conformity[group]), *given)
    return Fit(conformity, np.asarray(found) / data.rigidity - 1.0)


def main() -> None:
    data = printed()
    names, group = np.unique(data.series, return_inverse=True)
    every = np.ones(len(group), bool)
    fits = {"all": fit(data, group, every), "medium": fit(data, group, data.level == "M")}
    percent = lambda rows, deviation: 100.0 * np.sqrt(np.mean(deviation[rows] ** 2))
    print(f"{len(group)} preloads of {data.bearing.max() + 1} bearings; rms deviation of the pair's rigidity, %")
    print("                    fitted to all three levels          fitted to the medium level")
    print("series  bearings  conformity  light medium heavy   all  conformity  light heavy (predicted)")
    for number, name in enumerate(names):
        mine = group == number
        line = f"{name:<6}  {mine.sum() // 3:8d}"
        for one, levels in (("all", LEVELS), ("medium", ("L", "S"))):
            found = fits[one]
            line += f"  {found.conformity[number]:10.4f} "
            line += "".join(f"{percent(mine & (data.level == level), found.deviation):6.1f}" for level in levels)
            line += f"{percent(mine, found.deviation):6.1f}" if one == "all" else ""
        print(line)


if __name__ == "__main__":
    main()

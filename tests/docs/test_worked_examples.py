"""The worked examples, from the command line as they are printed, beside the numbers of their tables.

Each command runs with its solver and `--json`. A row of a table has a printed number, ours, and the deviation: both are
those of the command, to the last digit that the page shows.
"""

import csv
import json
import math
import re
import shlex
import shutil
from pathlib import Path

import jax
import numpy as np
import pytest
from makers_tables import spindle_bearings

import jaxbearing as jb
from jaxbearing.cli.main import main
from jaxbearing.contacts import PointContact
from jaxbearing.life import ball_capacity, ball_static_capacity

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "worked_examples.md").read_text(encoding="utf-8")
POUND, INCH = 4.4482216152605, 25.4e-3
PSI = POUND / INCH**2


def sections():
    """By title, the commands and the rows of tables with a printed number."""
    found = {}
    for title, text in re.findall(r"^## (.+?)\n(.*?)(?=^## |\Z)", PAGE, flags=re.MULTILINE | re.DOTALL):
        blocks = re.findall(r"^```sh\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
        commands = [shlex.split(line)[1:] for block in blocks for line in block.splitlines()]
        tables = re.findall(r"^\| quantity .*?\n\|[-|]+\n(.*?)\n\n", text, flags=re.MULTILINE | re.DOTALL)
        rows = [
            [cell.strip() for cell in line.strip("|").split("|")] for table in tables for line in table.splitlines()
        ]
        found[title] = commands, rows
    return found


SECTIONS = sections()


def largest(found):
    return max(found["elements"]["load_inner"])


def angle_of(found, race):
    return math.degrees(found["elements"][f"contact_angle_{race}"][0])


# of each section, what its rows are, from what its commands print
EXAMPLES = {
    "Bearings of a pump: NU 311 and 7312-B": lambda nu, acbb: [
        nu["life"]["dynamic_capacity"] / nu["life"]["catalogue_load"],
        acbb["life"]["L10h"],
        acbb["life"]["viscosity_ratio"],
    ],
    "The pair 7312-B itself": lambda pair: [pair["system_life"]["L10r_hours"]],
    "6207 with a turning outer ring": lambda *found: [one["life"]["L10h"] for one in found],
    "Load distribution: Stribeck's numbers": lambda balls, rollers, angular, tapered: [
        16 * largest(balls) / 1e3,
        16 * largest(rollers) / 1e3,
        angular["force"][0] / (50.0 * math.tan(math.radians(40.0))),
        tapered["force"][0] / (50.0 * math.tan(math.radians(14.036))),
    ],
    "Spindle bearings: ratings and the rigidity of pairs": lambda rated, *found: [
        1e-3 * rated["life"]["dynamic_capacity"],
        1e-3 * rated["life"]["static_capacity"],
        *(2e-6 * one["stiffness"][0][0] for one in found[:-1]),
        1e-6 * sum(one["stiffness"][0][0] for one in found[-1]["bearings"].values()),
        found[-1]["sets"]["pair"]["loss_force"] / found[-1]["sets"]["pair"]["preload"],
    ],
    "A program of 1973": lambda found: [
        *(angle_of(found, race) for race in ("outer", "inner")),
        *(found["elements"][f"load_{race}"][0] / POUND for race in ("outer", "inner")),
        *(found["elements"][f"pressure_{race}"][0] / PSI for race in ("outer", "inner")),
    ],
}


@pytest.fixture
def solved(tmp_path, monkeypatch, capfd):
    """Runs the commands of a section in one folder; gives the objects of those that solve."""
    shutil.copytree(ROOT / "docs" / "examples", tmp_path / "docs" / "examples")
    (pair,) = re.findall(r"^```toml\n(.*?)^```", PAGE, flags=re.MULTILINE | re.DOTALL)
    (tmp_path / "pair.toml").write_text(pair, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("JAXBEARING_CACHE", "off")

    def run(commands):
        found = []
        for arguments in commands:
            monkeypatch.setattr("sys.argv", ["jaxbearing", *arguments, "--json"])
            capfd.readouterr()
            with pytest.raises(SystemExit) as ended:
                main()
            out, err = capfd.readouterr()
            assert not ended.value.code, err
            found += [json.loads(out)] if arguments[0] == "solve" else []
        return found

    return run


def test_every_command_of_the_page_is_compared():
    assert {title for title, (commands, _) in SECTIONS.items() if commands} == set(EXAMPLES)


QUICK = {"6207 with a turning outer ring", "A program of 1973"}
"""Sections of one structure; the others have several structures."""


@pytest.mark.parametrize(
    "title", [title if title in QUICK else pytest.param(title, marks=pytest.mark.slow) for title in EXAMPLES]
)
def test_commands_give_the_numbers_of_their_tables(title, solved):
    commands, rows = SECTIONS[title]
    numbers = EXAMPLES[title](*solved(commands))
    assert len(numbers) == len(rows)
    for number, (what, printed, here, deviation) in zip(numbers, rows, strict=True):
        digits = len(re.sub(r"\D", "", here.lstrip("0.")))
        assert float(f"{number:.{digits}g}") == float(here), f"{what}: {number}"
        assert f"{100.0 * (number / float(printed) - 1.0):+.1f} %".replace("-0.0", "0.0").replace("+0.0", "0.0") == (
            deviation
        ), what


def test_life_of_a_sheave_has_one_round_pair():
    """Loads and speeds in round numbers whose life has the four printed digits."""
    speeds, loads = [*range(10, 1000, 10), *range(1000, 10000, 25)], [0.01 * step for step in range(10, 1000)]
    hours = lambda speed, load: 1e6 / (60.0 * speed) * (27.0 / load) ** 3
    found = [(n, round(p, 2)) for n in speeds for p in loads if abs(hours(n, p) - 804800.0) <= 50.0]
    assert found == [(2450, 0.55)]
    assert abs(hours(407.6, 1.0) - 804800.0) <= 50.0


def test_ratings_of_the_257_spindle_bearings():
    """The table of medians, and the median with the conformity of the rigidities."""
    rows = spindle_bearings()
    column = lambda name: np.array([getattr(row, name) for row in rows], dtype=float)
    sizes = column("n_balls"), 1e-3 * column("ball_diameter"), 1e-3 * column("pitch_diameter")
    angle = np.radians(column("contact_angle"))

    def ratios(groove):
        one = lambda *size: (ball_capacity(*size, groove, groove), ball_static_capacity(*size, groove))
        dynamic, static = jax.vmap(one)(*sizes, angle)
        return np.asarray(dynamic) / column("dynamic_capacity"), np.asarray(static) / column("static_capacity")

    series = np.array([f"{row.designation.split()[0]}, {row.contact_angle:g}°" for row in rows])
    tables = re.findall(r"^\| (\w+, \d+°) \| (\d+) \| ([\d.]+) \| ([\d.]+) \|$", PAGE, flags=re.MULTILINE)
    assert sum(int(count) for _, count, _, _ in tables) == len(rows) == 257
    rated = ratios(0.52)
    for name, count, *medians in tables:
        chosen = series == name
        assert chosen.sum() == int(count)
        found = [f"{np.median(ratio[chosen]):.3f}" for ratio in rated]
        assert found == medians, name
    open_grooves = [np.median(ratio[series == "KH, 17°"]) for ratio in ratios(0.5388)]
    np.testing.assert_allclose(open_grooves, [1.10, 1.32], atol=5e-3)


def test_hertz_coefficients_of_a_textbook():
    """All rows of the table; deviations of the last printed digit."""
    lines = (ROOT / "tests" / "published" / "harris_table_6_1.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    difference, *printed = (np.array([float(row[name]) for row in rows]) for name in rows[0])
    assert len(difference) == 22
    contact = PointContact(2.0 / (1.0 + difference), 2.0 / (1.0 - difference), 2.0)
    ellipse, size = contact.ellipse(1e3), 1500.0 ** (1.0 / 3.0)
    found = ellipse.transverse / size, ellipse.rolling / size, 2.0 * contact.approach(1e3) / size**2
    off = np.abs(np.array(found) / np.array(printed) - 1.0)
    doubtful = np.unravel_index(np.argmax(off), off.shape)
    assert (int(doubtful[0]), difference[doubtful[1]]) == (2, 0.4795)
    np.testing.assert_allclose(off[doubtful], 3e-4, atol=1e-4)
    off[doubtful] = 0.0
    assert off.max() < 2.5e-4


@pytest.mark.parametrize(("modulus", "size", "pressure"), [(29.6e6, -6.8e-3, 1.375e-2), (29.0e6, 0.0, 0.0)])
def test_ellipses_of_a_program_of_1973(modulus, size, pressure):
    """Semi-axes and pressures at the printed loads, with the modulus as it is read and as it must have been."""
    ball, pitch, reduced = 0.8125 * INCH, 6.2008 * INCH, modulus * PSI / (1.0 - 0.25**2)
    printed = {
        -1: (14.475, 571.07, 9.6824e-2, 1.2801e-2, 2.1999e5),
        1: (29.762, 287.76, 7.8504e-2, 8.9653e-3, 1.9522e5),
    }
    for race, (degrees, load, long, short, most) in printed.items():
        gamma = ball * math.cos(math.radians(degrees)) / pitch
        contact = PointContact(0.5 * ball * (1.0 - race * gamma), 0.52 * ball / 0.04, reduced)
        found = contact.ellipse(load * POUND)
        ratios = [float(found.transverse) / (long * INCH), float(found.rolling) / (short * INCH)]
        np.testing.assert_allclose(ratios, 1.0 + size, atol=5e-5)
        np.testing.assert_allclose(float(found.pressure) / (most * PSI), 1.0 + pressure, atol=5e-5)
        if modulus == 29.0e6:
            deflection = {-1: 6.2275e-4, 1: 4.0335e-4}[race]
            np.testing.assert_allclose(float(contact.approach(load * POUND)) / INCH, deflection, rtol=2e-5)


def test_pair_by_two_reactions():
    """KH 6010 C: the closure of both bearings that makes the preload, and the load at a closure of twice that, at
    which one of them is empty."""
    scene = jb.load_scene(ROOT / "docs" / "examples" / "worked" / "spindle_kh_6010.toml")
    at = lambda closure: jb.reaction(scene, [0.0] * 5, closure=closure)
    for preload, rigidity, lost in ((60.0, 48.5, 177), (180.0, 73.8, 551), (350.0, 97.1, 1112)):
        closure = 5e-6
        for _ in range(8):
            one = at(closure)
            closure += (preload - one.force[0]) / one.stiffness[0, 0]
        assert f"{2e-6 * one.stiffness[0, 0]:.1f}" == f"{rigidity}"
        assert f"{at(2.0 * closure).force[0]:.0f}" == f"{lost}"

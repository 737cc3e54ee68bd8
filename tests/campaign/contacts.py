"""Random two-disk machines and lubricated line contacts.

The films of line contacts are asked for M = 3 to 1000, as the documentation states, with the inlet that a light load
needs; below M = 3 the solve must refuse. A mesh of 101 nodes is left out above M = 500: it is too coarse for the edges
of such a contact, and Newton's iteration fails on every second one above M = 600 (with 201 and 401 nodes on none).
Traction beyond 1.8 GPa is extrapolated, and said so: it is drawn to 2.5 GPa.
"""

import functools
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from campaign import elastic
from campaign.bearings import CELSIUS, SCALE, TINY, largest
from campaign.draws import Numbers, Range, even, log
from campaign.structure import Results, Structure, Twin

import jaxbearing as jb

POISSON = 0.3
BODIES: dict[str, Range] = {
    "radius": log(2e-3, 0.1),
    "body_1": even(190e9, 320e9),
    "body_2": even(190e9, 320e9),
    "grade": log(0.2, 5.0),
    "temperature": even(CELSIUS - 20.0, CELSIUS + 200.0),
}
SWAPPED = {"materials.body_1.youngs_modulus": "materials.body_2.youngs_modulus"}


def bodies(v: Numbers) -> Numbers:
    return {
        "geometry.reduced_radius_rolling": v["radius"],
        "materials.body_1.youngs_modulus": v["body_1"],
        "materials.body_2.youngs_modulus": v["body_2"],
    }


def modulus_of(scene: Any, n: Numbers) -> np.ndarray:
    pairs = [
        (n[f"materials.{body}.youngs_modulus"], float(getattr(scene.materials, body).poisson_ratio))
        for body in ("body_1", "body_2")
    ]
    return elastic.reduced_modulus(*pairs)


def _exchanged(numbers: Numbers) -> Numbers:
    first, second = (f"materials.{body}.youngs_modulus" for body in ("body_1", "body_2"))
    return {**numbers, first: numbers[second], second: numbers[first]}


# -- two-disk machines ------------------------------------------------------------------------------------------------

DISKS: dict[str, Range] = {
    "across": log(0.3, 10.0),
    "length": log(1e-3, 20e-3),
    "pressure": even(0.3e9, 2.5e9),
    "speed": log(0.01, 50.0),
    "slide": log(1e-5, 1.0),
    "stress": log(0.5, 2.0),
    "modulus": log(0.5, 2.0),
}


def disk_numbers(v: Numbers, scene: Any) -> Numbers:
    oil = scene.oil
    numbers = {
        **bodies(v),
        "operation.pressure": v["pressure"],
        "operation.entrainment_speed": v["speed"],
        "operation.temperature": v["temperature"],
        "operation.slide_to_roll": v["slide"][:, None] * np.array([-1.0, 0.0, 1.0]),
        "oil.viscosity.glass_viscosity": float(oil.viscosity.glass_viscosity) * v["grade"],
        "oil.rheology.stress": float(oil.rheology.stress) * v["stress"],
        "oil.rheology.shear_modulus": float(oil.rheology.shear_modulus) * v["modulus"],
    }
    if scene.geometry.contact_length is not None:
        numbers["geometry.contact_length"] = v["length"]
    else:
        numbers["geometry.reduced_radius_transverse"] = v["across"] * v["radius"]
    return numbers


def disk_balances(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    flat = lambda name: r[name].reshape(len(n["operation.pressure"]), -1)
    coefficient, power, load = flat("traction_coefficient"), flat("power"), flat("load")[:, 0]
    slide = n["operation.slide_to_roll"]
    along, pressure, modulus = n["geometry.reduced_radius_rolling"], n["operation.pressure"], modulus_of(scene, n)
    if "geometry.contact_length" in n:
        hertz = elastic.line_pressure(load, along, n["geometry.contact_length"], modulus)
    else:
        hertz = elastic.point_pressure(load, along, n["geometry.reduced_radius_transverse"], modulus)
    largest_one = np.maximum(np.abs(coefficient[:, 2]), TINY)
    speed = slide * n["operation.entrainment_speed"][:, None]
    dissipated = coefficient * load[:, None] * speed
    return {
        "Hertz": (np.abs(hertz / pressure - 1.0), 1e-6),
        "traction is odd": (np.abs(coefficient[:, 0] + coefficient[:, 2]) / largest_one, 1e-7),
        "no traction without sliding": (np.abs(coefficient[:, 1]), 1e-12),
        "traction along the sliding": (np.maximum(-np.min(coefficient * slide, axis=1), 0.0), 0.0),
        "power = force times sliding": (largest(power - dissipated) / np.maximum(largest(power), TINY), 1e-9),
    }


def disk_summary(solution: Any) -> jax.Array:
    return 10.0 * solution.traction_coefficient.ravel()[2] + jnp.log(solution.film.ravel()[2])


def _same_disks(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    here, there = (r["traction_coefficient"] for r in (results, twin))
    films = largest(results["film"] - twin["film"]) / largest(results["film"])
    return np.maximum(largest(here - there) / np.maximum(largest(here), TINY), films)


EXCHANGED = Twin("bodies exchanged", _exchanged, _same_disks, 1e-9)


def _hotter(numbers: Numbers) -> Numbers:
    name = "operation.temperature" if "operation.temperature" in numbers else "operation.oil_temperature"
    return {**numbers, name: numbers[name] + 10.0}


def _thicker(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    name = "film" if "film" in results else "film.central"
    here, there = (r[name].reshape(len(r[name]), -1)[:, 0] for r in (results, twin))
    return (there - here) / here


HOTTER = Twin("hotter oil, thinner film", _hotter, _thicker, 0.0)


def disk(name: str, base: str, changes: dict[str, str], **kwargs: Any) -> Structure:
    changes = {"operation.load": "none", "operation.pressure": "1 GPa", "contact.traction_accuracy": "1e-2", **changes}
    one = {
        "operation.slide_to_roll": "0.01",
        "operation.entrainment_speed": "1 m/s",
        "operation.temperature": "40 degC",
    }
    built = functools.cache(lambda: jb.load_scene(base, {**one, **changes}))
    return Structure(
        name=f"two-disk: {name}",
        kind="two-disk machine",
        load=built,
        ranges={**BODIES, **DISKS},
        numbers=lambda v: disk_numbers(v, built()),
        balances=lambda n, r: disk_balances(built(), n, r),
        summary=disk_summary,
        **{"twins": (EXCHANGED,), **kwargs},
    )


# -- line contacts ----------------------------------------------------------------------------------------------------

LINES: dict[str, Range] = {"pressure": even(0.2e9, 2e9), "sign": even(0.9, 1.1, negative=0.5)}
SLOWEST, FASTEST = 1e-5, 100.0
"""m/s."""


def line_numbers(v: Numbers, scene: Any) -> Numbers:
    numbers = bodies(v)
    modulus, radius = modulus_of(scene, numbers), v["radius"]
    load = elastic.load_at_line_pressure(1.0, radius, np.ones(1), modulus) * v["pressure"] ** 2
    ambient = v["grade"] * np.asarray(scene.oil.viscosity.viscosity(0.0, jnp.asarray(v["temperature"])))
    # from Moes' load number, within speeds of bearings
    speed = (load / (modulus * radius * v["moes"])) ** 2 * modulus * radius / (2.0 * ambient)
    glass = float(scene.oil.viscosity.glass_viscosity) * v["grade"]
    numbers |= {
        "operation.load_per_length": load,
        "operation.entrainment_speed": np.where(v["sign"] < 0.0, -1.0, 1.0) * np.clip(speed, SLOWEST, FASTEST),
        "operation.oil_temperature": v["temperature"],
        "oil.viscosity.glass_viscosity": glass,
    }
    if hasattr(scene.oil.pressure_viscosity, "viscosity"):
        numbers["oil.pressure_viscosity.viscosity.glass_viscosity"] = glass
    return numbers


def moes_load(scene: Any, n: Numbers) -> np.ndarray:
    modulus, radius = modulus_of(scene, n), n["geometry.reduced_radius_rolling"]
    grade = n["oil.viscosity.glass_viscosity"] / float(scene.oil.viscosity.glass_viscosity)
    ambient = grade * np.asarray(scene.oil.viscosity.viscosity(0.0, jnp.asarray(n["operation.oil_temperature"])))
    speed = 2.0 * ambient * np.abs(n["operation.entrainment_speed"]) / (modulus * radius)
    return n["operation.load_per_length"] / (modulus * radius * np.sqrt(speed))


def log_kernel(x: np.ndarray) -> np.ndarray:
    """Integral of hat functions on the nodes times ln|x - s|, exact: (place, node)."""
    start, end = x[:-1] - x[:, None], x[1:] - x[:, None]
    logs = lambda t: np.log(np.where(t == 0.0, 1.0, np.abs(t)))
    zeroth = (end * logs(end) - end) - (start * logs(start) - start)
    first = (end**2 / 2 * logs(end) - end**2 / 4) - (start**2 / 2 * logs(start) - start**2 / 4)
    right = (first - start * zeroth) / (end - start)
    kernel = np.zeros((x.size, x.size))
    kernel[:, 1:] += right
    kernel[:, :-1] += zeroth - right
    return kernel


def line_balances(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    x, pressure, film = r["profile.x"], r["profile.pressure"], r["profile.film"]
    load, modulus, radius = n["operation.load_per_length"], modulus_of(scene, n), n["geometry.reduced_radius_rolling"]
    forwards = n["operation.entrainment_speed"] > 0
    turned = lambda values: np.where(forwards[:, None], values, values[:, ::-1])
    width = np.sqrt(8.0 * load * radius / (np.pi * modulus))
    # in flow direction all contacts have the same mesh of half widths
    place = turned(np.where(forwards[:, None], x, -x))[0] / width[0]
    pressed, gap = turned(pressure), turned(film)
    deflection = -4.0 / np.pi / modulus[:, None] * width[:, None] * (pressed @ log_kernel(place).T)
    shape = (place * width[:, None]) ** 2 / (2.0 * radius[:, None]) + deflection
    bent = gap - shape
    loaded = np.abs(place) <= 1.0
    unevenness = np.ptp(bent[:, loaded], axis=1) / np.maximum(np.max(np.abs(shape), axis=1), TINY)
    carried = np.sum(0.5 * (pressure[:, 1:] + pressure[:, :-1]) * np.diff(x, axis=1), axis=1)
    return {
        "pressure carries the load": (np.abs(np.abs(carried) / load - 1.0), 1e-7),
        "film = gap + deflection": (unevenness, 1e-8),
        "no tension": (np.maximum(-np.min(pressure, axis=1), 0.0) / np.max(pressure, axis=1), 1e-12),
        "a film everywhere": (np.maximum(-np.min(film, axis=1), 0.0) / r["film.central"], 0.0),
        "the smallest film is the smallest": (r["film.minimum"] / np.min(film, axis=1) - 1.0, 1e-12),
    }


def line_summary(solution: Any) -> jax.Array:
    return jnp.log(solution.film.central) + jnp.log(solution.film.minimum) + solution.central_pressure / 1e9


def _reversed(numbers: Numbers) -> Numbers:
    return {**numbers, "operation.entrainment_speed": -numbers["operation.entrainment_speed"]}


def _reverse_error(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    films = np.abs(results["profile.film"] - twin["profile.film"][:, ::-1]) / results["film.central"][:, None]
    return np.maximum(np.max(films, axis=1), np.abs(twin["film.minimum"] / results["film.minimum"] - 1.0))


def _scaled(numbers: Numbers) -> Numbers:
    lengths = ("geometry.reduced_radius_rolling", "operation.load_per_length", "operation.entrainment_speed")
    return {name: SCALE * value if name in lengths else value for name, value in numbers.items()}


def _scale_error(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    pairs = [(results[f"film.{name}"], twin[f"film.{name}"] / SCALE) for name in ("central", "minimum")]
    return np.max([np.abs(there / here - 1.0) for here, there in pairs], axis=0)


LINE_TWINS = (
    Twin("turned the other way", _reversed, _reverse_error, 1e-8),
    Twin("bodies exchanged", _exchanged, lambda n, r, o, t: _scale_error(n, r, o, _same_size(t)), 1e-8),
    Twin("all lengths scaled", _scaled, _scale_error, 1e-7),
    HOTTER,
)


def _same_size(results: Results) -> Results:
    return {**results, **{f"film.{name}": SCALE * results[f"film.{name}"] for name in ("central", "minimum")}}


def line(name: str, changes: dict[str, str], moes: Range, **kwargs: Any) -> Structure:
    changes = {"simulation": "none", "contact.accuracy": "none", **changes}
    built = functools.cache(lambda: jb.load_scene("satellite_contact_1", changes))
    return Structure(
        name=f"line contact: {name}",
        kind="line contact",
        load=built,
        ranges={**BODIES, **LINES, "moes": moes},
        numbers=lambda v: line_numbers(v, built()),
        balances=lambda n, r: line_balances(built(), n, r),
        summary=line_summary,
        outside=lambda n: moes_load(built(), n) < 3.0,
        **{"twins": LINE_TWINS, **kwargs},
    )


LINE_DISK = {
    "geometry.reduced_radius_transverse": "none",
    "geometry.contact_length": "5 mm",
    "contact.film": "moes",
}
STRUCTURES = [
    disk(
        "point, isothermal",
        "two_disk_mobil_jet_ii",
        {"contact.thermal": "none", "contact.film_heating": "false"},
        twins=(EXCHANGED, HOTTER),
        small=True,
    ),
    disk(
        "point, warm inlet and film, half spaces",
        "two_disk_mobil_jet_ii",
        {"contact.thermal": "gupta", "contact.film_heating": "true", "contact.compliance": "half_space"},
    ),
    disk(
        "point, Pennzane, cold inlet", "two_disk_pennzane", {"contact.inlet": "cold", "contact.film": "hamrock_dowson"}
    ),
    disk(
        "line, Hsu-Lee",
        "two_disk_mobil_jet_ii",
        {**LINE_DISK, "contact.thermal": "hsu_lee", "contact.traction": "bair_winer", "contact.film_heating": "false"},
    ),
    disk(
        "line, viscous, heated film",
        "two_disk_mobil_jet_ii",
        {
            **LINE_DISK,
            "contact.elastic": "false",
            "contact.traction": "gecim_winer",
            "contact.thermal": "none",
            "contact.film_heating": "true",
        },
        twins=(EXCHANGED, HOTTER),
    ),
    line("incompressible", {"contact.nodes": "101", "contact.inlet": "4"}, log(25.0, 500.0), small=True),
    line(
        "compressible, Mobil Jet II",
        {"contact.nodes": "201", "contact.compressible": "true", "contact.inlet": "4", "oil.name": "mobil_jet_ii"},
        log(25.0, 1000.0),
    ),
    line(
        "light, long inlet",
        {"contact.nodes": "151", "contact.compressible": "true", "contact.inlet": "16"},
        log(2.0, 25.0),
    ),
]

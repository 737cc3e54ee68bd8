"""What the bearings of the campaign have in common: oils, rings' speeds, friction, energy, twins."""

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from campaign.draws import Numbers, Range, even, log
from campaign.structure import Results, Twin

from jaxbearing.contacts.oil_supply import SEPARATION_SHARE
from jaxbearing.numerics.newton_steps import MOST_ROUNDED, NewtonOptions

RPM = 2.0 * np.pi / 60.0
LITRE_PER_HOUR = 1e-3 / 3600.0
CELSIUS = 273.15
TINY = 1e-300

OPERATION: dict[str, Range] = {
    "speed": even(0.0, 1.0, negative=0.3),
    "both": even(0.0, 1.0),
    "outer": even(-1.0, 0.9),
}
"""`speed`: logarithm of the inner ring's; `both`: above 0.6 the outer ring turns too, by `outer` of the inner."""
OIL: dict[str, Range] = {
    "temperature": even(CELSIUS - 20.0, CELSIUS + 200.0),
    "grade": log(0.2, 5.0),
    "stress": log(0.5, 2.0),
    "modulus": log(0.5, 2.0),
}
"""Temperature, K; viscosity, shear stress and shear modulus over those of the oil of the catalogue."""
STEELS: dict[str, Range] = {
    "rings_modulus": even(190e9, 220e9),
    "elements_modulus": even(190e9, 320e9),
    "poisson": even(0.24, 0.32),
    "density": even(3200.0, 8000.0),
}
"""From silicon nitride to steel."""
FRICTION: dict[str, Range] = {
    "roughness": log(1e-8, 3e-6),
    "start": log(1e-5, 0.1),
    "boundary": even(0.05, 0.2),
    "hysteresis": even(0.0, 0.02, zero=0.1),
}
"""Roughness, m; sliding speed over which boundary friction starts, m/s; its coefficient; part of elastic work lost."""
SUPPLY: dict[str, Range] = {
    "gap_over_central": log(0.03, 1e3),
    "meniscus_gap": log(1e-8, 1e-3),
    "layer": log(1e-9, 1e-3, zero=0.05),
    "meniscus_distance": log(0.03, 0.5),
    "from_flow": log(0.01, 1.0),
}
"""How a supply is given -> its numbers; the distance over the diameter of a rolling element."""


def supplied(field: str) -> dict[str, Range]:
    """The range of a supply that is given by this field."""
    flow = {"supply_flow": log(1.0, 300.0)} if field == "from_flow" else {}
    return {"supply": SUPPLY[field], **flow}


def friction(v: Numbers, scene: Any) -> Numbers:
    """Numbers of supply, mixed friction and hysteresis, as far as the scene has them."""
    contact, rib = scene.contact, getattr(scene, "rib", None)
    found: Numbers = {}
    if contact.hysteresis is not None:
        found["contact.hysteresis"] = v["hysteresis"]
    for path, laws in (("contact.mixed", contact), ("rib.mixed", rib)):
        if laws is not None and laws.mixed is not None:
            found |= {f"{path}.roughness": v["roughness"], f"{path}.slide_width": v["start"]}
            found[f"{path}.mu_boundary"] = v["boundary"]
    supply = contact.supply
    if supply is None:
        return found
    field = next(name for name in SUPPLY if getattr(supply, name) is not None)
    found[f"contact.supply.{field}"] = v["supply"] * (v["diameter"] if field == "meniscus_distance" else 1.0)
    if field == "from_flow":
        found["operation.oil_flow"] = v["supply_flow"] * LITRE_PER_HOUR
    return found


def places_known(scene: Any) -> bool:
    """True if the films that place the rolling elements follow from the printed ones: not where each contact has
    another part of its flooded film."""
    supply = None if scene.contact is None else scene.contact.supply
    return supply is None or supply.gap_over_central is not None


def placing_film(scene: Any, r: Results, race: str) -> np.ndarray:
    """Films that place the rolling elements: with a supply the film and a hundredth of what it lacks of the flooded
    one."""
    film = r[f"elements.film_{race}"]
    if scene.contact.supply is None:
        return film
    return film * (1.0 + SEPARATION_SHARE * (1.0 / r[f"supply.film_factor_{race}"][:, None] - 1.0))


def rubbed(scene: Any, n: Numbers, r: Results) -> dict[str, tuple[np.ndarray, float]]:
    """Boundary friction is a part of the loss of its place; a load share is one; films are no thicker than the oil
    layer, and factors of supply at most 1."""
    found: dict[str, tuple[np.ndarray, float]] = {}
    whole = np.maximum(np.abs(r.get("power_loss.total", np.zeros(1))), TINY)
    # where nothing touches there is no film: NaN, which is no excess. Not lost: `judge` counts it as a breach where a
    # number must be
    beyond = lambda values, most: largest(np.maximum(np.nan_to_num(values) - most, 0.0))
    for path, values in r.items():
        if path.startswith("boundary_power."):
            loss = r[path.replace("boundary_power", "power_loss")]
            found[f"{path} is a part"] = (np.maximum(np.maximum(values - loss, -values), 0.0) / whole, 1e-9)
        elif path.startswith(("elements.load_share_", "supply.film_factor", "supply.rolling_factor")):
            found[f"{path} is a part"] = (np.maximum(beyond(values, 1.0), beyond(-values, 0.0)), 1e-12)
    if "contact.supply.layer" in n and scene.line_contacts:
        layer = n["contact.supply.layer"][:, None]
        thicker = [beyond(r[f"elements.film_{race}"] - layer, 1e-15) for race in ("inner", "outer")]
        found["no film beyond the layer"] = (np.max(thicker, axis=0) / 1e-6, 1e-9)
    return found


def speeds(v: Numbers, pitch: np.ndarray, low: float, high: float, rest: float = 0.0) -> Numbers:
    """Speeds of the rings, rad/s: from `low`, rpm, to `high`, the product of rpm and pitch diameter in mm; a part
    `rest` at rest. Where both turn they do so against each other by at least `low`."""
    share = np.abs(v["speed"])
    moving = share >= rest
    share = np.where(moving, (share - rest) / (1.0 - rest), 0.0)
    both = (v["both"] > 0.6) & moving
    least = np.where(both, 10.0 * low, low)
    most = np.maximum(high / (1e3 * pitch), 2.0 * least)
    inner = np.where(v["speed"] < 0.0, -1.0, 1.0) * least * (most / least) ** share * RPM * moving
    return {"operation.inner_speed": inner, "operation.outer_speed": np.where(both, v["outer"] * inner, 0.0)}


def oil(v: Numbers, scene: Any) -> Numbers:
    """Numbers of the oil, those of the scene's own scaled."""
    law = scene.oil
    viscosity = type(law.viscosity).__name__
    names = {"ModifiedWLF": ("glass_viscosity",), "WaltherRoelands": ("viscosity_1", "viscosity_2")}[viscosity]
    changes = {"operation.oil_temperature": v["temperature"]}
    for name in names:
        value = float(getattr(law.viscosity, name))
        changes[f"oil.viscosity.{name}"] = value * v["grade"]
        if hasattr(law.pressure_viscosity, "viscosity"):
            # the coefficient is integrated from a copy of the law
            changes[f"oil.pressure_viscosity.viscosity.{name}"] = value * v["grade"]
    if law.rheology is not None:
        changes["oil.rheology.stress"] = float(law.rheology.stress) * v["stress"]
        changes["oil.rheology.shear_modulus"] = float(law.rheology.shear_modulus) * v["modulus"]
    return changes


def solids(v: Numbers, elements: str) -> Numbers:
    return {
        "materials.rings.youngs_modulus": v["rings_modulus"],
        f"materials.{elements}.youngs_modulus": v["elements_modulus"],
        f"materials.{elements}.poisson_ratio": v["poisson"],
        f"materials.{elements}.density": v["density"],
    }


def largest(values: np.ndarray) -> np.ndarray:
    """Over all but the axis of the cases."""
    return np.max(np.abs(values.reshape(len(values), -1)), axis=1)


def energy(
    results: Results, unit: np.ndarray | float = 0.0, rough: bool = False
) -> dict[str, tuple[np.ndarray, float]]:
    """The power that drives the rings, from torques, is the sum of all losses, and no loss is negative. Granted is the
    residual of the equations, in `unit`, W, where it is beyond its tolerance: where thick oil makes forces of the last
    bits of a speed rounding leaves more, at most `MOST_ROUNDED`. `rough`: granted below the tolerance too, where
    asperities hold balls that then lose next to nothing, and an open force turns at the speed of the rings."""
    total = results.get("power_loss.total")
    parts = {path: value for path, value in results.items() if path.startswith("power_loss.") and value is not total}
    if total is None or not parts:
        return {}
    added = np.sum(list(parts.values()), axis=0)
    scale = np.maximum(np.abs(total), TINY)
    least = np.min(list(parts.values()), axis=0)
    residual = results["residual_norm"]
    counts = rough | (residual > NewtonOptions().residual_tolerance)
    left = np.where(counts, np.minimum(residual, MOST_ROUNDED), 0.0) * unit
    return {
        "drive power = total loss": (np.maximum(np.abs(results["drive_power"] - total) - left, 0.0) / scale, 1e-8),
        "losses add up": (np.abs(added - total) / scale, 1e-12),
        "no negative loss": (np.maximum(-least, 0.0) / scale, 1e-9),
    }


def summary(solution: Any) -> jax.Array:
    """Loads, displacements, films and power in one number of order 1 to 100."""
    loads = solution.elements.load_outer
    value = jnp.log(jnp.sum(loads**4)) + jnp.log(jnp.sum(solution.elements.load_inner**2))
    for name in solution.ring_freedom:
        size = 1e3 if name.startswith("tilt") else 1e5
        value += size * getattr(solution.ring, name)
    total = solution.power_loss.total
    if total is not None and solution.drive_power is not None and solution.cage is not None:
        value += jnp.log(total)
    films = solution.elements.film_outer if hasattr(solution.elements, "film_outer") else None
    if films is not None:
        heaviest = jnp.argmax(loads)
        value += jnp.log(films[heaviest])
    return value


def first_moment(laminae: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of the loads of a roller's laminae about its end s = 0, over its length; and by how much at most they leave it
    open. A lamina at an end of the contact carries somewhere; within another the load per length changes as
    between neighbours, or twice as much: a linear change D moves its moment by D/12 of its width."""
    count = laminae.shape[-1]
    places = (np.arange(count) + 0.5) / count
    beside = [(0, 0)] * (laminae.ndim - 1)
    before, after = (np.pad(laminae, [*beside, pad], "edge") for pad in ((1, 0), (0, 1)))
    before, after = before[..., :-1], after[..., 1:]
    change = np.maximum(np.abs(laminae - before), np.abs(after - laminae))
    ends = np.minimum(before, after) <= 0.0
    left_open = np.where(ends, laminae / 2.0, change / 6.0) / count
    return np.sum(laminae * places, axis=-1), np.sum(left_open, axis=-1)


# -- twins ------------------------------------------------------------------------------------------------------------

SPEEDS = ("operation.inner_speed", "operation.outer_speed")


def _mirrored(numbers: Numbers) -> Numbers:
    return {name: -value if name in SPEEDS else value for name, value in numbers.items()}


def _mirror_error(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    loads = results["elements.load_outer"]
    turned = -np.arange(loads.shape[1]) % loads.shape[1]
    error = np.zeros(len(loads))
    for name in ("load_inner", "load_outer", "pressure_inner", "film_inner", "film_outer"):
        here, there = results.get(f"elements.{name}"), twin.get(f"elements.{name}")
        if here is None or there is None:
            continue
        here, there = np.nan_to_num(here), np.nan_to_num(there)
        error = np.maximum(error, largest(here - there[:, turned]) / np.maximum(largest(here), TINY))
    if "power_loss.total" in results:
        total = results["power_loss.total"]
        error = np.maximum(error, np.abs(twin["power_loss.total"] - total) / np.maximum(np.abs(total), 1e-12))
    for name in ("radial", "axial"):
        error = np.maximum(error, np.abs(results[f"ring.{name}"] - twin[f"ring.{name}"]) / 1e-6)
    return error


MIRROR = Twin("turned the other way", _mirrored, _mirror_error, 1e-7)
"""All speeds reversed: the same loads, films and power at the rolling elements on the other side of the load line."""


def at_rest(numbers: Numbers) -> Numbers:
    return {name: np.zeros_like(value) if name in SPEEDS else value for name, value in numbers.items()}


def _crawling(numbers: Numbers) -> Numbers:
    return {**at_rest(numbers), "operation.inner_speed": np.full_like(numbers["operation.inner_speed"], 1e-3)}


def _displacement(results: Results) -> np.ndarray:
    return np.stack([results[f"ring.{name}"] for name in ("axial", "radial")], axis=1)


def _crawl_error(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    loads = results["elements.load_inner"]
    error = largest(loads - twin["elements.load_inner"]) / np.maximum(largest(loads), TINY)
    moved = largest(_displacement(results) - _displacement(twin))
    return np.maximum(error, moved / np.maximum(largest(_displacement(results)), 1e-7))


LOADS = ("operation.axial_load", "operation.radial_load", "operation.moment")


def _heavier(numbers: Numbers) -> Numbers:
    return {name: 1.2 * value if name in LOADS else value for name, value in at_rest(numbers).items()}


def _work(numbers: Numbers, results: Results) -> np.ndarray:
    """Loads times displacements, J."""
    pairs = zip(LOADS, ("axial", "radial", "tilt"), strict=True)
    return sum((numbers[load] * results[f"ring.{name}"] for load, name in pairs if load in numbers), np.zeros(1))


def _yields(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    """How far the work falls; an elastic bearing gives way in the direction of its load: the operator is monotone."""
    before, after = _work(numbers, results), _work(numbers, twin)
    scale = np.maximum(np.abs(before), np.abs(after))
    return (before - after) / np.maximum(scale, TINY)


def _softer(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    """How far the work falls, or under a single load the largest load of an element."""
    lighter = largest(results["elements.load_inner"]) - largest(twin["elements.load_inner"])
    single = sum(name in numbers for name in LOADS) == 1
    unloaded = lighter / np.maximum(largest(results["elements.load_inner"]), TINY) if single else np.zeros(1)
    return np.maximum(_yields(numbers, results, others, twin), unloaded)


HEAVIER = Twin("more load, more deflection", _heavier, _softer, 1e-9, base=at_rest)
YIELDING = Twin("more load, more work", _heavier, _yields, 1e-9, base=at_rest)
"""Where lobes press elements at the sides of the load: more load may relieve these."""
CRAWL = Twin("at rest = hardly turning", _crawling, _crawl_error, 1e-6, base=at_rest)
SCALE = 1.7


def scaled(lengths: tuple[str, ...], floor: float = 0.0, limit: float = 1e-7) -> Twin:
    """All lengths times 1.7: with loads times its square, moments times its cube and speeds over it pressures and
    angles stay, for solids obey no other length. **Arguments:** `lengths`: paths besides those of `geometry`; `floor`:
    loads that the package adds and does not scale, N."""
    powers = {**dict.fromkeys(lengths, 1), **dict.fromkeys(SPEEDS, -1)}
    powers |= {"operation.axial_load": 2, "operation.radial_load": 2, "operation.moment": 3}
    shapes = ("angle", "conformity", "shim")

    def change(numbers: Numbers) -> Numbers:
        power = {
            name: 1 if name.startswith("geometry.") and not any(s in name for s in shapes) else powers.get(name, 0)
            for name in numbers
        }
        return {name: value * SCALE ** power[name] for name, value in numbers.items()}

    def error(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
        worst = np.zeros(1)
        for name in ("load_inner", "load_outer", "pressure_inner", "pressure_outer"):
            here, there = results[f"elements.{name}"], twin[f"elements.{name}"]
            if name.startswith("load"):
                there = there / SCALE**2
            else:
                # like loads: that of an unloaded contact is the pressure of 1 nN, which is not scaled
                here, there = here**3, there**3
            worst = np.maximum(worst, largest(here - there) / np.maximum(largest(here), TINY))
        moved = largest(_displacement(results) - _displacement(twin) / SCALE)
        worst = np.maximum(worst, moved / np.maximum(largest(_displacement(results)), 1e-7))
        heaviest = largest(results["elements.load_inner"])
        return np.where(heaviest < 100.0 * floor, 0.0, worst - floor / heaviest)

    return Twin("all lengths scaled", change, error, limit)


def _hotter(numbers: Numbers) -> Numbers:
    return {**numbers, "operation.oil_temperature": numbers["operation.oil_temperature"] + 10.0}


def _thicker(numbers: Numbers, results: Results, others: Numbers, twin: Results) -> np.ndarray:
    """How much thicker the hotter film of the most loaded element is."""
    rows, heaviest = np.arange(len(results["status"])), np.argmax(results["elements.load_outer"], axis=1)
    here, there = (r["elements.film_outer"][rows, heaviest] for r in (results, twin))
    return (there - here) / here


HOTTER = Twin("hotter oil, thinner film", _hotter, _thicker, 0.0)
"""At the same speeds and without inlet heating, which a thinner oil has less of."""

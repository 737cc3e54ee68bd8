"""A lubricated line contact as a scene: two cylinders, an oil, a load and a speed."""

from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float

from .._scene import AbstractScene, label, number, optional_number
from .._solvers import solver
from .._types import Scalar
from ..contacts import AbstractLineFilm, DowsonHigginson, DowsonToyoda, LineContact, Moes
from ..lubricants import Lubricant
from ..materials import Material, reduced_modulus
from ..numerics.checks import Checked
from ..numerics.newton import NewtonOptions
from ..numerics.structure import constant, count, switch
from .equations import Fluid
from .mesh import INLET, OUTLET, STOP_OUTLET, MeshKey
from .simulation import FilmSimulation
from .steady import Steady, existing

if TYPE_CHECKING:
    from .history import LineContactHistory
    from .solution import LineContactSolution

SMALLEST_MOES_LOAD = 3.0
"""Moes load number M below which a contact is nearly rigid: its Hertz half width no longer measures the film, and the
domain would have to be many times longer."""
FEWEST_NODES, MOST_NODES = 51, 3201


class ContactGeometry(Checked):
    """Shape of the contact.

    **Arguments:**
    - `reduced_radius_rolling`: R', m, 1/R' = 1/R1 + 1/R2 in the plane of rolling, > 0.
    """

    part: ClassVar[str] = "geometry"

    reduced_radius_rolling: Scalar = number(bound="> 0", unit="m")


class ContactBodies(eqx.Module):
    """Solids of the two bodies."""

    body_1: Material
    body_2: Material


class FilmModel(Checked):
    """Model of the film and its mesh.

    **Arguments:**
    - `compressible`: whether the density follows Dowson and Higginson; else it is constant.
    - `nodes`: number of nodes of the mesh; the film's error is about 0.9 % at 201 nodes and M < 50, a quarter of that
      for each doubling, and more under heavier loads (`resolution.mesh_error`).
    - `inlet`: length of the domain upstream of the centre, half widths; light loads need more than 4
      (`resolution.cut_error`); below 2 the contact is starved, with its meniscus there.
    - `film_limit`: film at which a transient run ends, m: below about 0.5 nm oil is no continuum.
    - `accuracy`: requested relative error of the steady films, > 0: a warning is given where mesh or inlet cause more.
      `None`: it is given above 5 % by the mesh, and above 0.5 % by the inlet.
    """

    part: ClassVar[str] = "contact"

    compressible: bool = switch("contact.compressible", True)
    nodes: int = count("contact.nodes", 501, least=FEWEST_NODES, most=MOST_NODES)
    inlet: float = constant("contact.inlet", INLET, bound="between 1.05 and 64")
    film_limit: Scalar = number(0.5e-9, bound=">= 0", unit="m")
    accuracy: float | None = constant("contact.accuracy", None, bound="> 0")


class ContactOperation(Checked):
    """Operating point of a line contact.

    **Arguments:**
    - `entrainment_speed`: (u1 + u2)/2, m/s, any sign: a negative one enters the contact from the other side.
    - `oil_temperature`: temperature of the oil in the contact, K, > 0.
    - `load_per_length`: load per length, N/m, > 0; give either this or `pressure`.
    - `pressure`: Hertz (peak) pressure, Pa, > 0.
    """

    part: ClassVar[str] = "operation"

    entrainment_speed: Scalar = number(metadata=label("m/s", "mean surface speed (u1 + u2)/2, of either sign"))
    oil_temperature: Scalar = number(bound="> 0", metadata=label("K", "oil temperature"))
    load_per_length: Scalar | None = optional_number(bound="> 0", unit="N/m")
    pressure: Scalar | None = optional_number(bound="> 0", unit="Pa")

    def __check_init__(self):
        super().__check_init__()
        if (self.load_per_length is None) == (self.pressure is None):
            word = "neither" if self.pressure is None else "both"
            raise ValueError(
                f"operation.load_per_length: found {word} of load_per_length and pressure, expected one of the two: a "
                "load per length or a Hertz (peak) pressure"
            )


class Scales(NamedTuple):
    """Scales of the dimensionless contact, and its dimensionless numbers."""

    half_width: Float[Array, ""]
    hertz_pressure: Float[Array, ""]
    load_per_length: Float[Array, ""]
    film: Float[Array, ""]
    """Unit of the film: a^2/R', m."""
    reference_speed: Float[Array, ""]
    """|u_m| of the operation, 1 m/s where that is 0."""
    wedge: Float[Array, ""]
    """Speed number lambda = 12 eta_0 u R'^2/(a^3 p_h)."""
    moes_load: Float[Array, ""]
    moes_material: Float[Array, ""]


class EHLLineContact(AbstractScene):
    """A lubricated line contact.

    The pressure between two elastic cylinders and the film that keeps them apart, isothermal, Newtonian, fully flooded,
    smooth; cavitation as P >= 0 with the Swift-Stieber condition (oil that cavitates is not conserved there).

    **Arguments:** `geometry`; `materials`; `oil`, whose law of viscosity counts; `contact`: model and mesh;
    `operation`; `simulation`: settings of a transient run.
    """

    kind: ClassVar[str] = "line_contact"

    geometry: ContactGeometry
    materials: ContactBodies
    oil: Lubricant
    contact: FilmModel
    operation: ContactOperation
    simulation: FilmSimulation | None = None

    def steady_solution(self, options: NewtonOptions) -> "LineContactSolution":
        return solver(self.kind, "steady_solution")(self, options)

    def simulated(self, duration: float | None, **settings: Any) -> "LineContactHistory":
        return solver(self.kind, "simulated")(self, duration, **settings)

    def check_restart(self, restart: object, duration: float | None = None) -> None:
        solver(self.kind, "check_restart")(self, restart, duration)

    @property
    def hertz(self) -> LineContact:
        """The dry contact, 1 m long."""
        return LineContact(self.geometry.reduced_radius_rolling, 1.0, self._reduced_modulus)

    @property
    def _reduced_modulus(self) -> Array:
        return reduced_modulus(self.materials.body_1, self.materials.body_2)

    @property
    def load_per_length(self) -> Scalar:
        """Load per length, N/m, given or from the Hertz pressure."""
        operation = self.operation
        if operation.load_per_length is not None:
            return operation.load_per_length
        return self.hertz.load_at_pressure(operation.pressure)

    def scales(self) -> Scales:
        """Dimensionless numbers and the units of the unknowns."""
        modulus, radius, load = self._reduced_modulus, self.geometry.reduced_radius_rolling, self.load_per_length
        load, radius = jnp.asarray(load, dtype=float), jnp.asarray(radius, dtype=float)
        speed = jnp.abs(jnp.asarray(self.operation.entrainment_speed, dtype=float))
        moving = speed > 0
        reference = jnp.where(moving, speed, 1.0)
        half_width = jnp.sqrt(8.0 * load * radius / (jnp.pi * modulus))
        pressure = 2.0 * load / (jnp.pi * half_width)
        inlet = self.oil.at(self.operation.oil_temperature)
        wedge = 12.0 * inlet.viscosity * reference * radius**2 / (half_width**3 * pressure)
        speed_number = 2.0 * inlet.viscosity * reference / (modulus * radius)
        return Scales(
            half_width,
            pressure,
            load,
            half_width**2 / radius,
            reference,
            jnp.asarray(wedge),
            load / (modulus * radius) / jnp.sqrt(speed_number),
            jnp.asarray(inlet.pressure_viscosity * modulus * speed_number**0.25),
        )

    def fluid(self, scales: Scales) -> Fluid:
        """The oil as functions of this contact's dimensionless pressure."""
        temperature = jnp.asarray(self.operation.oil_temperature, dtype=float)
        return Fluid(self.oil.viscosity, temperature, scales.hertz_pressure, self.contact.compressible)

    def formulas(self, speed: Scalar | None = None) -> dict[str, Float[Array, ""]]:
        """Films by formulas, for comparison, m. **Arguments:** `speed`: m/s; that of the operation if not given."""
        inlet = self.oil.at(self.operation.oil_temperature)
        speed = jnp.abs(jnp.asarray(self.operation.entrainment_speed if speed is None else speed, dtype=float))
        laws: dict[str, AbstractLineFilm] = {
            "moes_central": Moes(),
            "dowson_toyoda_central": DowsonToyoda(),
            "dowson_higginson_minimum": DowsonHigginson(),
        }
        load = jnp.asarray(self.load_per_length, dtype=float)
        contact, oil = self.hertz, (inlet.viscosity, inlet.pressure_viscosity)
        return {name: jnp.exp(law.log_thickness(contact, load, speed, *oil)) for name, law in laws.items()}

    def steady(self, scales: Scales, speed: Scalar) -> Steady:
        """The steady problem at a speed (over the reference speed, any sign)."""
        speed = jnp.asarray(speed, dtype=float)
        guess = self.formulas(speed * scales.reference_speed)["moes_central"] / scales.film
        return Steady(self.fluid(scales), scales.wedge, speed, guess, self.solvable(scales, speed))

    def film_ratio(self, scales: Scales, film: Any = None) -> Float[Array, ""]:
        """Moes' M/H, on which the errors of mesh and inlet depend (`resolution`). **Arguments:** `film`: Moes'
        central film, m, if it is known."""
        film = self.formulas()["moes_central"] if film is None else film
        return 0.125 * jnp.pi * scales.film / film

    def solvable(self, scales: Scales, speed: Scalar) -> Bool[Array, ""]:
        """True if there is a film at this speed and the model applies to it."""
        return existing(scales.wedge, speed) & self.described(scales)

    def described(self, scales: Scales) -> Bool[Array, ""]:
        """True if the cylinders deform enough for this elastic model."""
        return scales.moes_load >= SMALLEST_MOES_LOAD

    @property
    def steady_mesh(self) -> MeshKey:
        return MeshKey(self.contact.nodes, self.contact.inlet, OUTLET)

    def run_mesh(self, reverses: bool) -> MeshKey:
        """Mesh of a transient run; one that reverses has an inlet on both sides."""
        outlet = self.contact.inlet if reverses else STOP_OUTLET
        return MeshKey(self.contact.nodes, self.contact.inlet, outlet, stop=True)

    def assumptions(self) -> tuple[str, ...]:
        """Notes for the user: assumptions, and limits of the oil's data."""
        # the notes of the oil on conductivity and rheology are about what is not used here
        notes = tuple(f"oil: {note}" for note in self.oil.viscosity.notes)
        if self.contact.compressible:
            return notes
        return (
            *notes,
            "the oil is incompressible (contact.compressible): compression thins the central film",
        )

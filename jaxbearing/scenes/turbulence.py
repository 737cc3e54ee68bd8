"""What the names of flow regimes in scene files stand for."""

from ..gaps import AbstractTurbulence, BlendedTurbulence, FullTurbulence, Laminar

TURBULENCE: dict[str, type[AbstractTurbulence]] = {
    "laminar": Laminar,
    "blend": BlendedTurbulence,
    "pure": FullTurbulence,
}

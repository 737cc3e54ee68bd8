"""Names of flow regimes in scene files, and their models."""

from ..gaps import AbstractTurbulence, BlendedTurbulence, FullTurbulence, Laminar

TURBULENCE: dict[str, type[AbstractTurbulence]] = {
    "laminar": Laminar,
    "blend": BlendedTurbulence,
    "pure": FullTurbulence,
}

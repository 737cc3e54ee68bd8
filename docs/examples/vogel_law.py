"""A viscosity law of one's own in a bearing: Vogel's temperature dependence with Barus' pressure dependence."""

import jax.numpy as jnp

import jaxbearing as jb
from jaxbearing.lubricants import ConstantPressureViscosity
from jaxbearing.lubricants.viscosity import AbstractViscosity


class VogelBarus(AbstractViscosity):
    r"""$\ln\mu = \ln\mu_\infty + b/(T - c) + \alpha p$.

    **Validity:** T above c by some 50 K; below 0.5 GPa, as Barus' law.
    **Reference:** Vogel (1921), Phys. Z. 22, 645; Barus (1893), Am. J. Sci. 45, 87.
    """

    limit_viscosity: float
    temperature_factor: float
    pole_temperature: float
    pressure_factor: float

    def log_viscosity(self, pressure, temperature):
        cold = jnp.maximum(temperature - self.pole_temperature, 1.0)
        return jnp.log(self.limit_viscosity) + self.temperature_factor / cold + self.pressure_factor * pressure


law = VogelBarus(limit_viscosity=5e-5, temperature_factor=1000.0, pole_temperature=155.0, pressure_factor=10.4e-9)

if __name__ == "__main__":
    scene = jb.load_scene("reference_roller", {"contact.traction": "none", "cage": "none", "drag": "none"})
    own = scene.replace({"oil.viscosity": law, "oil.pressure_viscosity": ConstantPressureViscosity(10.4e-9)})
    for name, one in {"catalogue": scene, "Vogel and Barus": own}.items():
        viscosity = 1e3 * float(one.oil.viscosity.viscosity(0.0, 373.15))
        film = 1e6 * float(jb.solve(one).elements.film_inner[0])
        print(f"{name}: {viscosity:.3f} mPa s at 100 degC, film {film:.4f} um")

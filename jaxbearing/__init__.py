"""jaxbearing: lubricated rolling bearings, differentiable, in JAX.

Importing the package switches JAX to 64-bit floats.
"""

import jax

jax.config.update("jax_enable_x64", True)

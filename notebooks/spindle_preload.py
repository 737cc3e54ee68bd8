# Draft of the notebook spindle_preload.ipynb, which has not been run yet. Each `# %%` begins a cell.

# %% [markdown]
# # The preload of a spindle pair over speed and temperature
#
# A pair of spindle bearings in O arrangement is mounted with 180 N. How much of this preload is there at 24 500
# rpm, and how much when the shaft is warmer than the housing? It depends on how the preload is held: by a
# **rigid** distance of the rings, by a **spring**, or by a constant **force** (a hydraulic piston, or a spring
# that is very soft). This notebook compares the three. Running all cells takes about two minutes, nearly all of
# it compiling.

# %%
import jax
import jax.numpy as jnp
import matplotlib.pyplot as plt
import numpy as np

import jaxbearing as jb

plt.rcParams["figure.dpi"] = 90
RPM = 2 * np.pi / 60

# %% [markdown]
# ## One pair, three ways to hold it
#
# The built-in scene `spindle_pair` has 20 balls of 6.35 mm on 65 mm and 17 deg, 16 mm apart. All three ways
# give 180 N in the mounted pair at rest; the spring has 2 N/um. There is no load from outside.

# %%
pair = jb.load_scene("spindle_pair", {"force.cutting": "none"})
ways = {
    "rigid": pair,
    "spring, 2 N/um": jb.load_scene(
        "spindle_pair",
        {
            "force.cutting": "none",
            "set.pair.preload.spring_force": "180 N",
            "set.pair.preload.spring_stiffness": "2 N/um",
        },
    ),
}
ways["constant force"] = ways["spring, 2 N/um"].replace({"set.pair.preload.spring_stiffness": 0.0})
geometry = pair.sets[0].scene.geometry
groove = 0.5 * (geometry.pitch_diameter - geometry.ball_diameter * np.cos(geometry.contact_angle))


def running(scene, rpm, warmer):
    """Axial force of a bearing, N, and axial stiffness of the pair, N/m. The shaft, its inner rings included, is
    `warmer` than the rest, K; steel, 12e-6 1/K."""
    strain = 12e-6 * warmer
    changes = {"shaft.speed": rpm * RPM, "shaft.thermal_strain": strain, "set.pair.expansion": strain * groove}
    solved = jb.solve(scene.replace(changes), throw=False)
    first, second = solved.bearings.values()
    spring = scene.sets[0].preload.spring_stiffness
    other = second.stiffness[0, 0]
    # a ring on a spring gives way with it
    other = other if spring is None else other * spring / (other + spring)
    return first.force[0], first.stiffness[0, 0] + other


compiled = {}  # both springs are one program
for scene in ways.values():
    structure = jax.tree.structure(scene)
    if structure not in compiled:
        numbers = lambda leaves, rpm, warmer, structure=structure: running(
            jax.tree.unflatten(structure, leaves), rpm, warmer
        )
        compiled[structure] = jax.jit(jax.vmap(numbers, (None, 0, 0)))


def curve(name, rpm, warmer):
    """Forces, N, and stiffnesses, N/um, at speeds and temperatures."""
    leaves, structure = jax.tree.flatten(ways[name])
    rpm, warmer = np.broadcast_arrays(np.asarray(rpm, float), np.asarray(warmer, float))
    force, stiffness = compiled[structure]([jnp.asarray(leaf) for leaf in leaves], rpm, warmer)
    return np.asarray(force), 1e-6 * np.asarray(stiffness)


# %% [markdown]
# ## Over speed
#
# Centrifugal force presses the balls outwards: the outer contact angle falls, the inner one rises, and a ball
# that wants to move out wedges the rings apart. Between rigid rings this adds to the preload. A spring gives
# way.

# %%
speeds = np.linspace(0.0, 24_500.0, 15)
over_speed = {name: curve(name, speeds, np.zeros_like(speeds)) for name in ways}
figure, axes = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
for name, (force, stiffness) in over_speed.items():
    axes[0].plot(speeds, force, label=name)
    axes[1].plot(speeds, stiffness, label=name)
    print(f"{name:16} {force[0]:5.0f} N at rest; at 24 500 rpm {force[-1]:5.0f} N and {stiffness[-1]:5.1f} N/um")
axes[0].set(xlabel="rpm", ylabel="preload, N")
axes[1].set(xlabel="rpm", ylabel="axial stiffness of the pair, N/um")
axes[0].legend()
rigid, soft = over_speed["rigid"][0], over_speed["constant force"][0]
np.testing.assert_allclose(rigid[[0, -1]], [180.0, 425.807], rtol=1e-5)
np.testing.assert_allclose(soft, 180.0, rtol=1e-8)

# %% [markdown]
# The rigid pair more than doubles its preload, and with it the load of every contact: it runs hotter than it
# was mounted. Constant force keeps 180 N at all speeds, and pays with stiffness: only one of the two bearings
# holds the shaft along its axis.
#
# ## Over temperature
#
# The inner rings and the shaft are warmer than the outer rings and the housing. Two things happen: the shaft
# between the rows grows, which opens an O pair, and the inner raceways grow radially, which closes it. With
# rows 16 mm apart the second is far stronger.

# %%
warmer = np.linspace(0.0, 12.0, 13)
over_temperature = {name: curve(name, np.full_like(warmer, 20_000.0), warmer) for name in ways}
figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
for name, (force, _) in over_temperature.items():
    axes.plot(warmer, force, label=name)
    print(f"{name:16} {force[0]:5.0f} N, with 12 K more {force[-1]:5.0f} N")
axes.set(xlabel="shaft warmer than the housing, K", ylabel="preload at 20 000 rpm, N")
axes.legend()
hot = over_temperature["rigid"][0]
assert hot[-1] > 1.5 * hot[0]
np.testing.assert_allclose(over_temperature["constant force"][0], 180.0, rtol=1e-8)

# %% [markdown]
# ## Newtons a kelvin
#
# The derivative says it without a curve. It is exact: the implicit function theorem at the equilibrium of the
# pair.

# %%
leaves, structure = jax.tree.flatten(ways["rigid"])
leaves = [jnp.asarray(leaf) for leaf in leaves]
force = lambda kelvin: running(jax.tree.unflatten(structure, leaves), 20_000.0, kelvin)[0]
_, slope = jax.jit(lambda kelvin: jax.jvp(force, (kelvin,), (1.0,)))(0.0)
print(f"rigid pair at 20 000 rpm: {float(slope):.1f} N a kelvin")
np.testing.assert_allclose(slope, (hot[1] - hot[0]) / (warmer[1] - warmer[0]), rtol=0.1)

# %% [markdown]
# ## Next
#
# * `set.pair.distance` moves the rows apart: the neutral distance of this pair, where both growths cancel to
#   first order, is about 193 mm.
# * An X pair (`set.pair.picture = "><"`) always gains preload with a warm shaft.
# * `jaxbearing stiffness spindle_pair --speeds "0 rpm:24500 rpm:8"` writes the whole 5 x 5 stiffness over
#   speed, also for ROSS.

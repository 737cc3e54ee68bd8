"""Lanes shared out among devices, in processes of their own that have two."""

import json
import subprocess
import sys

import pytest
from command_process import environment

SMALL = """
import jax, jax.numpy as jnp, json
import jaxbearing
from jaxbearing.numerics.devices import shared_out

@jax.jit
def run(lanes, factor):
    # each device goes round as often as the slowest of its own lanes
    def lane(x):
        return jax.lax.while_loop(lambda s: s[0] < x, lambda s: (s[0] + 1.0, s[1] + factor * x), (0.0, 0.0))[1]
    return shared_out(lambda lanes, factor: jax.vmap(lane)(lanes["x"]))(lanes, factor)

found = {count: run({"x": jnp.arange(float(count))}, jnp.asarray(3.0)) for count in (1, 3, 4)}
slope = jax.grad(lambda f: jnp.sum(shared_out(lambda x, f: x * f**2)(jnp.arange(4.0), f)))(2.0)
print(json.dumps([
    len(jax.devices()), [values.tolist() for values in found.values()], float(slope),
    [len(values.sharding.device_set) for values in found.values()],
]))
"""
BATCH = """
import gc, json
gc.set_threshold(100_000, 20, 10)
import jax
import jax.numpy as jnp
import jaxbearing as jb
from moving_roller import table_16

def run(loads):
    runs = jb.simulate_batch(table_16(0.6), 1e-4, {"operation.radial_load": loads}, method="vmap")
    return runs.converged.tolist(), runs.instants.cage.speed

loads = jnp.asarray([20e3, jnp.nan, 22e3, 25e3])
(good, together), (_, alone), (_, put) = run(loads), run(loads[3:]), run(jax.device_put(loads[3:], jax.devices()[1]))
apart = [float(jnp.max(jnp.abs(one[0] / jax.device_get(together)[3] - 1.0))) for one in (alone, put)]
print(json.dumps([[len(one.sharding.device_set) for one in (together, alone, put)], good, apart]))
"""


def printed(folder, program):
    command = [sys.executable, "-c", program]
    surroundings = environment(JAX_NUM_CPU_DEVICES="2", JAX_PLATFORMS="cpu")
    ran = subprocess.run(command, cwd=folder, env=surroundings, capture_output=True, text=True, timeout=300)
    assert ran.returncode == 0, ran.stderr[-2000:]
    return json.loads(ran.stdout)


def test_lanes_are_shared_out_where_they_divide(tmp_path):
    devices, found, slope, used = printed(tmp_path, SMALL)
    assert devices == 2
    assert found == [[3.0 * x * x for x in map(float, range(count))] for count in (1, 3, 4)]
    assert slope == 2.0 * 2.0 * 6.0
    assert used == [1, 1, 2]


@pytest.mark.slow
def test_runs_in_time_on_two_devices_are_those_on_one(tmp_path):
    """Four lanes of which one fails, on both; one lane, on one; and one where it was put."""
    used, good, apart = printed(tmp_path, BATCH)
    assert used == [2, 1, 1]
    assert good == [True, False, True, True]
    assert max(apart) < 1e-9

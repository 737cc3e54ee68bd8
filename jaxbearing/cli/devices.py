"""Number of JAX devices on this machine: on a CPU as many as there are cores to use, if a verb asks for them."""

import os


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def use_cores(count: int) -> None:
    """Let JAX have so many CPU devices. To be called before anything runs on JAX; what the environment says
    (`JAX_NUM_CPU_DEVICES`, `XLA_FLAGS`) holds, and devices that are there already stay."""
    import jax

    if getattr(jax.config, "jax_num_cpu_devices", -1) > 0 or "host_platform_device_count" in os.environ.get(
        "XLA_FLAGS", ""
    ):
        return
    try:
        jax.config.update("jax_num_cpu_devices", count)
    except RuntimeError:
        # JAX runs already
        return

"""Times of a run that lasts from seconds to days, as people read them."""

_UNITS = ((2.0 * 86400.0, "d", 86400.0), (2.0 * 3600.0, "h", 3600.0), (120.0, "min", 60.0), (0.0, "s", 1.0))


def clock_unit(longest: float) -> tuple[str, float]:
    """Unit of an axis of time, and its length in s. **Arguments:** `longest`: time, s."""
    return next((unit, length) for least, unit, length in _UNITS if longest >= least)


def clock(time: float) -> str:
    """A time, s, with a unit."""
    unit, length = clock_unit(time)
    return f"{time / length:.4g} {unit}"

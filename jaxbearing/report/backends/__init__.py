"""Backends that make outputs: they know formats and libraries, and no kind of result."""

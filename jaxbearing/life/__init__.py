"""Fatigue life (ISO 281, ISO 16281) of a solved bearing, and the ratings that it needs.

The standards themselves were not at hand. Each formula says how far its constants are supported:
[T] it reproduces well-known values of the standard's tables, [D] derived here by computation, [C] it passes a test of
consistency, [M] from memory only.
"""

"""Numerics without physics: safe functions, roots, quadrature, the block-arrow Newton, status."""

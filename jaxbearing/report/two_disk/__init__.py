"""Output of traction curves."""

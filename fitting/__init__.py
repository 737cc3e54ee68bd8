"""Rheology of an oil from two-disk traction curves: comes with the full traction model, empty until then."""

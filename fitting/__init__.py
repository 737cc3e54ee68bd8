"""Identification of an oil's rheology from two-disk traction curves: arrives with the traction model, empty until then."""

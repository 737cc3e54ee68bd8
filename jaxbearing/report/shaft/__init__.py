"""Outputs of shafts on bearings."""

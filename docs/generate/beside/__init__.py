"""The computations of `measurements.py` for the page "Beside measurements": one module for each kind of data."""

"""What `measurements.py` computes for the page "Beside measurements": one module for each kind of data."""

"""Several bearings together: matched sets, and shafts on bearings."""

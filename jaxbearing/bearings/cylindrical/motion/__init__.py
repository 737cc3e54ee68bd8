"""Motion of the cylindrical roller bearing: rates of rollers and cage, start, results of an instant, range checks."""

"""Scene files of cylindrical roller bearings: schema, builder, writer."""

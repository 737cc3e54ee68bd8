"""Scene files of ball bearings: schema, builder, writer."""

"""Scene files of shafts on bearings: names of their tables, schema, builder, writer."""

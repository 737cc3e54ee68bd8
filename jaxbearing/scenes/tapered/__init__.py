"""Scene files of tapered roller bearings: schema, builder, writer."""

"""Scene files of two-disk machines: schema, builder, writer."""

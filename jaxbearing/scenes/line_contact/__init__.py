"""Scene files of line contacts: schema, builder, writer."""

"""Tables of scene files that all bearings have: schema, builder, writer."""

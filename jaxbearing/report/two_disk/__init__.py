"""How traction curves are shown."""

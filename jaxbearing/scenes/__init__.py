"""Scene files: reading, units, validation, the built-in scenes. The edge of the library: nothing inside imports it.

Nothing is imported here, so that the list of built-in scenes does not wait for the models; see `reader`.
"""

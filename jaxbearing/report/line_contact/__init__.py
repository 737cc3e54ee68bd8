"""Output of the film of a line contact, steady and in time."""

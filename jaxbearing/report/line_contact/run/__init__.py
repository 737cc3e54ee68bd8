"""Output of a transient run of a line contact."""

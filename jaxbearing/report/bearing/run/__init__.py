"""Output of a transient run of a bearing."""

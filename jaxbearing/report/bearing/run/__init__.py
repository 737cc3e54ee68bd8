"""Output of a run in time of a bearing."""

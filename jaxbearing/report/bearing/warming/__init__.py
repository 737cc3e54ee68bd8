"""Output of a run of the temperatures of a bearing."""

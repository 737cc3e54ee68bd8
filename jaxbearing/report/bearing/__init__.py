"""Output of a bearing's solution."""

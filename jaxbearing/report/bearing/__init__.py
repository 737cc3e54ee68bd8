"""How a bearing's solution is shown."""

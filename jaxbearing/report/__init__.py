"""Output of solutions: JSON for programs, a summary for people."""

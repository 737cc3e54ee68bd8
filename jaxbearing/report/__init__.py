"""What a solution looks like: JSON for programs, a summary for people."""

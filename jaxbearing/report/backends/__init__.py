"""What outputs are made with: they know formats and libraries, and no kind of result."""

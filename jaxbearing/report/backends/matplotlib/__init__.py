"""Pages, panels and moving pictures with matplotlib."""

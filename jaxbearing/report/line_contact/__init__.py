"""How the film of a line contact is shown, steady and in time."""

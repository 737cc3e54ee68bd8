"""Ball bearings in motion: balls free in the plane of their groove, with orbit and spin as states, cage and ring."""

"""Does it hold, and how long: pin, horn, lock, shafts, and the roller's life."""

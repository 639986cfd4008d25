"""Effects of the dimensions' deviations on the wheel's place, play and entry."""

"""What the dimensions' deviations do to the wheel's place, play and entry."""

"""The full turn: a collision check of the parts at sampled positions, and its certificate."""

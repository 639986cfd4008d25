"""The full turn: a collision check of the parts in all positions."""

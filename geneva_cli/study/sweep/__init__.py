"""Sweeps: one row for each design of a grid or of a random sample."""

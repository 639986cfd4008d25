"""Strength and life of pin, arm, keys, horn, lock, shafts and roller."""

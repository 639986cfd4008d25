"""Strength and life of pin, horn, lock, shafts and roller."""

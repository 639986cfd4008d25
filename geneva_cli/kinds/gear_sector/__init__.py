"""Gear sectors: steps at a constant ratio."""

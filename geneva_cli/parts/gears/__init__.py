"""Gears: pitch curves, and blanks up to them."""

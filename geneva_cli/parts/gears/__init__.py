"""Gears: pitch curves, meshes, teeth and blanks."""

"""Spherical machines: the parts of wheels whose shafts meet at an angle."""

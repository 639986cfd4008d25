"""Drawings of spherical machines."""

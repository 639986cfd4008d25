"""Carousels: wheels on a carrier that turns about a standing finger."""

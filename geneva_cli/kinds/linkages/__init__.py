"""Linkages that carry the roller: four-bars and slider-cranks."""

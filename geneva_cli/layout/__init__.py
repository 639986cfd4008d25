"""Sizes and positions of the parts, before any outline is drawn."""

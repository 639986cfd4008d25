"""Sizes of the parts: of the spec, usual ones, and those that a load needs."""

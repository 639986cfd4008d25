"""Impacts of the roller: at entry, at the mouth, at a change of sides."""

"""Figures: their layout, and their formats."""

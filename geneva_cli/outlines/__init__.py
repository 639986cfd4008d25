"""Outlines of wheel and crank, and bounds of the gaps between them."""

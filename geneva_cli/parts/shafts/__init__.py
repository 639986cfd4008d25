"""Shafts, bores, fits, screws and hubs."""

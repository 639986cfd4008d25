"""Shafts, bearings, bores, keys, screws and hubs."""

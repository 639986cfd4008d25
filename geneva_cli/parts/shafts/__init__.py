"""Bores, screws, shafts, hubs and the crank arm."""

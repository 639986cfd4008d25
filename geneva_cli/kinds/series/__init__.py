"""Drives in series: one machine turns the input shaft of another."""

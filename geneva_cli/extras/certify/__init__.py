"""Certificates: proved bounds of the peaks and loads."""

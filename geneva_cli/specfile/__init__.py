"""Specs as TOML files: read, written, explained."""

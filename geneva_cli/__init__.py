"""Design calculator for Geneva (Maltese-cross) mechanisms."""

__version__ = "0.1.0"

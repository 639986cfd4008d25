"""Every machine against mpmath: what `stress.py` compares, by subject."""

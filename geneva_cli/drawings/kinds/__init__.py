"""The kinds of parts of wheels, each a file and a line in ``kind.py``."""

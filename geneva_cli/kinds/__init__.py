"""Kinds of machines that only some users need, a folder each.

The list holds folders, a line each, as a test leaves each out. Each has ``KINDS``, the records of
its kinds, and imports nothing else.
"""

FOLDERS = (
    "series",
    "linkages",
    "gear_sector",
    "carousel",
    "spherical",
    "stop",
    "linear",
)

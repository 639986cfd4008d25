"""Answers that not every user needs.

The list holds folders. Each has ``EXTRA``, its record, and imports nothing else.
"""

FOLDERS = (
    "certify",
    "outline",
    "servo",
)

"""Answers that not every user needs.

The list holds folders. Each has ``ANSWERS``, the names of its functions, and imports nothing else.
"""

FOLDERS = (
    "certify",
    "servo",
)

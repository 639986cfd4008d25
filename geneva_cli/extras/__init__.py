"""Answers that not every user needs.

The list holds folders. Each names the functions of its ``ANSWERS`` and the classes of its ``LAWS``,
and imports nothing.
"""

FOLDERS = (
    "certify",
    "outline",
    "servo",
)

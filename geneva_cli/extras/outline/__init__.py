"""Outlines that somebody else drew: whether they turn, and with which motion."""

from geneva_cli.motion.kind import Extra

EXTRA = Extra(
    answers={
        "checks": "extras.outline.checks:checks",
        "warnings": "extras.outline.checks:warnings",
    }
)

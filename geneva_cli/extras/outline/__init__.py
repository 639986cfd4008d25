"""Outlines that somebody else drew: whether they turn, and with which motion."""

from geneva_cli.motion.kind import Extra

EXTRA = Extra(
    answers={
        "checks": "extras.outline.checks:checks",
        "motion": "extras.outline.real_motion:motion",
        "peaks": "extras.outline.real_motion:peaks",
        "warnings": "extras.outline.checks:warnings",
    }
)

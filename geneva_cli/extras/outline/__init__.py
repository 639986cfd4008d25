"""Outlines that somebody else drew: whether they turn, and with which motion."""

ANSWERS = {
    "as_built": "extras.outline.checks:as_built",
    "checks": "extras.outline.checks:checks",
    "motion": "extras.outline.real_motion:motion",
    "over": "extras.outline.pictures:over",
    "peaks": "extras.outline.real_motion:peaks",
    "scene": "extras.outline.pictures:drawn_scene",
    "warnings": "extras.outline.checks:warnings",
}
LAWS: dict[str, str] = {}

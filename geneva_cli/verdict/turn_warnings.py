"""Warnings about a whole turn of the parts that breaks no limit."""

from __future__ import annotations

from geneva_cli.collisions.full_turn import SAME
from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError, Notice
from geneva_cli.verdict.checks.play import motion_play_max


def turn_warnings(model: PartsModel) -> list[Notice]:
    """Warnings about the parts' whole turn; none without such a turn."""
    if not model.mechanism.spec.is_turned:
        return []
    try:
        ahead, behind, limit = model.turn.ahead, model.turn.behind, motion_play_max(model.parts)
    except GenevaError:
        return []
    # Play to both sides has a limit of its own.
    free = max(ahead.deg, behind.deg)
    if free <= limit or model.turn.motion.deg >= free * (1.0 - SAME):
        return []
    first = ahead.deg >= behind.deg * (1.0 - SAME)
    side, at_deg = ("ahead", ahead.at_deg) if first else ("behind", behind.at_deg)
    if len(model.parts.assembly.rollers) > len(model.parts.assembly.motions):
        return [
            Notice(
                "driven-by-one-wall",
                f"in its slots the wheel is free ahead by {ahead.deg:.4g} deg at "
                f"{ahead.at_deg:.4g} deg and behind by {behind.deg:.4g} deg at "
                f"{behind.at_deg:.4g} deg. One wall starts it and one stops it: it leaves them if "
                "its load overruns the first roller, or stays behind the second",
            )
        ]
    helps = "a load that overruns the roller" if first else "a load that holds back"
    return [
        Notice(
            "driven-by-one-wall",
            f"in its slot the wheel is free {side} by {free:.4g} deg at {at_deg:.4g} deg, where "
            f"one wall alone drives it: {helps} meets a corner. Friction or a brake keeps it on "
            "that wall",
        )
    ]

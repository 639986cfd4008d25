"""Failing checks in words: those that prevent the parts, and others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.table import in_digits
from geneva_cli.verdict.checks.all_checks import JAMS
from geneva_cli.verdict.checks.check import Check

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts


def failures(rows: list[Check], parts: Parts) -> tuple[str, list[str]]:
    """The reason why the parts jam or cannot be cut, and a sentence on each other failing check.

    The first text is empty if the parts can be written.
    """
    refused, warned, advice = [], [], ""
    for c in rows:
        if c.passes is not False:
            continue
        if c.name == "full_turn":
            refused.append(c.why)
        elif c.name == "parts":  # the reason why there are none
            warned.append(c.why)
        elif c.not_computed:
            warned.append(c.not_computed)
        elif c.name in JAMS or (
            # Links and gears lie below the wheel's plane, so the wheel can be cut all the same.
            c.name not in ("link_wall_mm", "link_gap_mm", "gear_gap_mm")
            and c.must_be == "at least"
            and c.name.endswith("_mm")
            and (c.value or 0.0) < 0.0
        ):
            refused.append(in_words(c, parts.turn.smallest.parts if c.name == "gap_mm" else ""))
            advice = advice or c.nearest
        else:
            more = f"{c.nearest} would pass" if c.nearest else c.why
            warned.append("; ".join(text for text in (in_words(c), more) if text))
    return "; ".join(refused) + (f"; {advice} would free it" if advice else ""), [
        *dict.fromkeys(warned)
    ]


def in_words(c: Check, parts: str = "") -> str:
    """A failing check in words; ``parts`` names those that overlap, where they are known."""
    shown = in_digits(c.value or 0.0, 6)
    general = f"{c.name} is {shown}{c.where}; it must be {c.must_be} {c.limit or 0.0:.6g}"
    return meaning(c, parts) or general


def meaning(c: Check, parts: str = "") -> str:
    """The meaning of a failing check; empty if its value is enough."""
    from geneva_cli.verdict.checks.walls import NO_WALL

    where, value, limit = c.where, c.value or 0.0, c.limit or 0.0
    if c.name == "gap_mm":
        return f"{parts or 'parts'} overlap by {-value:.4g} mm{where}"
    if c.name == "idle_roller_mm":
        return f"an idle roller overlaps the wheel by {-value:.4g} mm{where}"
    if c.name in NO_WALL and value < 0.0:
        return f"{NO_WALL[c.name]} by {-value:.4g} mm"
    if c.name == "dwell_hold":
        return "nothing holds the wheel in its dwell"
    moves, unit = ("rack can move", " mm") if c.name.endswith("_mm") else ("wheel can turn", "°")
    if c.name in ("hand_over_play_deg", "hand_over_play_mm"):
        return (
            f"between lock and slot the {moves} by {value:.4g}{unit}{where}, more than the "
            f"{limit:.4g}{unit} at which the roller still finds its slot"
        )
    if c.name == "hand_over_pressure_deg":
        return (
            f"the roller meets the wheel{where} at a pressure angle of {value:.4g}°, above "
            f"{limit:g}°"
        )
    if c.name == "driven_fraction":
        return f"not positively driven during {100.0 * (1.0 - value):.3g} % of the motion"
    if c.name == "hand_over_offset_mm":
        return (
            f"the rim does not reach the roller, which first touches the wheel{where}, "
            f"{value:.4g} mm farther off the slot's middle than the clearance"
        )
    if c.name in ("motion_play_deg", "motion_play_mm"):
        return (
            f"in its slot the {moves} by {value:.4g}{unit} either way{where}, more than "
            f"{limit:.4g}{unit}"
        )
    return ""

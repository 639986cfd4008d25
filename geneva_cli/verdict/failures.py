"""Failing checks in words, and what stands of a record below its summary."""

from collections.abc import Sequence

from geneva_cli.answer import value_text
from geneva_cli.errors import is_warning
from geneva_cli.names import spoken
from geneva_cli.parts.parts import Parts
from geneva_cli.table import Table, record_table
from geneva_cli.verdict.checks import Check

# The meaning of a failing check, by its name; without one its value says enough.
_PLAY = (
    "between lock and slot the {moves} by {value:.4g}{unit}{where}, more than the "
    "{limit:.4g}{unit} at which the roller still finds its slot"
)
_MOTION_PLAY = (
    "in its slot the {moves} by {value:.4g}{unit} either way{where}, more than {limit:.4g}{unit}"
)
MEANINGS = {
    "dwell_hold": "nothing holds the wheel in its dwell",
    "turns": "{value:.0f} of {limit:.0f} slots pass{where}",
    "gap_mm": "{parts} overlap by {short:.4g} mm{where}",
    "idle_roller_mm": "an idle roller overlaps the wheel by {short:.4g} mm{where}",
    "hand_over_play_deg": _PLAY,
    "hand_over_play_mm": _PLAY,
    "hand_over_pressure_deg": (
        "the roller meets the wheel{where} at a pressure angle of {value:.4g}°, above {limit:g}°"
    ),
    "hand_over_offset_mm": (
        "the mouth does not reach the roller, which first touches the wheel{where}, {value:.4g} mm "
        "farther off the slot's middle than the clearance"
    ),
    "driven_fraction": "not positively driven during {idle:.3g} % of the motion",
    "motion_play_deg": _MOTION_PLAY,
    "motion_play_mm": _MOTION_PLAY,
}


def below_summary(record: Table, without: Sequence[str] = ()) -> Table:
    """A record as it stands below its summary, without the warnings and the names shown there.

    Notes on unknown values remain, as ``not_known``. Of an angle in two units, degrees remain. An
    allowed stress without a stress is left out.
    """
    values = dict(zip(record.names, next(record.rows()), strict=True))
    notes = tuple(text for text in values.pop("warnings") if not is_warning(text))
    left = {n: v for n, v in values.items() if n not in without and not n.endswith("_arcsec")}
    for name in [n for n in left if n.endswith(".allowed_MPa")]:
        if left.get(name.replace("allowed_MPa", "margin")) is None:  # there is no stress
            del left[name]
    return record_table(left | ({"not_known": notes} if notes else {}), prose=record.prose)


def failures(rows: list[Check], parts: Parts) -> tuple[str, list[str]]:
    """The reason why the parts jam or cannot be cut, and a sentence on each other failing check."""
    refused, warned, advice = [], [], ""
    for c in rows:
        if c.passes is not False:
            continue
        # Links and gears lie below the wheel's plane, so the wheel can be cut all the same.
        below = c.name in ("link_wall_mm", "link_gap_mm", "gear_gap_mm")
        overlaps = c.must_be == "at least" and c.name.endswith("_mm") and (c.value or 0.0) < 0.0
        if c.name == "full_turn":
            refused.append(c.why)
        elif c.name == "parts":  # the reason why there are none
            warned.append(c.why)
        # a roller that does not find its slot, or meets the rim next to it, jams
        elif c.name.startswith("hand_over_") or (overlaps and not below):
            what = parts.turn.smallest.parts if c.name == "gap_mm" else "parts"
            refused.append(_in_words(c, what))
            advice = advice or c.nearest
        else:
            warned.append(sentence(c))
    free = f"; {advice} would free it" if advice else ""
    return "; ".join(refused) + free, [*dict.fromkeys(warned)]


def sentence(c: Check) -> str:
    """A failing check in words, with the change with which all checks pass, or the reason."""
    if c.value is None:
        return f"{c.name} is not computed: {c.why}"
    more = f"{c.nearest} would pass" if c.nearest else c.why
    return "; ".join(filter(None, (_in_words(c), more)))


def _in_words(c: Check, parts: str = "parts") -> str:
    return meaning(c, parts) or f"{spoken(c.name)[0]} {compared_text(c)}"


def compared_text(c: Check) -> str:
    """The value of a check, its place, and its limit."""
    unit = spoken(c.name)[1]
    where = "" if c.at_deg is None else f" at {value_text(c.at_deg, 'deg')}"
    limit = value_text(c.limit, unit if unit == "deg" else "")
    return f"{value_text(c.value, unit)}{where}, {c.must_be} {limit}"


def meaning(c: Check, parts: str = "parts") -> str:
    """The meaning of a failing check; empty if its value is enough."""
    value, limit = c.value or 0.0, c.limit or 0.0
    moves, unit = ("rack can move", " mm") if c.name.endswith("_mm") else ("wheel can turn", "°")
    named = {"value": value, "limit": limit, "short": -value, "idle": 100.0 * (1.0 - value)}
    where = "" if c.at_deg is None else f" at {value_text(c.at_deg, 'deg')}"
    words = {"where": where, "moves": moves, "unit": unit, "parts": parts}
    return MEANINGS.get(c.name, "").format(**named, **words)

"""Summary of ``geneva tolerance``: place and play of the wheel, and the main contributions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.answer import Answer, SummaryLine
from geneva_cli.design import Design
from geneva_cli.errors import is_warning
from geneva_cli.names import spoken
from geneva_cli.study.summary.titles import record_answer
from geneva_cli.table import Table
from geneva_cli.verdict.headline import bare, measured


def of_tolerance(design: Design, record: Table) -> Answer:
    """The answer of ``geneva tolerance``, from the record of ``Design.tolerance``."""
    values = record.to_dict()
    warnings = [*design.motion_warnings, *filter(is_warning, values["warnings"])]
    return record_answer(design, record, _lines(values), warnings)


def _lines(values: dict[str, Any]) -> Iterator[SummaryLine]:
    yield _angle("dwell", "place of the wheel", "dwell_position", values)
    yield _angle("motion", "play of the wheel", "motion_play", values)
    rows = values["contributions"]
    most = max(rows, key=lambda row: row["share"] or 0.0, default=None)
    if most and most["share"]:
        words, _ = spoken(most["dimension"])
        percent = measured(100.0 * most["share"], "%", 3)
        yield SummaryLine("greatest", f"{words} contributes {percent} of the dwell's variance")
    if values["entry_jump.worst"] is not None:
        jump = measured(values["entry_jump.worst"])
        yield SummaryLine("entry", f"the wheel's velocity jumps by up to {jump} of the input's")
    yield SummaryLine("clearances", _clearances(values))


def _angle(label: str, what: str, name: str, values: dict[str, Any]) -> SummaryLine:
    worst = values[f"{name}.worst_deg"]
    if worst is None:
        return SummaryLine(label, f"{what} is not known")
    most = measured(values[f"{name}.p997_deg"], "deg")
    seconds = measured(values[f"{name}.p997_arcsec"], "arc seconds", 3)
    at_worst = measured(worst, "deg")
    text = f"{what} within {most} ({seconds}) in 99.7 % of machines, {at_worst} at worst"
    return SummaryLine(label, text)


def _clearances(values: dict[str, Any]) -> str:
    turns = values["clearances.turns"]
    sentence = {True: "every machine turns", False: "not every machine turns", None: "not known"}[
        turns
    ]
    parts = [
        f"{part} {measured(values[f'clearances.{part}_mm'], 'mm')}, needed {bare(needed, 'mm')}"
        for part in ("slot", "lock")
        if (needed := values[f"clearances.{part}_needed_mm"]) is not None
    ]
    return "; ".join([sentence, *parts])

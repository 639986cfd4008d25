"""Summary of ``geneva vibration``: vibration after an index, and the speeds to avoid."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.answer import Answer, SummaryLine
from geneva_cli.design import Design
from geneva_cli.errors import is_warning
from geneva_cli.study.summary.titles import record_answer
from geneva_cli.table import Table
from geneva_cli.verdict.headline import measured


def of_vibration(design: Design, record: Table) -> Answer:
    """The answer of ``geneva vibration``, from the record of ``Design.vibration``."""
    values = record.to_dict()
    warnings = [text for text in values["warnings"] if is_warning(text)]
    return record_answer(design, record, _lines(values), warnings)


def _lines(values: dict[str, Any]) -> Iterator[SummaryLine]:
    if values["period_ratio"] is None:
        for text in values["warnings"]:
            yield SummaryLine("vibration", text.replace("no value is computed", "not known"))
        return
    ratio = measured(values["period_ratio"])
    damping = measured(values["damping_ratio"])
    hertz = values["natural_Hz"]
    natural = "" if hertz is None else f" of {measured(hertz, 'Hz')}"
    yield SummaryLine("motion", f"lasts {ratio} natural periods{natural}, damping ratio {damping}")
    residual = measured(values["residual_share"])
    swing = "an index leaves the load swinging"
    if values["residual_deg"] is not None:
        swing += f" by {measured(values['residual_deg'], 'deg')}"
    if values["residual_share"] < 1e-6:  # of a step of 90°, a third of an arc second
        swing = "an index leaves the load practically at rest"
    yield SummaryLine("residual", f"{swing}, {residual} of the step")
    if values["residual_share_worst"] is not None:
        worst = measured(values["residual_share_worst"])
        yield SummaryLine("worst", f"{worst} of the step, with a stiffness off by up to 20 %")
    windup = "" if values["windup_deg"] is None else measured(values["windup_deg"], "deg")
    factor = measured(values["dynamic_factor"])
    yield SummaryLine(
        "load",
        f"accelerated {factor} times as hard as the wheel"
        + (f"; the shaft winds up by {windup}" if windup else ""),
    )
    speeds = values["speeds_to_avoid_rpm"]
    avoid = ", ".join(measured(rpm) for rpm in speeds)
    yield SummaryLine(
        "avoid", f"{avoid} rpm" if speeds else "no speed from half to twice the design's"
    )

"""Summary of ``geneva report``: the verdict, six key figures and the motor."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.answer import Answer, Summary, SummaryLine
from geneva_cli.design import Design
from geneva_cli.study.summary.load_lines import cycle_lines, motor_line, title_of
from geneva_cli.verdict.headline import (
    below_summary,
    both_ways_lines,
    failure_lines,
    headline,
    input_lines,
    measured,
    tightest,
    warning_lines,
)


def of_report(design: Design) -> Answer:
    """The answer of ``geneva report``: the verdict, key figures, failures and warnings."""
    record = design.report.table
    state, text = headline(design.checks, design.warnings)
    checks, warnings = design.checks, design.warnings
    first = (*failure_lines(checks), *input_lines(design.with_units))
    both = both_ways_lines(checks) if design.spec.drive.both_ways else ()
    lines = (*first, *key_figures(design), *both, *warning_lines(checks, warnings))
    summary = Summary(f"{title_of(design)}: {text}", lines, state)
    shown = ("title", "passes", "checks_failed", "not_proved")
    return Answer((summary,), below_summary(record, without=shown), record)


def key_figures(design: Design) -> Iterator[SummaryLine]:
    """Six figures of a machine and its motor; without a load its peaks instead."""
    values = design.report.table.to_dict()
    unit, times = design.mechanism.output.unit, design.timings
    steps, motions, dwells = (
        " and ".join(dict.fromkeys(each))
        for each in (
            [measured(t.step, unit) for t in times],
            [measured(t.motion_s, "s") for t in times],
            [measured(t.dwell_s, "s") for t in times],
        )
    )
    n_rpm = measured(design.spec.drive.n_rpm, "rpm")
    text = f"{steps} in {motions}, then {dwells} of dwell; input at {n_rpm}"
    yield SummaryLine("cycle", text)
    yield _size(values)
    if design.cycle.is_loaded:
        yield from cycle_lines(design)
        yield from tightest(design.checks)
        yield motor_line(design)
    else:
        unit = design.mechanism.output.rate_unit
        for name, digit, power in (
            ("velocity", "", ""),
            ("acceleration", "2", "²"),
            ("jerk", "3", "³"),
        ):
            size = measured(values[f"{name}.max_{unit}_s{digit}"], f"{unit}/s{power}")
            yield SummaryLine(name, f"{size} at {measured(values[f'{name}.at_deg'], 'deg')}")
        yield from tightest(design.checks)
        yield SummaryLine("motor", f"not known: set {design.spec.load_keys}")


def _size(values: dict[str, Any]) -> SummaryLine:
    """Centre distance and wheel, or a sphere's radius, and the roller."""
    roller = f", roller Ø {measured(2.0 * values['sizes.roller_radius_mm'], 'mm')}"
    if values["sizes.center_distance_mm"] is None:
        radius = measured(values["sizes.sphere_radius_mm"], "mm")
        return SummaryLine("size", f"sphere of radius {radius}{roller}")
    across = "centre distance", values["sizes.center_distance_mm"]
    if values["timing.index_mm"] is not None:  # a rack has no axis
        across = "crank radius", values["sizes.crank_radius_mm"]
    text = f"{across[0]} {measured(across[1], 'mm')}"
    rim = values["sizes.wheel_radius_mm"]
    text += "" if rim is None else f", wheel Ø {measured(2.0 * rim, 'mm')}"
    return SummaryLine("size", f"{text}{roller}")

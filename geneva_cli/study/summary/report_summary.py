"""Summaries of ``geneva report``, ``vibration`` and ``tolerance``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.answer import Answer, Summary, SummaryLine, phrases, value_text
from geneva_cli.design import Design
from geneva_cli.errors import is_warning
from geneva_cli.names import capital, described, spoken
from geneva_cli.output.text import only
from geneva_cli.study import verdicts
from geneva_cli.study.summary import load_lines
from geneva_cli.table import Reading, Table, record_table, rows_table
from geneva_cli.verdict.checks import LIMITS, Check
from geneva_cli.verdict.failures import below_summary

LOADS = (
    *("alpha_rad_s2", "rack_acceleration_m_s2", "wheel_torque_Nm", "rack_force_N", "pin_force_N"),
    *("contact_stress_MPa", "input_torque_Nm", "power_W", "wheel_bearing_N", "crank_bearing_N"),
    "guide_force_N",
)
UNITS = {"N", "N m", "MPa", "W", "W/m²"}  # of checks that bound a load
COLUMNS = ("load", "value", "unit", "at_deg", "must_be", "limit", "passes")
PARTS = ("name", "count", "material", "thickness_mm", "size_x_mm", "size_y_mm", "mass_kg")


def greatest_loads(design: Design) -> Table:
    """Return a row for each load: its greatest size, where it is, and the limit of its check.

    Loads of the cycle come first, then those that only a check has, such as stresses of parts.
    """
    checks = {check.name: check for check in design.checks}
    rows: list[tuple[Any, ...]] = []

    def add(name: str, size: float, at_deg: float | None, check: Check | None) -> None:
        bound = (check.must_be, check.limit, check.passes) if check else (None, None, None)
        rows.append((capital(described(name)[0]), size, spoken(name)[1], at_deg, *bound))

    for name in LOADS if design.cycle.is_loaded else ():
        known = load_lines.greatest(design.loads[name])
        stem, _, unit = name.rpartition("_")
        if known:  # else the row of its check says that it has no bound
            add(name, *known, checks.pop(f"{stem}_max_{unit}", None))
    for name, check in checks.items():
        shown = name in LIMITS or spoken(name)[1] in UNITS or name == "pressure_angle_deg"
        if shown and check.value is not None:
            add(name, check.value, check.at_deg, check)
    first = ("load", "value", "limit", "unit", "must_be", "at_deg")
    return rows_table(COLUMNS, rows).replaced(reading=Reading(first, decide=("passes",)))


def parts_of(design: Design) -> Table | None:
    """Return count, material, size and mass of each part; None if there are none."""
    table: Table | None = design.report.table["parts_list.part"]
    return only(table, PARTS) if table else None


def of_report(design: Design, is_full: bool) -> Answer:
    """The answer of ``geneva report``: verdict, key figures, loads with limits, parts, warnings.

    If ``is_full``, all values of the report stand below the summary instead.
    """
    record, checks, warnings = design.report.table, design.checks, design.warnings
    state, text = verdicts.headline(checks, warnings)
    last = verdicts.warning_lines(checks, warnings, design.unused_acceptances)
    lines = (*verdicts.failure_lines(checks), *key_figures(design), *last)
    if is_full:
        shown = ("title", "passes", "checks_failed", "not_proved", "chosen")
        page = below_summary(record, without=shown)
    else:
        tables = {"greatest_loads": greatest_loads(design), "parts": parts_of(design)}
        page = record_table({n: t for n, t in tables.items() if t}, prose=record.prose)
    return Answer((Summary(f"{load_lines.title_of(design)}: {text}", lines, state),), page, record)


OF_LOADS = ("input", "pin", "wheel", "rack", "tightest", "motor")


def machine_lines(design: Design) -> Iterator[SummaryLine]:
    """The key figures without loads, which a table shows with their limits; then the motor."""
    lines = list(key_figures(design))
    yield from (line for line in lines if line.label not in OF_LOADS)
    yield from (line for line in lines if line.label == "motor")
    if design.cycle.is_loaded:
        yield from load_lines.flywheel_line(design)


def key_figures(design: Design) -> Iterator[SummaryLine]:
    """Six figures of a machine and its motor; without a load its peaks instead."""
    values = design.report.table.to_dict()
    unit, times = design.mechanism.output.unit, design.timings

    def each(name: str, unit: str) -> str:
        return " and ".join(dict.fromkeys(value_text(getattr(t, name), unit) for t in times))

    text = f"{each('step', unit)} in {each('motion_s', 's')}, then {each('dwell_s', 's')} of dwell"
    text += f"; input at {value_text(design.spec.drive.n_rpm, 'rpm')}"
    if design.spec.drive.stop_s:
        text += f", at rest for {value_text(design.spec.drive.stands_s, 's')} of each dwell"
    yield SummaryLine("cycle", text)
    first = "centre distance {sizes.center_distance_mm}"
    if values["timing.index_mm"] is not None:  # a rack has no axis
        first = "crank radius {sizes.crank_radius_mm}"
    size = phrases(values, first, "sphere of radius {sizes.sphere_radius_mm}")
    for part in ("wheel", "roller"):
        if (radius := values[f"sizes.{part}_radius_mm"]) is not None:
            size += f", {part} Ø {value_text(2.0 * radius, 'mm')}"
    yield SummaryLine("size", size)
    if design.cycle.is_loaded:
        yield from load_lines.cycle_lines(design)
        yield from verdicts.tightest(design.checks)
        yield load_lines.motor_line(design)
        yield from verdicts.chosen_lines(design.chosen_by_load, design.spec.path)
    else:
        unit = design.mechanism.output.rate_unit
        for name, power in {"velocity": "", "acceleration": "2", "jerk": "3"}.items():
            text = f"{{{name}.max_{unit}_s{power}}} at {{{name}.at_deg}}"
            yield SummaryLine(name, phrases(values, text))
        yield from verdicts.tightest(design.checks)
        yield SummaryLine("motor", f"not known: set {design.spec.output.load_keys}")


def of_vibration(design: Design, record: Table) -> Answer:
    """The answer of ``geneva vibration``, from the record of ``Design.vibration``."""
    values = record.to_dict()
    warnings = [text for text in values["warnings"] if is_warning(text)]
    return load_lines.record_answer(design, record, _swing_lines(values), warnings)


def _swing_lines(values: dict[str, Any]) -> Iterator[SummaryLine]:
    periods = "lasts {period_ratio} natural periods", " of {natural_Hz}"
    yield SummaryLine("motion", phrases(values, *periods, ", damping ratio {damping_ratio}"))
    swing = "an index leaves the load swinging", " by {residual_deg}"
    if values["residual_share"] < 1e-6:  # of a step of 90°, a third of an arc second
        swing = "an index leaves the load ", "practically at rest"
    yield SummaryLine("residual", phrases(values, *swing, ", {residual_share} of the step"))
    text = "accelerated {dynamic_factor} times as hard as the wheel"
    yield SummaryLine("load", phrases(values, text, "; the shaft winds up by {windup_deg}"))
    avoid = ", ".join(map(value_text, values["speeds_to_avoid_rpm"]))
    text = f"{avoid} rpm" if avoid else "no speed from half to twice the design's"
    yield SummaryLine("avoid", text)


def of_tolerance(design: Design, record: Table) -> Answer:
    """The answer of ``geneva tolerance``, from the record of ``Design.tolerance``."""
    values = record.to_dict()
    warnings = [*design.motion_warnings, *filter(is_warning, values["warnings"])]
    return load_lines.record_answer(design, record, _error_lines(values), warnings)


def _error_lines(values: dict[str, Any]) -> Iterator[SummaryLine]:
    yield _angle("dwell", "place of the wheel", "dwell_position", values)
    yield _angle("motion", "play of the wheel", "motion_play", values)
    most = max(values["contributions"], key=lambda row: row["share"] or 0.0, default=None)
    if most and most["share"]:
        words, _ = spoken(most["dimension"])
        percent = value_text(100.0 * most["share"], "%", 3)
        yield SummaryLine("greatest", f"{words} contributes {percent} of the dwell's variance")
    text = "the wheel's velocity jumps by up to {entry_jump.worst} of the input's"
    if entry := phrases(values, text):
        yield SummaryLine("entry", entry)
    turns = {True: "every machine turns", False: "not every machine turns", None: "not known"}
    parts = [
        f"{part} {value_text(values[f'clearances.{part}_mm'], 'mm')}, needed {value_text(needed)}"
        for part in ("slot", "lock")
        if (needed := values[f"clearances.{part}_needed_mm"]) is not None
    ]
    text = "; ".join([turns[values["clearances.turns"]], *parts])
    yield SummaryLine("clearances", text)


def _angle(label: str, what: str, name: str, values: dict[str, Any]) -> SummaryLine:
    text = f" within {{{name}.p997_deg}} in 99.7 % of machines, {{{name}.worst_deg}} at worst"
    return SummaryLine(label, what + (phrases(values, text) or " is not known"))

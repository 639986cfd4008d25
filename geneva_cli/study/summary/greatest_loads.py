"""What a report for a first reader shows: the greatest loads with their limits, and the parts."""

from __future__ import annotations

from typing import Any

from geneva_cli.design import Design
from geneva_cli.loads.cycle_figures import AXIS_BY_NAME
from geneva_cli.names import spoken
from geneva_cli.output.finite import only
from geneva_cli.study.summary.load_lines import greatest
from geneva_cli.table import Reading, Table, rows_table
from geneva_cli.verdict.checks.all_checks import LIMITS

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
    for name in LOADS if design.cycle.is_loaded else ():
        axis, known = AXIS_BY_NAME[name], greatest(design.loads[name])
        stem, _, unit = name.rpartition("_")
        if known:  # else the row of its check says that it has no bound
            check = checks.pop(f"{stem}_max_{unit}", None)
            bound = (check.must_be, check.limit, check.passes) if check else (None, None, None)
            size, at_deg = known
            rows.append((axis.label, size, axis.unit, at_deg, *bound))
    for name, check in checks.items():
        words, unit = spoken(name)
        if check.value is not None and (name in LIMITS or unit in UNITS):
            bound = (check.must_be, check.limit, check.passes)
            rows.append((words[:1].upper() + words[1:], check.value, unit, check.at_deg, *bound))
    first = ("load", "value", "limit", "unit", "must_be", "at_deg")
    return rows_table(COLUMNS, rows).replaced(reading=Reading(first, decide=("passes",)))


def parts_of(design: Design) -> Table | None:
    """Return count, material, size and mass of each part; None if there are none."""
    table: Table | None = design.report.table["parts_list.part"]
    return only(table, PARTS) if table else None

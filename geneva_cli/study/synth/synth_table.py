"""The rows that a search found as a table, the first of them turned, and a row as a spec."""

import math
from bisect import bisect_left
from collections.abc import Collection
from functools import partial
from typing import Any

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.progress import tracked
from geneva_cli.spec.defaults import wall_min
from geneva_cli.spec.tables import LIMITED
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synth.suiting import SPARE, USUAL, slot_paths, with_roller
from geneva_cli.study.synth.synth_search import CELLS, COSTS, MAYBE, YES, MachineRow, search
from geneva_cli.study.target import Target
from geneva_cli.table import Reading, Table, rows_table
from geneva_cli.verdict import checks as judged
from geneva_cli.verdict.advice import Adviser, Change

TURNED = 20  # rows whose parts are turned by default
# keys of [limits] and what they bound
_LIMITED = {
    **LIMITED,
    "pressure_angle_max_deg": "sizes.pressure_angle_max_deg",
    "product_acceleration_max_m_s2": "product.acceleration_m_s2.max",
}
# keys that conflict with a crank's bore
SHAFT = {"crank_shaft_mm", "crank_hub_mm", "crank_bore_wall_mm"}
# checks that no other roller can mend
UNSIZED = {*judged.QUICK} - {"undercut_mm"}
# Columns in order, with the requested quantities before the last, and short names of some.
COLUMNS = (
    *("no", "z", "gearing", "rollers", "machine", "ratio", "motion_deg", "dwell_deg", "motion_s"),
    *("dwell_s", "tau", "k", "n_rpm", "velocity_max", "acceleration_max", "acceleration_entry"),
    *("jerk_max", "power_max", "acceleration_max_rad_s2", "parts"),
)
SHORT = {
    "gearing": "wheel",
    "n_rpm": "rpm",
    "acceleration_max": "accel_max",
    "acceleration_entry": "accel_entry",
    "acceleration_max_rad_s2": "accel_rad/s2",
}
LINKS = ("crank_mm", "ground_mm", "coupler_mm", "rocker_mm", "point_mm")
WORDS = {
    "A": "A {}",
    "planet_ratio": "rp {}",
    "axes_deg": "axes {}",
    "offset_mm": "offset {} mm",
    "sector_deg": "D {}",
    "first_z": "first z {}",
}


def synthesis_table(target: Target, count: int = TURNED, buildable: bool = False) -> Table:
    """One row for each machine, numbered from 1, as ``turned`` returns them."""
    rows = search(target)
    shown = [tuple(row.cells.values()) for row in turned(target, rows, count, buildable)]
    title = "1 machine" if len(shown) == 1 else f"{len(shown)} machines"
    if several := len(shown) > 1:
        first = str(target.sort or "") or f"lowest peak acceleration{' in rad/s2' * target.timed}"
        title = f"{title}, {first} first"
    if buildable:
        title = f"{title}{',' * several} of {len(rows)}"
    return rows_table((*CELLS, *target.names), shown, f"{target.words}: {title}.")


def turned(
    target: Target, rows: list[MachineRow], count: int = TURNED, buildable: bool = False
) -> list[MachineRow]:
    """The rows, the first ``count`` of them turned; with ``buildable`` the first that pass.

    A turned row says yes, with sizes that pass, or no. Others say maybe, or no if that is known
    without turning.
    """
    maybe = [row for row in rows if row.cells["parts"] == MAYBE]
    if not buildable:
        maybe = [row for row in maybe if row.cells["no"] <= count]
    done = mapped(partial(_turned, target), maybe, min(len(maybe), cores()))
    results, passed = dict[int, MachineRow](), list[MachineRow]()
    for row in tracked(done, "machines turned", len(maybe)):
        results[row.cells["no"]] = row
        passed += [row] if row.cells["parts"] == YES else []
        if buildable and len(passed) >= count:
            break
    return passed if buildable else [results.get(row.cells["no"], row) for row in rows]


def _turned(target: Target, row: MachineRow) -> MachineRow:
    """A row with sizes that pass a full turn, or with the checks that fail; a frame's stay."""
    if row.trouble:
        return row
    sizes = target.frame.size.as_dict() if target.frame else {}
    spec, trouble = built(row.spec, {key for key, value in sizes.items() if value is not None})
    return MachineRow(spec, row.cells | {"parts": f"no: {trouble}" if trouble else YES})


def built(spec: Spec, fixed: Collection[str] = ()) -> tuple[Spec, str]:
    """The spec with sizes with which its parts pass every check in a full turn, and what fails.

    The largest of the usual rollers that passes is taken: smaller ones fail less. ``fixed`` are
    keys of its [size] that must not change. If no sizes pass, the spec is unchanged.
    """
    machine = build(spec)
    failing = [check for check in judged.checks(machine) if check.passes is False]
    names = [check.name for check in failing]
    own, reasons, trouble = spec, ", ".join(names), {*names}
    if not trouble or trouble & UNSIZED:
        return spec, reasons
    adviser, ended = Adviser(machine, failing), list[Change]()
    if "crank_bore_mm" not in fixed and trouble & SHAFT:
        ended = [("size.crank_bore_mm", 0.0)]  # the shaft ends in the arm
        own = spec.with_keys(dict(ended))
        if adviser.trial(ended, names, True).passes:
            return own, ""
    if trouble <= SHAFT or "roller_radius_mm" in fixed:
        return spec, reasons
    L = machine.center_distance_mm
    least = SPARE * float(slot_paths(machine).least[0]) if spec.is_flat else 0.0
    if spec.drive.LOCKS and spec.size.lock_radius_mm is None:
        least = max(least, wall_min(spec.size, L))  # a horn is no thicker than its roller's radius
    most = machine.roller_radius_mm * (1.0 - 1e-9)
    radii = [r for r in 0.01 * L * np.array(USUAL) if least <= r < most]
    each = [with_roller(own, radius) for radius in radii]

    def passes(other: Spec) -> bool:
        roller = ("size.roller_radius_mm", other.size.roller_radius_mm)
        return adviser.trial([*ended, roller], names, True).passes

    first = bisect_left(each, True, key=passes)
    return (each[first], "") if first < len(each) else (spec, reasons)


def chosen(target: Target, rows: list[MachineRow], number: int) -> tuple[MachineRow, str]:
    """Row ``number``, and the text of its spec with comments, as ``turned`` shows it.

    The parts are turned through a whole turn, unless they are known to be impossible.
    """
    if not 1 <= number <= len(rows):
        raise GenevaError(f"--write {cut(number)}: the table has rows 1 to {len(rows)}")
    row = _turned(target, rows[number - 1])
    row = row._replace(spec=with_limits(target, row.spec))
    return row, commented(target, number, row)


def with_limits(target: Target, spec: Spec) -> Spec:
    """The spec with each requirement that a key of ``[limits]`` can hold, so that checks hold it.

    Of a requirement and a limit of the frame the stricter one stays.
    """
    bounds = list(target.bounds)
    for name, span in target.spans.items():
        timing = f"timing.{'cycle_s' if name == 'cycle' else name}"
        bounds += [Constraint(timing, ">=", span.low), Constraint(timing, "<=", span.high)]
    own, limits = spec.limits.as_dict(), dict[str, float]()
    for key, name in _LIMITED.items():
        sign, stricter = (">=", max) if "_min" in key else ("<=", min)
        asked = [bound.bound for bound in bounds if (bound.name, bound.sign) == (name, sign)]
        asked = [bound for bound in (*asked, own[key]) if bound and 0.0 < bound < math.inf]
        if asked:
            limits[key] = stricter(asked)
    return spec.replace(limits=spec.limits.replace(**limits))


def commented(target: Target, number: int, machine: MachineRow) -> str:
    """The text of a spec from synthesis, with comments."""
    row = machine.cells
    slots = f"{row['drive']}, {row['law']}" if row["law"] else row["drive"]
    title = f"{target.words}: {row['z']} slots, {row['gearing']}, {slots}"
    costs = [f"{name} {row[name]:.7g}" for name in (one.replace(".", "_") for one in COSTS)]
    moves = f"It moves for {row['motion_deg']:.7g} deg of the input and"
    lines = [
        f"title = {quoted(title)}",
        "",
        f"# Row {number} of `geneva synth`. {moves}",
        f"# rests for {row['dwell_deg']:.7g}: tau = {row['tau']:.7g}, k = {row['k']:.7g}.",
        f"# Invariants: {', '.join(costs[:3])},",
        f"# {', '.join(costs[3:])}.",
    ]
    if machine.trouble:
        lines.append(f"# Warning: its parts cannot be built: {machine.trouble}.")
    return "\n".join([*lines, *spec_lines(machine.spec)]) + "\n"


def for_people(table: Table, most: int | None = None) -> Table:
    """The first ``most`` rows with a description of each machine, without empty columns.

    Columns are in order of importance. The title says how to get the other rows.
    """
    every_row = table.to_rows()
    rows, title = every_row[:most], table.title
    if len(rows) < len(every_row):
        title += f" The first {most} rows. All {len(every_row)} rows: -o FILE.csv"
    several = len({row["law"] for row in rows if row["law"]}) > 1
    for row in rows:
        row["machine"] = _machine(row, several)
        row["gearing"] = row["gearing"][:3]  # ext, int, sph
        no, colon, reasons = (row["parts"] or "").partition(": ")
        if colon:  # of several reasons the first, without its unit
            first, *others = reasons.split(", ")
            name = first.removesuffix("_mm").removesuffix("_deg")
            row["parts"] = f"{no}: {name}{' +' if others else ''}"
    extra, columns = table.names[len(CELLS) :], dict[str, list[Any]]()
    for name in (*COLUMNS[:-1], *extra, COLUMNS[-1]):
        cells = [row[name] for row in rows]
        if any(v is not None for v in cells):
            columns[name] = cells
    heads = {name: SHORT.get(name, name.replace(".", "_")) for name in columns}
    # rows are sorted by the peak, and --write takes their number: a narrow window keeps both
    peak = next(name for name in ("acceleration_max_rad_s2", "acceleration_max") if name in columns)
    ranked = ("no", "machine", "parts", peak, "z", "gearing", "n_rpm", *extra, "rollers")
    ranked += ("motion_deg", "dwell_s")  # what most requirements are of
    first = tuple(heads[name] for name in ranked if name in heads)
    reading = Reading(first, decide=("parts",))
    return Table(tuple(heads.values()), [*columns.values()], title=title, reading=reading)


def _machine(row: dict[str, Any], several: bool) -> str:
    """A short description of the machine: its drive, and the number that determines the motion."""
    own = [row["drive"], row["law"] if several else "", row["fixed"]]
    own.append(f"alpha0 {row['alpha0_deg']:.5g}" if row["law"] else "")
    if row["phase"]:
        own.append(f"e {row['eccentricity']:.5g} {row['phase']}")
    for key, text in WORDS.items():
        value = row[key]
        if value is not None and (key, value) != ("axes_deg", 90.0):
            own.append(text.format(f"{value:.5g}" if isinstance(value, float) else value))
    if row["ground_mm"]:
        own += (f"{row[key]:.3g}" for key in LINKS)
    return " ".join(filter(None, own))

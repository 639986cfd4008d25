"""The rows of a synthesis for people: short names, and a description of each machine."""

from __future__ import annotations

from typing import Any

from geneva_cli.study.synth.machine_rows import CELLS
from geneva_cli.table import Reading, Table

# Columns in order, the requested quantities before the parts, and short names of some.
COLUMNS = (
    *("no", "z", "gearing", "rollers", "machine", "ratio", "motion_deg", "dwell_deg", "motion_s"),
    *("dwell_s", "tau", "k", "n_rpm", "velocity_max", "acceleration_max", "acceleration_entry"),
    *("jerk_max", "power_max", "acceleration_max_rad_s2", "extra", "parts"),
)
SHORT = {
    "gearing": "wheel",
    "n_rpm": "rpm",
    "acceleration_max": "accel_max",
    "acceleration_entry": "accel_entry",
    "acceleration_max_rad_s2": "accel_rad/s2",
}
# The most important first. Rows are sorted by the peak acceleration, and --write takes their
# number: a narrow window keeps both.
RANKED = (
    *("no", "machine", "parts", "acceleration_max", "z", "gearing", "n_rpm", "extra", "rollers"),
    *("motion_deg", "dwell_s", "acceleration_max_rad_s2", "acceleration_entry", "velocity_max"),
    *("jerk_max", "tau", "power_max", "motion_s", "dwell_deg", "k", "ratio"),
)
LINKS = ("crank_mm", "ground_mm", "coupler_mm", "rocker_mm", "point_mm")
WORDS = {
    "A": "A {}",
    "planet_ratio": "rp {}",
    "axes_deg": "axes {}",
    "offset_mm": "offset {} mm",
    "sector_deg": "D {}",
    "first_z": "first z {}",
}


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
    columns, ranks = dict[str, list[Any]](), dict[str, float]()
    for source in COLUMNS:
        for name in table.names[len(CELLS) :] if source == "extra" else (source,):
            cells = [row[name] for row in rows]
            if any(v is not None for v in cells):
                columns[name], ranks[name] = cells, RANKED.index(source)
    names = [*zip(*(columns.get(key, ()) for key in ("z", "gearing", "machine")), strict=True)]
    if len({*names}) < len(names):
        ranks["rollers"] = RANKED.index("z") + 0.5
    peak, per_s2 = "acceleration_max", "acceleration_max_rad_s2"
    if per_s2 in columns:  # rows are sorted by it
        ranks[peak], ranks[per_s2] = ranks[per_s2], ranks[peak]
    heads = {name: SHORT.get(name, name.replace(".", "_")) for name in columns}
    first = tuple(heads[name] for name in sorted(ranks, key=ranks.__getitem__))
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

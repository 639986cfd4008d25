"""The rows of a synthesis for people: short names, and a description of each machine."""

from __future__ import annotations

from typing import Any

from geneva_cli.study.synth.machine_rows import CELLS
from geneva_cli.table import Reading, Table

# Columns and their short names, in order; empty ones are left out.
COLUMNS = {
    **{name: name for name in ("no", "z")},
    "gearing": "wheel",
    **{name: name for name in ("rollers", "machine", "ratio", "motion_deg")},
    **{name: name for name in ("dwell_deg", "motion_s", "dwell_s", "tau", "k")},
    "n_rpm": "rpm",
    "velocity_max": "velocity_max",
    "acceleration_max": "accel_max",
    "acceleration_entry": "accel_entry",
    **{name: name for name in ("jerk_max", "power_max")},
    "acceleration_max_rad_s2": "accel_rad/s2",
    "extra": "",
    "parts": "parts",
}
# The most important first. Rows are sorted by the peak acceleration, and --write takes their
# number: a narrow window keeps both.
RANKED = (
    *("no", "machine", "parts", "acceleration_max", "z", "gearing", "n_rpm", "extra", "rollers"),
    *("motion_deg", "dwell_s", "acceleration_max_rad_s2"),
    *("acceleration_entry", "velocity_max", "jerk_max", "tau", "power_max", "motion_s"),
    *("dwell_deg", "k", "ratio"),
)
LINKS = ("crank_mm", "ground_mm", "coupler_mm", "rocker_mm", "point_mm")


def for_people(table: Table, most: int | None = None) -> Table:
    """The first ``most`` rows with a description of each machine, without empty columns.

    Columns are in order of importance. The title says how to get the other rows.
    """
    every_row = table.to_rows()
    rows, title = every_row[:most], table.title
    if len(rows) < len(every_row):
        title += f" The first {most} rows. All {len(every_row)} rows: -o FILE.csv"
    several = len({row["law"] for row in rows if row["law"]}) > 1
    extra = table.names[len(CELLS) :]
    heads, columns, ranks = list[str](), list[list[Any]](), list[float]()
    for source, head in COLUMNS.items():
        for name in extra if source == "extra" else (source,):
            if source == "machine":
                cells: list[Any] = [_machine(row, several) for row in rows]
            elif source == "parts":
                cells = [_parts_entry(row["parts"]) for row in rows]
            elif source == "gearing":  # ext, int, sph
                cells = [row[source][:3] for row in rows]
            else:
                cells = [row[name] for row in rows]
            if any(v is not None for v in cells):
                heads.append(head or name.replace(".", "_"))
                columns.append(cells)
                ranks.append(RANKED.index(source))
    named = [columns[heads.index(head)] for head in ("z", "wheel", "machine") if head in heads]
    names = [*zip(*named, strict=True)]
    if len({*names}) < len(names) and "rollers" in heads:
        ranks[heads.index("rollers")] = RANKED.index("z") + 0.5
    if "accel_rad/s2" in heads:  # rows are sorted by it
        i, j = heads.index("accel_max"), heads.index("accel_rad/s2")
        ranks[i], ranks[j] = ranks[j], ranks[i]
    first = sorted(range(len(heads)), key=ranks.__getitem__)
    reading = Reading(tuple(heads[i] for i in first), decide=("parts",))
    return Table(tuple(heads), columns, title=title, reading=reading)


def _machine(row: dict[str, Any], several: bool) -> str:
    """A short description of the machine: its drive, and the number that determines the motion."""
    words = {
        "A": "A {}",
        "planet_ratio": "rp {}",
        "axes_deg": "axes {}",
        "offset_mm": "offset {} mm",
        "sector_deg": "D {}",
        "first_z": "first z {}",
    }
    own = [row["drive"], row["law"] if several else "", row["fixed"]]
    own.append(f"alpha0 {row['alpha0_deg']:.5g}" if row["law"] else "")
    if row["phase"]:
        own.append(f"e {row['eccentricity']:.5g} {row['phase']}")
    for key, text in words.items():
        value = row[key]
        if value is not None and (key, value) != ("axes_deg", 90.0):
            own.append(text.format(f"{value:.5g}" if isinstance(value, float) else value))
    if row["ground_mm"]:
        own += (f"{row[key]:.3g}" for key in LINKS)
    return " ".join(filter(None, own))


def _parts_entry(parts: str | None) -> str | None:
    """The entry about parts; of several reasons the first, without its unit."""
    no, colon, reasons = (parts or "").partition(": ")
    if not colon:
        return parts
    first, *others = reasons.split(", ")
    name = first.removesuffix("_mm").removesuffix("_deg")
    return f"{no}: {name}{' +' if others else ''}"

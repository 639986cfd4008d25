"""The rows of a synthesis for people: constant values in the title, within a hundred columns."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from geneva_cli.numerics.tolerances import same
from geneva_cli.output.text import cell
from geneva_cli.study.synth.machine_rows import OWN_KEYS
from geneva_cli.table import Reading, Table

# Columns and their short names, the least important last; empty ones are left out. Rows are sorted
# by the peak acceleration, and --write takes their number: a narrow window keeps both.
SHORT = {
    "acceleration_max": "accel_max",
    "gearing": "wheel",
    "n_rpm": "rpm",
    "extra": "",
    "acceleration_max_rad_s2": "accel_rad/s2",
    "acceleration_max_m_s2": "accel_m/s2",
    "acceleration_entry": "accel_entry",
}
RANKED = (
    *("no", "machine", "parts", "acceleration_max", "z", "gearing", "n_rpm", "extra", "rollers"),
    *("motion_deg", "dwell_s", "acceleration_max_rad_s2", "acceleration_max_m_s2", "index_mm"),
    *("acceleration_entry", "velocity_max", "jerk_max", "tau", "power_max", "motion_s"),
    *("dwell_deg", "k", "ratio"),
)
HEADS = {name: SHORT.get(name, name) for name in RANKED}
ORDER = (
    *("no", "z", "gearing", "rollers", "machine", "ratio", "index_mm", "motion_deg", "dwell_deg"),
    *("motion_s", "dwell_s", "tau", "k", "n_rpm", "velocity_max", "acceleration_max"),
    *("acceleration_entry", "jerk_max", "power_max"),
    *("acceleration_max_rad_s2", "acceleration_max_m_s2", "extra", "parts"),
)


LINKS = ("crank_mm", "ground_mm", "coupler_mm", "rocker_mm", "point_mm")


class _Column(NamedTuple):
    """A column for people: its source, its heading and its cells."""

    source: str
    head: str
    cells: list[Any]


def for_terminal(table: Table, most: int) -> Table:
    """The first ``most`` rows with a description of each machine and all its numbers.

    Columns are in order of importance. The title says how to get the other rows.
    """
    every_row = table.to_rows()
    rows = every_row[:most]
    title = table.title
    if len(rows) < len(every_row):
        title += f" The first {most} rows. All {len(every_row)} rows: -o FILE.csv"
    laws = {row["law"] for row in rows if row["law"]}
    every = _columns(rows, table.names, len(laws) > 1)
    columns = [c for c in every if any(v is not None for v in c.cells)]
    names = [c.head if c.source == "extra" else c.source for c in columns]
    rank = _ranks(columns)
    first = sorted(range(len(columns)), key=lambda i: rank[columns[i].source])
    reading = Reading(tuple(names[i] for i in first), decide=("parts",))
    return Table(tuple(names), [c.cells for c in columns], title=title, reading=reading)


def for_people(table: Table) -> Table:
    """A table without empty columns, constant ones in its title, no wider than a screen."""
    rows = table.to_rows()
    laws = {row["law"] for row in rows if row["law"]}
    columns, once = [], [f"law {law}" for law in laws if len(laws) == 1]
    titled = ("rollers", "motion_deg", "dwell_deg", "motion_s", "dwell_s", "tau", "k", "n_rpm")
    for column in _columns(rows, table.names, len(laws) > 1):
        first = column.cells[0] if column.cells else None
        if all(v is None for v in column.cells):
            continue
        constant = len(rows) > 1 and all(same(v, first) for v in column.cells)
        if column.source in titled and constant:
            once.append(f"{column.source} {cell(first)}")
        elif not (column.source == "rollers" and constant and first == 1):
            columns.append(column)
    title = table.title + (f" All: {', '.join(once)}." if once else "")
    kept = _fitting(
        [
            c._replace(cells=[float(_number(v)) if isinstance(v, float) else v for v in c.cells])
            for c in columns
        ]
    )
    return Table(tuple(c.head for c in kept), [c.cells for c in kept], title=title)


def _columns(
    rows: list[dict[str, Any]], names: tuple[str, ...], several: bool
) -> Iterator[_Column]:
    # the machine's description has the keys
    known = {*HEADS, "drive", "law", "alpha0_deg", *OWN_KEYS}
    for source in ORDER:
        if source == "machine":
            yield _Column(source, source, [_machine(row, several) for row in rows])
        elif source == "extra":
            for name in (name for name in names if name not in known):
                yield _Column(source, name.replace(".", "_"), [row[name] for row in rows])
        elif source == "parts":
            yield _Column(source, source, [_parts_entry(row["parts"]) for row in rows])
        else:
            cells = [row[source] for row in rows]
            if source == "gearing":  # ext, int, sph
                cells = [word[:3] for word in cells]
            yield _Column(source, HEADS[source], cells)


def _machine(row: dict[str, Any], several: bool) -> str:
    """A short description of the machine: its drive, and the number that determines the motion."""
    own = [
        row["law"] if several and row["law"] else "",
        f"alpha0 {_number(row['alpha0_deg'])}" if row["law"] else "",
        f"A {_number(row['A'])}" if row["A"] is not None else "",
        f"e {_number(row['eccentricity'])} {row['phase']}" if row["phase"] else "",
        f"{row['fixed']} rp {_number(row['planet_ratio'])}" if row["fixed"] else "",
        f"axes {_number(row['axes_deg'])}" if row["axes_deg"] not in (None, 90.0) else "",
        f"offset {_number(row['offset_mm'])} mm" if row["offset_mm"] else "",
        f"D {_number(row['sector_deg'])}" if row["sector_deg"] else "",
        f"first z {row['first_z']}" if row["first_z"] else "",
        f"{row['wheels']} wheels" if (row["wheels"] or 1) > 1 else "",
        " ".join(f"{row[key]:.3g}" for key in LINKS) if row["ground_mm"] else "",
    ]
    return " ".join([row["drive"], *filter(None, own)])


def _fitting(columns: list[_Column]) -> list[_Column]:
    rank = _ranks(columns)
    # letters with a frame's gap between two columns; headings are broken at underscores
    wide = [
        max(len(text) for text in (*c.head.split("_"), *map(cell, c.cells))) + 3 for c in columns
    ]
    kept = [*range(len(columns))]
    while sum(wide[i] for i in kept) + 1 > 100:
        kept.remove(max(kept, key=lambda i: rank[columns[i].source]))
    return [columns[i] for i in kept]


def _ranks(columns: list[_Column]) -> dict[str, float]:
    rank: dict[str, float] = {source: i for i, source in enumerate(HEADS)}
    named = [c.cells for c in columns if c.source in ("z", "gearing", "machine")]
    names = [*zip(*named, strict=True)]
    if len({*names}) < len(names):
        rank["rollers"] = rank["z"] + 0.5
    peak = "acceleration_max"
    for rate in ("acceleration_max_rad_s2", "acceleration_max_m_s2"):
        if rate in {c.source for c in columns}:  # rows are sorted by it
            rank[peak], rank[rate] = rank[rate], rank[peak]
    return rank


def _number(value: Any) -> str:
    """A number with 5 digits, which are enough to compare rows; csv and json have all."""
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def _parts_entry(parts: str | None) -> str | None:
    """The entry about parts; of several reasons the first, without its unit."""
    no, colon, reasons = (parts or "").partition(": ")
    if not colon:
        return parts
    first, *others = reasons.split(", ")
    name = first.removesuffix("_mm").removesuffix("_deg")
    return f"{no}: {name}{' +' if others else ''}"

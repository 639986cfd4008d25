"""The numbers of a design: timing, peaks, loads, sizing, sizes, strength, vibration, parts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.analysis.figures import OF_NAME
from geneva_cli.analysis.loads.summary import Summary
from geneva_cli.design import Design
from geneva_cli.document import Block, Facts, Grid, Heading, Row, TextList
from geneva_cli.study.document.left import Left, grid
from geneva_cli.study.document.named import capital, fact, facts, unit_of
from geneva_cli.table import Table

BESIDE = 6  # engagements that fit on a page side by side
# of the wheel's angle: by the input's angle in radians, and by time
UNITS = {
    "velocity": "rad/s",
    "acceleration": "rad/s²",
    "jerk": "rad/s³",
    "power": "rad²/s³",
}
# names that end with a stroke are followed by the unit
PEAKS = ("max", "at_deg", "max_", "entry", "entry_", "exit")
STRONG = ("pin", "horn", "lock", "wheel_shaft", "crank_shaft")


def timing(left: Left, n_rpm: float) -> Iterator[Block]:
    """Timing and peaks; if engagements differ, shared values, the worst, and each."""
    yield Heading("Timing")
    yield from facts("Timing of a cycle", left.take("timing"))
    yield Heading("Peaks")
    heads = (
        "Of the wheel",
        "Greatest, by input angle",
        "At input angle, °",
        f"Greatest at {n_rpm:.6g} rpm",
        "At entry, by input angle",
        f"At entry at {n_rpm:.6g} rpm",
        "At exit, by input angle",
        "Unit at speed",
    )
    rows = []
    for name, unit in UNITS.items():
        found = left.take(name)
        ends = [key for key in found if key not in PEAKS]
        by_time = {key.partition("_")[0]: found.pop(key) for key in ends}
        values = (found["max"], found["at_deg"], by_time["max"])
        entry = (found.get("entry"), by_time.get("entry"))
        rows.append((capital(name), *values, *entry, found.get("exit"), unit))
    yield Grid("Peaks: derivatives of the wheel's angle, in radians", heads, tuple(rows))
    yield from _each(left.one("stations"))


def _each(stations: Table | None) -> Iterator[Block]:
    """Engagements in adjacent columns."""
    if stations is None:
        return
    rows = list(stations.rows())
    for start in range(0, len(rows), BESIDE):
        some = rows[start : start + BESIDE]
        heads = ("Of the engagement", "Unit", *(str(start + i + 1) for i in range(len(some))))
        columns = zip(stations.names, zip(*some, strict=True), strict=True)
        lines = [(fact(n, None).name, unit_of(n), *values) for n, values in columns]
        yield Grid("Engagement by engagement", heads, tuple(lines))


def loads(design: Design, left: Left) -> Iterator[Block]:
    """The cycle under load, sizing, and impacts; without a load the motion alone."""
    own = {name: left.take(name) for name in ("loads", "cycle")}
    page = design.loads_page.to_dict()
    yield Heading("Loads")
    heads = ("Quantity", "Unit", *map(_column, Summary._fields))
    rows: list[Row] = []
    for row in page["loads"]:
        axis = OF_NAME[row.pop("quantity")]
        rows.append((axis.label, axis.unit, *row.values()))
    yield Grid("Over the motions, and means over a whole period", heads, tuple(rows))
    more = {
        "reversals_deg": own["cycle"]["reversals_deg"] or None,
        "kinetic_power_W": own["loads"]["kinetic_power_W"],
    }
    yield from facts("Of the loads", more)
    for name in ("entry", "reversal"):
        caption = "Impact at entry" if name == "entry" else "Impact where the roller changes walls"
        yield from facts(caption, left.take(f"shock.{name}"))
    sizing = {n.partition(".")[2]: v for n, v in page.items() if n.startswith("sizing.")}
    found = facts("What it takes", sizing)
    if found:
        yield Heading("Sizing")
        yield from found


def _column(name: str) -> str:
    return f"{fact(name, None).name}, °" if name.endswith("_at_deg") else fact(name, None).name


def sizes(left: Left) -> Iterator[Block]:
    """Sizes of the machine and its parts."""
    yield Heading("Sizes")
    for caption, group in (
        ("Of the machine", "sizes"),
        ("Of the parts", "parts"),
        ("Of the curved slots", "slot"),
    ):
        yield from facts(caption, left.take(group))


def strength(left: Left) -> Iterator[Block]:
    """Strength and life of the parts."""
    found: list[Facts] = []
    for part in STRONG:
        found += facts(capital(part.replace("_", " ")), left.take(f"strength.{part}"))
    found += facts("Life", left.take("life"))
    if found:
        yield Heading("Life and strength")
        yield from found


def swinging(left: Left) -> Iterator[Block]:
    """Vibration and tolerances, if they are given."""
    for text, group in (("Vibration", "vibration"), ("Tolerances", "tolerance")):
        said = left.one(f"{group}.warnings")
        found = facts(text, left.take(group))
        if found:
            yield Heading(text)
            yield from found
        if said:
            yield TextList(tuple(said))


CAPTIONS = {
    "part": "Parts",
    "pivot": "Pivots",
    "dimension": "Dimensions",
    "missing": "Not built",
}
# The list of parts in two tables, each as wide as a page: descriptions, and places.
PLACED = (
    *("density_kgm3", "z_low_mm", "z_high_mm", "centroid_x_mm", "centroid_y_mm", "inertia_kgm2"),
)
WHAT = ("count", "material", "thickness_mm", "size_x_mm", "size_y_mm", "mass_kg")


def parts(left: Left) -> Iterator[Block]:
    """The list of parts, pivots and dimensions."""
    tables: dict[str, Any] = left.take("parts_list")
    if any(table is not None for table in tables.values()):
        yield Heading("Parts list")
    for name, caption in CAPTIONS.items():
        table: Table | None = tables.get(name)
        if table is None:
            continue
        if name == "part":
            yield grid(caption, _columns(table, ("name", *WHAT)))
            yield grid("Places, densities and inertias", _columns(table, ("name", *PLACED)))
            continue
        found = grid(caption, table)
        rows = (tuple("°" if cell == "deg" else cell for cell in row) for row in found.rows)
        yield found._replace(rows=tuple(rows))


def _columns(table: Table, names: tuple[str, ...]) -> Table:
    """Some columns of a table."""
    columns = dict(zip(table.names, table.columns, strict=True))
    return Table(names, [columns[name] for name in names])

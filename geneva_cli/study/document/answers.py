"""The numbers of a design: timing, peaks, loads, sizing, sizes, strength, vibration, parts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geneva_cli.design import Design
from geneva_cli.loads.cycle_figures import AXIS_BY_NAME
from geneva_cli.loads.load_peaks import LoadSummary
from geneva_cli.motion.wheels.gearing import Output
from geneva_cli.output.document.blocks import Block, Grid, Heading, Row, TextList
from geneva_cli.output.finite import only
from geneva_cli.study.document.facts import (
    RemainingValues,
    capital,
    fact,
    facts,
    grid,
    grids,
    section,
)
from geneva_cli.table import Table


def timing(left: RemainingValues, n_rpm: float, output: Output) -> Iterator[Block]:
    """Timing and peaks; if engagements differ, shared values, the worst, and each."""
    yield Heading("Timing")
    yield from facts("Timing of a cycle", left.take("timing"))
    yield Heading("Peaks")
    heads = (
        f"Of the {output.noun}",
        "Greatest, by input angle",
        "At input angle, °",
        f"Greatest at {n_rpm:.6g} rpm",
        "At entry, by input angle",
        f"At entry at {n_rpm:.6g} rpm",
        "At exit, by input angle",
        "Unit at speed",
    )
    rows, own = [], output.rate_unit
    for name, unit in (
        ("velocity", f"{own}/s"),
        ("acceleration", f"{own}/s²"),
        ("jerk", f"{own}/s³"),
        ("power", f"{own}²/s³"),
    ):
        peak = left.take(name)
        by_angle = {key: peak.pop(key, None) for key in ("max", "at_deg", "entry", "exit")}
        # the other names have the unit of a time at their end, that of a wheel or that of a rack
        by_time = {
            key.partition("_")[0]: value
            for key, value in peak.items()
            if key.split("_")[1].rstrip("2") == own
        }
        values = (by_angle["max"], by_angle["at_deg"], by_time["max"])
        entry = (by_angle["entry"], by_time.get("entry"))
        rows.append((capital(name), *values, *entry, by_angle["exit"], unit))
    of = "the wheel's angle, in radians" if output.turns else "the rack's travel over R"
    yield Grid(f"Peaks: derivatives of {of}", heads, tuple(rows))
    yield from _each(left.one("stations"))


def _each(stations: Table | None) -> Iterator[Block]:
    """Engagements in adjacent columns."""
    if stations is None:
        return
    rows = list(stations.rows())
    width = 6  # engagements that fit on a page side by side
    for start in range(0, len(rows), width):
        group = rows[start : start + width]
        heads = ("Of the engagement", "Unit", *(str(start + i + 1) for i in range(len(group))))
        columns = zip(stations.names, zip(*group, strict=True), strict=True)
        lines = [(*fact(name, None)[::2], *values) for name, values in columns]
        yield Grid("Engagement by engagement", heads, tuple(lines))


def loads(design: Design, left: RemainingValues) -> Iterator[Block]:
    """The cycle under load, sizing, and impacts; without a load the motion alone."""
    own = {name: left.take(name) for name in ("loads", "cycle")}
    page = design.loads_page.to_dict()
    yield Heading("Loads")
    heads = ("Quantity", "Unit", *map(_column, LoadSummary._fields))
    rows: list[Row] = []
    for row in page["loads"]:
        axis = AXIS_BY_NAME[row.pop("quantity")]
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
    yield from section("Sizing", facts("What it takes", sizing))


def _column(name: str) -> str:
    return f"{fact(name, None).name}, °" if name.endswith("_at_deg") else fact(name, None).name


def special(left: RemainingValues) -> Iterator[Block]:
    """What some machines alone have: a product, wheels on a carrier, several cranks, a stop."""
    yield from section("Product", facts("What the product on the dial feels", left.take("product")))
    own = facts("The wheels on the carrier, from the ground", left.take("carousel"))
    caption = "When each wheel moves, by the carrier's angle"
    yield from section("Carousel", [*own, *grids(caption, left.one("wheels"))])
    caption = "When each crank moves the wheel, by the input's angle"
    yield from section("Cranks", grids(caption, left.one("cranks")))
    yield from section("Stop", facts("Where the convex face blocks the crank", left.take("stop")))


def sizes(left: RemainingValues) -> Iterator[Block]:
    """Sizes of the machine and its parts."""
    yield Heading("Sizes")
    for caption, group in (
        ("Of the machine", "sizes"),
        ("Of the parts", "parts"),
        ("Of the curved slots", "slot"),
    ):
        yield from facts(caption, left.take(group))


def strength(left: RemainingValues) -> Iterator[Block]:
    """Strength and life of the parts."""
    blocks: list[Block] = []
    shafts = "wheel_shaft", "wheel_key", "crank_shaft", "crank_key"
    for part in ("pin", "horn", "lock", "arm", *shafts):
        blocks += facts(capital(part.replace("_", " ")), left.take(f"strength.{part}"))
    blocks += facts("Life", left.take("life"))
    yield from section("Life and strength", blocks)


def both_ways(left: RemainingValues) -> Iterator[Block]:
    """What differs between the directions of a machine that turns both ways."""
    table: Table | None = left.one("both_ways")
    if table is not None:
        yield Heading("Both ways")
        rows: list[Row] = []
        for name, forwards, backwards in table.rows():
            named = fact(name, None)
            rows.append((named.name, named.unit, forwards, backwards))
        heads = ("Quantity", "Unit", "Forwards", "Backwards")
        yield Grid("What differs between the directions", heads, tuple(rows))


def swinging(left: RemainingValues) -> Iterator[Block]:
    """Vibration and tolerances, if the report has them."""
    for text, group in (("Vibration", "vibration"), ("Tolerances", "tolerance")):
        warnings = left.one(f"{group}.warnings")
        yield from section(text, facts(text, left.take(group)))
        if warnings:
            yield TextList(tuple(warnings))


def parts(left: RemainingValues) -> Iterator[Block]:
    """The list of parts, pivots and dimensions."""
    tables: dict[str, Any] = left.take("parts_list")
    if any(table is not None for table in tables.values()):
        yield Heading("Parts list")
    list_of_parts: Table | None = tables.get("part")
    if list_of_parts is not None:  # two tables, each as wide as a page
        sizes = ("count", "material", "thickness_mm", "size_x_mm", "size_y_mm", "mass_kg")
        yield grid("Parts", only(list_of_parts, ("name", *sizes)))
        places = ("z_low_mm", "z_high_mm", "centroid_x_mm", "centroid_y_mm", "inertia_kgm2")
        caption = "Places, densities and inertias"
        yield grid(caption, only(list_of_parts, ("name", "density_kgm3", *places)))
    captions = {"pivot": "Pivots", "dimension": "Dimensions", "missing": "Not built"}
    for name, caption in captions.items():
        table: Table | None = tables.get(name)
        if table is not None:
            block = grid(caption, table)
            rows = (tuple("°" if cell == "deg" else cell for cell in row) for row in block.rows)
            yield block._replace(rows=tuple(rows))

"""The sections of a design's document, in the order in which it has them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from geneva_cli.answer import SummaryLine
from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.loads.cycle_figures import AXIS_BY_NAME
from geneva_cli.loads.load_peaks import LoadSummary
from geneva_cli.loads.load_tables import no_load
from geneva_cli.manual.explained import entries
from geneva_cli.motion.wheels.gearing import Output
from geneva_cli.output.document.blocks import (
    BAD,
    Block,
    Curves,
    Grid,
    Heading,
    Picture,
    Prose,
    Row,
    TextList,
)
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
from geneva_cli.study.summary.greatest_loads import PARTS, greatest_loads, parts_of
from geneva_cli.table import Table
from geneva_cli.verdict.strength import OF_LIFE

SOURCES = (
    "Cited: Malteski mehanizmi, a lecture; handbook no. 7, Maltese mechanisms; F. Krasniqi, "
    "Improvements of kinetic properties and lifespan of Maltic cross through curved canal, "
    "University of Prishtina; Polyudov and Kandyak, Kinematics of the Maltese cross mechanism "
    "with a side-crank drive, Ukrainian Academy of Printing. Where our numbers differ, and "
    "why: geneva help numbers.",
    "Derivatives: Taylor coefficients that are carried along; peaks: roots of the next derivative.",
    "Contact stress: Hertz, line contact. Life of the roller: ISO 281. Shafts: the ASME code "
    "for transmission shafting (B17c). Pins and arm: beams, by von Mises. Keys: DIN 6892. "
    "Default steel: C45+N, EN 10083-2; of printed plates PLA, doi 10.1089/3dp.2020.0109.",
    "Formula and source of each value and check: geneva explain NAME.",
)


def drawn(design: Design) -> Iterator[Block]:
    """The assembled machine at mid-motion, or a sphere's parts; or the reason for no drawing."""
    yield Heading("The machine")
    try:
        drawing = design.drawing("assembly", tolerance_mm=0.01)  # it is only viewed
        flat = design.spec.wheel.FLAT
        title = "Put together, at mid-motion" if flat else "Wheel and crank, laid flat"
        yield Picture(drawing._replace(title=title))
    except GenevaError as error:
        message, path = str(error), design.spec.path
        if path and message.startswith(path):  # without the file and the line
            message = message.removeprefix(path).lstrip(":0123456789").lstrip()
        yield Prose(f"Not drawn: {message}")


def in_short(lines: Iterable[SummaryLine]) -> Grid:
    """Lines of a summary as a table, without the commands that explain them."""
    command = re.compile(r" ?\(?geneva explain [\w.-]+\)?")
    rows = [
        (capital(x.label), "; ".join(filter(None, (x.text, command.sub("", x.note)))))
        for x in lines
    ]
    return Grid("In short", ("", ""), tuple(rows))


def greatest(design: Design) -> Iterator[Block]:
    """The greatest loads with their limits; or which keys they need."""
    words = {True: "passes", False: BAD, None: ""}
    rows = tuple(
        (*row[:-3], row[-3] or "", row[-2], words[row[-1]]) for row in greatest_loads(design).rows()
    )
    yield Heading("Greatest loads")
    if rows:
        heads = ("", "Greatest", "Unit", "At input angle, °", "Must be", "Limit", "Verdict")
        yield Grid("Over a cycle, with the limit of its check", heads, rows)
    if not design.cycle.is_loaded:
        yield Prose(f"{capital(no_load(design.cycle))}.")


def parts_in_short(design: Design) -> Iterator[Block]:
    """Count, material, size and mass of each part."""
    table = parts_of(design)
    if table is not None:
        yield Heading("Parts")
        yield grid("", table)


def warnings(texts: tuple[str, ...]) -> Iterator[Block]:
    """The list of warnings."""
    yield Heading("Warnings")
    yield TextList(texts) if texts else Prose("None.")


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
    units = {"velocity": "/s", "acceleration": "/s²", "jerk": "/s³", "power": "²/s³"}
    for name, unit in units.items():
        peak = left.take(name)
        most, at_deg, entry, leaving = (
            peak.pop(key, None) for key in ("max", "at_deg", "entry", "exit")
        )
        # the other names have the unit of a time at their end, that of a wheel or that of a rack
        by_time = {
            key.partition("_")[0]: value
            for key, value in peak.items()
            if key.split("_")[1].rstrip("2") == own
        }
        values = (most, at_deg, by_time["max"], entry, by_time.get("entry"), leaving)
        rows.append((capital(name), *values, f"{own}{unit}"))
    of = "the wheel's angle, in radians" if output.turns else "the rack's travel over R"
    yield Grid(f"Peaks: derivatives of {of}", heads, tuple(rows))
    stations: Table | None = left.one("stations")
    each = list(stations.rows()) if stations else []
    width = 6  # engagements that fit on a page side by side
    for start in range(0, len(each), width):
        group = each[start : start + width]
        numbers = (str(start + i + 1) for i in range(len(group)))
        names = [fact(name) for name in stations.names] if stations else []
        columns = zip(names, zip(*group, strict=True), strict=True)
        lines = [(one.name, one.unit, *values) for one, values in columns]
        heads_of_group = ("Of the engagement", "Unit", *numbers)
        yield Grid("Engagement by engagement", heads_of_group, tuple(lines))


def curves(design: Design) -> Iterator[Block]:
    """Curves of the motion over a cycle, and of its loads."""
    yield Heading("Curves over a cycle")
    loads = ("pin_force_N", "input_torque_Nm") if design.cycle.is_loaded else ()
    figure = design.figure(("velocity", "acceleration", "jerk", *loads))
    yield Curves(figure._replace(title="By the input's angle, from the first entry"))


def loads(design: Design, left: RemainingValues) -> Iterator[Block]:
    """The cycle under load, sizing, and impacts; without a load the motion alone."""
    own = {name: left.take(name) for name in ("loads", "cycle")}
    page = design.loads_page.to_dict()
    yield Heading("Loads")
    columns = [f"{fact(x).name}{', °' * x.endswith('_at_deg')}" for x in LoadSummary._fields]
    rows: list[Row] = []
    for row in page["loads"]:
        axis = AXIS_BY_NAME[row.pop("quantity")]
        rows.append((axis.label, axis.unit, *row.values()))
    caption = "Over the motions, and means over a whole period"
    yield Grid(caption, ("Quantity", "Unit", *columns), tuple(rows))
    more = {
        "reversals_deg": own["cycle"]["reversals_deg"] or None,
        "kinetic_power_W": own["loads"]["kinetic_power_W"],
    }
    yield from facts("Of the loads", more)
    yield from facts("Impact at entry", left.take("shock.entry"))
    yield from facts("Impact where the roller changes walls", left.take("shock.reversal"))
    sizing = {n.partition(".")[2]: v for n, v in page.items() if n.startswith("sizing.")}
    yield from section("Sizing", facts("What it takes", sizing))


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
    yield from facts("Of the machine", left.take("sizes"))
    yield from facts("Of the parts", left.take("parts"))
    yield from facts("Of the curved slots", left.take("slot"))


def strength(left: RemainingValues) -> Iterator[Block]:
    """Strength and life of the parts."""
    blocks: list[Block] = []
    shafts = "wheel_shaft", "wheel_key", "crank_shaft", "crank_key"
    for part in ("pin", "horn", "lock", "arm", *shafts):
        values = left.take(f"strength.{part}")
        if values.get("margin") is None:  # an allowed stress says nothing without a stress
            values.pop("allowed_MPa", None)
        blocks += facts(capital(part.replace("_", " ")), values)
    blocks += facts("Life", left.take("life"))
    yield from section("Life and strength", blocks)


def checks(design: Design) -> Iterator[Block]:
    """The table of all checks, with a column of remarks if there are any."""
    words = {True: "passes", False: BAD, None: "not proved"}
    heads = ["Check", "Value", "At input angle, °", "Must be", "Limit", "Verdict"]
    rows: list[Row] = [
        (c.name, c.value, c.at_deg, c.must_be, c.limit, words[c.passes]) for c in design.checks
    ]
    remarks = [c.nearest or c.why for c in design.checks]
    if any(remarks):
        heads.append("Nearest change that passes, or why there is none")
        rows = [(*row, remark) for row, remark in zip(rows, remarks, strict=True)]
    yield Heading("Checks")
    yield Grid("Every check with its verdict", tuple(heads), tuple(rows))


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
        yield grid("Parts", only(list_of_parts, PARTS))
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


def remarks(design: Design, left: RemainingValues) -> Iterator[Block]:
    """Unknown values with the keys that they need, and sources."""
    known = design.strength.missing(OF_LIFE)  # the report lists these, and more, itself
    notes: tuple[str, ...] = design.loads_page.to_dict().get("not_known", ())
    needs = (text for text in notes if text not in known)
    unknown = dict.fromkeys((*needs, *left.one("strength.needs")))
    yield from section("Other answers", list(left.rest()))
    texts = [TextList(tuple(unknown))] if unknown else []
    yield from section("What is not known, and the key that would give it", texts)
    spec = design.spec
    before = [spec.drive_before.NAME] if spec.drive_before else []
    laws = [spec.motion.law.NAME] if spec.motion else []
    names = [spec.wheel.NAME, spec.drive.NAME, *before, *laws]
    source = {n: e.source for e in entries() if e.group in ("kind", "law") for n in e.names}
    own = [f"{name[0].upper()}{name[1:]}: {source[name]}." for name in names if source.get(name)]
    yield Heading("Sources of the formulas")
    yield TextList((*own, *SOURCES))

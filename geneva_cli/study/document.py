"""A design as a document: its verdict, and then everything about it, in a fixed order."""

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from geneva_cli.answer import SummaryLine
from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.loads.load_peaks import LoadSummary
from geneva_cli.loads.load_tables import no_load
from geneva_cli.manual import read
from geneva_cli.manual.explained import entries
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.names import capital, described
from geneva_cli.output.document import blocks as page
from geneva_cli.output.document.blocks import Document, Fact, Grid, Heading, Prose, TextList
from geneva_cli.output.text import only
from geneva_cli.specfile.writer import keys_in, values_of
from geneva_cli.study.summary import report_summary
from geneva_cli.study.summary.load_lines import title_of
from geneva_cli.study.verdicts import headline
from geneva_cli.table import Table, for_people
from geneva_cli.verdict.failures import below_summary
from geneva_cli.verdict.strength import OF_LIFE

# Beginnings of the values' names that are in the tables of inputs and loads, or listed at the end
IN_TABLES = ("inputs.", "loads.", "cycle.", "not_known")
OTHER_LOADS = ("loads.kinetic_power_W", "loads.reversals_deg")
# Sections of the report's values, by the first parts of their names; the others follow them.
SECTIONS = {
    "Timing": ("timing", "input_stop"),
    "Peaks": ("velocity", "acceleration", "jerk", "power"),
    "Impacts": ("shock",),
    "Sizes": ("sizes", "parts", "slot"),
    "Life and strength": ("strength", "life"),
}


def short_document(design: Design) -> Document:
    """The document of a design for a first reader, on two pages.

    It has the verdict, a picture, the machine in words, the motor, the greatest loads with their
    limits, the parts and the warnings. Raises GenevaError for a spec that makes no machine.
    """
    blocks = [*_begin(design, report_summary.machine_lines(design)), Heading("Greatest loads")]
    words = {True: "passes", False: page.BAD, None: ""}
    rows = []
    for *first, must_be, limit, passes in report_summary.greatest_loads(design).rows():
        rows.append((*first, must_be or "", limit, words[passes]))
    if rows:
        heads = ("", "Greatest", "Unit", "At input angle, °", "Must be", "Limit", "Verdict")
        blocks.append(Grid("Over a cycle, with the limit of its check", heads, tuple(rows)))
    if not design.cycle.is_loaded:
        blocks.append(Prose(f"{capital(no_load(design.cycle))}."))
    if table := report_summary.parts_of(design):
        blocks += (Heading("Parts"), grid("", table))
    blocks += _warnings(design)
    blocks.append(Prose("All inputs, curves, sizes and checks: geneva report SPEC --full -o FILE."))
    return _document(design, blocks)


def document(design: Design) -> Document:
    """The whole document of a design."""
    # the title, the verdict, the key figures and the spec show these
    shown = ("spec", "title", "passes", "chosen", "checks_failed", "not_proved")
    table = below_summary(design.report.table, without=shown)
    left = {
        name: value
        for name, value in zip(table.names, next(table.rows()), strict=True)
        if not name.startswith(IN_TABLES) or name in OTHER_LOADS
    }
    needs = left.pop("strength.needs")
    parts = {name: left.pop(name) for name in [*left] if name.startswith("parts_list.")}
    keys = [*_keys(design.spec)]
    rows = [
        (name, for_people(value, digits=10) if isinstance(value, float) else value, unit, meaning)
        for name, value, unit, meaning, is_default in keys  # with all digits
        if not is_default
    ]
    caption = "Keys that are set; the appendix has those at their defaults"
    head = _begin(design, report_summary.key_figures(design))
    blocks = [*head, *_warnings(design), Heading("Inputs")]
    blocks.append(Grid(caption, ("Key", "Value", "Unit", "Meaning"), tuple(rows)))
    loads = ("pin_force_N", "input_torque_Nm") if design.cycle.is_loaded else ()
    figure = design.figure(("velocity", "acceleration", "jerk", *loads))
    figure = figure._replace(title="By the input's angle, from the first entry")
    blocks += (Heading("Curves over a cycle"), page.Curves(figure), *_loads(design))
    for heading, firsts in SECTIONS.items():
        own = {n: left.pop(n) for n in [*left] if n.partition(".")[0] in firsts}
        if values := [*_values(own)]:
            blocks += (Heading(heading), *values)
    blocks += (*_checks(design), *_parts_list(parts))
    if others := [*_values(left)]:
        blocks += (Heading("Other answers"), *others)
    known = design.strength.missing(OF_LIFE)  # the report lists these, and more, itself
    notes = (x for x in design.loads_page.to_dict().get("not_known", ()) if x not in known)
    if unknown := tuple(dict.fromkeys((*notes, *needs))):
        title = "What is not known, and the key that would give it"
        blocks += (Heading(title), TextList(unknown))
    sources = *_sources(design.spec), *read("sources.txt").splitlines()
    blocks += (Heading("Sources of the formulas"), TextList(sources))
    defaults = [Fact(name, value, unit) for name, value, unit, _, is_default in keys if is_default]
    blocks += (Heading("Appendix: keys at their defaults"), page.fact_grid("", defaults))
    return _document(design, blocks)


def _document(design: Design, blocks: Iterable[page.Block]) -> Document:
    state, text = headline(design.checks, design.warnings)
    table = design.report.table
    reasons = (*table["checks_failed"], *table["not_proved"])
    return Document(title_of(design), state, capital(text), reasons, tuple(blocks))


def _begin(design: Design, lines: Iterable[SummaryLine]) -> Iterator[page.Block]:
    """The machine in words and as a picture, or the reason for none, and lines of a summary."""
    yield Prose(design.report.table.prose)
    yield Heading("The machine")
    try:
        drawing = design.drawing("assembly", tolerance_mm=0.01)  # it is only viewed
        flat = design.spec.wheel.FLAT
        title = "Put together, at mid-motion" if flat else "Wheel and crank, laid flat"
        yield page.Picture(drawing._replace(title=title))
    except GenevaError as error:
        yield Prose(f"Not drawn: {error}")
    command = re.compile(r" ?\(?geneva explain [\w.-]+\)?")
    rows = []
    for one in lines:
        texts = one.text, command.sub("", one.note)
        rows.append((capital(one.label), "; ".join(filter(None, texts))))
    yield Grid("In short", ("", ""), tuple(rows))


def _warnings(design: Design) -> Iterator[page.Block]:
    texts = tuple(design.warnings)
    yield Heading("Warnings")
    yield TextList(texts) if texts else Prose("None.")


def _loads(design: Design) -> Iterator[page.Block]:
    """The cycle under load, and sizing."""
    values = design.loads_page.to_dict()
    columns = [f"{_fact(x).name}{', °' * x.endswith('_at_deg')}" for x in LoadSummary._fields]
    rows: list[page.Row] = []
    for row in values["loads"]:
        fact = _fact(row.pop("quantity"))
        rows.append((fact.name, fact.unit, *row.values()))
    yield Heading("Loads")
    caption = "Over the motions, and means over a whole period"
    yield Grid(caption, ("Quantity", "Unit", *columns), tuple(rows))
    yield from _values({n: v for n, v in values.items() if n.startswith("sizing.")})


def _checks(design: Design) -> Iterator[page.Block]:
    """Every check."""
    words = {True: "passes", False: page.BAD, None: "not proved"}
    heads = ("Check", "Value", "At input angle, °", "Must be", "Limit", "Verdict", "Remark")
    checks = [
        (c.name, c.value, c.at_deg, c.must_be, c.limit, words[c.passes], c.nearest or c.why)
        for c in design.checks
    ]
    yield Heading("Checks")
    yield Grid("Every check with its verdict", heads, tuple(checks))


def _parts_list(tables: Mapping[str, Table | None]) -> Iterator[page.Block]:
    """Parts, pivots and dimensions."""
    parts = tables["parts_list.part"]
    if any(table is not None for table in tables.values()):
        yield Heading("Parts list")
    if parts is not None:  # two tables, each as wide as a page
        places = ("z_low_mm", "z_high_mm", "centroid_x_mm", "centroid_y_mm", "inertia_kgm2")
        yield grid("Parts", only(parts, report_summary.PARTS))
        caption = "Places, densities and inertias"
        yield grid(caption, only(parts, ("name", "density_kgm3", *places)))
    captions = {"pivot": "Pivots", "dimension": "Dimensions", "missing": "Not built"}
    for name, caption in captions.items():
        table = tables.get(f"parts_list.{name}")
        if table is not None:
            yield grid(caption, table)


def _values(values: Mapping[str, Any]) -> Iterator[page.Block]:
    """Values of a report in groups, by the first parts of their names; tables as grids."""
    groups: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        group, _, own = name.rpartition(".")
        if isinstance(value, Table):
            yield from _table(capital(described(own)[0]), value)
        elif value is not None and value not in ("", ()):
            groups.setdefault(group, {})[own] = value
    for group, facts in groups.items():
        caption = capital(", ".join(described(part)[0] for part in group.split(".")))
        yield page.fact_grid(caption, (_fact(name, value) for name, value in facts.items()))


def _table(caption: str, table: Table) -> Iterator[Grid]:
    """A table; a wide one with its rows side by side, six on a page."""
    if len(table.names) <= 8:
        yield grid(caption, table)
        return
    rows, width = [*table.rows()], 6
    for start in range(0, len(rows), width):
        group = rows[start : start + width]
        columns = zip(map(_fact, table.names), zip(*group, strict=True), strict=True)
        lines = [(one.name, one.unit, *values) for one, values in columns]
        numbers = (str(start + i + 1) for i in range(len(group)))
        yield Grid(caption, ("Quantity", "Unit", *numbers), tuple(lines))


def grid(caption: str, table: Table) -> Grid:
    """A table with units in its headings, without columns that have no value."""
    rows = list(table.rows())
    shown = [
        i for i in range(len(table.names)) if any(row[i] not in (None, "", ()) for row in rows)
    ]
    named = [_fact(table.names[i]) for i in shown]
    heads = tuple(f"{head.name}, {head.unit}" if head.unit else head.name for head in named)
    return Grid(caption, heads, tuple(tuple(row[i] for i in shown) for row in rows))


def _fact(name: str, value: Any = None) -> Fact:
    """A value of a report by its name, in words."""
    parts = [described(part) for part in name.split(".")]
    unit = next((unit for _, unit in reversed(parts) if unit), "")
    return Fact(capital(", ".join(words for words, _ in parts)), value, unit)


def _keys(spec: Spec) -> Iterator[tuple[str, Any, str, str, bool]]:
    """Name, value, unit, meaning of each key that has a value, and whether it is the default."""
    for table, keys in keys_in(spec).items():
        several = values_of(spec, table)
        for number, values in enumerate(several):
            name = table if len(several) < 2 else f"{table}.{number}"
            for key in keys:
                value = shown = values[key.key]
                if isinstance(value, tuple):
                    shown = ", ".join(f"{one:.6g}" for one in value)
                if value is not None:
                    unit, is_default = described(key.key)[1], value == key.default
                    yield f"{name}.{key.key}", shown, unit, key.meaning, is_default


def _sources(spec: Spec) -> list[str]:
    """The sources of a machine's kinds and law."""
    before = [spec.drive_before.NAME] if spec.drive_before else []
    laws = [spec.motion.law.NAME] if spec.motion else []
    names = [spec.wheel.NAME, spec.drive.NAME, *before, *laws]
    source = {n: e.source for e in entries() if e.group in ("kind", "law") for n in e.names}
    return [f"{name[0].upper()}{name[1:]}: {source[name]}." for name in names if source.get(name)]

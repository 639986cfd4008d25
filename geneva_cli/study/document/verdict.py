"""Pictures of a design, and its verdict: figures, checks, warnings, unknown values, sources."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.manual.explained import entries
from geneva_cli.motion.machine_spec import Spec
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
from geneva_cli.study.document.facts import RemainingValues, capital, section
from geneva_cli.study.summary import report_summary
from geneva_cli.verdict.headline import headline
from geneva_cli.verdict.strength import OF_LIFE


def sources(spec: Spec) -> tuple[str, ...]:
    """The sources of the machine's kinds and its law, and those that all share."""
    before = [spec.drive_before.NAME] if spec.drive_before else []
    laws = [spec.motion.law.NAME] if spec.motion else []
    names = [spec.wheel.NAME, spec.drive.NAME, *before, *laws]
    known = {n: e.source for e in entries() if e.group in ("kind", "law") for n in e.names}
    own = [f"{name[0].upper()}{name[1:]}: {known[name]}." for name in names if known.get(name)]
    return (
        *own,
        "Cited: Malteski mehanizmi, a lecture; handbook no. 7, Maltese mechanisms; F. Krasniqi, "
        "Improvements of kinetic properties and lifespan of Maltic cross through curved canal, "
        "University of Prishtina; Polyudov and Kandyak, Kinematics of the Maltese cross mechanism "
        "with a side-crank drive, Ukrainian Academy of Printing. Where our numbers differ, and "
        "why: geneva help numbers.",
        "Derivatives: Taylor coefficients that are carried along; peaks: roots of the next "
        "derivative.",
        "Contact stress: Hertz, line contact. Life of the roller: ISO 281. Shafts: the ASME code "
        "for transmission shafting (B17c). Pins and arm: beams, by von Mises. Keys: DIN 6892. "
        "Default steel: C45+N, EN 10083-2; of printed plates PLA, doi 10.1089/3dp.2020.0109.",
        "Formula and source of each value and check: geneva explain NAME.",
    )


def verdict(design: Design, left: RemainingValues) -> tuple[str, str, tuple[str, ...]]:
    """State of a design, its verdict in a line, and the checks that fail or lack a proof."""
    state, text = headline(design.checks, design.warnings)
    left.one("passes")
    return state, capital(text), (*left.one("checks_failed"), *left.one("not_proved"))


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


def warnings(left: RemainingValues) -> Iterator[Block]:
    """The list of warnings."""
    texts = tuple(left.one("warnings"))
    yield Heading("Warnings")
    yield TextList(texts) if texts else Prose("None.")


def remarks(design: Design, left: RemainingValues) -> Iterator[Block]:
    """Unknown values with the keys that they need, and sources."""
    known = design.strength.missing(OF_LIFE)  # the report lists these, and more, itself
    notes: tuple[str, ...] = design.loads_page.to_dict().get("not_known", ())
    needs = (text for text in notes if text not in known)
    unknown = dict.fromkeys((*needs, *left.one("strength.needs")))
    yield from section("Other answers", list(left.rest()))
    texts = [TextList(tuple(unknown))] if unknown else []
    yield from section("What is not known, and the key that would give it", texts)
    yield Heading("Sources of the formulas")
    yield TextList(sources(design.spec))


def key_figures(design: Design) -> Grid:
    """The key figures of the summary of ``geneva report``."""
    rows: list[Row] = []
    for line in report_summary.key_figures(design):
        note = f"; {line.note}" if line.note else ""
        rows.append((capital(line.label), f"{line.text}{note}"))
    return Grid("In short", ("", ""), tuple(rows))


def drawn(design: Design) -> Iterator[Block]:
    """The assembled machine at mid-motion, or a sphere's parts; or the reason for no drawing."""
    yield Heading("The machine")
    try:
        drawing = design.drawing("assembly", tolerance_mm=0.01)  # it is only viewed
        flat = design.spec.wheel.FLAT
        title = "Put together, at mid-motion" if flat else "Wheel and crank, laid flat"
        yield Picture(drawing._replace(title=title))
    except GenevaError as error:
        yield Prose(f"Not drawn: {_without_path(design, str(error))}")


def curves(design: Design) -> Iterator[Block]:
    """Curves of the motion over a cycle, and of its loads."""
    yield Heading("Curves over a cycle")
    loads = ("pin_force_N", "input_torque_Nm") if design.cycle.is_loaded else ()
    figure = design.figure(("velocity", "acceleration", "jerk", *loads))
    yield Curves(figure._replace(title="By the input's angle, from the first entry"))


def _without_path(design: Design, message: str) -> str:
    """An error message without its file and line."""
    path = design.spec.path
    if path and message.startswith(path):
        return message.removeprefix(path).lstrip(":0123456789").lstrip()
    return message

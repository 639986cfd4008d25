"""What must be true of each random spec, for ``fuzz.py``: one function for each fuzzer.

Each takes the text of a spec and returns how it ended, in a word; a fault raises.
"""

import io
import math
import re
import sys
from types import SimpleNamespace
from xml.etree import ElementTree

import ezdxf
import numpy as np
from fuzz_machines import machine_text
from load_states import greatest
from sheet_witness import assert_as_listed, assert_measured, beyond, crossings, overlaps
from strength_checks import judged

from geneva_cli import design
from geneva_cli.design import Design
from geneva_cli.drawings.catalogue import DRAWINGS, PARTS, part_drawing, part_table, table_of
from geneva_cli.errors import GenevaError
from geneva_cli.extras.certify.certificate import LOADS, certificate, not_proved
from geneva_cli.geometry.sheet import prepared
from geneva_cli.motion.motion_table import motion_table
from geneva_cli.motion.peaks import QUANTITIES, peaks_table, worst
from geneva_cli.motion.registry import DRIVES
from geneva_cli.output import dxf, pdf, svg
from geneva_cli.parts.parts import parts_of
from geneva_cli.study.verdicts import Verdict, checks_table
from geneva_cli.table import Table, flat

PLACE = re.compile(r"(<stdin>|law\.csv|ratio\.csv)(:(\d+))?: ", re.DOTALL)
TOLERANCE = 0.01  # mm at L = 100, of the drawings
# The radius of a straight line; and loads that nothing bounds, where the report says so.
BOUNDLESS = {"curvature_radius_mm", "value"}
# Walls that are drawn coarser than the list of parts takes them move a thin wheel's mass so far.
CLOSE = 5e-3
# Of a load: behind the most uneven gears the last digit of the input angle is 4e-10 of the wheel's
# step.
LOST = 1e-9
TRIES = 100  # for a machine of a kind; two of three texts are refused, of epicyclic gears most


def read(data):
    """The machine that the bytes describe, or the message that refuses them; anything else raises.

    The folder holds law.csv, which a spec may name.
    """
    stdin, sys.stdin = sys.stdin, SimpleNamespace(buffer=io.BytesIO(data))
    try:
        return design.load("-").mechanism
    except GenevaError as error:
        message = str(error)
        place = PLACE.match(message)
        assert place, f"no place in: {message}"
        # errors.clean makes it printable; its length and its line are checked here
        assert len(message) < 2000, f"{len(message)} characters: {message[:200]}"
        lines = max(data.count(b"\n"), data.count(b"\r")) + 2
        assert int(place[3] or 0) <= max(lines, 20), message
        return message
    finally:
        sys.stdin = stdin


def consistent(mechanism):
    """Check what every machine has: rest at both ends, a whole step, an ascending window.

    The roller of a short crank as built never reaches the axis of the slot: it turns the wheel by
    less than a step.
    """
    for engagement in mechanism.engagements:
        assert engagement.entry_deg < engagement.exit_deg
        b = engagement.half_step
        for x, wheel in ((engagement.entry_deg, -b), (engagement.exit_deg, b)):
            p = engagement.motion(x, 3).derivatives()
            assert all(math.isfinite(v) for v in p), f"not finite at {x!r}: {p}"
            short = engagement.built and not engagement.built.crosses
            is_short = short and math.copysign(p[0], wheel) == p[0] and abs(p[0]) < b
            # a law given as points ends where its spline does: rounding of sums of such terms
            is_near = abs(p[0] - wheel) <= 1e-9 * b
            assert is_short or is_near, f"wheel at {x!r}: {p[0]!r}, not {wheel!r}"
    for i in range(len(mechanism.engagements)):
        assert math.isfinite(mechanism.dwell_deg(i))


def sound(table, boundless=()):
    """Check that no number of a table is NaN, and that only ``boundless`` columns are infinite."""
    for name, column in zip(table.names, table.columns, strict=True):
        values = [v for v in np.asarray(column, dtype=object).ravel() if isinstance(v, float)]
        assert not any(v != v for v in values), f"{name} is nan"
        if name not in boundless:
            assert all(map(math.isfinite, values)), f"{name} is infinite"


def motion(text):
    """A spec's motion is consistent and finite, with mid-motion among the samples and without."""
    machine = read(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
    if isinstance(machine, str):
        return "refused"
    consistent(machine)
    for table in (flat(peaks_table(machine)), motion_table(machine, 33), motion_table(machine, 50)):
        sound(table)
    return "machine"


def tried(make, *args):
    """A checked table or drawing; None if it is refused with the spec's key or an option."""
    try:
        table = make(*args)
    except GenevaError as error:
        assert error.key or "--" in str(error), f"no place: {error}"
        return None
    if isinstance(table, Table):
        sound(table, BOUNDLESS)
    return table


def parts(text):
    """All results of the commands are finite: report, checks, parts as points and as drawings."""
    if motion(text) == "refused":
        return "refused"
    machine = read(text.encode())
    # loads that would be rounding are refused
    tried(lambda: flat(Design.of(machine.spec).report.table))
    tried(lambda: checks_table([Verdict("", checks=tuple(judged(machine)))]))
    tolerance = TOLERANCE * machine.center_distance_mm / 100.0
    for part in PARTS:
        try:
            listed = bool(table_of(machine, part))
        except GenevaError:  # a part of other machines
            continue
        for samples in (None, 33, 50) if listed else ():
            tried(part_table, machine, part, tolerance, samples)
    drawn = parts_of(machine)
    try:
        drawn.built  # noqa: B018 - made here, once for all parts
    except GenevaError as error:
        assert error.key, f"no place: {error}"
        return "parts refused"
    for part in DRAWINGS:
        for curves in ("arcs", "cubics"):
            tried(lambda *of: prepared(part_drawing(*of)), drawn, part, tolerance, curves)
    return "parts"


def sheet(text):
    """On a sheet nothing overlaps, few dimensions cross, and each says what it spans.

    Its SVG, DXF and PDF are read by others.
    """
    machine = read(text.encode())
    if isinstance(machine, str):
        return "refused"
    one = Design.of(machine.spec)
    try:
        coarse = TOLERANCE * machine.center_distance_mm / 100.0
        drawn = one.sheet(coarse)
    except GenevaError as error:
        # of a machine that jams, walls may leap: `profile` refuses it before it draws
        known = error.key or "--" in str(error) or "roller and slot overlap" in str(error)
        assert known, f"no place: {error}"
        return "no sheet"
    assert overlaps(drawn) == []
    assert beyond(drawn) == []
    # A tiny wheel may have no place free of crossings. A rack of 24 slots behind elliptical
    # gears is drawn at 1:10. It has 109 dimensions, and up to 8 leaders and balloons of its
    # small parts cross another one there. Each can be followed.
    assert len(crossings(drawn)) <= max(4, len(drawn.measures) // 13)
    assert_measured(drawn)
    if machine.spec.wheel.FLAT:
        assert_as_listed(drawn, list(one.part_table("parts").to_rows()), CLOSE)
    tree = ElementTree.fromstring("".join(svg.sheet_chunks(drawn)))
    shown = {"".join(node.itertext()) for node in tree.iter() if node.tag.endswith("}text")}
    assert {label.text for label in drawn.texts} <= shown
    drawing = ezdxf.read(io.StringIO("".join(dxf.sheet_chunks(drawn))))
    assert not drawing.audit().errors
    spans = [m for m in drawn.measures if m.kind != "note"]
    assert len(drawing.modelspace().query("DIMENSION")) == len(spans)
    page = "".join(pdf.sheet_chunks(drawn))
    for at, number in offsets(page):
        assert page.startswith(f"{number} 0 obj", at)
    return "sheet"


def offsets(page):
    """The places that a PDF's own table gives for its objects, in bytes, and their numbers."""
    assert page.startswith("%PDF-")
    assert page.rstrip().endswith("%%EOF")
    assert page.isascii()  # or a byte were no character
    start = int(page.rstrip().splitlines()[-2])
    rows = page[start:].splitlines()
    assert rows[0] == "xref"
    count = int(rows[1].split()[1])
    return [(int(row[:10]), i) for i, row in enumerate(rows[3 : 2 + count], 1)]


def confirmed(mechanism):
    """Return "proved", or the number of peaks without a proof; raise for a wrong peak."""
    peaks, open_ = worst(mechanism), 0
    for quantity in QUANTITIES:
        proof = certificate(mechanism, quantity)
        peak = getattr(peaks, quantity)
        if proof.open is None:
            assert proof.confirms(*peak), f"{peak} against {proof.text} {proof.places}"
        open_ += proof.open is not None
    for name in LOADS:
        if not_proved(mechanism, name):
            continue
        try:
            peak = greatest(mechanism, name)
        except GenevaError:
            break  # a motion that is too uneven has no loads
        proof = certificate(mechanism, name)
        if proof.open is None:
            near = proof.low * (1.0 - LOST) <= peak.max <= proof.high * (1.0 + LOST)
            assert near, f"{name}: {peak} against {proof.text} {proof.places}"
        open_ += proof.open is not None
    return f"{open_} not proved" if open_ else "proved"


def machine_of_each_kind(rng):
    """The text of a machine of a random kind; the last one tried if all are refused."""
    kind = rng.choice(list(DRIVES))
    texts = (machine_text(rng, kind) for _ in range(TRIES))
    for text in texts:
        if not isinstance(read(text.encode()), str):
            break
    return text


def certified(text):
    """Certificates confirm the peaks and loads; one not proved is counted with its kind."""
    machine = read(text.encode())
    if isinstance(machine, str):
        return "refused"
    return f"{machine.spec.drive.NAME} {confirmed(machine)}"

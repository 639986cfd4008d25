"""The drawing sheet of a machine whose wheel is no outline: links, gears, shafts and frame."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.curves.measure import bounds
from geneva_cli.curves.plates import Group, Plate
from geneva_cli.curves.sheet import HIDDEN, OUTLINE, Sheet
from geneva_cli.parts.built import link_members
from geneva_cli.parts.gear_drawings import gear_shapes
from geneva_cli.parts.link_drawings import once, together
from geneva_cli.parts.links import Links, drawn_links
from geneva_cli.parts.parts_list import plate_rows
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.shafts import SHAFT
from geneva_cli.parts.sheet import links, sized
from geneva_cli.parts.sheet.composed import on_paper
from geneva_cli.parts.sheet.gears import draw_blank
from geneva_cli.parts.sheet.linked import flat_plates, geared, linked, rolling, shafted, titled
from geneva_cli.parts.sheet.paper import scale_name, smaller
from geneva_cli.parts.sheet.points import gear_tables
from geneva_cli.parts.sheet.sheet import ASSEMBLED, layout
from geneva_cli.parts.sheet.standing import draw_frame
from geneva_cli.parts.sheet.view import Block, View

WHEEL = "the wheel's slots: --part slot"


def sheet(proof: Proof, tolerance: float, curves: str) -> Sheet:
    """The drawing sheet of what a machine has beside its wheel.

    Raises GenevaError where no scale brings it on one.
    """
    given, bars = proof.mechanism, drawn_links(proof.mechanism)
    members = link_members(proof)
    rows = list(plate_rows(given.spec, Group("", members)))
    shafts = [m for m in members if isinstance(m.part, Plate) and m.part.layer == SHAFT]
    frame = members[-1].part
    assert isinstance(frame, Plate)
    pitch = gear_shapes(proof, tolerance, curves)
    fixed = [
        *gear_tables(given, tolerance),
        *links.round_parts(bars.joined, given),
        *layout(given),
    ]

    def blocks(scale: float) -> Iterator[list[Block]]:
        begin = titled(rows, scale)
        apart = [
            *linked(begin, bars, given),
            *geared(begin, pitch, given),
            *rolling(begin, given),
            *shafted(begin, shafts),
            begin(frame.name),
        ]
        draw_frame(apart[-1], frame)
        for times in ASSEMBLED:
            whole = _together(proof, bars, frame, smaller(scale, times))
            yield [*(view.block() for view in apart), whole.block(), *fixed]

    boxes = [bounds(plate.outline) for plate in flat_plates(members)]
    largest = max(max(box.x1 - box.x0, box.y1 - box.y0) for box in boxes)
    return on_paper(given.spec, rows, largest, blocks)


def _together(proof: Proof, bars: Links, frame: Plate, scale: float) -> View:
    """Links and gears at input angle 0 above the frame, with the centre distance."""
    given = proof.mechanism
    view = View(f"together, without the wheel ({scale_name(scale)})", scale)
    view.draw(frame.outline, HIDDEN)
    for shape in once(together(bars._replace(gears=()))):
        view.draw(shape, OUTLINE)
    for gear in bars.gears:
        draw_blank(view, gear, gear.at)
    L, deviation = given.center_distance_mm, given.spec.tolerance.center_distance_mm
    for x in (0.0, L):
        view.cross((x, 0.0), 0.1 * L)
    view.linear((0.0, 0.0), (L, 0.0), 0.0, sized.plain(L, "L = ", deviation))
    view.remark(WHEEL)
    return view

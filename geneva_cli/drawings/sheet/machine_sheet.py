"""The drawing sheet of a flat machine: dimensioned parts, the list of items and a title block."""

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.drawings.part_drawings import assembly
from geneva_cli.drawings.parts_list import part_rows
from geneva_cli.drawings.sheet import crank_views, sized
from geneva_cli.drawings.sheet.paper import Block, on_paper, scale_name, smaller
from geneva_cli.drawings.sheet.sized import Fits
from geneva_cli.drawings.sheet.view import View
from geneva_cli.drawings.sheet.wheel_views import draw_frame, draw_shaft, draw_wheel
from geneva_cli.geometry import shapes
from geneva_cli.geometry.board import chords
from geneva_cli.geometry.plates import Member, Plate, in_place, plates
from geneva_cli.geometry.sheet import CENTRE, HATCH, HIDDEN, OUTLINE, Sheet, line, rectangle
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.projection import alike
from geneva_cli.table import in_decimals as length

# Layers on the sheet of shapes of the assembled machine that are no outlines.
LAYERS: dict[str, shapes.Layer] = {"PITCH": CENTRE, "ARM": HIDDEN, "FRAME": HIDDEN, "HUB": HIDDEN}


class Face(NamedTuple):
    """A rectangle in which the plane cuts a plate, mm: along the line of centres, and upwards."""

    plate: Plate  # in its own frame
    left: float
    right: float


def sheet(parts: FlatParts) -> Sheet:
    """Return the drawing sheet of a machine. Raises GenevaError where no scale fits on one."""
    mechanism, L = parts.mechanism, parts.mechanism.center_distance_mm
    drawn, sizes = assembly(parts).shapes, parts.outlines.sizes
    every = [one.part for one in parts.members]
    rows: list[dict[str, Any]] = list(part_rows(mechanism.spec, every))
    largest = max(row[f"size_{axis}_mm"] for row in rows for axis in "xy")
    # the number of each kind of plate in the list
    items = {one: i for i, kind in enumerate(alike(every), 1) for one in kind}
    # chords of 1.5 mm on a part of 500 mm: spans are within 0.1 mm on any paper
    faces = cut_faces(parts.members, 500.0 / largest)
    marked = {items[face.plate] for face in faces}
    tables = crank_views.round_parts((*parts.links.joined, *parts.framed.spacers), mechanism)

    @cache
    def whole(scale: float) -> Block:
        view = View(f"assembly ({scale_name(scale)})", scale, Fits(mechanism.spec))
        for shape in drawn:
            view.draw(LAYERS.get(shape.layer, OUTLINE), shape)
        view.cross(shapes.ORIGIN, sizes.outer or sizes.rim)
        for place in mechanism.crank_places:
            view.cross(place.at, max(sizes.lock, 0.1 * L))
        off, box = mechanism.spec.tolerance.center_distance_mm, shapes.bounds_of(drawn)
        view.linear(shapes.ORIGIN, (L, 0.0), 0.0, sized.plain(L, "L = ", off))
        view.section((box.x0, 0.0), (box.x1, 0.0), "A")
        tips = defaultdict[int, list[shapes.Point]](list)
        for own, plate in in_place(parts.members):
            if items[own] not in marked:
                pieces = shapes.as_contour(plate.outline).segments
                # equal sides in their order, whatever their last digits
                longest = sorted(pieces, key=lambda one: -round(math.dist(one.start, one.end), 6))
                tips[items[own]] += [shapes.at(piece, 0.5) for piece in longest[:8]]
        view.balloons(tips)
        return view.block()

    @cache
    def section(scale: float) -> Block:
        view = View(f"A-A ({scale_name(scale)})", scale, Fits(mechanism.spec))
        _draw_section(view, faces, (0.0, L))
        tips = defaultdict[int, list[shapes.Point]](list)  # the middles of the faces' sides
        for face in sorted(faces, key=lambda f: round(f.left - f.right, 6)):  # as above
            low, high = face.plate.low, face.plate.high
            x, z = 0.5 * (face.left + face.right), 0.5 * (low + high)
            tips[items[face.plate]] += [(x, high), (x, low), (face.right, z), (face.left, z)]
        view.balloons(tips)
        return view.block()

    @cache
    def views(scale: float) -> list[Block]:
        return [*(view.block() for view in _views(rows, parts, scale)), *tables]

    def blocks(scale: float) -> Iterator[list[Block]]:
        half = smaller(scale)
        for of_cut, of_whole in ((scale, scale), (scale, half), (half, half)):
            yield [*views(scale), section(of_cut), whole(of_whole)]

    return on_paper(mechanism.spec, rows, largest, blocks)


def _views(rows: list[dict[str, Any]], parts: FlatParts, scale: float) -> Iterator[View]:
    """Yield the view of each part."""
    mechanism, bars = parts.mechanism, parts.links
    unborne = dict(parts.unborne)

    def begin(*names: str, thick: bool = True, of: FlatParts = parts) -> View:
        """Begin a view, titled with its parts' numbers and thicknesses."""
        own = {i: row for i, row in enumerate(rows, 1) if row["name"] in names}
        titles = [
            f"{i} {row['name']}" + f", t = {length(row['thickness_mm'])}" * thick
            for i, row in own.items()
        ]
        first = next((row["thickness_mm"] for row in own.values()), None)
        view = View("; ".join(titles) or names[0], scale, Fits(of.mechanism.spec, first))
        view.notes += ["no bearing: hold it from above" for name in names if name in unborne]
        return view

    for front, of in zip(("", "first "), (parts, *parts.in_front), strict=False):
        yield draw_wheel(begin(f"{front}wheel", f"{front}wheel's hub", of=of), of)
        if of.outlines.crank:
            names = ("locking disc", "locking sector", "crank's hub")
            yield crank_views.draw_disc(begin(*(f"{front}{name}" for name in names), of=of), of)
    if parts.arm:
        yield crank_views.draw_arm(begin("arm"), parts, parts.arm)
    yield crank_views.draw_roller(begin("roller", "pin"), parts)
    for member in {one.part: one for one in bars.cut}.values():
        yield crank_views.draw_link(begin(member.part.name), member, bars, mechanism)
    for shaft in dict.fromkeys(plate for one in parts.shafts for plate in plates(one.part)):
        yield draw_shaft(begin(shaft.name, thick=False), shaft)
    for plate in (plate for one in parts.framed.bridge for plate in plates(one.part)):
        _, *through = (hole for hole in plate.holes if isinstance(hole, shapes.Circle))
        screws = {hole: sized.screw_hole(hole.radius) for hole in through}
        yield draw_frame(begin(plate.name), plate, screws, "the crank's axis")
    screws = {h: sized.screw_hole(h.radius) for h in parts.framed.mounts}
    screws |= {h: sized.screw_hole(h.radius, tapped=True) for h in parts.framed.threads}
    (frame,) = plates(parts.frame.part)
    yield draw_frame(begin(frame.name), frame, screws)


def cut_faces(members: Iterable[Member], scale: float) -> list[Face]:
    """Return the faces that the plane y = 0 cuts, by chords of 1.5 mm at a scale."""
    faces = []
    for own, plate in in_place(members):
        scaled = (shapes.placed(one, scale=scale) for one in (plate.outline, *plate.holes))
        pieces = np.concatenate([*map(chords, scaled)])
        # chords that follow each other share their ends within rounding, 1e-9 mm
        start, end = (np.round(pieces.imag, 9) <= 0.0).T
        p, q = pieces[start != end].T
        slope = (q.real - p.real) / (q.imag - p.imag)
        spans = np.sort((p.real - p.imag * slope) / scale).reshape(-1, 2).tolist()
        faces += [Face(own, a, b) for a, b in spans if b - a > 1e-6]
    return faces


def _draw_section(view: View, cut: list[Face], axes: Iterable[float]) -> None:
    """Draw cut faces and the height; all but rods are hatched (ISO 128-3)."""
    numbers = [*dict.fromkeys(face.plate for face in cut)]
    low, high = min(f.plate.low for f in cut), max(f.plate.high for f in cut)
    for face in cut:
        plate = face.plate
        corners = face.left, plate.low, face.right, plate.high
        view.draw(OUTLINE, rectangle("", *corners))
        if plate.layer not in ("SHAFT", "ROLLER"):
            _hatch(view, face, numbers.index(plate))
    for x in axes:
        view.centre_line((x, low), (x, high))
    left = min(face.left for face in cut)
    view.linear((left, low), (left, high), 0.5 * math.pi)


def _hatch(view: View, face: Face, k: int) -> None:
    """Draw lines at 45 degrees, 2 mm apart on paper or 3, rising or falling by the plate."""
    rising, step = 1.0 - 2.0 * (k % 2), (2.0 if k % 4 < 2 else 3.0) * math.sqrt(2.0) / view.scale
    a, b = sorted((rising * face.left, rising * face.right))
    # a line x - z = level, with x to the left if it falls, between its crossings with the sides
    low, high = face.plate.low, face.plate.high
    for i in range(math.ceil((a - high) / step), math.floor((b - low) / step) + 1):
        level = i * step
        start, end = max(a, level + low), min(b, level + high)
        if end - start > 1e-9 * step:
            ends = (rising * start, start - level), (rising * end, end - level)
            view.draw(HATCH, line("", *ends))

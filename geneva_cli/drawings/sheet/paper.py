"""Sheets of paper: formats, scales, blocks side by side, title block and tables.

The views have one scale: the largest standard scale at which everything fits on one sheet, A1 at
most. The sheet is the smallest that fits. Above 1:1 the largest part is no wider than a hand.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import accumulate, product
from typing import Any, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import sheet
from geneva_cli.geometry.shapes import Box, Contour, Point, Shape, placed
from geneva_cli.geometry.sheet import SMALL, TEXT, Label, Measure, line, width
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.workshops import WORKSHOPS
from geneva_cli.table import in_decimals as length

LEFT, MARGIN = 20.0, 10.0  # mm: margin of the frame on the filing side, and on the others
TITLE_WIDTH = 180.0  # mm: width of the title block
APART = (40.0, 27.0, 18.0, 12.0, 8.0)  # mm between blocks, the widest that the paper allows
# width and height of trimmed sheets, mm; A4 is upright
FORMATS = {"A4": (210.0, 297.0), "A3": (420.0, 297.0), "A2": (594.0, 420.0), "A1": (841.0, 594.0)}
# ISO 5455, with its powers of ten
SCALES = [1.0 * n * 10**k for k in (4, 3, 2, 1, 0) for n in (5, 2, 1)] + [
    1 / (n * 10**k) for k in (0, 1, 2, 3, 4) for n in (1, 2, 5) if (n, k) != (1, 0)
]


def scale_name(scale: float) -> str:
    """Return a scale as text.

    >>> scale_name(2.0), scale_name(0.2)
    ('2:1', '1:5')
    """
    return f"{scale:.0f}:1" if scale >= 1.0 else f"1:{1.0 / scale:.0f}"


def smaller(scale: float) -> float:
    """Return the largest standard scale of at most half of one; else the smallest."""
    return max((s for s in SCALES if s <= 0.5 * scale * (1.0 + 1e-9)), default=SCALES[-1])


class Block(NamedTuple):
    """A part of a sheet that is placed as a whole, and its bounding box."""

    box: Box
    shapes: tuple[Shape, ...]
    labels: tuple[Label, ...]
    measures: tuple[Measure, ...] = ()

    def moved(self, dx: float, dy: float) -> Block:
        """Return the block, moved by (dx, dy)."""

        def point(p: Point) -> Point:
            return p[0] + dx, p[1] + dy

        def moved(measure: Measure) -> Measure:
            lines = placed(Contour("", measure.lines, closed=False), (dx, dy)).segments
            label = measure.label._replace(at=point(measure.label.at))
            arrows = tuple(arrow._replace(tip=point(arrow.tip)) for arrow in measure.arrows)
            points = tuple(map(point, measure.points))
            return measure._replace(points=points, lines=lines, label=label, arrows=arrows)

        box = Box(*point(self.box[:2]), *point(self.box[2:]))
        shapes = tuple(placed(one, (dx, dy)) for one in self.shapes)
        labels = tuple(label._replace(at=point(label.at)) for label in self.labels)
        return Block(box, shapes, labels, tuple(map(moved, self.measures)))


def packed(
    boxes: Sequence[Box], taken: Iterable[Box], area: Box, apart: float
) -> list[Point] | None:
    """Return how boxes move to free positions in an area, ``apart`` mm apart, or None.

    Large ones come first, and all are clear of the ``taken`` ones.
    """
    moves: dict[int, Point] = {}
    around, gap = [*taken], 0.999 * apart
    sizes = [(box.x1 - box.x0, box.y1 - box.y0) for box in boxes]
    for i in sorted(range(len(boxes)), key=lambda k: -sizes[k][0] * sizes[k][1]):
        wide, high = sizes[i]
        lefts = sorted({area.x0 + apart, *(box.x1 + apart for box in around)})
        tops = sorted({area.y1 - apart, *(box.y0 - apart for box in around)}, reverse=True)
        for top, left in product(tops, lefts):
            low, right = top - high, left + wide
            inside = right <= area.x1 - apart and low >= area.y0 + apart
            if inside and all(
                right + gap <= a or c + gap <= left or top + gap <= b or d + gap <= low
                for a, b, c, d in around
            ):
                break
        else:
            return None
        moves[i] = left - boxes[i].x0, top - boxes[i].y1
        around.append(Box(left, low, right, top))
    return [moves[i] for i in range(len(boxes))]


def on_paper(
    spec: Spec,
    rows: list[dict[str, Any]],
    largest: float,
    blocks: Callable[[float], Iterable[list[Block]]],
) -> sheet.Sheet:
    """Return the sheet with blocks at the largest scale at which all fit on it.

    ``rows`` are its list of items. ``largest`` is the greatest length that is drawn, mm. ``blocks``
    yields alternatives of what is on it at a scale, the best first. Raises GenevaError where no
    scale fits.
    """
    items = _items(rows)
    wide_most, _ = FORMATS["A1"]
    for scale in SCALES:
        most = 170.0 if scale > 1.0 else wide_most  # mm: an enlarged part is no wider than a hand
        if scale * largest > most:
            continue
        for name, (wide, high) in FORMATS.items():
            area = Box(LEFT, MARGIN, wide - MARGIN, high - MARGIN)
            corner = _title_block(spec, rows, scale, name).moved(area.x1 - TITLE_WIDTH, MARGIN)
            fixed = [corner, items.moved(area.x1 - items.box.x1, corner.box.y1)]
            for one in blocks(scale):
                boxes, taken = [block.box for block in one], [block.box for block in fixed]
                tried = (packed(boxes, taken, area, apart) for apart in APART)
                moves = next(filter(None, tried), None)
                if moves is None:
                    continue
                whole = [*fixed, *(block.moved(*to) for block, to in zip(one, moves, strict=True))]
                shapes = *_frame(wide, high), *(shape for block in whole for shape in block.shapes)
                labels = tuple(label for block in whole for label in block.labels if label.text)
                measures = tuple(measure for block in whole for measure in block.measures)
                title = spec.title or spec.wheel.title
                return sheet.Sheet(title, wide, high, scale, shapes, labels, measures)
    raise GenevaError("--part sheet: the parts and their tables do not fit on one A1 sheet")


def _frame(w: float, h: float) -> list[Shape]:
    """Return the frame, with marks at the middle of its sides."""
    x, y = 0.5 * w, 0.5 * h
    sides = [((x, 0.0), (x, MARGIN)), ((x, h), (x, h - MARGIN))]
    sides += [((0.0, y), (LEFT, y)), ((w, y), (w - MARGIN, y))]
    box = sheet.rectangle(sheet.FRAME, LEFT, MARGIN, w - MARGIN, h - MARGIN)
    return [box, *(line(sheet.FRAME, *ends) for ends in sides)]


def _title_block(spec: Spec, rows: list[dict[str, Any]], scale: float, size: str) -> Block:
    """Return the title block; its lower left corner is the origin."""
    own, shop = spec.drawing, WORKSHOPS[spec.size.process]
    materials = {wheel_material(spec).name, roller_material(spec).name}
    mass = sum(row["mass_kg"] * row["count"] for row in rows)
    # mg where kg would have too many zeros for the field
    shown = f"{_rounded(mass)} kg" if mass >= 1e-3 else f"{_rounded(1e6 * mass)} mg"
    material = materials.pop() if len(materials) == 1 else "see list"
    general = {"scale": scale_name(scale), "mass": shown, "material": material}
    general |= {"tolerances": shop.tolerances, "units": "mm, degrees", "size": size}
    general["sheet"] = "1/1"
    rough, flanks = (
        f"Ra {um:g}" if um else "" for um in (own.roughness_um, own.flank_roughness_um)
    )
    hard = f"{own.flank_hardness_HRC:g} HRC" if own.flank_hardness_HRC else ""
    chamfer, fillet, edges = spec.size.edge_chamfer_mm, spec.size.edge_fillet_mm, "free of burrs"
    if chamfer is not None:
        edges = f"chamfered {length(chamfer)} × 45°"
    elif fillet is not None:
        edges = f"rounded R {length(fillet)}"
    surfaces = {"roughness": rough or shop.roughness, "edges": edges}
    surfaces["faces that roll, slide, lock"] = ", ".join(filter(None, (flanks, hard)))
    names = {"drawing number": own.number or "", "revision": own.revision or ""}
    names |= {"date": own.date or "", "author": own.author or ""}
    high, top = 12.0, 36.0  # mm, of a row, and of all three
    shapes: list[Shape] = [sheet.rectangle(sheet.FRAME, 0.0, 0.0, TITLE_WIDTH, top + high)]
    labels = _field((0.0, top), "title", spec.title or spec.wheel.title, sheet.LARGE, TITLE_WIDTH)
    for k, fields in enumerate((general, surfaces, names)):  # rows from below
        x, y = 0.0, high * k
        shapes.append(line(TEXT, (0.0, y + high), (TITLE_WIDTH, y + high)))
        # what each field needs, and an equal part of what is left
        needed = [max(width(v) * SMALL, width(name) * 1.8) + 4.0 for name, v in fields.items()]
        spare = (TITLE_WIDTH - sum(needed)) / len(fields)
        for (name, value), need in zip(fields.items(), needed, strict=True):
            labels += _field((x, y), name, value, SMALL, need + spare)
            x += need + spare
            shapes.append(line(TEXT, (x, y), (x, y + high)))
    return Block(Box(0.0, 0.0, TITLE_WIDTH, top + high), tuple(shapes), tuple(labels))


def _field(at: Point, name: str, value: str, height: float, limit: float) -> list[Label]:
    x, y = at[0] + 2.0, at[1]
    shown = cut_to(value, height, limit - 4.0)
    return [Label(name, (x, y + 8.4), 1.8), Label(shown, (x, y + 3.0), height)]


def _items(rows: Iterable[dict[str, Any]]) -> Block:
    """Return the list of items."""
    lines = [("item", "part", "count", "t", "kg each", "material")]
    for i, row in enumerate(rows, 1):
        thick, mass = length(row["thickness_mm"]), _rounded(row["mass_kg"])
        lines.append((f"{i}", f"{row['name']}", f"{row['count']}", thick, mass, row["material"]))
    return table(lines, (12.0, 66.0, 14.0, 20.0, 24.0, 44.0))  # mm


def _rounded(mass: float) -> str:
    """Return a number of four digits, without exponent."""
    return length(float(f"{mass:.4g}"), 9)


def cut_to(text: str, height: float, limit: float) -> str:
    """Return a text, cut if it is longer than ``limit``."""
    every = (text, *(f"{text[:end]}..." for end in range(len(text) - 1, 0, -1)))
    return next((one for one in every if width(one) * height <= limit), "...")


def table(rows: Sequence[Sequence[str]], columns: Sequence[float], heading: str = "") -> Block:
    """Return a table of rows, with a heading above it."""
    row_height = 5.0  # mm
    levels = [row_height * k for k in range(len(rows))]
    wide, high, lefts = sum(columns), row_height * len(rows), [0.0, *accumulate(columns[:-1])]
    shapes: list[Shape] = [sheet.rectangle(sheet.OUTLINE, 0.0, 0.0, wide, high)]
    shapes += [line(TEXT, (x, 0.0), (x, high)) for x in lefts[1:]]
    shapes += [line(TEXT, (0.0, y), (wide, y)) for y in levels[1:]]
    labels = [Label(heading, (0.0, high + 0.6 * SMALL), SMALL)]
    for y, row in zip(reversed(levels), rows, strict=True):
        for text, x, column in zip(row, lefts, columns, strict=True):
            labels.append(Label(cut_to(text, SMALL, column - 2.0), (x + 1.0, y + 1.4), SMALL))
    top = high + 1.8 * SMALL if heading else high
    return Block(Box(0.0, 0.0, wide, top), tuple(shapes), tuple(labels))

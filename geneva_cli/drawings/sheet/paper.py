"""Sheets of paper: formats, scales, title block and tables.

The views have one scale: the largest standard scale at which everything fits on one sheet, A1 at
most. The sheet is the smallest that fits. Above 1:1 the largest part is no wider than a hand.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from geneva_cli.drawings.sheet.packing import Block, packed
from geneva_cli.errors import GenevaError
from geneva_cli.geometry import sheet
from geneva_cli.geometry.shapes import Point, Shape
from geneva_cli.geometry.sheet import SMALL, TEXT, Label, line, width
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.workshops import WORKSHOPS
from geneva_cli.table import in_decimals as length

LEFT, MARGIN = 20.0, 10.0  # mm: margin of the frame on the filing side, and on the others
TITLE_WIDTH = 180.0  # mm: width of the title block


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


def smaller(scale: float, times: float) -> float:
    """Return the largest standard scale that is smaller by a factor; else the smallest one."""
    return max((s for s in SCALES if s <= scale / times * (1.0 + 1e-9)), default=SCALES[-1])


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
            right, inside = wide - MARGIN, (LEFT, MARGIN, wide - MARGIN, high - MARGIN)
            corner = _title_block(spec, rows, scale, name).moved(right - TITLE_WIDTH, MARGIN)
            fixed = [corner, items.moved(right - items.width, corner.y1)]
            for one in blocks(scale):
                placed = packed(one, fixed, inside)
                if placed is None:
                    continue
                whole = [*fixed, *placed]
                shapes = *_frame(wide, high), *(shape for block in whole for shape in block.shapes)
                labels = tuple(label for block in whole for label in block.labels)
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
    return Block(0.0, 0.0, TITLE_WIDTH, top + high, tuple(shapes), tuple(labels))


def _field(at: Point, name: str, value: str, height: float, limit: float) -> list[Label]:
    x, y = at[0] + 2.0, at[1]
    shown = cut_to(value, height, limit - 4.0)
    labels = [Label(name, (x, y + 8.4), 1.8)]
    return [*labels, Label(shown, (x, y + 3.0), height)] if shown else labels


def _items(rows: Sequence[Mapping[str, Any]]) -> Block:
    """Return the list of items."""
    lines = [("item", "part", "count", "t", "kg each", "material")]
    for i, row in enumerate(rows, 1):
        thick, mass = length(row["thickness_mm"]), _rounded(row["mass_kg"])
        lines.append((f"{i}", f"{row['name']}", f"{row['count']}", thick, mass, row["material"]))
    return table((), lines, (12.0, 66.0, 14.0, 20.0, 24.0, 44.0))  # mm


def _rounded(mass: float) -> str:
    """Return a number of four digits, without exponent."""
    return length(float(f"{mass:.4g}"), 9)


def cut_to(text: str, height: float, limit: float) -> str:
    """Return a text, cut if it is longer than ``limit``."""
    if width(text) * height <= limit:
        return text
    while text and width(text + "...") * height > limit:
        text = text[:-1]
    return text + "..."


def table(heading: Sequence[str], rows: Sequence[Sequence[str]], columns: Sequence[float]) -> Block:
    """Return a table, with lines of text above it."""
    row_height = 5.0  # mm
    wide, high = sum(columns), row_height * len(rows)
    shapes: list[Shape] = [sheet.rectangle(sheet.OUTLINE, 0.0, 0.0, wide, high)]
    labels: list[Label] = []
    lefts = [sum(columns[:k]) for k in range(len(columns))]
    shapes += [line(TEXT, (x, 0.0), (x, high)) for x in lefts[1:]]
    for i, row in enumerate(rows):
        y = high - row_height * (i + 1)
        if i:
            shapes.append(line(TEXT, (0.0, y + row_height), (wide, y + row_height)))
        for text, x, column in zip(row, lefts, columns, strict=True):
            if shown := cut_to(text, SMALL, column - 2.0):
                labels.append(Label(shown, (x + 1.0, y + 1.4), SMALL))
    top = high
    for text in reversed(heading):
        top += 1.8 * SMALL
        labels.append(Label(text, (0.0, top - 1.2 * SMALL), SMALL))
        wide = max(wide, labels[-1].width)
    return Block(0.0, 0.0, wide, top, tuple(shapes), tuple(labels))

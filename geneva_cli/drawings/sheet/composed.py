"""Blocks on a sheet of paper, with the list of items and a title block.

The views have one scale: the largest standard scale at which everything fits on one sheet, A1 at
most. The sheet is the smallest that fits. Above 1:1 the largest part is no wider than a hand.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeAlias

from geneva_cli.drawings.sheet.paper import (
    FORMATS,
    LEFT,
    MARGIN,
    SCALES,
    TITLE_WIDTH,
    PaperSize,
    frame,
    scale_name,
    table,
    title_block,
)
from geneva_cli.drawings.sheet.sized import edge_note
from geneva_cli.drawings.sheet.view import Block
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.sheet import Sheet
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.spec.materials import material_names
from geneva_cli.spec.workshops import workshop
from geneva_cli.spec.written import length, number


def on_paper(
    spec: Spec,
    rows: list[dict[str, Any]],
    largest: float,
    blocks: Callable[[float], tuple[list[Block], Callable[[], Iterable[list[Block]]]]],
    area: float = 0.0,
) -> Sheet:
    """Return the sheet with blocks at the largest scale at which all fit on it.

    ``rows`` are its list of items. ``blocks`` returns what is always on it, and a function that
    yields alternatives of the rest, the best first, for each size of paper. ``largest`` is the
    greatest length that is drawn, mm. ``area``, mm², is the least area that some of it needs.
    Raises GenevaError where no scale fits.
    """
    for scale in SCALES:
        width, height = FORMATS[-1].width, FORMATS[-1].height
        most = 170.0 if scale > 1.0 else width  # mm: an enlarged part is no wider than a hand
        if scale * largest > most or scale * scale * area > width * height:
            continue
        parts, alternatives = blocks(scale)
        for paper in FORMATS:
            if is_overfull(parts, _inside(paper)):
                continue
            for one in alternatives():
                sheet = _composed(spec, paper, scale, rows, [*parts, *one])
                if sheet is not None:
                    return sheet
    raise GenevaError("--part sheet: the parts and their tables do not fit on one A1 sheet")


def _inside(paper: PaperSize) -> Box:
    return LEFT, MARGIN, paper.width - MARGIN, paper.height - MARGIN


def _composed(
    spec: Spec, paper: PaperSize, scale: float, rows: list[dict[str, Any]], blocks: list[Block]
) -> Sheet | None:
    area = _inside(paper)
    if is_overfull(blocks, area):
        return None
    materials = material_names(spec)
    general = {
        "scale": scale_name(scale),
        "mass": _mass(sum(r["mass_kg"] * r["count"] for r in rows)),
        "material": materials[0] if len(set(materials)) == 1 else "see list",
        "tolerances": workshop(spec.size.process).tolerances,
        "units": "mm, degrees",
        "size": paper.name,
        "sheet": "1/1",
    }
    head = spec.title or spec.wheel.title
    _, low, right, _ = area
    corner = title_block(head, [general, *_fields(spec)]).moved(right - TITLE_WIDTH, low)
    items = _items(rows)
    items = items.moved(right - items.width, corner.y1)
    placed = packed(blocks, [corner, items], area)
    if placed is None:
        return None
    all_blocks = [corner, items, *placed]
    return Sheet(
        head,
        paper.width,
        paper.height,
        scale,
        (*frame(paper), *(s for b in all_blocks for s in b.shapes)),
        tuple(label for b in all_blocks for label in b.labels),
        tuple(m for b in all_blocks for m in b.measures),
    )


def _fields(spec: Spec) -> list[dict[str, str]]:
    own = spec.drawing
    hard = f"{own.flank_hardness_HRC:g} HRC" if own.flank_hardness_HRC else ""
    working = filter(None, (_rough(own.flank_roughness_um), hard))
    surfaces = {
        "roughness": _rough(own.roughness_um) or workshop(spec.size.process).roughness,
        "edges": edge_note(spec.size) or "free of burrs",
        "faces that roll, slide, lock": ", ".join(working),
    }
    names = {"drawing number": own.number, "revision": own.revision}
    names |= {"date": own.date, "author": own.author}
    return [surfaces, {name: text or "" for name, text in names.items()}]


def _rough(roughness_um: float | None) -> str:
    return f"Ra {roughness_um:g}" if roughness_um else ""


def _items(rows: list[dict[str, Any]]) -> Block:
    lines = [
        (
            str(i),
            str(row["name"]),
            str(row["count"]),
            length(row["thickness_mm"]),
            _rounded(row["mass_kg"]),
            row["material"],
        )
        for i, row in enumerate(rows, 1)
    ]
    heading = ("item", "part", "count", "t", "kg each", "material")
    columns = (12.0, 66.0, 14.0, 20.0, 24.0, 44.0)  # mm
    return table((), [heading, *lines], columns)


def _mass(kg: float) -> str:
    """Return a mass with its unit, mg where kg would have too many zeros for the field."""
    return f"{_rounded(kg)} kg" if kg >= 1e-3 else f"{_rounded(1e6 * kg)} mg"


def _rounded(mass: float) -> str:
    """Return a number of four digits, without exponent."""
    return number(float(f"{mass:.4g}"), 9)


Box: TypeAlias = tuple[float, float, float, float]  # x0, y0, x1, y1


def is_overfull(blocks: Sequence[Block], area: Box) -> bool:
    """Return True if blocks need more than an area, so that ``packed`` cannot place them."""
    x0, y0, x1, y1 = area
    apart = 7.9  # mm, a little less than ``packed`` keeps between blocks, and to the edge
    needed = sum((block.width + apart) * (block.height + apart) for block in blocks)
    return needed > (x1 - x0 - apart) * (y1 - y0 - apart)


def packed(blocks: Sequence[Block], taken: Sequence[Block], area: Box) -> list[Block] | None:
    """Return the blocks at free positions in an area, clear of the ``taken`` ones.

    None where they do not fit.
    """
    orders: tuple[Callable[[Block], float], ...] = (
        lambda block: -block.width * block.height,
        lambda block: -block.height,
        lambda block: -block.width,
    )
    for order in orders:
        result = packed_apart(blocks, taken, area, order, 8.0)  # mm between blocks
        if result is None:
            continue
        for apart in (12.0, 18.0, 27.0, 40.0):
            wider = packed_apart(blocks, taken, area, order, apart)
            if wider is None:
                break
            result = wider
        return result
    return None


def packed_apart(
    blocks: Sequence[Block],
    taken: Sequence[Block],
    area: Box,
    order: Callable[[Block], float],
    apart: float,
) -> list[Block] | None:
    """Return the blocks as ``packed`` does, the least by ``order`` first, ``apart`` mm apart."""
    x0, y0, x1, y1 = area
    placed: dict[int, Block] = {}
    around = [(b.x0, b.y0, b.x1, b.y1) for b in taken]
    for i in sorted(range(len(blocks)), key=lambda k: order(blocks[k])):
        block = blocks[i]
        lefts = sorted({x0 + apart, *(box[2] + apart for box in around)})
        tops = sorted({y1 - apart, *(box[1] - apart for box in around)}, reverse=True)
        for top, left in ((top, left) for top in tops for left in lefts):
            box = (left, top - block.height, left + block.width, top)
            fits = box[2] <= x1 - apart and box[1] >= y0 + apart
            if fits and not any(_meet(box, other, apart) for other in around):
                break
        else:
            return None
        placed[i] = block.moved(left - block.x0, top - block.y1)
        around.append(box)
    return [placed[i] for i in range(len(blocks))]


def _meet(a: Box, b: Box, apart: float) -> bool:
    gap = 0.999 * apart
    separate = a[2] + gap <= b[0] or b[2] + gap <= a[0]
    return not (separate or a[3] + gap <= b[1] or b[3] + gap <= a[1])

"""Placing of blocks on a sheet: large ones first, each as high and then as far left as possible.

A block is placed at a corner that the frame and the blocks before it leave open. Large means area;
if that fails, height, and then width. Then the blocks are spread over the sheet.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from geneva_cli.drawings.sheet.view import Block

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

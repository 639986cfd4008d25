"""Blocks side by side on a sheet: the largest first, each as high up and then as far left as goes.

A block's place is a corner that the frame and the blocks before it leave open.
"""

from __future__ import annotations

from collections.abc import Sequence

from geneva_cli.parts.sheet.view import Block

APART = 8.0  # mm: between two blocks


def packed(
    blocks: Sequence[Block], taken: Sequence[Block], area: tuple[float, float, float, float]
) -> list[Block] | None:
    """The blocks where they have room in an area (x0, y0, x1, y1) beside those that are there.

    None where they have none.
    """
    x0, y0, x1, y1 = area
    found: dict[int, Block] = {}
    around = list(taken)
    for i in sorted(range(len(blocks)), key=lambda k: -blocks[k].width * blocks[k].height):
        block = blocks[i]
        lefts = sorted({x0 + APART, *(b.x1 + APART for b in around)})
        tops = sorted({y1 - APART, *(b.y0 - APART for b in around)}, reverse=True)
        for top, left in ((top, left) for top in tops for left in lefts):
            placed = block.moved(left - block.x0, top - block.y1)
            fits = placed.x1 <= x1 - APART and placed.y0 >= y0 + APART
            if fits and not any(_meet(placed, other) for other in around):
                break
        else:
            return None
        found[i] = placed
        around.append(placed)
    return [found[i] for i in range(len(blocks))]


def _meet(a: Block, b: Block) -> bool:
    gap = 0.999 * APART
    return not (
        a.x1 + gap <= b.x0 or b.x1 + gap <= a.x0 or a.y1 + gap <= b.y0 or b.y1 + gap <= a.y0
    )

"""Blocks of a sheet, and how they are placed side by side."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple, TypeAlias

from geneva_cli.geometry.shapes import Contour, Point, Shape, placed
from geneva_cli.geometry.sheet import Label, Measure

APART = (40.0, 27.0, 18.0, 12.0, 8.0)  # mm between blocks, the widest that the paper allows
Box: TypeAlias = tuple[float, float, float, float]  # x0, y0, x1, y1


class Block(NamedTuple):
    """A part of a sheet that is placed as a whole, and its bounding box."""

    x0: float
    y0: float
    x1: float
    y1: float
    shapes: tuple[Shape, ...]
    labels: tuple[Label, ...]
    measures: tuple[Measure, ...] = ()

    @property
    def width(self) -> float:
        """Width, mm."""
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        """Height, mm."""
        return self.y1 - self.y0

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

        shapes = tuple(placed(one, (dx, dy)) for one in self.shapes)
        labels = tuple(label._replace(at=point(label.at)) for label in self.labels)
        corners = *point((self.x0, self.y0)), *point((self.x1, self.y1))
        return Block(*corners, shapes, labels, tuple(map(moved, self.measures)))


def packed(blocks: Sequence[Block], taken: Sequence[Block], area: Box) -> list[Block] | None:
    """Return the blocks at free positions in an area, clear of the ``taken`` ones, or None."""
    every = (packed_apart(blocks, taken, area, apart) for apart in APART)
    return next((placed for placed in every if placed), None)


def packed_apart(
    blocks: Sequence[Block], taken: Sequence[Block], area: Box, apart: float
) -> list[Block] | None:
    """Return the blocks as ``packed`` does, large ones first, ``apart`` mm apart."""
    x0, y0, x1, y1 = area
    placed: dict[int, Block] = {}
    around, gap = [block[:4] for block in taken], 0.999 * apart
    for i in sorted(range(len(blocks)), key=lambda k: -blocks[k].width * blocks[k].height):
        block = blocks[i]
        lefts = sorted({x0 + apart, *(box[2] + apart for box in around)})
        tops = sorted({y1 - apart, *(box[1] - apart for box in around)}, reverse=True)
        for top, left in product(tops, lefts):
            low, right = top - block.height, left + block.width
            inside = right <= x1 - apart and low >= y0 + apart
            if inside and all(
                right + gap <= a or c + gap <= left or top + gap <= b or d + gap <= low
                for a, b, c, d in around
            ):
                break
        else:
            return None
        placed[i] = block.moved(left - block.x0, top - block.y1)
        around.append((left, low, right, top))
    return [placed[i] for i in range(len(blocks))]

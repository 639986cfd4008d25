"""All parts of a machine side by side on one bed, each with its lower face on it."""

from __future__ import annotations

import math

from geneva_cli.drawings.sheet.pack import packed_apart
from geneva_cli.drawings.sheet.view import Block
from geneva_cli.geometry.drawing import Drawing
from geneva_cli.geometry.measure import bounds_of
from geneva_cli.geometry.plates import Group, Member, Plate, Shell, Stack, lowered, solids
from geneva_cli.parts.edged_parts import EdgedParts
from geneva_cli.parts.projection import outlines_of, titled

APART = 5.0  # mm between parts, and round them


def plate(parts: EdgedParts) -> Drawing:
    """Return all parts, each as often as the machine has it, in front of and right of the origin.

    Raises GenevaError for a part that cannot be built.
    """
    every = (one for _, build in parts.turned.by_name() for part in build() for one in solids(part))
    whole = [one for one in every if not isinstance(one, Shell)]
    title = titled(parts.mechanism, "plate")
    solid = Group(title, tuple(_laid(whole)))
    return Drawing(title, outlines_of(solid), solid=solid)


def _laid(whole: list[Plate | Stack]) -> list[Member]:
    """Return parts at z = 0 side by side, on a square bed that is as small as they allow."""
    blocks = [Block(*bounds_of(outlines_of(one)), (), ()) for one in whole]
    side = math.sqrt(sum((b.width + APART) * (b.height + APART) for b in blocks))
    placed = None
    while placed is None:
        area = (0.0, 0.0, side, side)
        placed = packed_apart(blocks, (), area, lambda b: -b.width * b.height, APART)
        # the bed grows by a tenth until all parts fit
        side *= 1.1
    return [
        Member(
            lowered(one),
            (block.x0 - before.x0, block.y0 - before.y0),
        )
        for one, before, block in zip(whole, blocks, placed, strict=True)
    ]

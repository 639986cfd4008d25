"""All views of a machine's sheet."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.drawings.sheet.content import SheetContent, mark_items
from geneva_cli.drawings.sheet.crank import draw_arm, draw_assembly, draw_disc
from geneva_cli.drawings.sheet.linked import (
    Begin,
    flat_plates,
    geared,
    linked,
    rolling,
    shafted,
    titled,
)
from geneva_cli.drawings.sheet.paper import scale_name
from geneva_cli.drawings.sheet.standing import draw_frame, draw_groove
from geneva_cli.drawings.sheet.view import View
from geneva_cli.drawings.sheet.wheel import draw_wheel
from geneva_cli.parts.flat_parts import FlatParts


def views(shown: SheetContent, parts: FlatParts, scale: float) -> Iterator[View]:
    """Yield a view of each part."""
    begin = titled(shown.rows, scale, parts.mechanism.spec.size.process)
    yield from _wheels(parts, begin)
    if parts.arm:
        view = begin("arm")
        draw_arm(view, parts.mechanism, parts.arm)
        yield view
    yield from rolling(begin, parts.mechanism)
    yield from linked(begin, parts)
    yield from geared(begin, parts)
    yield from _standing(parts, begin)


def _wheels(parts: FlatParts, begin: Begin) -> Iterator[View]:
    """Yield the views of wheels and locking discs; of two wheels in series, of both."""
    for front, of in (("", parts), ("first ", parts.front)):
        if of is None:
            continue
        view = begin(f"{front}wheel", f"{front}wheel's hub")
        draw_wheel(view, of)
        yield view
        if of.outlines.crank:
            view = begin(
                *(f"{front}{name}" for name in ("locking disc", "locking sector", "crank's hub")),
            )
            draw_disc(view, of)
            yield view


def _standing(parts: FlatParts, begin: Begin) -> Iterator[View]:
    """Yield the views of shafts, and of the plates that stand still."""
    yield from shafted(begin, parts.shafts)
    grooved = flat_plates(parts.groove_plate)
    if grooved:
        view = begin(*(plate.name for plate in grooved), "groove")
        draw_groove(view, parts.groove, parts.outlines.sizes.half_width, grooved[0])
        yield view
    (frame,) = flat_plates([parts.frame])
    view = begin(frame.name)
    draw_frame(view, frame)
    yield view


def together(shown: SheetContent, parts: FlatParts, scale: float) -> View:
    """Return the view of the assembled machine, with balloons of what the section does not cut."""
    view = View(f"assembly ({scale_name(scale)})", scale)
    draw_assembly(view, parts.outlines, shown.together)
    mark_items(view, shown)
    return view

"""The views of gears: teeth or pitch curves, bores, and bolts of fixed gears."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.standing import bolted, bored, circle_of
from geneva_cli.drawings.sheet.view import View, times
from geneva_cli.geometry.measure import legs
from geneva_cli.geometry.plates import Group, Member, plates
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Shape
from geneva_cli.geometry.sheet import CENTRE, OUTLINE
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.gears.gear_blanks import Gear
from geneva_cli.parts.gears.gear_curves import PairTeeth
from geneva_cli.parts.gears.gear_mesh import ToothedGear
from geneva_cli.parts.projection import outlines_of
from geneva_cli.parts.shafts.bores import radius_of
from geneva_cli.spec.tables import Size
from geneva_cli.spec.written import is_metric, length, number


def draw_gear(view: View, gear: Gear, size: Size) -> None:
    """Draw a gear with its teeth, or else its pitch circle, with its bore and its bolts."""
    outline, axis, screwed = gear.plate.outline, (0.0, 0.0), gear.bolts
    pitch = Circle("", axis, gear.radius)
    if gear.cut:
        view.draw_plate(gear.plate)
    else:
        _draw_blank(view, gear)
    circle_of(view, screwed)
    view.cross(axis, gear.outer)
    text = f"pitch {sized.plain(2.0 * gear.radius, 'Ø ')}"
    if gear.cut:
        _teeth(view, gear.cut)
    elif isinstance(outline, Contour):
        _sectors(view, gear, outline, text)
    else:
        view.diameter([pitch], text)
    if isinstance(outline, Circle) and gear.teeth.inside:
        view.diameter([outline], sized.plain(2.0 * outline.radius, "Ø "))
    if gear.bore.bore.radius:
        bored(view, [gear.bore.hole()], size, gear.bore.part)
    bolted(view, screwed)
    if gear.cut:
        return
    only = "" if gear.teeth.all_round else "; teeth on these sectors only"
    view.remark(f"pitch circle; teeth not shown{only}")


def _teeth(view: View, gear: ToothedGear) -> None:
    teeth, (over, span) = gear.teeth, gear.span
    reference = Circle("", (0.0, 0.0), teeth.radius)
    view.draw(reference, CENTRE)
    view.diameter([reference], sized.plain(2.0 * teeth.radius, "reference Ø "))
    view.diameter(
        [Circle("", (0.0, 0.0), teeth.opening or teeth.tip)],
        sized.plain(2.0 * (teeth.opening or teeth.tip), "tips Ø "),
    )
    each, rack = len(gear.middles[0]), teeth.rack
    view.remark(
        f"{times(len(gear.middles), f'{each} teeth')}, m = {_module(rack.module)}, "
        f"x = {number(gear.shift, 4)}, {number(math.degrees(rack.angle))}°"
        + (f"; {length(span, fine=True)} over {over} teeth" if over else "")
    )
    if gear.last_tip:
        view.remark(f"tip of the last tooth {sized.plain(2.0 * gear.last_tip, 'Ø ')}")


def _draw_blank(view: View, gear: Gear) -> None:
    """Draw a gear without teeth; its arcs on the pitch circle are drawn as centre lines."""
    outline = gear.plate.outline
    pieces: list[Shape] = [outline, *gear.plate.holes]
    if isinstance(outline, Contour):
        pieces[:1] = [Contour("", (piece,), closed=False) for piece in outline.segments]
    for shape in pieces:
        arc = shape.segments[0] if isinstance(shape, Contour) and not shape.closed else shape
        on_pitch = isinstance(arc, (Arc, Circle)) and abs(arc.radius - gear.radius) < SAME_ON_SHEET
        view.draw(shape, CENTRE if on_pitch else OUTLINE)


def _sectors(view: View, gear: Gear, outline: Contour, pitch: str) -> None:
    arcs = [piece for piece in outline.segments if isinstance(piece, Arc)]
    toothed = [arc for arc in arcs if abs(arc.radius - gear.radius) < SAME_ON_SHEET]
    hub = [arc for arc in arcs if arc not in toothed]
    count = len(toothed)
    view.of_arcs(toothed, times(count, pitch), whole=True)
    view.of_arcs(hub, times(len(hub), sized.plain(hub[0].radius, "R ")))
    ends = [legs(arc) for arc in toothed]
    wide = times(count, f"{number(gear.teeth.each_deg)}°")
    view.angular(ends, gear.radius, gear.radius, wide)
    if count > 1:
        step = times(count, f"{number(360.0 / count)}°")
        turn = math.tau / count
        view.angular([(a, a + turn) for a, _ in ends], gear.radius, gear.radius, step)


def draw_gears(view: View, gears: Sequence[Member], size: Size, teeth: PairTeeth | None) -> None:
    """Draw two noncircular gears in mesh at input angle 0, with bores, about their axes."""
    for shape in outlines_of(Group("", tuple(gears))):
        view.draw(shape, OUTLINE if teeth or shape.layer == "BORE" else CENTRE)
    ends = gears[0].at, gears[1].at
    view.centre_line(*ends)
    for gear, part in zip(gears, ("crank", ""), strict=True):
        for bore in plates(gear.part)[0].holes:
            view.cross(gear.at, radius_of(bore))
            bored(view, [bore], size, part, gear.at)
    view.linear(*ends, 0.0, sized.plain(math.dist(*ends)))
    if teeth:
        each, rack = f"{teeth.z} teeth each", teeth.driver
        view.remark(f"{each}, m = {_module(rack.module, 6)}, {number(math.degrees(rack.angle))}°")
        if teeth.shift:
            view.remark(f"x = {number(teeth.shift, 4)} of the driver, and minus that")
    else:
        view.remark("pitch curves; teeth not shown")


def _module(mm: float, decimals: int = 3) -> str:
    """Return a module, which is in millimetres on every sheet."""
    return number(mm, decimals) + ("" if is_metric() else " mm")

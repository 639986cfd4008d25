"""The views of wheel, frame, hubs and shafts, and dimensions of bores and bolts."""

import math
from collections.abc import Mapping, Sequence

from geneva_cli.drawings.part_drawings import pitch_lines
from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.view import View, grouped, times, turns
from geneva_cli.geometry import shapes
from geneva_cli.geometry.plates import Plate, plates
from geneva_cli.geometry.sheet import CENTRE, HIDDEN, OUTLINE, rectangle
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.outlines.outlines import Outlines, dial_circle, wheel_holes
from geneva_cli.parts.projection import outlines_of
from geneva_cli.parts.shafts.bores import bore_of
from geneva_cli.table import in_decimals as length


def draw_wheel(view: View, parts: FlatParts) -> View:
    """Draw the wheel with all its dimensions but the flanks of curved slots."""
    outlines = parts.outlines
    assembly, sizes = outlines.assembly, outlines.sizes
    wheel, *hubs = plates(parts.wheel.part)
    for shape in outlines_of(parts.wheel.part):
        view.draw(HIDDEN if shape.layer == "HUB" else OUTLINE, shape)
    edges = (s for s in (wheel.outline, *wheel.holes) if s.layer == wheel.layer)
    contour = next(s for s in edges if isinstance(s, shapes.Contour))
    reach = sizes.outer or max(math.hypot(*s.start) for s in contour.segments)
    view.cross(shapes.ORIGIN, reach)
    slots, angles = dict[Engagement, list[shapes.Contour]](), list[float]()
    for (engagement, direction), walls in zip(assembly.slots, outlines.cut, strict=True):
        slots.setdefault(engagement, []).append(walls)
        if engagement.slot.curved:
            angles.append(direction)
            continue
        for inner, outer in (ends[:: round(assembly.sign)] for ends in _ends(walls)):
            view.centre_line(inner, outer)
            angle = math.atan2(outer[1] - inner[1], outer[0] - inner[0])
            angles.append(direction + math.remainder(angle - direction, math.tau))
    if assembly.slots[0][0].slot.curved:
        view.draw(CENTRE, *pitch_lines(parts, assembly.slots[0][0]))
    L = assembly.L
    # a recess's centre, the leftmost one
    centres = ((L * math.cos(a), L * math.sin(a)) for a in assembly.rests)
    at_rest = min(centres, key=lambda p: p[0], default=shapes.ORIGIN)
    if sizes.recess:
        view.cross(at_rest, 0.0)
    arcs = [s for s in contour.segments if isinstance(s, shapes.Arc)]
    screwed = dial_circle(assembly, sizes).holes
    circle_of(view, screwed)
    if sizes.recess:
        about = [arc for arc in arcs if abs(math.hypot(*arc.centre) - L) < SAME_ON_SHEET]
        own = [arc for arc in about if abs(arc.radius - sizes.recess) < SAME_ON_SHEET]
        deviation = assembly.mechanism.spec.tolerance.center_distance_mm
        view.radial(at_rest, sized.plain(L, off=deviation))
        recess = view.fits.made("recess", sizes.recess)
        view.diameter(own, times(len(own), recess))
        view.radii(arc for arc in about if arc not in own)
    width = view.fits.made("slot", sizes.half_width)
    for engagement in assembly.kinds:
        if engagement.slot.curved:
            many = times(len(slots[engagement]), "slot")
            view.notes.append(f"{many}, {width} wide: flanks as in the wheel's dxf")
        else:
            _slot(view, slots[engagement], sizes.half_width, width)
    view.linear((0.0, -reach), (0.0, reach), 0.5 * math.pi, sized.plain(2.0 * reach, "Ø "))
    _steps(view, outlines, sorted(angles), reach)
    own = [arc for arc in arcs if math.hypot(*arc.centre) < SAME_ON_SHEET]
    view.radii(own, besides=reach)
    clear = assembly.mechanism.spec.size.allowances
    if clear.source and clear.slot_clearance_mm:  # of a process, whose fits do not say it
        text = f"clearance a side: {length(clear.slot_clearance_mm)} from roller to slot"
        lock = f", {length(clear.lock_clearance_mm)} from locking disc to recess"
        view.notes.append(text + (lock if sizes.lock else ""))
    if sizes.mouth_radius:
        view.notes.append(f"mouths of the slots rounded with R {length(sizes.mouth_radius)}")
    if sizes.arm - sizes.half_width - sizes.recess < sizes.horn_tip:
        view.notes.append(
            f"horns cut square to the slots where they are {length(sizes.horn_tip)} wide"
        )
    for hub in hubs:
        draw_hub(view, hub)
    bored(view, wheel_holes(assembly, sizes), "wheel", sizes.wheel_bore)
    bolted(view, screwed)
    return view


def _ends(walls: shapes.Contour) -> list[tuple[shapes.Point, shapes.Point]]:
    """Return inner end and mouth of the axis of a straight slot, or of each slot of a pair."""
    first, *middle, last = walls.segments
    arcs = [piece for piece in middle if isinstance(piece, shapes.Arc)]
    corners, out = (first.start, last.end), []
    sides = [(first.start, first.end, arcs[0]), (last.end, last.start, arcs[-1])]
    for corner, inner, arc in sides[: len(arcs)]:
        (x, y), turn = arc.centre, math.atan2(inner[1] - corner[1], inner[0] - corner[0])
        c, s = math.cos(turn), math.sin(turn)
        # of a pair, each has one corner of its own
        own = corners if len(arcs) == 1 else (corner,)
        mouth = shapes.polar(arc.centre, min((u - x) * c + (v - y) * s for u, v in own), turn)
        out.append((shapes.polar(arc.centre, arc.radius, turn), mouth))
    return out


def _slot(view: View, slots: list[shapes.Contour], half_width: float, width: str) -> None:
    """Draw the size and the position of equal straight slots, at the first of them."""
    (end, mouth), *others = _ends(slots[0])
    count = len(slots) * (1 + len(others))
    turn = math.atan2(mouth[1] - end[1], mouth[0] - end[0])
    across = turn + 0.5 * math.pi
    corner, far = slots[0].segments[0].start, slots[0].segments[-1].end
    if not others:
        view.linear(corner, far, across, times(count, width), "slot's width")
    else:  # one wall each
        half = times(count, sized.plain(half_width))
        view.linear(corner, mouth, across, half, "from a slot's wall to its axis")
    along = end[0] * math.cos(turn) + end[1] * math.sin(turn)
    foot = end[0] - along * math.cos(turn), end[1] - along * math.sin(turn)
    view.linear(foot, end, turn, "", "from the wheel's middle to a slot's end", near=True)
    deep = times(count, sized.plain(math.dist(end, mouth)))
    view.linear(end, mouth, turn, deep, "from a slot's end to its mouth", near=True)
    if math.hypot(*foot) > SAME_ON_SHEET:
        normal = math.atan2(foot[1], foot[0])
        view.linear(shapes.ORIGIN, foot, normal, "", "from the wheel's axis to a slot's axis")
    arcs = [s for walls in slots for s in walls.segments if isinstance(s, shapes.Arc)]
    rounds = [arc for arc in arcs if math.hypot(*arc.centre) > SAME_ON_SHEET]
    view.radius(rounds, times(count, sized.plain(rounds[0].radius, "R ")))


def _steps(view: View, parts: Outlines, angles: list[float], reach: float) -> None:
    """Draw the angles from slot to slot, and from a slot to a recess."""
    deviation = parts.assembly.mechanism.spec.tolerance.slot_angle_deg
    view.angles(turns(angles), reach, f" ±{deviation:g}°" if deviation else "")
    rests = parts.assembly.rests if parts.sizes.recess else ()
    halves = ((min((rest - angle) % math.tau for angle in angles), rest) for rest in rests)
    view.angles(((rest - half, rest) for half, rest in halves), reach)


def draw_frame(
    view: View,
    plate: Plate,
    screws: Mapping[shapes.Circle, str],
    axis_name: str = "the wheel's axis",
) -> View:
    """Draw the frame: its size, and diameter and position of each hole from the axis."""
    view.draw(OUTLINE, plate.outline, *plate.holes)
    holes = [hole for hole in plate.holes if isinstance(hole, shapes.Circle)]
    crosses = {shapes.ORIGIN: holes[0].radius} if holes else {}  # the axis may have no hole
    for centre, radius in (crosses | {hole.centre: hole.radius for hole in holes}).items():
        view.cross(centre, radius)
    box = shapes.bounds(plate.outline)
    up = 0.5 * math.pi
    where = f"from {axis_name} to a hole"
    view.places(
        (hole.centre for hole in holes), shapes.ORIGIN, (f"across, {where}", f"up, {where}")
    )
    low, high = box[:2], box[2:]
    if holes:
        view.linear(low, shapes.ORIGIN, 0.0, "", f"from the left edge to {axis_name}")
        view.linear(low, shapes.ORIGIN, up, "", f"from the lower edge to {axis_name}")
    view.linear(low, (high[0], low[1]), 0.0, "", "wide")
    view.linear(low, (low[0], high[1]), up, "", "high")
    texts_of = {hole: view.fits.bore(hole.radius) for hole in holes}
    texts_of |= screws
    for text, some in grouped((texts_of[hole], hole) for hole in holes):
        places = ", ".join(f"({length(x)}, {length(y)})" for _, (x, y), _ in some)
        view.diameter(some, text, f"at {places} from {axis_name}")
    assert isinstance(plate.outline, shapes.Contour)
    view.radii(plate.outline.segments)
    return view


def draw_hub(view: View, hub: Plate) -> None:
    """Draw the diameter of a hub that is already drawn."""
    assert isinstance(hub.outline, shapes.Circle)
    view.diameter([hub.outline], f"{hub.name} {sized.plain(2.0 * hub.outline.radius, 'Ø ')}")


def draw_shaft(view: View, shaft: Plate) -> View:
    """Draw a shaft from the side; a hexagon has no fit, as its corners are free."""
    long, bore = shaft.thickness, shaft.bore
    radius = bore.around
    view.draw(OUTLINE, rectangle("", 0.0, -radius, long, radius))
    view.centre_line((0.0, 0.0), (long, 0.0))
    view.linear((0.0, -radius), (long, -radius), 0.0)
    has_corners = bore.form == "hex"
    size = sized.plain(2.0 * radius, "Ø ") if has_corners else view.fits.shaft(radius)
    view.linear((0.0, -radius), (0.0, radius), 0.5 * math.pi, size)
    if note := bore.shaft_note:
        view.notes.append(note if view.fits.turned.is_iso else note.replace(" P9", ""))
    return view


def bored(view: View, holes: Sequence[shapes.Shape], part: str, radius: float) -> None:
    """Draw the first of a part's holes, its bore for a shaft; a note has the angle of its shape."""
    if not radius:
        return
    shape, form = holes[0], bore_of(view.fits.spec.size, part, radius)
    if form.form != "hex":
        cut = form.radius + form.loose
        view.diameter([shapes.Circle("", shapes.ORIGIN, cut)], view.fits.bore(cut))
    if isinstance(shape, shapes.Contour):
        x, y = shapes.at(shape.segments[0], 0.5)
        note = form.note if view.fits.is_iso else form.note.replace(" JS9", "")
        view.note((x, y), note)
        turn, what = math.degrees(math.atan2(y, x)), note.split()[0].rstrip(",")
        view.notes.append(f"{what} at {length(turn, 2)}°, counterclockwise from the right")


def circle_of(view: View, screwed: Sequence[shapes.Circle]) -> None:
    """Draw the circles that bolts lie on, as centre lines."""
    for far in {round(math.hypot(*c.centre), 6) for c in screwed}:
        view.draw(CENTRE, shapes.Circle("", (0.0, 0.0), far))


def bolted(view: View, screwed: Sequence[shapes.Circle], tapped: bool = False) -> None:
    """Draw the diameters of the bolts' holes and of their circle."""
    if not screwed:
        return
    far = math.hypot(*screwed[0].centre)
    hole = sized.screw_hole(screwed[0].radius, tapped)
    view.diameter(screwed, times(len(screwed), f"{hole} on Ø {length(2.0 * far)}"))
    angles = [math.degrees(math.atan2(c.centre[1], c.centre[0])) for c in screwed]
    view.notes.append("holes at " + ", ".join(f"{length(angle, 2)}°" for angle in angles))

"""The drawings of parts to cut, and of the whole machine."""

import math
from collections.abc import Iterator
from functools import partial
from itertools import pairwise

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import shapes as forms
from geneva_cli.geometry.plates import Group, Member, in_place
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Segment
from geneva_cli.geometry.sheet import Annotations, Drawing, LevelDistance
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.pivots import Joint
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.links.links import places
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.parts import EdgedParts
from geneva_cli.parts.projection import drawing_of, once, outlines_of, shapes, titled, with_frame
from geneva_cli.parts.shafts.arm_and_shafts import crank_arm
from geneva_cli.parts.slots.roller_paths import roller_paths

BEYOND = 0.04  # of the centre distance: from a part to the arrow that shows how it turns


def wheel(parts: EdgedParts) -> Drawing:
    """Return the wheel or rack; x is along the first slot."""
    return drawing_of(parts.mechanism, parts.mechanism.output.noun, parts.wheel.part)


def crank(parts: EdgedParts) -> Drawing:
    """Return the crank in the wheel's plane; its axis is the origin, x is to the first roller."""
    return drawing_of(parts.mechanism, "crank", parts.crank_with(arm=False).part)


def arm(parts: FlatParts) -> Drawing:
    """Return the crank arm below the wheel's plane: outline, bore, holes for pins and bolts."""
    solid = parts.arm_plate
    if solid is None:
        crank_arm(parts.outlines)  # whose error says why there is none
    assert solid is not None
    return drawing_of(parts.mechanism, "arm", solid)


def slot(parts: FlatParts) -> Drawing:
    """Return the first slot, closed along the rim, and the roller's path in it."""
    assembly = parts.outlines.assembly
    engagement = assembly.slots[0][0]
    walls = parts.walls(engagement)
    start, end = walls.segments[0].start, walls.segments[-1].end
    back = math.atan2(start[1], start[0]) - math.atan2(end[1], end[0])
    level = abs(math.hypot(*start) - math.hypot(*end)) < 1e-9 * assembly.L
    rim: Segment = Arc(end, start, math.tan(0.25 * back)) if level else Line(end, start)
    outline = forms.closed("WHEEL", [*walls.segments, rim])
    return Drawing(titled(parts.mechanism, "slot"), (outline, *pitch_lines(parts, engagement)))


def groove(parts: FlatParts) -> Drawing:
    """Return both flanks of a cam-Geneva's fixed groove all round, about the crank's axis."""
    return Drawing(titled(parts.mechanism, "groove"), parts.groove)


def links(parts: FlatParts) -> Drawing:
    """Return every link and sliding block once, one above the other, each in its own frame."""
    mechanism, bars = parts.mechanism, parts.links
    if not bars.cut:
        kind = f'kind = "{mechanism.spec.drive.NAME}"'
        raise GenevaError(f"--part links: {kind} has no links: --part parts lists what it has")
    members, top = [], 0.0
    for plate in dict.fromkeys(bars.plates):
        box = forms.bounds(plate.outline)
        # moved itself, so that the kerf finds its outlines in the drawing
        ((_, moved),) = in_place([Member(plate, (0.0, top - box.y0))])
        members.append(Member(moved))
        # links side by side are 0.05 of the centre distance apart
        top += box.y1 - box.y0 + 0.05 * mechanism.center_distance_mm
    title = titled(mechanism, "links")
    return Drawing(title, tuple(shapes(members)), solid=Group(title, tuple(members)))


def frame(parts: EdgedParts) -> Drawing:
    """Return the frame as it is drilled."""
    return drawing_of(parts.mechanism, "frame", parts.frame.part)


def gears(parts: FlatParts) -> Drawing:
    """Return all gears with bores and bolts, and the line of centres."""
    from geneva_cli.parts.gears.gear_pair import FINE, required_gears

    mechanism, name = parts.mechanism, "gears"
    if mechanism.spec.gears or not mechanism.spec.drive.round_gears:
        pair = required_gears(mechanism)
        name = "pitch curves of the gears"
        fine = FINE[parts.curves] * pair.distance_mm
        parts = parts.within(min(parts.tolerance or fine, fine), parts.curves)
    L = mechanism.center_distance_mm
    members = (*parts.round_gears, *parts.gear_pair)
    about_crank = [one._replace(at=(one.at[0] - L, one.at[1])) for one in members]
    title, ends = titled(mechanism, name), [one.at for one in about_crank]
    line = Contour("PITCH", (Line(min(ends), max(ends)),), closed=False)
    drawn = tuple(once(shapes(about_crank)))
    return Drawing(title, (*drawn, line), solid=Group(title, members))


def groove_plate(parts: FlatParts) -> Drawing:
    """Return outline, both flanks, bore and holes of the groove's plate."""
    *_, pitch = parts.groove
    title = titled(parts.mechanism, "groove plate")
    stack = Group(title, tuple(Member(one.part) for one in parts.groove_plate))
    return Drawing(title, (*outlines_of(stack), pitch), solid=stack)


def pitch_lines(parts: FlatParts, engagement: Engagement) -> list[Contour]:
    """Return the slot's pitch curve; of a pair of slots, both."""
    assembly, apart, through = parts.outlines.assembly, engagement.apart, engagement.through
    x, y = through.slot(np.array([through.entry_deg, 0.0]), 0)
    if not through.slot.curved:
        mouth, end = (assembly.L * np.column_stack((x.c[0], y.c[0] + 0.0 * x.c[0]))).tolist()
        line = Contour("PITCH", (Line(tuple(mouth), tuple(end)),), closed=False)
    else:
        from geneva_cli.parts.outlines.path_walls import parallel

        write, pieces = parts.writer(1e-3), list[Segment]()  # mm, as a drawing's
        for a, b in ((through.entry_deg, 0.0), (0.0, through.exit_deg)):
            pieces += write(partial(parallel, assembly.L, through, 0.0, b > 0.0), a, b)
        line = Contour("PITCH", forms.joined(pieces), closed=False)
    return [forms.placed(line, turn=turn) for turn in ((-apart, apart) if apart else (0.0,))]


def assembly(parts: FlatParts) -> Drawing:
    """Return the machine at input angle 0, from the frame up to the wheel."""
    assembly, title = parts.outlines.assembly, titled(parts.mechanism)
    drawn = list(shapes((parts.wheel, *parts.orbiting)))
    for one in parts.about_wheel(parts.crank_with(arm=False)):
        drawn += shapes([one])
        if parts.arm:
            drawn.append(forms.placed(parts.arm.outline, one.at, one.turn))
            if parts.arm.bore not in outlines_of(one.part):
                drawn.append(forms.placed(parts.arm.bore._replace(layer="ARM"), one.at, one.turn))
    # the links, and the round gears by their pitch circles, with all holes
    drawn += [shape._replace(layer="LINK") for shape in shapes(parts.links.cut)]
    blanks = list(shapes(parts.round_gears))
    drawn += [shape for shape in blanks if shape.layer == "PITCH"]
    drawn += [shape._replace(layer="LINK") for shape in blanks if shape.layer != "PITCH"]
    drawn += outlines_of(Group("", parts.gear_pair))
    drawn += shapes(parts.first)
    drawn = [*with_frame(drawn, parts.standing)]
    # the line of centres, and the rollers' paths on their circles and in their slots
    axes = [place.at for place in assembly.full.crank_places]
    drawn += [Contour("PITCH", (Line((0.0, 0.0), axis),), closed=False) for axis in axes]
    radii = set()
    for number, (engagement, behind) in enumerate(assembly.rollers):
        if not engagement.crank_sense and engagement.groove is None:
            x, y = assembly.pin(number, np.array([behind]))[0]
            radii.add(round(math.hypot(x - assembly.L, y), 9))
    drawn += [Circle("PITCH", axis, radius) for axis in axes for radius in sorted(radii)]
    pitches = {one: pitch_lines(parts, one) for one in assembly.kinds}
    for engagement, direction in assembly.slots:
        drawn += [
            forms.placed(line, turn=direction + parts.wheel.turn) for line in pitches[engagement]
        ]
    distance = LevelDistance((0.0, 0.0), (assembly.L, 0.0), "L")
    look = Annotations((distance,), tuple(_turns(parts.outlines)))
    return Drawing(title, tuple(once(drawn)), look, Group(title, parts.members))


def _turns(parts: Outlines) -> Iterator[Arc]:
    """Yield the senses of rotation of wheel and crank, as arcs outside of them."""
    assembly, sizes, mechanism = parts.assembly, parts.sizes, parts.assembly.full
    reach = max(math.hypot(*s.start) for s in parts.wheel.segments)
    beyond = (sizes.outer or reach) + BEYOND * assembly.L
    half, free = math.radians(25.0), math.radians(140.0)
    turns = sorted(place.turn for place in mechanism.crank_places)
    if len(turns) > 1:  # between the cranks that are farthest apart
        before, after = max(pairwise([*turns, math.tau]), key=lambda ends: ends[1] - ends[0])
        free = 0.5 * (before + after)
    yield forms.about((0.0, 0.0), beyond, free - half, 2.0 * half)
    if mechanism.frame:  # the finger stands, and the carrier turns
        sense = mechanism.frame
        yield forms.about((assembly.L, 0.0), assembly.L + beyond, -sense * 0.5, sense)
        return
    sense, L = -assembly.sign, assembly.L  # the wheel turns counterclockwise
    if not mechanism.spec.drive.ONE_ARM:  # beyond the link on the crank's shaft, or the disc
        sense, links = mechanism.own_shaft.sense, links_at(mechanism, np.zeros(1))
        own = [np.array(places(one)) - L for one in links if one.kinds[0] is Joint.SHAFT]
        reaches = [float(np.abs(ends).max()) for ends in own if abs(ends[0]) < SAME_LENGTH * L]
        radius = max(sizes.lock, *reaches) + 2.0 * BEYOND * L
    elif assembly.sign > 0.0:
        radius = max(roller_paths(assembly)[2]) + 2.0 * sizes.roller + BEYOND * L
    else:  # an internal wheel's crank turns within the wheel: near its shaft
        radius = 0.5 * sizes.arm
    for place in mechanism.crank_places:
        yield forms.about(place.at, radius, place.turn - sense * 0.5, sense)

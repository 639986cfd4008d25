"""The scene of a design: bodies, links, forces and states over one turn."""

import math
from collections.abc import Iterator
from contextlib import suppress

import numpy as np

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Shape, as_contour, bounds, placed, polygon
from geneva_cli.geometry.sheet import line
from geneva_cli.motion.drive import Gears
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.pivots import Joint
from geneva_cli.motion.registry import thing
from geneva_cli.output import scene as page
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.gears.gear_pair import gears_table
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.animation.animated_turn import STILL, MachineTurn, pushes
from geneva_cli.study.summary.load_lines import title_of
from geneva_cli.verdict.report import words


def scene(design: Design) -> page.Scene:
    """The machine over a whole turn of its crank, with curves, forces and the wheel's states."""
    mechanism = design.mechanism
    turn = MachineTurn(mechanism)
    parts = tuple(body for body in _bodies(design, turn) if body.shapes)
    outlines = None
    with suppress(GenevaError):  # no flat parts
        outlines = design.parts.outlines
    bars, rollers = tuple(_bars(turn, outlines)), turn.rollers()
    spec, title = design.spec, title_of(design)
    wheels = wheels_of(spec)
    loads = ("pin_force_N", "input_torque_Nm") if design.cycle.is_loaded else ()
    turning = tuple(body for body in parts if not body.travel)
    box = _box(turning, bars, rollers, mechanism.roller_radius_mm, turn.turn_deg)
    frame = None
    if mechanism.frame:  # the carrier makes whole turns
        x, y = centre = mechanism.center_distance_mm, 0.0
        frame = page.Body("frame", (), centre, turn.steady(mechanism.frame, 0.0))
        reach = max(math.dist(b.centre, centre) + _reach(b.shapes) for b in parts)
        box = x - reach, y - reach, x + reach, y + reach
    pauses = []
    if spec.drive.stop_s:  # in the middle of each dwell, also of one without length
        entries = [*(one.entry for one in turn.passages[1:]), turn.end]
        dwells = zip(turn.passages, entries, strict=True)
        pauses = [0.5 * (one.exit + after) - turn.start for one, after in dwells]
    return page.Scene(
        title=title,
        caption=words(mechanism) + _remark(design),
        spec="\n".join((f"title = {quoted(title)}", *spec_lines(spec))),
        start_deg=mechanism.shown_deg(turn.start),
        turn_deg=turn.turn_deg,
        seconds=turn.turn_deg / (6.0 * spec.drive.n_rpm),
        bodies=parts,
        bars=bars,
        rollers=rollers,
        roller_radius=mechanism.roller_radius_mm,
        pushes=tuple(pushes(design.cycle, turn)),
        states=tuple(_states(design, turn)),
        figure=design.figure(("velocity", "acceleration", *loads)),
        box=wheels.view(parts[0], box, turn),
        stops=wheels.stops(outlines, turn),
        pauses=tuple(pauses),
        stop_s=spec.drive.stop_s,
        frame=frame,
    )


def _bars(turn: MachineTurn, outlines: Outlines | None) -> Iterator[page.Bar]:
    """The links, with their plates if the links' sizes allow any."""
    plates = list[Plate]()
    with suppress(GenevaError):
        members = drawn_links(turn.mechanism, outlines).cut
        plates = [member.part for member in members if isinstance(member.part, Plate)]
    for i, link in enumerate(links_at(turn.mechanism, np.zeros(1))):
        own = [(0, plate) for plate in plates if plate.name == link.name]
        slid = (j for j, kind in enumerate(link.kinds) if kind in (Joint.SLIDE, Joint.CARRIED))
        blocks = (plate for plate in plates if plate.name == f"{link.name}'s block")
        own += zip(slid, blocks, strict=False)
        carried = (page.CarriedShapes(j, (plate.outline, *plate.holes)) for j, plate in own)
        joints = (turn.joint(i, j) for j in range(len(link.joints)))
        yield page.Bar(link.name, tuple(joints), link.radius_mm, tuple(carried))


def _bodies(design: Design, turn: MachineTurn) -> Iterator[page.Body]:
    """Wheel, crank with its arm, the cam's groove and gears, as far as the machine has them."""
    L = turn.L
    # parts of a sphere are drawn laid flat: these outlines do not turn about the shaft
    shapes = _shapes(design, "wheel") if turn.mechanism.axes else ()
    if rims := tuple(s for s in shapes if isinstance(s, Circle) and s.layer == "WHEEL"):
        # an internal wheel: its rim first, then what is cut out of the plate
        cuts = (s for s in shapes if s not in rims)
        hollow = (s._replace(layer="HOLLOW") if s.layer == "WHEEL" else s for s in cuts)
        shapes = (*rims, *hollow)
    yield from wheels_of(design.spec).bodies(shapes, turn)
    if shapes:
        carried = (*_shapes(design, "arm"), *_shapes(design, "crank"))
        carried = tuple(shape for shape in carried if shape.layer != "ROLLER")
        for place in turn.mechanism.crank_places:
            name = f"crank-{place.number}" if place.number > 1 else "crank"
            yield page.Body(name, carried, place.at, turn.crank(place))
        yield page.Body("groove", _shapes(design, "groove"), (L, 0.0), STILL)
        if turn.mechanism.frame > 0.0:
            yield page.Body("carrier", _shapes(design, "frame"), (0.0, 0.0), STILL)
    if design.spec.gears:
        yield from _gears(design.spec.gears, turn)


def _gears(gears: Gears, turn: MachineTurn) -> Iterator[page.Body]:
    """Gears that are not round, by their pitch curves."""
    machine = turn.mechanism
    x, sense = machine.gear_shaft
    before = machine.spec.drive_before
    first = before is not None and before.gears is not None  # they turn the shaft of the drive
    table = gears_table(machine, 0.001, 241).to_dict()

    def curve(name: str) -> tuple[Shape, ...]:  # the table turns as an external wheel does
        u, v = -table[f"{name}_x_mm"][:-1], sense * table[f"{name}_y_mm"][:-1]
        return (polygon("GEAR", list(zip(u.tolist(), v.tolist(), strict=True))),)

    is_input = first or before is None
    driver = turn.steady(-sense, turn.passages[0].mid) if is_input else turn.own_shaft(-sense)
    yield page.Body("driver-gear", curve("driver"), (x + gears.distance_mm, 0.0), driver)
    driven = turn.own_shaft(sense) if first else turn.crank(turn.on_crank(0), turn.ahead)
    yield page.Body("driven-gear", curve("driven"), (x, 0.0), driven)


def _shapes(design: Design, part: str) -> tuple[Shape, ...]:
    """The shapes of a part in its own frame; none if the machine lacks it."""
    with suppress(GenevaError):
        return design.drawing(part).shapes
    return ()


def _remark(design: Design) -> str:
    stop_s, out = design.spec.drive.stop_s, ""
    if stop_s:
        out = f" The input stands still for {stop_s:g} s in the middle of each dwell."
    if not design.mechanism.axes:
        return f"{out} Seen along the wheel's shaft."
    if design.cycle.mechanism.period_deg > 360.0 * design.spec.turns:
        out += (
            " The forces are those of the first turn. A body off the wheel's axis makes them "
            "different in each turn."
        )
    return out


def _states(design: Design, turn: MachineTurn) -> Iterator[page.Phase]:
    holder = design.spec.dwell_holder  # what holds the wheel at rest
    rest = f"the {design.spec.output.noun} rests"
    if design.spec.wheel.held_by:
        rest += f", held by a {design.spec.wheel.held_by}"
    else:
        rest += f", locked by the {holder.split()[-1]}" if holder else "; nothing holds it"
    moves, wheels = list[page.Phase](), design.mechanism.wheel_places
    for i, one in enumerate(turn.passages):
        which = f"roller {i + 1}" if len(turn.passages) > 1 else "the roller"
        if len(design.mechanism.crank_places) > 1:
            which = f"crank {turn.on_crank(i).number}"
        if one.engagement.paired:
            which = "a roller, then gears, then a roller"
        text = f"{which} moves the {design.mechanism.output.noun}"
        moves.append(page.Phase(one.entry - turn.start, one.exit - turn.start, True, text))
    if len(wheels) > 1:
        rest, (first, *_) = "all wheels rest on the carrier", moves
        moves = []
        for place in wheels:
            text = f"the finger turns wheel {place.number} on the carrier"
            a = place.behind_deg
            moves.append(page.Phase(a, a + first.end, True, text))
    ends = [*(one.start for one in moves[1:]), turn.turn_deg]
    for move, end in zip(moves, ends, strict=True):
        yield move
        if end > move.end + 1e-9:
            yield page.Phase(move.end, end, False, rest)


def _box(
    parts: tuple[page.Body, ...],
    bars: tuple[page.Bar, ...],
    rollers: tuple[page.Place, ...],
    radius: float,
    turn_deg: float,
) -> page.Box:
    """The bounding box of bodies at any angle, and of joints, rollers and links in the turn."""
    circles = [(*body.centre, _reach(body.shapes)) for body in parts]
    places = [(place, bar.radius) for bar in bars for place in bar.joints]
    places += [(place, radius) for place in rollers]
    plates = [(bar, plate) for bar in bars for plate in bar.plates]
    for t in np.arange(0.0, turn_deg, 2.0).tolist():
        circles += [(page.value_at(x, t), page.value_at(y, t), r) for (x, y), r in places]
        for bar, plate in plates:
            x, y, angle = page.pose(bar, plate, t)
            own = bounds(placed(plate.shapes[0], (x, y), angle))
            circles += [(own.x0, own.y0, 0.0), (own.x1, own.y1, 0.0)]
    x, y, r = np.array(circles).T
    return min(x - r), min(y - r), max(x + r), max(y + r)


def _reach(shapes: tuple[Shape, ...]) -> float:
    """The greatest distance of shapes from their own origin."""
    return float(Polyarc(map(as_contour, shapes)).farthest(np.zeros((1, 2))).max())


class WheelScene:
    """What a page shows of wheels that turn without end."""

    def bodies(self, shapes: tuple[Shape, ...], turn: MachineTurn) -> Iterator[page.Body]:
        """All wheels; without shapes, as symbols."""
        one, z = turn.passages[0], turn.mechanism.spec.wheel.z
        # distances of the first roller from the wheel's axis in its slot
        pins = turn.assembly.pin(0, np.linspace(one.entry, one.exit, 181), drives=True)
        reach = np.hypot(*pins.T)
        least, most = float(reach.min()), float(reach.max())
        if not shapes:  # a disc with a line along each slot
            one_slot = line("WHEEL", (least, 0.0), (most, 0.0))
            lines = (placed(one_slot, turn=math.tau * k / z) for k in range(z))
            shapes, dot = (Circle("WHEEL", ORIGIN, 1.02 * most), *lines), 1.01 * least
        else:
            dot = 0.78 * least
        # a dot behind the end of the first slot tells the slots apart
        wheel = (*shapes, Circle("PITCH", (dot, 0.0), 0.012 * turn.L))
        for place in turn.mechanism.wheel_places:
            name = f"wheel-{place.number}" if place.number > 1 else "wheel"
            yield page.Body(name, wheel, place.at, turn.wheel(place))

    def view(self, wheel: page.Body, box: page.Box, turn: MachineTurn) -> page.Box:
        """The box that a page shows; ``box`` bounds all that turns."""
        return box

    def stops(self, outlines: Outlines | None, turn: MachineTurn) -> tuple[float, float] | None:
        """Input angles, degrees from the start, between which the machine moves; None for all."""
        return None


def wheels_of(spec: Spec) -> WheelScene:
    """What a page shows of a machine's wheels."""
    wheels: WheelScene = (thing(spec.wheel.NAME, "scene") or WheelScene)()
    return wheels

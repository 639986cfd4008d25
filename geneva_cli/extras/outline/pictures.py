"""Pictures of drawn outlines: turning on a page with their contact, and over the computed ones."""

import math
from collections.abc import Iterable, Iterator

import numpy as np

from geneva_cli.design import Design
from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.machine import drawn_machine
from geneva_cli.extras.outline.real_motion import at_crank, inside, motion, steady_turn
from geneva_cli.extras.outline.turning import moving, turned
from geneva_cli.figure import Curve
from geneva_cli.geometry.shapes import Contour, Layer, placed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import first_entry_deg
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.scene import Phase, Push, Scene, Track
from geneva_cli.study.animation.turning_scene import scene

SAMPLES = 721  # of a curve
TOUCHES = 1e-12  # N: the size of a contact whose force is not known
PLACES = 49  # of a contact in a push
DRAWN: Layer = "OUTLINE"


def drawn_scene(design: Design) -> Scene:
    """The scene of a design with its drawings in place of the computed outlines."""
    result, shown = turned(design.mechanism), scene(design)
    turn, machine = steady_turn(result), result.machine
    start = first_entry_deg(design.mechanism)
    entry = math.radians(machine.assembly.motions[0].entry)

    def time(crank: float) -> float:
        """Input degrees from the start; angles before the first entry come a turn later."""
        late = 360.0 if crank < entry - 1e-9 else 0.0
        return max(0.0, machine.assembly.to_input(math.degrees(crank) + late) - start)

    # the wheel's angle over the turn, from the first entry on
    after = turn.crank >= entry - 1e-9
    order = np.concatenate((np.flatnonzero(after), np.flatnonzero(~after)))
    angle = (turn.wheel + np.where(after, 0.0, turn.gained))[order]
    track = _track(np.array([time(x) for x in turn.crank[order].tolist()]), angle, turn.gained)
    # the contact points of each push, with the direction in which the wheel's point goes
    pushes, stretches = [], []
    for push in moving(turn):
        crank = np.linspace(push.begin + 1e-9, push.end - 1e-6, PLACES)
        wheel, _ = at_crank(result, turn, crank)
        found = contacts(machine.free, crank, wheel)
        known = np.flatnonzero(found.is_known)
        z = (found.point[:, 0] + 1j * found.point[:, 1]) * np.exp(1j * wheel)
        way = 1j * z / np.abs(z) * TOUCHES
        places = tuple(time(x) for x in crank[known].tolist())
        columns = (z.real, z.imag, way.real, way.imag)
        pushes.append(Push(places, *(tuple(each[known].tolist()) for each in columns)))
        stretches.append((time(push.begin), time(push.end)))
    # the real velocity in place of all ideal curves, with both ends of each push
    figure = shown.figure
    panel = next(panel for panel in figure.panels if panel.y.name == "velocity")
    ends = [time(x) for push in turn.pushes for x in inside(push)]
    ends = [x for end in ends for x in (end - 1e-4, end, end + 1e-4)]
    even = np.linspace(*figure.window, SAMPLES)
    x = np.unique(np.clip(np.append(even, start + np.array(ends)), *figure.window)).tolist()
    y = np.asarray(motion(design.mechanism, 2, x)["velocity"]).tolist()
    curve = Curve(panel.curves[0].number, panel.curves[0].name, ((x, y),))
    own, other, *_ = shown.bodies
    bodies = (
        own._replace(shapes=_layered(machine.wheel, "WHEEL"), angle=track),
        other._replace(shapes=_layered(machine.crank, "CRANK")),
    )
    return shown._replace(
        caption=f"{shown.caption} Wheel and crank as drawn, moved by what touches.",
        bodies=bodies,
        rollers=(),
        pushes=tuple(pushes),
        states=tuple(_states(stretches, shown.turn_deg)),
        figure=figure._replace(panels=(panel._replace(curves=(curve,)),), shaded=()),
    )


def _track(at: Array, angle: Array, gained: float) -> Track:
    """The wheel's angle at times, and on a line between each two."""
    keep = np.append(np.diff(at) > 1e-6, True)
    at, angle = at[keep], angle[keep]
    lines = np.column_stack((angle[:-1] + angle[1:], np.diff(angle))) / 2.0
    return Track(tuple(at.tolist()), tuple(map(tuple, lines.tolist())), gained)


def _states(pushed: Iterable[tuple[float, float]], whole: float) -> Iterator[Phase]:
    """The stretches of a turn in which the wheel rests or is pushed."""
    last = 0.0
    for begin, end in sorted(pushed):
        if begin > end:  # it goes on beyond the end of the turn
            end = whole
        if begin > last + 1e-9:
            yield Phase(last, begin, False, "the wheel rests")
        yield Phase(max(begin, last), end, True, "the crank pushes the wheel")
        last = end
    if last < whole - 1e-9:
        yield Phase(last, whole, False, "the wheel rests")


def _layered(contours: tuple[Contour, ...], layer: Layer) -> tuple[Contour, ...]:
    return tuple(contour._replace(layer=layer) for contour in contours)


def over(mechanism: Mechanism, drawing: Drawing) -> Drawing:
    """A drawing of our own part with that of somebody else over it, on layer OUTLINE."""
    machine, outline = drawn_machine(mechanism), mechanism.spec.outline
    shapes: list[Contour] = []
    has_wheel, has_crank = (layer in drawing.layers for layer in ("WHEEL", "CRANK"))
    if outline.wheel is not None and has_wheel:
        shapes += machine.wheel
    if outline.crank is not None and has_crank:
        turn = float(machine.free.crank_direction(np.zeros(1))[0])
        at, turn = ((machine.assembly.L, 0.0), turn) if has_wheel else ((0.0, 0.0), 0.0)
        shapes += [placed(shape, at, turn) for shape in machine.crank]
    added = _layered(tuple(shapes), DRAWN)
    return drawing._replace(shapes=(*drawing.shapes, *added), solid=None, look=None)

"""Pictures of drawn outlines: turning on a page with their contact, and over the computed ones."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geneva_cli.design import Design
from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.machine import drawn_machine
from geneva_cli.extras.outline.real_motion import at_crank, inside, motion, steady_turn
from geneva_cli.extras.outline.turning import Turned, moving, turned
from geneva_cli.figure import Curve, Figure
from geneva_cli.geometry.plates import placed
from geneva_cli.geometry.shapes import Contour, Layer, Shape
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import first_entry_deg
from geneva_cli.output.scene import Phase, Push, Scene, Track
from geneva_cli.parts.turn.lazy_turn import LazyTurn
from geneva_cli.study.animation.turning_scene import scene

SAMPLES = 721  # of a curve
TOUCHES = 1e-12  # N: the size of a contact whose force is not known
PLACES = 49  # of a contact in a push
DRAWN: Layer = "OUTLINE"


def drawn_scene(design: Design) -> Scene:
    """Return the scene of a design with its drawings in place of the computed outlines.

    Raises GenevaError if the wheel jams.
    """
    result = turned(design.mechanism)
    turn, machine, shown = steady_turn(result), result.machine, scene(design)
    wheel, crank, *_ = shown.bodies
    time = _Time(design.mechanism, result, turn)
    bodies = (
        wheel._replace(shapes=_layered(machine.wheel, "WHEEL"), angle=time.track()),
        crank._replace(shapes=_layered(machine.crank, "CRANK")),
    )
    return shown._replace(
        caption=f"{shown.caption} Wheel and crank as drawn, moved by what touches.",
        bodies=bodies,
        rollers=(),
        pushes=tuple(_contacts(result, turn, time)),
        states=tuple(_states(turn, time, shown.turn_deg)),
        figure=_figure(shown.figure, design.mechanism, time),
    )


class _Time:
    """The times of a scene, input degrees from its start, at crank angles of a turn."""

    def __init__(self, mechanism: Mechanism, result: Turned, turn: LazyTurn) -> None:
        self.to_input, self.turn = result.machine.assembly.to_input, turn
        self.start = first_entry_deg(mechanism)
        self.entry = math.radians(result.machine.assembly.motions[0].entry)

    def at(self, crank: float) -> float:
        """The time at a crank angle, radians; angles before the first entry come a turn later."""
        late = 360.0 if crank < self.entry - 1e-9 else 0.0
        return max(0.0, self.to_input(math.degrees(crank) + late) - self.start)

    def track(self) -> Track:
        """The wheel's angle over the turn."""
        turn = self.turn
        after = turn.crank >= self.entry - 1e-9
        order = np.concatenate((np.flatnonzero(after), np.flatnonzero(~after)))
        value = (turn.wheel + np.where(after, 0.0, turn.gained))[order]
        at = np.array([self.at(float(x)) for x in turn.crank[order]])
        keep = np.append(np.diff(at) > 1e-6, True)
        at, value = at[keep], value[keep]
        rate = np.diff(value) / np.diff(at)
        # slopes between those on both sides, so that no cubic overshoots
        pairs = rate[:-1] * rate[1:]
        mean = 2.0 * pairs / np.where(pairs > 0.0, rate[:-1] + rate[1:], 1.0)
        slope = np.concatenate((rate[:1], np.where(pairs > 0.0, mean, 0.0), rate[-1:]))
        knots, values, slopes = (tuple(each.tolist()) for each in (at, value, slope))
        return Track(knots, values, slopes, turn.gained)


def _layered(contours: tuple[Contour, ...], layer: Layer) -> tuple[Shape, ...]:
    return tuple(contour._replace(layer=layer) for contour in contours)


def _contacts(result: Turned, turn: LazyTurn, time: _Time) -> Iterator[Push]:
    """Yield the contact points of each push, with the direction in which the wheel's point goes."""
    for push in moving(turn):
        crank = np.linspace(push.begin + 1e-9, push.end - 1e-6, PLACES)
        wheel, _ = at_crank(result, turn, crank)
        found = contacts(result.machine.free, crank, wheel)
        known = np.flatnonzero(found.is_known)
        z = (found.point[:, 0] + 1j * found.point[:, 1]) * np.exp(1j * wheel)
        way = 1j * z / np.abs(z) * TOUCHES
        at = [time.at(float(x)) for x in crank[known]]
        columns = (z.real, z.imag, way.real, way.imag)
        yield Push(tuple(at), *(tuple(each[known].tolist()) for each in columns))


def _states(turn: LazyTurn, time: _Time, whole: float) -> Iterator[Phase]:
    """Yield the stretches of a turn in which the wheel rests or is pushed."""
    stretches = sorted((time.at(p.begin), time.at(p.end)) for p in moving(turn))
    last = 0.0
    for begin, end in stretches:
        if begin > end:  # it goes on beyond the end of the turn
            end = whole
        if begin > last + 1e-9:
            yield Phase(last, begin, False, "the wheel rests")
        yield Phase(max(begin, last), end, True, "the crank pushes the wheel")
        last = end
    if last < whole - 1e-9:
        yield Phase(last, whole, False, "the wheel rests")


def _figure(figure: Figure, mechanism: Mechanism, time: _Time) -> Figure:
    """The real velocity in place of all ideal curves, with both ends of each push."""
    panel = next(panel for panel in figure.panels if panel.y.name == "velocity")
    ends = [time.at(x) for push in time.turn.pushes for x in inside(push)]
    ends = [x for end in ends for x in (end - 1e-4, end, end + 1e-4)]
    even = np.linspace(*figure.window, SAMPLES)
    x = np.unique(np.clip(np.append(even, time.start + np.array(ends)), *figure.window))
    rows = motion(mechanism, 2, x.tolist())
    y = np.asarray(rows.columns[rows.names.index("velocity")])
    curve = Curve(panel.curves[0].number, panel.curves[0].name, ((x.tolist(), y.tolist()),))
    return figure._replace(panels=(panel._replace(curves=(curve,)),), shaded=())


def over(mechanism: Mechanism, drawing: Drawing) -> Drawing:
    """Return a drawing of our own part with that of somebody else over it, on layer OUTLINE.

    Drawings of other parts than wheel, crank and assembly are returned as they are.
    """
    machine = drawn_machine(mechanism)
    outline, place = mechanism.spec.outline, machine.assembly
    shapes: list[Contour] = []
    has_wheel, has_crank = (layer in drawing.layers for layer in ("WHEEL", "CRANK"))
    if outline.wheel is not None and has_wheel:
        shapes += machine.wheel
    if outline.crank is not None and has_crank:
        turn = float(machine.free.crank_direction(np.zeros(1))[0])
        at, turn = ((place.L, 0.0), turn) if has_wheel else ((0.0, 0.0), 0.0)
        shapes += [placed(shape, at, turn) for shape in machine.crank]
    added = tuple(shape._replace(layer=DRAWN) for shape in shapes)
    return drawing._replace(shapes=(*drawing.shapes, *added), solid=None, look=None)

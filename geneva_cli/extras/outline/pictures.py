"""Pictures of drawn outlines: turning on a page with their contact, and over the computed ones."""

import math
from collections.abc import Iterable, Iterator
from itertools import chain, pairwise

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

    # the contact points of each push, with the direction in which the wheel's point goes
    pushes, stretches = [], []
    for push in moving(turn):
        crank = np.linspace(push.begin + 1e-9, push.end - 1e-6, PLACES)
        wheel, _ = at_crank(result, turn, crank)
        found = contacts(machine.free, crank, wheel)
        z = (found.point @ (1.0, 1j) * np.exp(1j * wheel))[found.is_known]
        way = 1j * z / np.abs(z) * TOUCHES
        places = tuple(time(x) for x in crank[found.is_known].tolist())
        pushes.append(
            Push(places, *map(tuple, np.array((z.real, z.imag, way.real, way.imag)).tolist()))
        )
        begin, end = time(push.begin), time(push.end)
        # it may go on beyond the end of the turn
        stretches.append((begin, end if begin < end else shown.turn_deg))
    # the real velocity in place of all ideal curves, with both ends of each push
    figure = shown.figure
    panel = next(panel for panel in figure.panels if panel.y.name == "velocity")
    at = [start + time(x) for push in turn.pushes for x in inside(push)]
    at = [x for end in at for x in (end - 1e-4, end, end + 1e-4)]
    even = np.linspace(*figure.window, SAMPLES)
    x = np.unique(np.clip(np.append(even, at), *figure.window)).tolist()
    real = motion(design.mechanism, 2, x)
    angle, rate = (np.asarray(real[name]) for name in ("wheel_deg", "velocity"))
    curve = Curve(panel.curves[0].number, panel.curves[0].name, ((x, rate.tolist()),))
    turns = np.radians(angle)
    lines = np.column_stack((turns[:-1] + turns[1:], np.diff(turns))) / 2.0
    ends = tuple(at - start for at in x)
    track = Track(ends, tuple(map(tuple, lines.tolist())), turn.gained)
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


def _states(pushed: Iterable[tuple[float, float]], whole: float) -> Iterator[Phase]:
    """The stretches of a turn in which the wheel rests and is pushed, one after the other."""
    ends = [0.0, *chain(*sorted(pushed)), whole]
    for i, (begin, end) in enumerate(pairwise(ends)):
        if end > begin + 1e-9:
            words = "the crank pushes the wheel" if i % 2 else "the wheel rests"
            yield Phase(begin, end, bool(i % 2), words)


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

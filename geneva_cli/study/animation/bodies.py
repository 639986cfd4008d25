"""Bodies of a scene: parts with their outlines, and symbols for machines without drawings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Member, Plate, placed
from geneva_cli.geometry.shapes import Circle, Contour, Line, Shape, polygon
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Link
from geneva_cli.motion.records import thing
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.output.scene import Body, Box, Track
from geneva_cli.parts.assembly import links_at, same
from geneva_cli.parts.gears.gear_curves import gears_table
from geneva_cli.parts.links.link_sizes import places
from geneva_cli.study.animation.animated_turn import MachineTurn
from geneva_cli.study.animation.tracks import still

if TYPE_CHECKING:
    from geneva_cli.parts.outlines.outlines import Outlines


def bodies(design: Design, turn: MachineTurn, teeth: DrawnTeeth) -> Iterator[Body]:
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
            name = f"crank {place.number}" if place.number > 1 else "crank"
            yield Body(name, carried, place.at, turn.crank(place))
        yield Body("groove", _shapes(design, "groove"), (L, 0.0), still())
        if turn.mechanism.frame > 0.0:
            yield Body("carrier", _shapes(design, "frame"), (0.0, 0.0), still())
    for link in links_at(turn.mechanism, np.zeros(1)):  # round gears on shafts that stand
        angle = _angle(turn, link)
        if link.name in teeth.round and angle:
            (x, y) = (float(c[0]) for c in link.joints[0])
            yield Body(link.name, teeth.round[link.name], (x, y), angle)
    if design.spec.gears:
        yield from _gears(turn, teeth)


def _shapes(design: Design, part: str) -> tuple[Shape, ...]:
    """The shapes of a part in its own frame; none if the machine lacks it."""
    with suppress(GenevaError):
        return design.drawing(part).shapes
    return ()


def _gears(turn: MachineTurn, teeth: DrawnTeeth) -> Iterator[Body]:
    machine = turn.mechanism
    gears, (x, sense) = machine.spec.gears, machine.gear_shaft
    assert gears
    driven, driver = teeth.pair or _pitch_curves(machine, -sense)
    before = machine.spec.drive_before
    first = before is not None and before.gears is not None  # the gears turn the shaft of the drive
    yield Body(
        "driver gear",
        driver,
        (x + gears.distance_mm, 0.0),
        turn.input_shaft(-sense) if first or before is None else turn.own_shaft(-sense),
    )
    yield Body(
        "driven gear", driven, (x, 0.0), turn.own_shaft(sense) if first else turn.crank_from_mid()
    )


def _pitch_curves(machine: Mechanism, sign: float) -> list[tuple[Shape, ...]]:
    table = gears_table(machine, 0.001, 241).to_dict()
    curves = []
    for gear in ("driven", "driver"):  # the table turns as an external wheel does
        x, y = -table[f"{gear}_x_mm"][:-1], -sign * table[f"{gear}_y_mm"][:-1]
        curves.append((polygon("GEAR", list(zip(x.tolist(), y.tolist(), strict=True))),))
    return curves


class DrawnTeeth(NamedTuple):
    """Toothed outlines with bores, about each gear's axis at input angle 0, as far as there are."""

    pair: tuple[tuple[Shape, ...], ...]  # driven gear and driver of noncircular ones
    round: dict[str, tuple[Shape, ...]]
    why: str = ""  # reason why teeth of the spec are not drawn


def drawn_teeth(design: Design) -> DrawnTeeth:
    """The teeth of a design's gears; none without a module."""
    if design.spec.size.gear_module_mm is None:
        return DrawnTeeth((), {})
    try:
        # a hundredth of a millimetre is less than a screen shows
        *_, (_, built) = design.parts.all_built
        parts = built().within(0.01, "arcs")
        pair = tuple(map(_gear_shapes, parts.gear_pair))
        return DrawnTeeth(
            pair, {one.name: _gear_shapes(one.member) for one in parts.toothed if one.cut}
        )
    except GenevaError as error:
        return DrawnTeeth((), {}, str(error))


def _gear_shapes(gear: Member) -> tuple[Shape, ...]:
    assert isinstance(gear.part, Plate)
    return (gear.part.outline, *gear.part.holes)


def _angle(turn: MachineTurn, link: Link) -> Track | None:
    """The angle of a gear from its place at input angle 0; None on an axis that moves."""
    at = (float(link.joints[0][0][0]), float(link.joints[0][1][0]))
    if link.teeth.fixed:
        return still()
    if same(at, turn.mechanism.crank_shaft.at, turn.L):
        return turn.crank_from_mid()
    if same(at, (0.0, 0.0), turn.L):
        return turn.wheel(turn.mechanism.wheel_places[0])
    return None


def carried_gear(turn: MachineTurn, teeth: DrawnTeeth, link: Link) -> tuple[Shape, ...]:
    """The gear with teeth that turns with a link about its first joint; empty without one.

    Its shapes are in the link's frame, whose x is towards the second joint.
    """
    joints = [complex(*(float(c[0]) for c in joint)) for joint in link.joints]
    for other in links_at(turn.mechanism, np.zeros(1)):
        here = abs(complex(places(other)[0][0]) - joints[0]) < SAME_LENGTH * turn.L
        if other.name in teeth.round and here and len(joints) > 1 and not _angle(turn, other):
            ahead = joints[1] - joints[0]
            back = -math.atan2(ahead.imag, ahead.real)
            return tuple(placed(shape, (0.0, 0.0), back) for shape in teeth.round[other.name])
    return ()


class WheelScene:
    """What a page shows of wheels that turn without end."""

    def bodies(self, shapes: tuple[Shape, ...], turn: MachineTurn) -> Iterator[Body]:
        """All wheels; without shapes, as symbols."""
        one, machine = turn.passages[0], turn.mechanism
        # distances of the first roller from the wheel's axis in its slot
        reach = np.hypot(*turn.assembly.driving(0, np.linspace(one.entry, one.exit, 181)).T)
        least, most = float(reach.min()), float(reach.max())
        if not shapes:  # a disc with a line along each slot
            angles = np.arange(machine.spec.wheel.z) * math.tau / machine.spec.wheel.z
            along = [(math.cos(a), math.sin(a)) for a in angles.tolist()]
            ends = [((least * c, least * s), (most * c, most * s)) for c, s in along]
            lines = [Contour("WHEEL", (Line(*both),), closed=False) for both in ends]
            shapes, dot = (Circle("WHEEL", (0.0, 0.0), 1.02 * most), *lines), 1.01 * least
        else:
            dot = 0.78 * least
        # a dot behind the end of the first slot tells the slots apart
        wheel = (*shapes, Circle("PITCH", (dot, 0.0), 0.012 * turn.L))
        for place in turn.mechanism.wheel_places:
            name = f"wheel {place.number}" if place.number > 1 else "wheel"
            yield Body(name, wheel, place.at, turn.wheel(place))

    def view(self, wheel: Body, box: Box, turn: MachineTurn) -> Box:
        """The box that a page shows; ``box`` bounds all that turns."""
        return box

    def stops(self, outlines: Outlines | None, turn: MachineTurn) -> tuple[float, float] | None:
        """Input angles, degrees from the start, between which the machine moves; None for all."""
        return None


def wheels_of(spec: Spec) -> WheelScene:
    """What a page shows of a machine's wheels."""
    wheels: WheelScene = (thing(spec.wheel.NAME, "scene") or WheelScene)()
    return wheels

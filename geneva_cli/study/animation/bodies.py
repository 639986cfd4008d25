"""Bodies of a scene: parts with their outlines, and symbols for machines without drawings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Circle, Contour, Line, Shape, polygon
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import thing
from geneva_cli.output.scene import Body, Box
from geneva_cli.parts.gears.gear_curves import gears_table
from geneva_cli.study.animation.animated_turn import MachineTurn
from geneva_cli.study.animation.tracks import still

if TYPE_CHECKING:
    from geneva_cli.parts.outlines.outlines import Outlines


def bodies(design: Design, turn: MachineTurn) -> Iterator[Body]:
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
    if design.spec.gears:
        yield from _gears(turn)


def _shapes(design: Design, part: str) -> tuple[Shape, ...]:
    """The shapes of a part in its own frame; none if the machine lacks it."""
    with suppress(GenevaError):
        return design.drawing(part).shapes
    return ()


def _gears(turn: MachineTurn) -> Iterator[Body]:
    machine = turn.mechanism
    gears, (x, sense) = machine.spec.gears, machine.gear_shaft
    assert gears
    driven, driver = _pitch_curves(machine, -sense)
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
    curves: list[tuple[Shape, ...]] = []
    for gear in ("driven", "driver"):  # the table turns as an external wheel does
        x, y = -table[f"{gear}_x_mm"][:-1], -sign * table[f"{gear}_y_mm"][:-1]
        curves.append((polygon("GEAR", list(zip(x.tolist(), y.tolist(), strict=True))),))
    return curves


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

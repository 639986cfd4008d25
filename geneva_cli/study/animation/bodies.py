"""Bodies of a scene: parts with their outlines, and symbols for machines without drawings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress

import numpy as np

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Circle, Contour, Line, Shape, polygon
from geneva_cli.kinds.linear.scene import rack
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.scene import Body
from geneva_cli.parts.gears.gear_curves import gears_table
from geneva_cli.study.animation.teeth import DrawnTeeth, round_gears
from geneva_cli.study.animation.tracks import still
from geneva_cli.study.animation.turn import MachineTurn


def bodies(design: Design, turn: MachineTurn, teeth: DrawnTeeth) -> Iterator[Body]:
    """Wheel, crank with its arm, the cam's groove and gears, as far as the machine has them."""
    L = turn.L
    # parts of a sphere are drawn laid flat: these outlines do not turn about the shaft
    shapes = () if design.spec.wheel.SHELLS else _hollow(_shapes(design, "wheel"))
    flat = bool(shapes)
    if design.mechanism.output.turns:
        yield from _wheels(shapes, turn)
    else:
        yield rack(shapes, turn)
    if flat:
        carried = (*_shapes(design, "arm"), *_shapes(design, "crank"))
        carried = tuple(shape for shape in carried if shape.layer != "ROLLER")
        for place in turn.mechanism.crank_places:
            name = f"crank {place.number}" if place.number > 1 else "crank"
            yield Body(name, carried, place.at, turn.crank(place))
        yield Body("groove", _shapes(design, "groove"), (L, 0.0), still())
        if turn.mechanism.frame > 0.0:
            yield Body("carrier", _shapes(design, "frame"), (0.0, 0.0), still())
    yield from round_gears(turn, teeth)
    if design.spec.gears:
        yield from _gears(turn, teeth)


def _wheels(shapes: tuple[Shape, ...], turn: MachineTurn) -> Iterator[Body]:
    """All wheels; without shapes, as symbols."""
    wheel = (*(shapes or _slots(turn)), _mark(shapes, turn))
    for place in turn.mechanism.wheel_places:
        name = f"wheel {place.number}" if place.number > 1 else "wheel"
        yield Body(name, wheel, place.at, turn.wheel(place))


def _shapes(design: Design, part: str) -> tuple[Shape, ...]:
    """The shapes of a part in its own frame; none if the machine lacks it."""
    with suppress(GenevaError):
        return design.drawing(part).shapes
    return ()


def _hollow(shapes: tuple[Shape, ...]) -> tuple[Shape, ...]:
    """The shapes of an internal wheel: its rim first, then its cut-outs."""
    rims = tuple(s for s in shapes if isinstance(s, Circle) and s.layer == "WHEEL")
    if not rims:
        return shapes
    # the layer of what is cut out of a plate, together with the plate's edge
    hollow = [s._replace(layer="HOLLOW") if s.layer == "WHEEL" else s for s in shapes]
    return (*rims, *(h for h, s in zip(hollow, shapes, strict=True) if s not in rims))


def _slots(turn: MachineTurn) -> tuple[Shape, ...]:
    """A symbol for a wheel without drawing: a disc with a line along each slot."""
    spec, reach = turn.mechanism.spec, _reach(turn)
    lines = [
        Contour("WHEEL", (Line(_at(reach.min(), a), _at(reach.max(), a)),), closed=False)
        for a in np.arange(spec.wheel.z) * math.tau / spec.wheel.z
    ]
    return (Circle("WHEEL", (0.0, 0.0), 1.02 * float(reach.max())), *lines)


def _reach(turn: MachineTurn) -> Array:
    """The distances of the first roller from the wheel's axis in its slot."""
    one = turn.passages[0]
    return np.hypot(*turn.assembly.driving(0, np.linspace(one.entry, one.exit, 181)).T)


def _at(r: float, a: float) -> tuple[float, float]:
    return float(r * math.cos(a)), float(r * math.sin(a))


def _mark(shapes: tuple[Shape, ...], turn: MachineTurn) -> Shape:
    """A dot behind the end of the first slot, which tells the slots apart."""
    least = float(_reach(turn).min())
    return Circle("PITCH", (0.78 * least if shapes else 1.01 * least, 0.0), 0.012 * turn.L)


def _gears(turn: MachineTurn, teeth: DrawnTeeth) -> Iterator[Body]:
    """Both gears, with their teeth or by their pitch curves."""
    machine = turn.mechanism
    gears, (x, sense) = machine.spec.gears, machine.gear_shaft
    assert gears
    driven, driver = teeth.pair or _pitch_curves(turn, -sense)
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


def _pitch_curves(turn: MachineTurn, sign: float) -> list[tuple[Shape, ...]]:
    """The pitch curves of the driven gear and the driver."""
    table = gears_table(turn.mechanism, 0.001, 241).to_dict()
    # the table turns as an external wheel does
    return [
        (_closed(-table[f"{gear}_x_mm"], -sign * table[f"{gear}_y_mm"]),)
        for gear in ("driven", "driver")
    ]


def _closed(x: Array, y: Array) -> Contour:
    return polygon("GEAR", list(zip(x[:-1].tolist(), y[:-1].tolist(), strict=True)))

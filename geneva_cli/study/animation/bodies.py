"""Bodies of a scene: parts with their outlines, and symbols for machines without drawings."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Circle, Contour, Shape, polygon
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.scene import Body
from geneva_cli.parts.gears.gear_curves import gears_table
from geneva_cli.study.animation.animated_turn import MachineTurn
from geneva_cli.study.animation.shown_wheels import wheels_of
from geneva_cli.study.animation.teeth import DrawnTeeth, round_gears
from geneva_cli.study.animation.tracks import still


def bodies(design: Design, turn: MachineTurn, teeth: DrawnTeeth) -> Iterator[Body]:
    """Wheel, crank with its arm, the cam's groove and gears, as far as the machine has them."""
    L = turn.L
    # parts of a sphere are drawn laid flat: these outlines do not turn about the shaft
    shapes = _hollow(_shapes(design, "wheel")) if turn.mechanism.axes else ()
    flat = bool(shapes)
    yield from wheels_of(design.spec).bodies(shapes, turn)
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

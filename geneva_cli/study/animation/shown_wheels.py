"""The wheels of a scene, by their drawing or as a symbol; other kinds of wheels show their own."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.geometry.shapes import Circle, Contour, Line, Shape
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.records import thing
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.scene import Body, Box
from geneva_cli.study.animation.animated_turn import MachineTurn

if TYPE_CHECKING:
    from geneva_cli.parts.outlines.outlines import Outlines


class WheelScene:
    """What a page shows of wheels that turn without end."""

    def bodies(self, shapes: tuple[Shape, ...], turn: MachineTurn) -> Iterator[Body]:
        """All wheels; without shapes, as symbols."""
        wheel = (*(shapes or _slots(turn)), _mark(shapes, turn))
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

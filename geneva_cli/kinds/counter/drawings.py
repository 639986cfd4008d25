"""Drawings of a counter's driver, pinion and number wheel, each in its own frame, and of all."""

from __future__ import annotations

from geneva_cli.geometry.drawing import Annotations, Drawing, LevelDistance
from geneva_cli.geometry.plates import Group
from geneva_cli.kinds.counter.parts import CounterParts
from geneva_cli.parts.projection import drawing_of, titled, with_frame


def wheel(parts: CounterParts) -> Drawing:
    """Return the pinion; a wide tooth points along x, to the driver at mid-motion."""
    return drawing_of(parts.mechanism, "pinion", parts.pinions[-1].part)


def crank(parts: CounterParts) -> Drawing:
    """Return the driver; x is from its axis to the middle between its two teeth."""
    return drawing_of(parts.mechanism, "driver", parts.driver.part)


def number_wheel(parts: CounterParts) -> Drawing:
    """Return the number wheel that the driver's pinion turns; x is to the middle of a space."""
    return drawing_of(parts.mechanism, "number wheel", parts.number_wheels[-1].part)


def assembly(parts: CounterParts) -> Drawing:
    """Return the counter at input angle 0."""
    title, drawn = titled(parts.mechanism), with_frame(parts.moving, [parts.frame])
    look = Annotations((LevelDistance((0.0, 0.0), parts.axis, "L"),))
    return Drawing(title, drawn, look, Group(title, parts.members))

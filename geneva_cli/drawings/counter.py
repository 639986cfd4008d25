"""Drawings of a counter's driver, pinion and number wheel, each in its own frame, and of all."""

from __future__ import annotations

from geneva_cli.curves.drawing import Annotations, Drawing, LevelDistance
from geneva_cli.curves.plates import Group, Member
from geneva_cli.layout.projection import outlines_of, titled, with_frame
from geneva_cli.parts.counter_parts import CounterParts


def wheel(parts: CounterParts) -> Drawing:
    """Return the pinion; a wide tooth points along x, to the driver at mid-motion."""
    return _drawn(parts, parts.pinions[-1])


def crank(parts: CounterParts) -> Drawing:
    """Return the driver; x is from its axis to the middle between its two teeth."""
    return _drawn(parts, parts.driver)


def number_wheel(parts: CounterParts) -> Drawing:
    """Return the number wheel that the driver's pinion turns; x is to the middle of a space."""
    return _drawn(parts, parts.number_wheels[-1])


def assembly(parts: CounterParts) -> Drawing:
    """Return the counter at input angle 0."""
    title, drawn = titled(parts.mechanism), with_frame(parts.moving, [parts.frame])
    look = Annotations((LevelDistance((0.0, 0.0), parts.axis, "L"),))
    return Drawing(title, drawn, look, Group(title, parts.members))


def _drawn(parts: CounterParts, member: Member) -> Drawing:
    """Return the drawing of a part in its own frame."""
    solid = member.part
    assert isinstance(solid, Group)
    return Drawing(titled(parts.mechanism, solid.name), outlines_of(solid), solid=solid)

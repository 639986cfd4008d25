"""Drawings of a counter's driver, pinion and number wheel, each in its own frame, and of all."""

from __future__ import annotations

from geneva_cli.curves.drawing import Annotations, Drawing, LevelDistance
from geneva_cli.curves.plates import Group, Member
from geneva_cli.curves.shapes import Circle
from geneva_cli.layout.projection import circle_key, once, outlines_of, shapes, titled
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
    moving = list(shapes(parts.moving))
    seen = {circle_key(shape) for shape in moving if isinstance(shape, Circle)}
    standing = [
        shape._replace(layer="FRAME")
        for shape in shapes([parts.frame])
        if not (isinstance(shape, Circle) and circle_key(shape) in seen)
    ]
    title = titled(parts.mechanism)
    look = Annotations((LevelDistance((0.0, 0.0), parts.axis, "L"),))
    return Drawing(title, tuple(once([*moving, *standing])), look, Group(title, parts.members))


def _drawn(parts: CounterParts, member: Member) -> Drawing:
    """Return the drawing of a part in its own frame."""
    solid = member.part
    assert isinstance(solid, Group)
    return Drawing(titled(parts.mechanism, solid.name), outlines_of(solid), solid=solid)

"""The scene: drawings that move with the input angle, handed to the output as a page.

Millimetres and radians, y up, the wheel's axis the origin; the input's angle in degrees from the
scene's start.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from geneva_cli.curves.shapes import Shape
    from geneva_cli.figure import Figure


class Track(NamedTuple):
    """A value that moves: between two knots the cubic with these values and slopes, per degree.

    A single knot is a value that stands still. A turn of the scene adds ``gain``.
    """

    at: tuple[float, ...]
    value: tuple[float, ...]
    slope: tuple[float, ...]
    gain: float = 0.0


Place: TypeAlias = tuple[Track, Track]
Box: TypeAlias = tuple[float, float, float, float]  # least x and y, greatest x and y


class Body(NamedTuple):
    """Shapes in its own frame, which turns about a fixed point."""

    name: str
    shapes: tuple[Shape, ...]
    centre: tuple[float, float]
    angle: Track  # counterclockwise


class Bar(NamedTuple):
    """A link between joints, or with a radius a circle about its one joint."""

    name: str
    joints: tuple[Place, ...]
    radius: float = 0.0


class Push(NamedTuple):
    """Where a roller bears on the wheel, and its force on the wheel, N; chords between."""

    at: tuple[float, ...]
    x: tuple[float, ...]
    y: tuple[float, ...]
    force_x: tuple[float, ...]
    force_y: tuple[float, ...]


class State(NamedTuple):
    """What the wheel does over a stretch of the input, in words."""

    start: float
    end: float
    moves: bool
    words: str


class Scene(NamedTuple):
    """A machine over the turn after which it stands as before, but for the wheel's steps."""

    title: str
    caption: str
    spec: str  # as text
    start_deg: float  # the input's angle at the start, as it is shown
    turn_deg: float
    seconds: float  # of that turn
    bodies: tuple[Body, ...]  # the wheel first
    bars: tuple[Bar, ...]
    rollers: tuple[Place, ...]
    roller_radius: float
    pushes: tuple[Push, ...]
    states: tuple[State, ...]
    figure: Figure
    box: Box  # of all that is ever seen

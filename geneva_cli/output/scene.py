"""The scene: drawings that move with the input angle, for a page.

Millimetres and radians, y up, with the wheel's axis as origin. The input's angle is in degrees from
the scene's start.
"""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from geneva_cli.figure import Figure
    from geneva_cli.geometry.shapes import Shape


class Track(NamedTuple):
    """A value that moves: a Chebyshev series between each two ``ends``, degrees from the start.

    A turn of the scene adds ``gain``.
    """

    ends: tuple[float, ...]
    series: tuple[tuple[float, ...], ...]
    gain: float = 0.0


def value_at(track: Track, t: float) -> float:
    """A track's value at an input angle, as the page's script computes it.

    >>> from geneva_cli.output.scene import Track, value_at
    >>> value_at(Track((0.0, 2.0, 4.0), ((5.0,), (0.0, 0.0, 1.0))), 2.5)  # 2 u² - 1, u = -1/2
    -0.5
    """
    from numpy.polynomial.chebyshev import chebval

    i = min(max(bisect_right(track.ends, t), 1), len(track.series))
    a, b = track.ends[i - 1 : i + 1]
    u = min(1.0, max(-1.0, (2.0 * t - a - b) / (b - a)))
    return float(chebval(u, track.series[i - 1]))


Place: TypeAlias = tuple[Track, Track]
Box: TypeAlias = tuple[float, float, float, float]  # least x and y, greatest x and y


class Body(NamedTuple):
    """Shapes in its own frame, which turns about a point. A rack's frame moves along y instead.

    Its name is the id of its element on the page.
    """

    name: str
    shapes: tuple[Shape, ...]
    centre: tuple[float, float]
    angle: Track  # counterclockwise
    travel: Track | None = None  # along y, mm


class CarriedShapes(NamedTuple):
    """Shapes that a link carries: their origin is at a joint, their x away from the first joint."""

    joint: int
    shapes: tuple[Shape, ...]


class Bar(NamedTuple):
    """A link between joints, or with a radius a circle about its one joint.

    ``plates`` are the link itself, from its first joint towards the second, and the blocks that
    slide in it. Without plates it is shown as a bar.
    """

    name: str
    joints: tuple[Place, ...]
    radius: float = 0.0
    plates: tuple[CarriedShapes, ...] = ()


class Push(NamedTuple):
    """The contact point of a roller on the wheel, and its force, N; linear between samples."""

    at: tuple[float, ...]
    x: tuple[float, ...]
    y: tuple[float, ...]
    force_x: tuple[float, ...]
    force_y: tuple[float, ...]


class Phase(NamedTuple):
    """A stretch of the input in which the wheel moves or rests, described in words."""

    start: float
    end: float
    moves: bool
    words: str


class Scene(NamedTuple):
    """A machine over the turn after which its position repeats, except for the wheel's steps."""

    title: str
    caption: str
    spec: str  # as text
    start_deg: float  # the input's angle at the start, as displayed
    turn_deg: float
    seconds: float  # of that turn
    bodies: tuple[Body, ...]  # the wheel first
    bars: tuple[Bar, ...]
    rollers: tuple[Place, ...]
    roller_radius: float
    pushes: tuple[Push, ...]
    states: tuple[Phase, ...]
    figure: Figure
    box: Box = (0.0, 0.0, 0.0, 0.0)  # of all shapes during the turn
    stops: tuple[float, float] | None = None  # from the start: the machine goes back and forth
    # from the start: where the input stands still for so many seconds, in the middle of each dwell
    pauses: tuple[float, ...] = ()
    stop_s: float = 0.0
    # a carrier, in whose frame all positions are written: its rotation
    frame: Body | None = None

"""Metric screws: their holes, and where these lie on a circle.

A screw passes the part that it fixes, and its thread is in the part below.
"""

from __future__ import annotations

import math
from itertools import starmap
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import ORIGIN, Circle, polar
from geneva_cli.numerics.arrays import half_or
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.spec.tables import Size


class Screw(NamedTuple):
    """A metric screw: thread, pitch, and hole that it passes, mm."""

    thread: float
    pitch: float
    through: float


# Sizes by ISO 262, coarse pitches by ISO 261, clearance holes by ISO 273 (medium).
# fmt: off
SCREWS = [*starmap(Screw, (
    (1.6, 0.35, 1.8), (2, 0.4, 2.4), (2.5, 0.45, 2.9), (3, 0.5, 3.4), (4, 0.7, 4.5), (5, 0.8, 5.5),
    (6, 1.0, 6.6), (8, 1.25, 9.0), (10, 1.5, 11.0), (12, 1.75, 13.5), (16, 2.0, 17.5),
    (20, 2.5, 22.0), (24, 3.0, 26.0), (30, 3.5, 33.0), (36, 4.0, 39.0), (42, 4.5, 45.0),
    (48, 5.0, 52.0), (56, 5.5, 62.0), (64, 6.0, 70.0),
))]
# fmt: on


class BoltCircle(NamedTuple):
    """Holes evenly on a circle about an axis: both radii, mm, and the holes in a plate."""

    radius: float
    hole: float
    holes: tuple[Circle, ...]


class Screws(NamedTuple):
    """Equal screws: the part that they fix, their clearance hole, and the part with the thread."""

    fixed: str
    number: int
    hole_mm: float  # diameter
    tapped: str

    @property
    def name(self) -> str:
        """What a list calls them."""
        return f"screws of the {self.fixed}, tapped in {self.tapped}"

    @property
    def text(self) -> str:
        """Their number and thread; the hole where no screw is so thin.

        >>> Screws("dial", 4, 5.5, "the dial").text, Screws("dial", 4, 1.0, "the dial").text
        ('4 × M5', '4 holes of 1 mm')
        """
        one = screw_through(self.hole_mm)
        what = f"× M{one.thread:g}" if one else f"holes of {self.hole_mm:g} mm"
        return f"{self.number} {what}"


def screw_through(hole_mm: float) -> Screw | None:
    """Return the largest screw that passes a hole of a diameter with clearance; None below M1.6.

    >>> screw_through(6.25).thread, screw_through(1.7)
    (5, None)
    """
    for one in reversed(SCREWS):
        if one.through <= hole_mm * (1.0 + ROUNDED):
            return one
    return None


def tapped(hole: Circle) -> Circle:
    """Return the hole before the thread is cut for the screw that passes another hole.

    By ISO 2306 its diameter is thread minus pitch. It is as wide as the other hole where no screw
    is so thin.
    """
    one = screw_through(2.0 * hole.radius)
    return hole._replace(radius=0.5 * (one.thread - one.pitch)) if one else hole


def bolt_radius(
    diameter_mm: float | None, L: float, half_width: float, key: str = "", asked: int | None = None
) -> float:
    """Return the radius of a screw's hole in the middle of a ring, twice ``half_width`` wide.

    By default it takes at most half of the ring, and L/40; it is 0 where that leaves no screw.
    Raises GenevaError, naming the ``key``, where the spec has ``asked`` for screws.

    >>> bolt_radius(None, 100.0, 10.0), bolt_radius(None, 60.0, 10.0)
    (1.2, 0.0)
    """
    one = screw_through(min(L / 40.0, half_width))
    radius = half_or(diameter_mm, 0.5 * one.through if one else 0.0)
    if asked and not radius:
        raise GenevaError(
            f"{key}s = {asked}: the parts are too small for a screw of M{SCREWS[0].thread:g}; set "
            f"{key}_mm for other holes, or remove {key}s",
            ("size", f"{key}s"),
        )
    return radius


def bolt_circle(
    size: Size, part: str, L: float, ring: tuple[float, float], start: float
) -> BoltCircle:
    """Return the bolts of a part, "dial" or "gear"; by default in the middle of a ring.

    ``ring`` has its inner and outer radius, and ``start`` is the first hole's direction. Where no
    screw is thin enough there are none; for a dial that is an error.

    >>> bolt_circle(Size(dial_bolts=4), "dial", 100.0, (20.0, 40.0), 0.0)[:2]
    (30.0, 1.2)
    """
    values, (low, high) = vars(size), ring
    count: int = values[f"{part}_bolts"]
    radius = half_or(values[f"{part}_bolt_circle_mm"], 0.5 * (low + high))
    asked = count if part == "dial" else 0
    hole = bolt_radius(values[f"{part}_bolt_mm"], L, 0.5 * (high - low), "dial_bolt", asked)
    holes = []
    for k in range(count if hole else 0):
        at = polar(ORIGIN, radius, start + math.tau * k / count)
        holes.append(Circle("BORE", at, hole))
    return BoltCircle(radius, hole, tuple(holes))

"""The smallest wall of a drawn part: between slots, bores and its outline.

A wall is thinnest where a line through the material meets its boundary at a right angle on both
sides, at an edge, an arc, or a corner that points into the material. Of two edges that is at a
corner of one, of an arc with the material outside it on the line through its centre. So points are
compared with pieces: all corners, and the centres of those arcs. A horn is thinnest where it ends,
at the corner of a slot's mouth.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.loops import JOINED_MM
from geneva_cli.geometry.shapes import Contour
from geneva_cli.numerics.arrays import Array, Mask, Whole

BLUNTEST = -0.7  # cosine of 135°, nearly: a blunter corner is one of facets
SLANT = 1e-6  # sine of an angle that counts as right: tangents of rounded drawings differ
SHARES = (0.1, 0.3, 0.5, 0.7, 0.9)  # places of a line that must be in the material
LEAST_MM = 4.0 * JOINED_MM  # a thinner wall comes from rounded joints
BLOCK = 1 << 18  # pairs of points and pieces that are compared together


class Wall(NamedTuple):
    """A wall: its thickness, mm, and both of its ends as complex numbers."""

    thickness: float
    start: complex
    end: complex


class _Corners(NamedTuple):
    """The joints at which pieces start, and the directions in which the boundary leaves them.

    ``before`` leads back along the piece before, ``after`` along the piece that starts there.
    """

    place: Array
    before: Array
    after: Array
    following: Whole  # the piece that starts where each piece ends

    def faces(self, which: Whole, direction: Array) -> Mask:
        """Whether directions lead into the material, and the boundary nowhere comes nearer."""
        before, after = self.before[which], self.after[which]
        normal = 1j * (after - before)  # to the left of both pieces
        nearer = [(side.conjugate() * direction).real for side in (before, after)]
        return ((normal.conjugate() * direction).real > 0.0) & (np.maximum(*nearer) <= SLANT)

    def ends_at(self, which: Whole, direction: Array) -> Mask:
        """Whether a wall ends at a corner, as a horn does at the mouth of a slot.

        Directions lead into the material, and one side of the corner comes no nearer.
        """
        before, after = self.before[which], self.after[which]
        is_sharp = (before.conjugate() * after).real > BLUNTEST
        between = [(side.conjugate() * direction).real for side in (1j * after, -1j * before)]
        nearer = [(side.conjugate() * direction).real for side in (before, after)]
        return is_sharp & (np.minimum(*between) > SLANT) & (np.minimum(*nearer) <= SLANT)


def smallest_wall(contours: Sequence[Contour], some: Whole | None = None) -> Wall | None:
    """Return the smallest wall of a part, or None if it has none.

    Its contours have the material on their left. Only walls that begin at the pieces ``some`` are
    looked at, numbers in the order of the contours: one sector of a wheel is enough.
    """
    outline = Polyarc(contours)
    some = np.arange(len(outline)) if some is None else some
    corners = _corners(outline, [len(contour.segments) for contour in contours])
    hollow = some[outline.sense[some] < 0.0]
    piece = np.concatenate((some, hollow))
    centres = outline.cx[hollow] + 1j * outline.cy[hollow]
    points = np.concatenate((corners.place[some], centres))
    radius = np.concatenate((np.zeros(len(some)), outline.radius[hollow]))
    starts, ends = [np.zeros(0, dtype=complex)], [np.zeros(0, dtype=complex)]
    size = max(1, BLOCK // len(outline))
    for first in range(0, len(points), size):
        block = np.arange(first, min(first + size, len(points)))
        row, foot = _feet(outline, corners, points[block])
        k = block[row]
        direction = (foot - points[k]) / np.abs(foot - points[k])
        of_arc, at = radius[k] > 0.0, points[k] + radius[k] * direction
        spans = _spans(outline, piece[k], direction)
        of_corner = corners.faces(piece[k], direction) | corners.ends_at(piece[k], direction)
        keep = np.where(of_arc, spans, of_corner)
        keep &= ((foot - at) * direction.conjugate()).real > LEAST_MM
        starts.append(at[keep])
        ends.append(foot[keep])
    return _first_inside(outline, np.concatenate(starts), np.concatenate(ends))


def _corners(outline: Polyarc, lengths: list[int]) -> _Corners:
    """Return the corners of contours of some numbers of pieces."""
    begins = np.repeat(np.cumsum([0, *lengths[:-1]]), lengths)
    following = begins + np.concatenate([np.roll(np.arange(n), -1) for n in lengths])
    chord = _chords(outline)
    # an arc to the left begins half of its sweep to the right of its chord
    half = outline.cos_half + 1j * outline.sin_half
    turn = np.where(outline.sense < 0.0, half, half.conjugate())
    before = np.empty(len(outline), dtype=complex)
    before[following] = -chord * turn.conjugate()
    return _Corners(outline.x0 + 1j * outline.y0, before, chord * turn, following)


def _feet(outline: Polyarc, corners: _Corners, points: Array) -> tuple[Whole, Array]:
    """Return the nearest points of pieces to points: rows and feet.

    The line from the foot back to the point leads into the material, at a right angle.
    """
    seen = outline.distances(points.real[:, None], points.imag[:, None])
    row, piece = np.nonzero(seen.distance > LEAST_MM)
    facing, along = seen.facing[row, piece], seen.along[row, piece]
    corner = np.where(along < 0.0, piece, corners.following[piece])
    is_arc, chord = outline.arc[piece], _chords(outline)[piece]
    centre = outline.cx[piece] + 1j * outline.cy[piece]
    on_line = outline.ox[piece] + 1j * outline.oy[piece] + along * chord
    away = points[row] - centre
    on_arc = centre + outline.radius[piece] * away / np.maximum(np.abs(away), 1e-300)
    foot = np.where(facing, np.where(is_arc, on_arc, on_line), corners.place[corner])
    back = (points[row] - foot) / np.maximum(np.abs(points[row] - foot), 1e-300)
    # the material is on the left
    inward = np.where(is_arc, (centre - foot) * outline.sense[piece], 1j * chord)
    arrives = (inward.conjugate() * back).real > 0.0
    keep = np.where(facing, arrives, corners.faces(corner, back))
    return row[keep], foot[keep]


def _chords(outline: Polyarc) -> Array:
    """Return the directions from the starts of pieces to their ends."""
    return (outline.dx + 1j * outline.dy) / outline.length


def _spans(outline: Polyarc, piece: Whole, direction: Array) -> Mask:
    """Whether arcs have a point in a direction from their centre."""
    along = direction.real * outline.mx[piece] + direction.imag * outline.my[piece]
    return along >= outline.cos_half[piece] - 1e-9


def _first_inside(outline: Polyarc, start: Array, end: Array) -> Wall | None:
    """Return the shortest of some lines that lies in the material."""
    thickness = np.abs(end - start)
    for i in np.argsort(thickness, kind="stable"):
        places = [start[i] + share * (end[i] - start[i]) for share in SHARES]
        if outline.signed(np.array([(z.real, z.imag) for z in places])).max() < 0.0:
            return Wall(float(thickness[i]), complex(start[i]), complex(end[i]))
    return None

"""The smallest wall of a drawn part: between slots, bores and its outline.

A wall is thinnest where a line through the material meets its boundary at a right angle on both
sides, at an edge, an arc, or a corner that points into the material. So all corners, and the
centres of arcs with the material outside, are compared with pieces.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.loops import JOINED_MM
from geneva_cli.geometry.shapes import Contour
from geneva_cli.numerics.arrays import Array, Mask, Whole, blocks

BLUNTEST = -0.7  # cosine of 135°, nearly: a blunter corner is one of facets
SLANT = 1e-6  # sine of an angle that counts as right: tangents of rounded drawings differ
SHARES = (0.1, 0.3, 0.5, 0.7, 0.9)  # places of a line that must be in the material
LEAST_MM = 4.0 * JOINED_MM  # a thinner wall comes from rounded joints
BLOCK = 1 << 18  # pairs of points and pieces that are compared together


def smallest_wall(
    contours: Sequence[Contour], some: Whole | None = None
) -> tuple[float, complex, complex] | None:
    """The smallest wall of a part with the material on the left: mm, and its ends; None without."""
    outline = Polyarc(contours)
    some = np.arange(len(outline)) if some is None else some
    # The directions in which the boundary leaves the corner where each piece starts: ahead along
    # it, and back along the piece before. An arc to the left begins half of its sweep to the right
    # of its chord.
    place, chord = outline.x0 + 1j * outline.y0, (outline.dx + 1j * outline.dy) / outline.length
    half = outline.cos_half + 1j * outline.sin_half
    turn = np.where(outline.sense < 0.0, half, half.conjugate())
    after, before = chord * turn, np.empty(len(outline), dtype=complex)
    before[outline.after] = -chord * turn.conjugate()

    def faces(which: Whole, direction: Array, ends: bool = False) -> Mask:
        """Whether directions lead into the material from corners that nowhere come nearer.

        A wall ``ends`` at a sharp corner of which one side comes no nearer, as a horn at its mouth.
        """
        a, b = before[which], after[which]
        nearer = [(side.conjugate() * direction).real for side in (a, b)]
        if not ends:
            normal = 1j * (b - a)  # to the left of both pieces
            inwards = (normal.conjugate() * direction).real > 0.0
            return inwards & (np.maximum(*nearer) <= SLANT)
        between = [(side.conjugate() * direction).real for side in (1j * b, -1j * a)]
        is_sharp = (a.conjugate() * b).real > BLUNTEST
        return is_sharp & (np.minimum(*between) > SLANT) & (np.minimum(*nearer) <= SLANT)

    def feet(points: Array) -> tuple[Whole, Array]:
        """The nearest points of pieces to points: rows and feet."""
        away_mm, _, facing, along = outline.distances(points.real[:, None], points.imag[:, None])
        row, piece = np.nonzero(away_mm > LEAST_MM)
        facing, along = facing[row, piece], along[row, piece]
        corner = np.where(along < 0.0, piece, outline.after[piece])
        is_arc, direction = outline.arc[piece], chord[piece]
        centre = outline.cx[piece] + 1j * outline.cy[piece]
        on_line = outline.ox[piece] + 1j * outline.oy[piece] + along * direction
        away = points[row] - centre
        on_arc = centre + outline.radius[piece] * away / np.maximum(np.abs(away), 1e-300)
        foot = np.where(facing, np.where(is_arc, on_arc, on_line), place[corner])
        back = (points[row] - foot) / np.maximum(np.abs(points[row] - foot), 1e-300)
        # the material is on the left
        inward = np.where(is_arc, (centre - foot) * outline.sense[piece], 1j * direction)
        arrives = (inward.conjugate() * back).real > 0.0
        keep = np.where(facing, arrives, faces(corner, back))
        return row[keep], foot[keep]

    hollow = some[outline.sense[some] < 0.0]
    piece = np.concatenate((some, hollow))
    points = np.concatenate((place[some], outline.cx[hollow] + 1j * outline.cy[hollow]))
    radius = np.concatenate((np.zeros(len(some)), outline.radius[hollow]))
    starts, ends = [np.zeros(0, dtype=complex)], [np.zeros(0, dtype=complex)]
    for block in blocks(len(points), max(1, BLOCK // len(outline))):
        row, foot = feet(points[block])
        k = block.start + row
        direction = (foot - points[k]) / np.abs(foot - points[k])
        at, own = points[k] + radius[k] * direction, piece[k]
        # an arc has a point in that direction from its centre, or a corner faces it
        along = direction.real * outline.mx[own] + direction.imag * outline.my[own]
        of_corner = faces(own, direction) | faces(own, direction, ends=True)
        keep = np.where(radius[k] > 0.0, along >= outline.cos_half[own] - 1e-9, of_corner)
        keep &= ((foot - at) * direction.conjugate()).real > LEAST_MM
        starts.append(at[keep])
        ends.append(foot[keep])
    start, end = np.concatenate(starts), np.concatenate(ends)
    thickness = np.abs(end - start)
    for i in np.argsort(thickness, kind="stable"):  # the shortest that lies in the material
        places = [start[i] + share * (end[i] - start[i]) for share in SHARES]
        if outline.signed(np.array([(z.real, z.imag) for z in places])).max() < 0.0:
            return float(thickness[i]), complex(start[i]), complex(end[i])
    return None

"""The solids of a part as closed meshes, by manifold3d: one for each kind, and its places."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import manifold3d as m3
import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Part, Plate, Shell, Solid, oriented
from geneva_cli.geometry.shapes import STRAIGHT, Arc, Cubic, Layer, Segment, points
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.geometry.sphere import Vector, axis_frame, unit
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.solid_part import plate_contours, require_thick, solid_part

if TYPE_CHECKING:
    import numpy.typing as npt

    Numbers: TypeAlias = npt.NDArray[np.int64]

DECIMALS = 6  # of coordinates in mm, so that rounding of another processor is not seen
CORNERS_MAX = 200_000  # of a solid: a file of about 40 MB


Place: TypeAlias = tuple[Array, Array]  # a solid's position: p becomes turn @ p + shift, in mm


class Body(NamedTuple):
    """A kind of solid: its name and layer, its surface, and where it stands.

    The surface has corners in mm (n, 3), and triangles by their numbers (m, 3), counterclockwise
    from outside. Every side of a triangle is a side of one other, in the opposite sense.
    """

    name: str
    layer: Layer
    corners: Array
    triangles: Numbers
    places: list[Place]


def bodies(drawing: Drawing, format: str) -> list[Body]:
    """Return the kinds of solids of a drawing; their chords keep the drawing's tolerance."""
    kinds: dict[Solid, list[Place]] = {}
    rest: list[tuple[Part, Array, Array]] = [(solid_part(drawing, format), np.eye(3), np.zeros(3))]
    while rest:
        part, turn, shift = rest.pop()
        if not isinstance(part, Group):
            kinds.setdefault(part, []).append((turn, shift))
            continue
        for member in reversed(part.members):
            c, s = math.cos(member.turn), math.sin(member.turn)
            own = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
            if member.frame:
                own = np.array([member.frame.x, member.frame.y, member.frame.z]).T
            at = turn @ np.array([*member.at, 0.0]) + shift
            rest.append((member.part, turn @ own, at))
    return [
        Body(solid.name, solid.layer, *_surface(solid, drawing.tolerance), places)
        for solid, places in kinds.items()
    ]


def placed(corners: Array, place: Place) -> Array:
    """Return corners (n, 3) at a position, rounded as those of a surface."""
    turn, shift = place
    return _rounded(corners @ turn.T + shift)


@lru_cache(maxsize=32)  # an export writes each solid by itself, and all of them together
def _surface(solid: Solid, tolerance: float) -> tuple[Array, Numbers]:
    if not tolerance > 0.0:
        raise GenevaError(f"--tolerance {tolerance:g}: it must be above 0 mm")
    body = _shell(solid, tolerance) if isinstance(solid, Shell) else _plate(solid, tolerance)
    mesh = body.to_mesh64()
    corners = _rounded(np.asarray(mesh.vert_properties)[:, :3])
    if body.is_empty() or not np.ptp(corners, axis=0).all():  # thinner than the decimals
        raise _no_wall(solid.name)
    return corners, np.asarray(mesh.tri_verts).astype(np.int64)


def _plate(plate: Plate, tolerance: float) -> m3.Manifold:
    """Return a plate: a ring of corners around each face, strips, and two faces."""
    shapes = plate_contours(plate)
    if not shapes:  # its outline is rounding
        raise _no_wall(plate.name)
    outline, *holes = shapes
    contours = [contour.segments for contour in oriented(outline, holes)]
    counts = [[_chords(piece, tolerance) for piece in contour] for contour in contours]
    around = sum(map(sum, counts))
    _require_few(2 * around, plate.name)
    ring = np.concatenate([_corners(one, n) for one, n in zip(contours, counts, strict=True)])
    corners = np.concatenate((_raised(ring, plate.low), _raised(ring, plate.high)))
    starts = np.cumsum([0, *map(sum, counts)])
    loops = [np.arange(a, b) for a, b in pairwise(starts)]
    top = _triangles([ring[loop] for loop in loops], plate.name)
    triangles = [top[:, ::-1], top + around]
    for loop in loops:
        triangles += _strips(loop, around)
    return _manifold(corners, triangles)


def _manifold(corners: Array, triangles: list[Numbers]) -> m3.Manifold:
    return m3.Manifold(m3.Mesh64(corners, np.concatenate(triangles).astype(np.uint64)))


def _strips(ring: Numbers, up: int) -> list[Numbers]:
    """Return the walls over a closed ring of corners; each above has a number ``up`` greater."""
    after = np.roll(ring, -1)
    return [
        np.column_stack((ring, after, after + up)),
        np.column_stack((ring, after + up, ring + up)),
    ]


def _triangles(loops: list[Array], name: str) -> Numbers:
    """Return the triangles of an outline with holes; raises GenevaError for loops that cross."""
    triangles = m3.triangulate(loops)
    p, q, r = np.concatenate(loops)[triangles.T]
    twice = (q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0]
    if not len(triangles) or twice.min() < -1e-6 * twice.sum():
        raise _no_wall(name)
    return triangles


def _shell(shell: Shell, tolerance: float) -> m3.Manifold:
    """Return a shell: a curved block between the spheres, in pyramids from the centre."""
    require_thick(shell)
    middle = unit(np.sum([region.middle for region in shell.regions], axis=0))
    far = 1.01 * shell.outer
    pyramids, reach = [], 0.0
    for region in shell.regions:
        arcs = [
            arc.at(arc.sweep / n * np.arange(float(n)))[0]
            for arc in region.boundary
            for n in [arc_chords(shell.outer * math.sin(arc.angle), arc.sweep, tolerance)]
        ]
        around = np.concatenate(arcs)
        reach = max(reach, float(np.arccos(around @ middle).max()))
        frame = np.array(axis_frame(region.middle))
        seen = around @ frame.T
        flat = far * seen[:, :2] / seen[:, 2:]  # great circles are straight lines
        here = np.arange(len(flat))
        walls = np.column_stack((np.full_like(here, len(flat)), np.roll(here, -1), here))
        corners = np.concatenate((_raised(flat, far), np.zeros((1, 3)))) @ frame
        pyramids.append(_manifold(corners, [_triangles([flat], shell.name), walls]))
    body = _block(shell, middle, reach, tolerance)
    body ^= m3.Manifold.batch_boolean(pyramids, m3.OpType.Add)
    for hole in shell.holes:
        chords = arc_chords(hole.radius, math.tau, tolerance)
        drill = m3.Manifold.cylinder(far, hole.radius, circular_segments=chords)
        body -= drill.transform(np.column_stack((np.array(axis_frame(hole.axis)).T, np.zeros(3))))
    return body


def _block(shell: Shell, middle: Vector, reach: float, tolerance: float) -> m3.Manifold:
    """Return a block between the spheres of a shell, over all within ``reach`` of its middle."""
    # A right triangle with legs a is at most a²/4R below a sphere.
    step = 2.0 * math.sqrt(tolerance / shell.outer)
    half = 1.02 * reach + step
    count = math.ceil(2.0 * half / step)
    _require_few(2 * count * count, shell.name)
    across = np.linspace(-half, half, count + 1)
    x, y = (one.ravel() for one in np.meshgrid(across, across, indexing="ij"))
    angle = np.hypot(x, y)
    ahead = np.column_stack((x, y, np.cos(angle)))
    ahead[:, :2] *= np.sinc(angle / math.pi)[:, None]
    sphere = ahead @ np.array(axis_frame(middle))
    number = np.arange(len(sphere)).reshape(count + 1, count + 1)
    a, b = number[:-1, :-1].ravel(), number[1:, :-1].ravel()
    face = np.concatenate((np.column_stack((a, b, b + 1)), np.column_stack((a, b + 1, a + 1))))
    ring = (number[:-1, 0], number[-1, :-1], number[:0:-1, -1], number[0, :0:-1])
    walls = _strips(np.concatenate(ring), len(sphere))
    corners = np.concatenate((shell.inner * sphere, shell.outer * sphere))
    return _manifold(corners, [face[:, ::-1], face + len(sphere), *walls])


def arc_chords(radius: float, sweep: float, tolerance: float) -> int:
    """Return the number of chords of an arc of ``sweep`` radians; lengths in mm.

    >>> arc_chords(10.0, 6.283185307179586, 0.01)
    71
    """
    # as in Polyarc.samples: 1 minus a cosine loses the digits of an arc that is nearly straight
    most = 4.0 * math.asin(math.sqrt(0.5 * min(tolerance / radius, 1.0)))
    # at least 8 chords in a whole turn
    return max(1, math.ceil(abs(sweep) / min(most, math.tau / 8)))


def _chords(segment: Segment, tolerance: float) -> int:
    if isinstance(segment, Arc) and abs(segment.bulge) >= STRAIGHT:
        return arc_chords(segment.radius, segment.sweep, tolerance)
    if isinstance(segment, Cubic):
        a, b, c, d = np.array(segment)
        bend = max(np.hypot(*(a - 2.0 * b + c)), np.hypot(*(b - 2.0 * c + d)))
        # the second derivative is at most 6 bends, and a chord's error an eighth of it
        return max(1, math.ceil(math.sqrt(0.75 * bend / tolerance)))
    return 1


def _corners(pieces: tuple[Segment, ...], counts: list[int]) -> Array:
    flat = [p for piece, n in zip(pieces, counts, strict=True) for p in points(piece, n)[:-1]]
    return np.array(flat)


def _raised(flat: Array, z: float) -> Array:
    return np.column_stack((flat, np.full(len(flat), z)))


def _rounded(corners: Array) -> Array:
    return np.round(corners, DECIMALS) + 0.0


def _require_few(count: int, name: str) -> None:
    if count > CORNERS_MAX:
        raise GenevaError(
            f"--tolerance: the mesh of the {name} takes more than {CORNERS_MAX} corners; use a "
            "larger tolerance"
        )


def _no_wall(name: str) -> GenevaError:
    return GenevaError(
        f"{name}: its outline and holes leave no wall, so it has no mesh; use a smaller --tolerance"
    )

"""The solids of a part as closed meshes, by manifold3d: one for each kind, and its places."""

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple, TypeAlias

import manifold3d as m3
import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Part, Plate, Shell, Solid, oriented
from geneva_cli.geometry.shapes import STRAIGHT, Arc, Cubic, Layer, Segment, points
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.geometry.sphere import axis_frame
from geneva_cli.numerics.arrays import Array, Complex, Whole
from geneva_cli.output.solid_part import plate_contours, solid_part

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
    triangles: Whole
    places: list[Place]


def bodies(drawing: Drawing, format: str) -> list[Body]:
    """Return the kinds of solids of a drawing; their chords keep the drawing's tolerance."""
    kinds: dict[Solid, list[Place]] = {}
    for solid, place in _places(solid_part(drawing, format), (np.eye(3), np.zeros(3))):
        kinds.setdefault(solid, []).append(place)
    return [
        Body(solid.name, solid.layer, *_surface(solid, drawing.tolerance), places)
        for solid, places in kinds.items()
    ]


def _places(part: Part, place: Place) -> Iterator[tuple[Solid, Place]]:
    """Yield the solids of a part, which is at a position, and their positions."""
    if not isinstance(part, Group):
        yield part, place
        return
    turn, shift = place
    for member in part.members:
        c, s = math.cos(member.turn), math.sin(member.turn)
        frame = member.frame or ((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0))
        at = turn @ np.array([*member.at, 0.0]) + shift
        yield from _places(member.part, (turn @ np.array(frame).T, at))


def placed(corners: Array, place: Place) -> Array:
    """Return corners (n, 3) at a position, rounded as those of a surface."""
    turn, shift = place
    return _rounded(corners @ turn.T + shift)


@lru_cache(maxsize=32)  # an export writes each solid by itself, and all of them together
def _surface(solid: Solid, tolerance: float) -> tuple[Array, Whole]:
    body = _shell(solid, tolerance) if isinstance(solid, Shell) else _plate(solid, tolerance)
    mesh = body.to_mesh64()
    corners = _rounded(np.asarray(mesh.vert_properties)[:, :3])
    if body.is_empty() or not np.ptp(corners, axis=0).all():  # thinner than the decimals
        raise _no_wall(solid.name)
    return corners, np.asarray(mesh.tri_verts).astype(np.intp)


def _plate(plate: Plate, tolerance: float) -> m3.Manifold:
    """Return a plate: its face, extruded."""
    shapes = plate_contours(plate)
    if not shapes:  # its outline is rounding
        raise _no_wall(plate.name)
    outline, *holes = shapes
    contours, loops = oriented(outline, holes), list[Complex]()
    counts = [[_chords(piece, tolerance) for piece in one.segments] for one in contours]
    _require_few(2 * sum(map(sum, counts)), plate.name)
    for contour, each in zip(contours, counts, strict=True):
        corners = [at for run in map(points, contour.segments, each) for at in run[:-1]]
        loops.append(np.array([complex(*at) for at in corners]))
    return _face(loops, plate.name).extrude(plate.thickness).translate((0.0, 0.0, plate.low))


def _face(loops: list[Complex], name: str) -> m3.CrossSection:
    """Return the inside of loops of complex numbers; raises GenevaError for loops that cross."""
    face = m3.CrossSection([np.column_stack((loop.real, loop.imag)) for loop in loops])
    area = sum(0.5 * float(np.vdot(loop, np.roll(loop, -1)).imag) for loop in loops)
    if not abs(face.area() - area) <= 1e-5 * area:
        raise _no_wall(name)
    return face


def _shell(shell: Shell, tolerance: float) -> m3.Manifold:
    """Return a shell, cut from a block on a map of its outer sphere, with radii as heights.

    Distances from the middle of the map are true. The block bulges, so that its triangles stay.
    """
    frame = np.array(axis_frame(shell.regions[-1].middle))
    loops = []
    for region in shell.regions:
        arcs = []
        for arc in region.boundary:
            n = arc_chords(shell.outer * math.sin(arc.angle), arc.sweep, 0.5 * tolerance)
            arcs.append(arc.at(arc.sweep / n * np.arange(float(n)))[0])
        x, y, z = frame @ np.concatenate(arcs).T
        away = np.arctan2(np.hypot(x, y), z)
        loops.append(shell.outer * away * np.exp(1j * np.arctan2(y, x)))
    face = _face(loops, shell.name)
    x0, y0, x1, y1 = face.bounds()
    # A right triangle with legs a is at most a²/4R below a sphere.
    step = 2.0 * math.sqrt(tolerance * shell.outer)
    _require_few(math.ceil(2.0 * face.area() / step**2), shell.name)
    size = max(x1 - x0, y1 - y0) + 2.0 * step
    corner = 0.5 * (x0 + x1 - size), 0.5 * (y0 + y1 - size), 0.0
    block = m3.Manifold.cube((size, size, 1.0)).translate(corner).refine(math.ceil(size / step))
    bulge = 1e-10 * size / step**2  # more than rounding, and less than the decimals of corners

    def raised(at: Array, by: float) -> Array:
        return at + by * np.outer((at[:, :2] ** 2).sum(axis=1), (0.0, 0.0, 1.0))

    def place(at: Array) -> Array:
        across, height = at[:, :2] / shell.outer, raised(at, -bulge)[:, 2:]
        away = np.hypot(*across.T)
        ahead = np.column_stack((across * np.sinc(away / math.pi)[:, None], np.cos(away)))
        return (shell.inner + (shell.outer - shell.inner) * height) * (ahead @ frame)

    block = block.warp_batch(lambda at: raised(at, bulge))
    body = (block ^ face.extrude(4.0).translate((0.0, 0.0, -1.0))).warp_batch(place)
    for hole in shell.holes:
        chords = arc_chords(hole.radius, math.tau, tolerance)
        drill = m3.Manifold.cylinder(1.01 * shell.outer, hole.radius, circular_segments=chords)
        body -= drill.transform(np.column_stack((np.array(axis_frame(hole.axis)).T, np.zeros(3))))
    return body


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


def _rounded(corners: Array) -> Array:
    return np.round(corners, DECIMALS) + 0.0


def _require_few(count: int, name: str) -> None:
    if count > CORNERS_MAX:
        text = f"--tolerance: the mesh of the {name} takes more than {CORNERS_MAX} corners; use a "
        raise GenevaError(f"{text}larger tolerance")


def _no_wall(name: str) -> GenevaError:
    text = f"{name}: its outline and holes leave no wall, so it has no mesh; use a smaller "
    return GenevaError(f"{text}--tolerance")

"""Plates and shells of a sphere as closed solids, between two faces or two spheres.

All contours have the material on their left. Seen from outside, each wall is then bounded
counterclockwise: the lower edge, up at its end, the upper edge back, and down at its start. Walls
of a plate are planes, cylinders and extruded splines. Of a shell they are cones with their apex in
the centre, over an arc of one region only; common arcs of two regions are edges within a sphere.
Round holes are cylinders, whose axis goes through the centre of a shell.
"""

import math
from itertools import pairwise

from geneva_cli.geometry.plates import Plate, Shell, with_material_left
from geneva_cli.geometry.shapes import Arc, Circle, Line, Point
from geneva_cli.geometry.sphere import POLE, SphereArc, Vector, cross, opposite, square_to, unit
from geneva_cli.output.solid_part import plate_contours
from geneva_cli.output.splines import Piece, Spline, pieces
from geneva_cli.output.step.entities import AHEAD, DIRECTION, ORIGIN, Entities, listed, real

FLAT = 1e-12  # cosine of a cone's angle below which it is a plane


def plate_solid(file: Entities, plate: Plate) -> str:
    """Write a plate, and return its MANIFOLD_SOLID_BREP."""
    faces: list[str] = []
    loops: tuple[list[str], list[str]] = [], []  # of the lower and the upper face
    levels = plate.low, plate.high
    outside = True
    for shape in plate_contours(plate):
        lower, upper = list[tuple[str, bool]](), list[tuple[str, bool]]()
        if isinstance(shape, Circle):
            frame = (*shape.centre, 0.0), POLE, AHEAD
            low, high, wall = file.tube(shape.radius, levels, outside, frame)
            faces.append(wall)
            lower.append((low, not outside))
            upper.append((high, outside))
        else:
            own = pieces(with_material_left(shape, outside).segments)
            corners = [file.rise([(*piece.start, z) for z in levels], POLE) for piece in own]
            ends = pairwise([*corners, corners[0]])
            for piece, (start, end) in zip(own, ends, strict=True):
                curves = [_curve(file, piece, z) for z in levels]
                # arcs that turn clockwise run against their curve
                along = not isinstance(piece, Arc) or piece.bulge > 0.0
                low, high = (file.edge(start[k], end[k], curves[k], along) for k in (0, 1))
                sides = [(low, True), (end[2], True), (high, False), (start[2], False)]
                around = file.loop(sides)
                # a cylinder's own normal points away from its axis, that of the others to the right
                faces.append(file.face([around], _surface(file, piece, plate), along))
                lower.insert(0, (low, False))
                upper.append((high, True))
        loops[0].append(file.loop(lower))
        loops[1].append(file.loop(upper))
        outside = False
    for k, z in enumerate(levels):
        level = file.add(f"PLANE('',{file.placement((0.0, 0.0, z))})")
        faces.append(file.face(loops[k], level, k == 1))
    return file.closed_solid(faces)


def _curve(file: Entities, piece: Piece, z: float) -> str:
    """Return the text of a piece's curve at a height."""
    if isinstance(piece, Line):
        return file.line((*piece.start, z), (*_unit(piece), 0.0))
    if isinstance(piece, Arc):
        return file.circle((*piece.centre, z), piece.radius)
    points = listed([file.point((*pole, z)) for pole in piece.poles])
    count, knots = _knots(piece)
    return (
        f"B_SPLINE_CURVE_WITH_KNOTS('',3,{points},.UNSPECIFIED.,.F.,.F.,{count},{knots},"
        ".UNSPECIFIED.)"
    )


def _surface(file: Entities, piece: Piece, plate: Plate) -> str:
    """Write the surface over a piece."""
    if isinstance(piece, Line):
        x, y = _unit(piece)
        place = file.placement((*piece.start, plate.low), (y, -x, 0.0), (x, y, 0.0))
        return file.add(f"PLANE('',{place})")
    if isinstance(piece, Arc):
        place = file.placement((*piece.centre, plate.low))
        return file.shared(f"CYLINDRICAL_SURFACE('',{place},{real(piece.radius)})")
    # The surface is a spline too: kernels integrate between knots, which they do not find in an
    # extruded curve.
    levels = plate.low, plate.high
    poles = listed([listed([file.point((*p, z)) for z in levels]) for p in piece.poles])
    count, knots = _knots(piece)
    return file.add(
        f"B_SPLINE_SURFACE_WITH_KNOTS('',3,1,{poles},.UNSPECIFIED.,.F.,.F.,.F.,{count},(2,2),"
        f"{knots},(0.,1.),.UNSPECIFIED.)"
    )


def _knots(spline: Spline) -> tuple[str, str]:
    """Return the multiplicity of each knot, two where it is once differentiable, and the knots."""
    ends = spline.knots
    count = listed(["4", *["2"] * (len(ends) - 2), "4"])
    return count, listed([real(end / ends[-1], DIRECTION) for end in ends])


def _unit(line: Line) -> Point:
    (x0, y0), (x1, y1) = line
    length = math.dist(line.start, line.end)
    return (x1 - x0) / length, (y1 - y0) / length


def shell_solid(file: Entities, shell: Shell) -> str:
    """Write a shell, and return its MANIFOLD_SOLID_BREP."""
    edges = _Edges(file, shell)
    arcs = {arc.key for region in shell.regions for arc in region.boundary}
    bored = []
    for hole in shell.holes:
        levels = [math.sqrt((r - hole.radius) * (r + hole.radius)) for r in edges.radii]
        frame = ORIGIN, hole.axis, square_to(hole.axis)
        bored.append(file.tube(hole.radius, levels, False, frame))
    faces = [wall for _, _, wall in bored]
    for region in shell.regions:
        sides = [edges.side(arc) for arc in region.boundary]
        # a sphere whose poles and seam are away from the region
        sideways = cross(POLE, region.middle)
        axis = unit(sideways) if math.hypot(*sideways) > FLAT else (1.0, 0.0, 0.0)
        place = file.placement(ORIGIN, axis, unit(opposite(region.middle)))
        for k, radius in enumerate(edges.radii):
            high = k == 1
            around = [(own[k], along is high) for *own, along in sides]
            bounds = [file.loop(around if high else around[::-1])]
            if region is shell.regions[-1]:
                bounds += [file.loop([(hole[k], not high)]) for hole in bored]
            sphere = file.add(f"SPHERICAL_SURFACE('',{place},{real(radius)})")
            faces.append(file.face(bounds, sphere, high))
        for arc, side in zip(region.boundary, sides, strict=True):
            if arc.back.key not in arcs:
                faces.append(edges.wall(arc, side))
    return file.closed_solid(faces)


class _Edges:
    """The edges of a shell, each written once."""

    def __init__(self, file: Entities, shell: Shell) -> None:
        self.file, self.radii = file, (shell.inner, shell.outer)
        self.corners: dict[Vector, tuple[str, str, str]] = {}  # a vertex on each sphere, and a rise
        # edges over an arc on both spheres, and whether they run along it
        self.sides: dict[tuple[Vector, Vector, Vector], tuple[str, str, bool]] = {}

    def side(self, arc: SphereArc) -> tuple[str, str, bool]:
        """The edges over an arc."""
        if arc.back.key in self.sides:
            return *self.sides[arc.back.key][:2], False
        start, end = self._corner(arc.start), self._corner(arc.end)
        axis, angle = _cone(arc)
        edges = []
        for k, radius in enumerate(self.radii):
            middle, across = _times(axis, radius * math.cos(angle)), radius * math.sin(angle)
            circle = self.file.circle(middle, across, axis, arc.frame[0])
            edges.append(self.file.edge(start[k], end[k], circle, not _wide(arc)))
        self.sides[arc.key] = edges[0], edges[1], True
        return self.sides[arc.key]

    def _corner(self, at: Vector) -> tuple[str, str, str]:
        if at not in self.corners:
            self.corners[at] = self.file.rise([_times(at, radius) for radius in self.radii], at)
        return self.corners[at]

    def wall(self, arc: SphereArc, side: tuple[str, str, bool]) -> str:
        """Write the wall over an arc."""
        low, high, along = side
        up, down = self._corner(arc.end)[2], self._corner(arc.start)[2]
        bound = self.file.loop([(low, along), (up, True), (high, not along), (down, False)])
        # a cone's own normal points away from its axis, which may be on the material's side
        axis, angle = _cone(arc)
        if math.cos(angle) < FLAT:
            frame = self.file.placement(ORIGIN, opposite(arc.axis), arc.frame[0])
            return self.file.face([bound], self.file.add(f"PLANE('',{frame})"), True)
        height, radius = math.cos(angle) * self.radii[0], math.sin(angle) * self.radii[0]
        frame = self.file.placement(_times(axis, height), axis, arc.frame[0])
        # the angle is in radians, with 16 decimals
        cone = f"CONICAL_SURFACE('',{frame},{real(radius)},{real(angle, 16)})"
        return self.file.face([bound], self.file.add(cone), not _wide(arc))


def _times(v: Vector, length: float) -> Vector:
    return v[0] * length, v[1] * length, v[2] * length


def _wide(arc: SphereArc) -> bool:
    """Return True if the circle's middle is nearer to the other end of its axis."""
    return math.cos(arc.angle) < 0.0


def _cone(arc: SphereArc) -> tuple[Vector, float]:
    """Return axis and angle of the cone through an arc, at most a right one."""
    return (opposite(arc.axis), math.pi - arc.angle) if _wide(arc) else arc[:2]

"""A reader of STEP files for tests: references, faces, edges and the volumes that they enclose.

It reads the entities of outlines that are extruded along z, and shares no code with the writer.
Volumes follow from the numbers in the file alone.
"""

import math
import re
from collections import Counter

TOKEN = re.compile(
    r"\s*(?:('(?:[^']|'')*')|(#\d+)|(\.[A-Z_]+\.)|([A-Z_0-9]+(?=\())|([-+0-9.E]+)|(.))"
)
GAUSS = [  # of eight points on -1..1
    (0.1834346424956498, 0.3626837833783620),
    (0.5255324099163290, 0.3137066458778873),
    (0.7966664774136267, 0.2223810344533745),
    (0.9602898564975363, 0.1012285362903763),
]


class File:
    """The instances of a file: ``of[7]`` is its entity's name and its values."""

    def __init__(self, text):
        assert text.startswith("ISO-10303-21;\nHEADER;")
        assert text.endswith("ENDSEC;\nEND-ISO-10303-21;\n")
        self.header, _, data = text.partition("DATA;\n")
        self.of = {}
        for line in data.partition("ENDSEC;")[0].splitlines():
            number, value = re.fullmatch(r"#(\d+)=(.*);", line).groups()
            assert int(number) not in self.of
            self.of[int(number)] = parsed(value)
        used = Counter(n for _, values in self.of.values() for n in references(values))
        assert set(used) <= set(self.of), "a reference leads nowhere"
        self.used = used

    def all(self, name):
        """Numbers of an entity's instances."""
        return [number for number, (kind, _) in self.of.items() if kind == name]

    def values(self, number, name=""):
        kind, values = self.of[number]
        assert name in ("", kind), (kind, name)
        return values

    def point(self, number):
        return tuple(self.values(number, "CARTESIAN_POINT")[1])

    def direction(self, number):
        way = tuple(self.values(number, "DIRECTION")[1])
        assert abs(math.hypot(*way) - 1.0) < 1e-15
        return way

    def frame(self, number):
        """Origin, axis and x of a placement."""
        _, origin, axis, ahead = self.values(number, "AXIS2_PLACEMENT_3D")
        axis, ahead = self.direction(axis), self.direction(ahead)
        assert abs(dot(axis, ahead)) < 1e-15
        return self.point(origin), axis, ahead

    def vertex(self, number):
        return self.point(self.values(number, "VERTEX_POINT")[1])


def parsed(text):
    """An instance: its entity's name and a list of values; several entities have the name "" """
    tokens = [next(t for t in m.groups() if t) for m in TOKEN.finditer(text)]
    at = 0

    def one():
        nonlocal at
        token = tokens[at]
        at += 1
        if token == "(":
            return many()
        if token[0] == "'":
            return token[1:-1]
        if token[0] == "#":
            return Reference(token[1:])
        if token in ("$", "*") or (token[0] == "." and token[1:2].isalpha()):
            return token
        if at < len(tokens) and tokens[at] == "(":
            at += 1
            return token, many()
        return float(token)

    def many():
        nonlocal at
        out = []
        while tokens[at] != ")":
            if tokens[at] == ",":
                at += 1
            else:
                out.append(one())
        at += 1
        return out

    value = one()
    assert at == len(tokens)
    return value if isinstance(value, tuple) else ("", value)


def less_sine(turn):
    """turn - sin(turn), for small angles by its series, since the difference would cancel."""
    if turn > 1.0:
        return turn - math.sin(turn)
    return sum((-1) ** k * turn ** (2 * k + 3) / math.factorial(2 * k + 3) for k in range(9))


class Reference(int):
    """The number of an instance."""


def references(values):
    for value in values:
        if isinstance(value, Reference):
            yield value
        elif isinstance(value, list | tuple):
            yield from references(value)


def de_boor(poles, knots, t):
    """A cubic B-spline's point and its derivative, by de Boor's triangle."""
    k = max(i for i in range(3, len(poles)) if knots[i] <= t)
    d = [poles[j] for j in range(k - 3, k + 1)]
    for r in (1, 2, 3):
        if r == 3:
            rate = [3.0 * (q - p) / (knots[k + 1] - knots[k]) for p, q in zip(*d, strict=True)]
        d = [mixed(d[i : i + 2], t, *knots_of(knots, k, r, i)) for i in range(len(d) - 1)]
    return d[0], rate


def knots_of(knots, k, r, i):
    """The knots between which a step of de Boor's mixes."""
    j = k - 3 + r + i
    return knots[j], knots[j + 4 - r]


def mixed(pair, t, low, high):
    share = (t - low) / (high - low)
    return tuple((1.0 - share) * p + share * q for p, q in zip(*pair, strict=True))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


class Solid:
    """A MANIFOLD_SOLID_BREP, whose faces are checked for consistency with edges and surfaces."""

    def __init__(self, file, number):
        self.file = file
        _, shell = file.values(number, "MANIFOLD_SOLID_BREP")
        self.faces = file.values(shell, "CLOSED_SHELL")[1]
        assert all(file.used[face] == 1 for face in self.faces)
        self.off = 0.0  # mm, by which vertices miss the curves and surfaces they are on
        sides, vertices, self.loops = [], set(), 0
        for face in self.faces:
            for edges in self.bounds(face):
                self.loops += 1
                for (edge, sense), (following, other) in zip(
                    edges, [*edges[1:], edges[0]], strict=True
                ):
                    assert self.ends(edge)[sense] == self.ends(following)[not other]
                    sides.append((edge, sense))
                    vertices.update(self.ends(edge))
        # each edge twice, once in each direction
        assert set(Counter(sides).values()) == {1}
        assert all((edge, not sense) in set(sides) for edge, sense in sides)
        edges = {edge for edge, _ in sides}
        for edge in edges:
            self.hold(edge)
        self.euler = len(vertices) - len(edges) + 2 * len(self.faces) - self.loops

    def bounds(self, face):
        """A face's loops, the outer one first: pairs of an edge, and True if it is run forwards."""
        bounds = self.file.values(face, "ADVANCED_FACE")[1]
        assert [self.file.of[b][0] for b in bounds] == [
            "FACE_OUTER_BOUND",
            *["FACE_BOUND"] * (len(bounds) - 1),
        ]
        for bound in bounds:
            _, loop, along = self.file.values(bound)
            assert along == ".T."
            edges = self.file.values(loop, "EDGE_LOOP")[1]
            oriented = [self.file.values(edge, "ORIENTED_EDGE") for edge in edges]
            yield [(edge, sense == ".T.") for _, _, _, edge, sense in oriented]

    def ends(self, edge):
        """Vertices at the start and the end, as numbers."""
        return self.file.values(edge, "EDGE_CURVE")[1:3]

    def hold(self, edge):
        """Assert that an edge runs along its curve, and note how far its ends miss it."""
        _, start, end, curve, along = self.file.values(edge)
        ends = [self.file.vertex(v) for v in (start, end)]
        if along == ".F.":
            ends.reverse()
        kind, values = self.file.of[curve]
        if kind == "LINE":
            origin, way = self.file.point(values[1]), self.file.values(values[2], "VECTOR")
            way = self.file.direction(way[1])
            for p in ends:
                v = [a - b for a, b in zip(p, origin, strict=True)]
                rest = [a - dot(v, way) * b for a, b in zip(v, way, strict=True)]
                self.off = max(self.off, math.hypot(*rest))
            assert dot([b - a for a, b in zip(*ends, strict=True)], way) > 0.0
        elif kind == "CIRCLE":
            origin, axis, _ = self.file.frame(values[1])
            assert axis == (0.0, 0.0, 1.0)
            for p in ends:
                assert p[2] == origin[2]
                self.off = max(self.off, abs(math.dist(p, origin) - values[2]))
        else:
            poles = [self.file.point(p) for p in self.poles(curve)]
            self.off = max(self.off, math.dist(poles[0], ends[0]), math.dist(poles[-1], ends[1]))

    def poles(self, curve):
        return self.spline(curve)[0]

    def spline(self, curve):
        """Poles, and knots repeated by their multiplicities."""
        _, degree, poles, _, closed, crosses, counts, knots, _ = self.file.values(
            curve, "B_SPLINE_CURVE_WITH_KNOTS"
        )
        assert (degree, closed, crosses) == (3, ".F.", ".F.")
        assert len(poles) == sum(counts) - 4
        return poles, [k for k, n in zip(knots, counts, strict=True) for _ in range(int(n))]

    def swept(self, edge, sense):
        """Integral of x dy along an edge, forwards if ``sense``."""
        _, start, end, curve, along = self.file.values(edge)
        (x0, y0, _), (x1, y1, _) = self.file.vertex(start), self.file.vertex(end)
        kind, values = self.file.of[curve]
        sign = 1.0 if sense else -1.0
        if kind == "LINE":
            return sign * 0.5 * (x0 + x1) * (y1 - y0)
        if kind == "CIRCLE":
            (cx, cy, _), r = self.file.frame(values[1])[0], values[2]
            a, b = math.atan2(y0 - cy, x0 - cx), math.atan2(y1 - cy, x1 - cx)
            way = 1.0 if along == ".T." else -1.0
            turn = way * (b - a) % math.tau or math.tau
            if turn < 1.0:  # the chord of a flat arc is more accurate than its distant centre
                turn = 2.0 * math.asin(0.5 * math.dist((x0, y0), (x1, y1)) / r)
            whole = 0.5 * (x0 + x1) * (y1 - y0) + way * 0.5 * r * r * less_sine(turn)
            return sign * whole
        poles, knots = self.spline(curve)
        p = [self.file.point(n)[:2] for n in poles]
        total = 0.0
        for a, b in zip(knots, knots[1:], strict=False):
            for node, weight in [(s * n, w) for n, w in GAUSS for s in (-1.0, 1.0)] * (a < b):
                (x, _), (_, dy) = de_boor(p, knots, 0.5 * (a + b) + 0.5 * (b - a) * node)
                total += 0.5 * (b - a) * weight * x * dy
        return sign * total

    def volumes(self):
        """The volume, twice by the divergence theorem: of (0, 0, z) and of (x, 0, 0).

        The first takes the faces that are level, the second those that stand.
        """
        level = standing = 0.0
        for face in self.faces:
            _, _, surface, same = self.file.values(face)
            kind, values = self.file.of[surface]
            axis = self.file.frame(values[1])[1] if kind == "PLANE" else (0.0, 0.0, 0.0)
            loops = list(self.bounds(face))
            if kind == "PLANE" and abs(axis[2]) == 1.0:
                origin = self.file.frame(values[1])[0]
                up = axis[2] if same == ".T." else -axis[2]
                inside = up * sum(self.swept(*side) for loop in loops for side in loop)
                assert inside > 0.0, "a face is bounded the wrong way round"
                level += up * origin[2] * inside
                continue
            (sides,) = loops
            low, rise, high, down = sides
            heights = [self.file.vertex(self.ends(e)[0])[2] for e, _ in (low, high)]
            assert rise[1] and not down[1]
            self.faces_outwards(face, low)
            standing += self.swept(*low) * (heights[1] - heights[0])
        return level, standing

    def faces_outwards(self, face, side):
        """Assert that a face's normal points to the right of its lower edge."""
        _, _, surface, same = self.file.values(face)
        kind, values = self.file.of[surface]
        sign = 1.0 if same == ".T." else -1.0
        edge, sense = side
        _, start, _, curve, along = self.file.values(edge)
        forwards = 1.0 if sense == (along == ".T.") else -1.0
        x, y, _ = self.file.vertex(start)
        if kind == "PLANE":
            way = self.file.direction(self.file.values(self.file.values(curve)[2])[1])
            right = (forwards * way[1], -forwards * way[0], 0.0)
            origin, normal, _ = self.file.frame(values[1])
            assert sign * dot(normal, right) > 1.0 - 1e-14
            self.off = max(self.off, abs(dot((x - origin[0], y - origin[1], 0.0), normal)))
        elif kind == "CYLINDRICAL_SURFACE":
            (cx, cy, _), axis, _ = self.file.frame(values[1])
            assert axis == (0.0, 0.0, 1.0)
            assert self.file.frame(self.file.values(curve, "CIRCLE")[1])[0][:2] == (cx, cy)
            assert sign == forwards  # a circle's right is away from its centre
            self.off = max(self.off, abs(math.hypot(x - cx, y - cy) - values[2]))
        else:
            assert kind == "B_SPLINE_SURFACE_WITH_KNOTS"
            (_, along, up, rows, *_, counts, levels, knots, heights, _) = values
            _, degree, poles, *_, own_counts, own_knots, _ = self.file.values(curve)
            assert (along, counts, knots) == (degree, own_counts, own_knots)
            assert (up, levels, heights) == (1, [2, 2], [0.0, 1.0])
            for low, (foot, head) in zip(poles, rows, strict=True):
                assert foot == low
                assert self.file.point(foot)[:2] == self.file.point(head)[:2]
                assert self.file.point(foot)[2] < self.file.point(head)[2]
            assert sign == forwards

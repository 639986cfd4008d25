"""Pieces of SVG in the place of their shape, and path data: the letters of a ``d`` attribute.

Points are complex numbers.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.shapes import Arc, Line
from geneva_cli.output.foreign.drawn import bezier_pieces, ellipse_pieces

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
# the numbers of each letter of a path
COUNTS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}


class Affine(NamedTuple):
    """A transform of points z: ``turn`` z + ``flip`` conj(z) + ``shift``."""

    turn: complex = 1 + 0j
    flip: complex = 0j
    shift: complex = 0j

    def __call__(self, z: complex) -> complex:
        """The image of a point."""
        return self.turned(z) + self.shift

    def turned(self, z: complex) -> complex:
        """The image of a direction."""
        return self.turn * z + self.flip * z.conjugate()

    def after(self, other: Affine) -> Affine:
        """This one after another."""
        turn = self.turn * other.turn + self.flip * other.flip.conjugate()
        flip = self.turn * other.flip + self.flip * other.turn.conjugate()
        return Affine(turn, flip, self(other.shift))


def matrix(a: float, b: float, c: float, d: float, e: float = 0.0, f: float = 0.0) -> Affine:
    """The transform x' = a x + c y + e, y' = b x + d y + f."""
    turn, flip = complex(a + d, b - c), complex(a - d, b + c)
    return Affine(0.5 * turn, 0.5 * flip, complex(e, f))


class Traced:
    """The pieces of shapes, each with the transform of its place."""

    def __init__(self) -> None:
        self.pieces: list[Line | Arc] = []
        self.is_exact = True
        self.frame = Affine()

    def line(self, p: complex, q: complex) -> None:
        """Add a line."""
        p, q = self.frame(p), self.frame(q)
        self.pieces.append(Line((p.real, p.imag), (q.real, q.imag)))

    def curve(self, poles: Sequence[complex]) -> None:
        """Add a quadratic or cubic Bézier curve, as arcs."""
        self.pieces += bezier_pieces([self.frame(z) for z in poles])
        self.is_exact = False

    def ellipse(
        self, centre: complex, major: complex, minor: complex, start: float, sweep: float
    ) -> None:
        """Add a part of an ellipse from its half axes, as arcs; angles are parameters, radians."""
        p, q, (c, s) = _axes(self.frame.turned(major), self.frame.turned(minor))
        if min(abs(p), abs(q)) <= 1e-9 * max(abs(p), abs(q)):
            raise GenevaError("a circle or ellipse has no width: remove it")
        shift = cmath.phase(complex(c, s))
        self.pieces += ellipse_pieces(self.frame(centre), (p, q), (start - shift, sweep))


def _axes(p: complex, q: complex) -> tuple[complex, complex, tuple[float, float]]:
    """Return the half axes, at right angles, of the ellipse p cos t + q sin t.

    The last pair has cosine and sine of the t at which the first of them is reached.
    """
    t = 0.5 * math.atan2(2.0 * (p.conjugate() * q).real, abs(p) ** 2 - abs(q) ** 2)
    c, s = math.cos(t), math.sin(t)
    return p * c + q * s, q * c - p * s, (c, s)


def trace_path(data: str, out: Traced) -> None:
    """Add the pieces of path data. Raises GenevaError, with the place, for what it cannot read."""
    at = first = 0j
    before = ("", 0j)  # the last letter, and the last pole of its curve
    for letter, v in _commands(data):
        kind, relative = letter.upper(), letter.islower()
        base = at if relative else 0j
        if kind == "M":
            at = first = base + complex(*v)
            before = ("M", at)
            continue
        pole = at
        if kind == "Z":
            end = first
        elif kind == "H":
            end = complex(v[0] + base.real, at.imag)
        elif kind == "V":
            end = complex(at.real, v[0] + base.imag)
        else:
            end = base + complex(*v[-2:])
        if kind in "CSQT":
            poles = [base + complex(*pair) for pair in zip(v[:-2:2], v[1:-2:2], strict=True)]
            if kind in "ST":
                alike = before[0] in ("CS" if kind == "S" else "QT")
                poles.insert(0, 2.0 * at - before[1] if alike else at)
            pole = poles[-1]
            out.curve((at, *poles, end))
        elif kind == "A":
            _elliptical_arc(at, end, v, out)
        elif kind != "Z" or end != at:
            out.line(at, end)
        at, before = end, (kind, pole)


def _commands(data: str) -> Iterator[tuple[str, list[float]]]:
    """Yield letters with their numbers; a letter may be left out where it repeats."""
    text, place, letter = data.strip(), 0, ""
    if text and text[0] not in "Mm":
        raise GenevaError(f'a path must begin with M, not with "{cut(text, 20)}"')
    while place < len(text):
        if text[place].isspace() or text[place] == ",":
            place += 1
            continue
        if text[place].isalpha():
            letter = text[place]
            place += 1
        if letter.upper() not in COUNTS:
            shown = cut(text[place - 1 : place + 20], 20)
            raise GenevaError(f'a path has "{shown}": unknown letter')
        values: list[float] = []
        for k in range(COUNTS[letter.upper()]):
            # the flags of an arc may stand without a space between them
            form = r"[01]" if letter in "Aa" and k in (3, 4) else NUMBER
            found = re.compile(rf"[\s,]*({form})").match(text, place)
            if not found:
                raise GenevaError(
                    f'a path breaks off at "{cut(text[place : place + 20], 20)}", where {letter} '
                    f"needs {COUNTS[letter.upper()]} numbers"
                )
            values.append(float(found[1]))
            place = found.end()
        yield letter, values
        letter = {"M": "L", "m": "l", "Z": "", "z": ""}.get(letter, letter)


def _elliptical_arc(start: complex, end: complex, v: list[float], out: Traced) -> None:
    """Add an elliptical arc by its centre, from both ends as in SVG 1.1, appendix F.6.5."""
    rx, ry, turn = abs(v[0]), abs(v[1]), cmath.exp(1j * math.radians(v[2]))
    if not (rx and ry) or start == end:
        out.line(start, end)
        return
    half = 0.5 * (start - end) / turn
    x, y = half.real / rx, half.imag / ry
    size = math.hypot(x, y)
    if size > 1.0:  # too small to reach both ends
        rx, ry, x, y = rx * size, ry * size, x / size, y / size
        size = 1.0
    root = math.sqrt(max(1.0 - size * size, 0.0)) / size
    side = 1.0 if bool(v[3]) != bool(v[4]) else -1.0
    middle = complex(y, -x) * root * side  # in the frame in which it is the unit circle
    first, last = complex(x, y) - middle, complex(-x, -y) - middle
    sweep = cmath.phase(last / first)
    if v[4] and sweep < 0.0:
        sweep += math.tau
    elif not v[4] and sweep > 0.0:
        sweep -= math.tau
    centre = 0.5 * (start + end) + complex(middle.real * rx, middle.imag * ry) * turn
    out.ellipse(centre, rx * turn, ry * 1j * turn, cmath.phase(first), sweep)

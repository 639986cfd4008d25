"""Path data of SVG: the letters and numbers of a ``d`` attribute as lines, arcs and curves."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
COUNTS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}


class Move(NamedTuple):
    """A piece of a path; points are complex numbers.

    ``L`` has both ends, ``C`` the poles of a Bézier curve, ``A`` the centre of an ellipse and its
    two half axes, with ``span`` the first parameter and how far it goes on, radians.
    """

    kind: str
    points: tuple[complex, ...]
    span: tuple[float, float] = (0.0, 0.0)


def numbers(text: str) -> list[float]:
    """Return the numbers in a text, separated by spaces or commas.

    >>> numbers("1,2.5-3e1.5")
    [1.0, 2.5, -30.0, 0.5]
    """
    return [float(number) for number in re.findall(NUMBER, text)]


def moves(data: str) -> Iterator[Move]:
    """Yield the pieces of path data. Raises GenevaError, with the place, for what it cannot read.

    >>> [move.kind for move in moves("M0 0H4a2 2 0 0 1-4 0z")]
    ['L', 'A']
    """
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
            end = complex(v[0] + (at.real if relative else 0.0), at.imag)
        elif kind == "V":
            end = complex(at.real, v[0] + (at.imag if relative else 0.0))
        else:
            end = base + complex(*v[-2:])
        if kind in "CSQT":
            poles = [base + complex(*pair) for pair in zip(v[:-2:2], v[1:-2:2], strict=True)]
            if kind in "ST":
                alike = before[0] in ("CS" if kind == "S" else "QT")
                poles.insert(0, 2.0 * at - before[1] if alike else at)
            pole = poles[-1]
            yield Move("C", (at, *poles, end))
        elif kind == "A":
            yield _arc(at, end, v)
        elif kind != "Z" or end != at:
            yield Move("L", (at, end))
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
            raise GenevaError(
                f'a path has "{cut(text[place - 1 : place + 20], 20)}": unknown letter'
            )
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
        if letter in "Zz":
            letter = ""
        letter = {"M": "L", "m": "l"}.get(letter, letter)


def _arc(start: complex, end: complex, v: list[float]) -> Move:
    """An elliptical arc by its centre, as SVG 1.1, appendix F.6.5, derives it from both ends."""
    rx, ry, turn = abs(v[0]), abs(v[1]), cmath.exp(1j * math.radians(v[2]))
    if not (rx and ry) or start == end:
        return Move("L", (start, end))
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
    return Move("A", (centre, rx * turn, ry * 1j * turn), (cmath.phase(first), sweep))

"""Witnesses of the laws of curved slots: the standard ones, and those of a file."""

import math
import random
from itertools import pairwise

import numpy as np
import spline_witness
from spline_witness import derivatives
from witness import PolynomialLaw, SineLaw, mp
from words import LAWS

from exact.compared import PEAKS, PICK, candidates, greatest
from exact.rates import exactly


class Series:
    """A law of the witness, piece by piece, with derivatives up to the fifth."""

    def __init__(self, law):
        self.law = law
        self.pieces = (
            [(p[0], p[1]) for p in law.pieces] if isinstance(law, SineLaw) else [(0, mp.mpf(1))]
        )

    def inside(self, i, u):
        if isinstance(self.law, PolynomialLaw):
            return self.law(u, 5)
        return [v / self.law.whole for v in SineLaw._inside(self.law.pieces[i], u, 5)]

    def at(self, u):
        u = min(max(u, mp.mpf(0)), mp.mpf(1))
        i = next(i for i, (_, end) in enumerate(self.pieces) if u <= end)
        return self.inside(i, u)

    def peaks(self):
        """Greatest sizes as a function of u, one unit of step and of time."""
        out = {}
        for name in ("position", *PEAKS):
            found = []
            for i, (a, b) in enumerate(self.pieces):
                grid = [
                    a + (b - a) * (mp.mpf(k) + (mp.mpf("0.01") if 0 < k < 96 else 0)) / 96
                    for k in range(97)
                ]

                def shifted(u, i=i):
                    s, *rest = self.inside(i, u)
                    return (s - mp.mpf(1) / 2, *rest)

                found += candidates(shifted, name, grid)
            out[name] = greatest(found)
        return out


class Points(Series):
    """The law through a file's points."""

    def __init__(self, u, s):
        x = exactly(u)
        self.spline = spline_witness.Spline(x, exactly(s), False)
        self.pieces = list(pairwise(x))
        self.law_pieces = self.spline.pieces()
        # of a unit of each point's last place: the change of each piece's coefficients
        last = np.array([math.ulp(v) for v in s])
        unit_pieces = np.array([[[float(v) for v in c] for c in part] for part in self.spline.unit])
        self.changes = unit_pieces * last[:, None, None]

    def inside(self, i, u):
        return derivatives(self.law_pieces[i], u - self.pieces[i][0])

    def peaks(self):
        """As above, over the whole law, which has no jump that matters."""
        grid = [a + (b - a) * k / 8 for a, b in self.pieces for k in range(8)] + [mp.mpf(1)]

        def shifted(u):
            s, *rest = self.at(u)
            return (s - mp.mpf(1) / 2, *rest)

        out = {}
        for name in ("position", *PEAKS):
            found = candidates(shifted, name, grid)
            out[name] = greatest([self._with_points(shifted, name, c) for c in found])
        return out

    def _with_points(self, f, name, found):
        """A stationary point's shift, with the last place of any one point."""
        if not found.shift:
            return found
        i = max(k for k, (a, _) in enumerate(self.pieces) if a <= found.x)
        here, shift = f(found.x), found.shift
        slope, bend = PICK[name](here)[1:]
        for change in self.changes[:, i]:
            by = derivatives([mp.mpf(float(c)) for c in change], found.x - self.pieces[i][0])
            moved = PICK[name]([a + b for a, b in zip(here, by, strict=True)])[1]
            shift = max(shift, abs((moved - slope) / bend))
        return found._replace(shift=shift)

    def moves(self, u):
        """What the last place of any one point moves: position to jerk at each of u."""
        x = np.array([float(a) for a, _ in self.pieces])
        i = np.clip(np.searchsorted(x, u, "right") - 1, 0, len(x) - 1)
        c = np.moveaxis(self.changes[:, i], -1, 0)
        return [np.abs(v).max(axis=0) for v in derivatives(c, u - x[i])[:4]]


def point_cases(sample):
    """Points of a law as they come: with all digits, a few, close, uneven, few."""
    rng = random.Random(3)

    def smooth(u):
        return u**4 * (35.0 - u * (84.0 - u * (70.0 - 20.0 * u)))

    for n in (12,) if sample else (6, 12, 41, 61):
        even = [k / (n - 1) for k in range(n)]
        uneven = [0.0, *sorted(v + rng.uniform(-0.3, 0.3) / n for v in even[1:-1]), 1.0]
        for digits in (17,) if sample else (17, 6):
            for u in (even, uneven):
                yield u, [0.0, *[round(smooth(v), digits) for v in u[1:-1]], 1.0]


def law_cases(sample):
    for name in LAWS:
        yield name, 0.0
    eighth = [0.125, math.nextafter(0.125, 0), math.nextafter(0.125, 1), 0.1249, 0.1251]
    shapes = [0.125, 10.0] if sample else [*eighth, 0.05, 0.25, 1e-9, 1.0, 10.0]
    for shape in shapes:
        yield "sine-group", shape
        yield "sine-group", -shape

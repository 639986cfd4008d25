"""Quintic splines of mpmath, from truncated powers: p(x) + sum of c_i (x - x_i)^5 past knot i.

The program has two unknowns a knot and elimination by blocks; here there is one dense system, of
values at the points and of derivatives at the ends, with as many digits as the powers cost.
"""

import math

from witness import mp


def powers(x, knots, k):
    """The k-th derivatives at x of 1, x, .. x^5 and of the knots' powers."""
    out = [math.perm(j, k) * x ** (j - k) if j >= k else mp.mpf(0) for j in range(6)]
    return out + [math.perm(5, k) * (x - t) ** (5 - k) if x > t else mp.mpf(0) for t in knots]


class Spline:
    """Through points (x, y), mpf; at rest at both ends."""

    def __init__(self, x, y):
        self.x, self.y = list(x), list(y)
        inner = self.x[1:-1]
        rows = [powers(v, inner, 0) for v in self.x]
        first, last = self.x[0], self.x[-1]
        rows += [powers(v, inner, k) for v in (first, last) for k in (1, 2)]
        inverse = mp.inverse(mp.matrix(rows))
        n = len(self.x)
        # of each point's unit spline, the coefficients of each piece about its left knot
        self.unit = [self._pieces([inverse[j, i] for j in range(n + 4)]) for i in range(n)]

    def _pieces(self, c):
        out = []
        for i, at in enumerate(self.x[:-1]):
            knots = self.x[1:-1][:i]
            rows = [powers(at, knots, k) for k in range(6)]
            # at its own knot a power's fifth derivative is already the one to the right
            if i:
                rows[5][5 + i] = mp.mpf(120)
            out.append(
                [
                    sum(a * b for a, b in zip(row, c, strict=False)) / math.factorial(k)
                    for k, row in enumerate(rows)
                ]
            )
        return out

    @staticmethod
    def _sum(parts):
        """The sum of pieces, each times a factor."""
        return [
            [sum(f * p[i][k] for f, p in parts) for k in range(6)] for i in range(len(parts[0][1]))
        ]

    def pieces(self, y=None):
        """Coefficients of each piece about its left knot, for these values at the points."""
        return self._sum(list(zip(y or self.y, self.unit, strict=True)))


def derivatives(c, t, whole=None):
    """Derivatives 0 to 5 of sum c_k t^k; ``whole``: of its integral, which is that at t = 0."""
    rates = [
        sum(math.perm(j, k) * v * t ** (j - k) for j, v in enumerate(c) if j >= k) for k in range(6)
    ]
    if whole is None:
        return rates
    return [whole + sum(v * t ** (j + 1) / (j + 1) for j, v in enumerate(c)), *rates[:5]]

"""Derivatives up to the fifth in mpmath, and variations of a drive's values."""

from witness import mp

DIGITS = 120  # A within 1e-12 of 1 costs a fourth derivative four times 12 of them, and more
BESIDE = mp.mpf(10) ** -60  # distance from a knot, on one side of it, below any digit compared
NEAR_1 = [1.0 - t for t in (1e-3, 1e-6, 1e-9, 1e-12)]


def angle_rates(Q):
    """arg Q and its derivatives 1..5, from Q and its own: the cumulants of Q'/Q."""
    a, b, c, d, e = (q / Q[0] for q in Q[1:])
    u = (
        a,
        b - a**2,
        c - 3 * a * b + 2 * a**3,
        d - 4 * a * c - 3 * b**2 + 12 * a**2 * b - 6 * a**4,
        e - 5 * a * d - 10 * b * c + 20 * a**2 * c + 30 * a * b**2 - 60 * a**3 * b + 24 * a**5,
    )
    return (mp.arg(Q[0]), *[x.imag for x in u])


def exactly(values):
    """Doubles as they are; whole numbers, which have no last place, stay whole."""
    return tuple(v if isinstance(v, int) else mp.mpf(v) for v in values)


def variations(values, h):
    """The values with each of them in turn moved by h."""
    return [
        tuple(v + (h if k == i and not isinstance(v, int) else 0) for k, v in enumerate(values))
        for i in range(len(values))
    ]

"""Motion and peaks of an engagement against those of a witness."""

import math
from typing import NamedTuple

import numpy as np
from witness import mp, to_radians

from exact.rates import DIGITS
from exact.table import strictly, ulps, unit

NAMES = ("position", "velocity", "acceleration", "jerk")
PEAKS = ("velocity", "acceleration", "jerk", "power")
# from the derivatives 0..5 of the wheel's angle: a quantity with its first two derivatives
PICK = {
    "position": lambda p: (p[0], p[1], p[2]),
    "velocity": lambda p: (p[1], p[2], p[3]),
    "acceleration": lambda p: (p[2], p[3], p[4]),
    "jerk": lambda p: (p[3], p[4], p[5]),
    "power": lambda p: (p[1] * p[2], p[2] ** 2 + p[1] * p[3], 3 * p[2] * p[3] + p[1] * p[4]),
}


def angles(engagement, even=9):
    """Input angles in degrees, ascending: evenly, and close to both ends, the middle, the cuts."""
    half = []
    for end in (engagement.entry_deg, engagement.exit_deg):
        near = [end]
        for _ in range(3):
            near.append(math.nextafter(near[-1], 0.0))
        half += near
        # 1e-15 rad is less than a double's step at most ends; 1e-13 degrees always more
        half += [end - math.copysign(d, end) for d in (1e-13, 1e-9, 1e-5, 0.01, 0.4999999, 0.51)]
        half += [end * t for t in (0.7499999999, 0.75, 0.7500000001, 1e-3, 1e-6, 1e-9, 1e-15)]
        half += [math.copysign(t, end) for t in (math.degrees(1e-15), 1e-15, 1e-12, 1e-4)]
        half += [end * (i + 0.37) / even for i in range(even)]
    inside = {x for x in half if engagement.entry_deg <= x <= engagement.exit_deg}
    return np.array(sorted({0.0, *inside}))


def values_at(engagement, x):
    """Position to jerk by each route through the program."""
    routes = [
        engagement.motion(x, 3).derivatives(),
        engagement.motion.derivatives(x),
        engagement.motion.derivatives(x[:-1]),
    ]
    some = x[:: max(1, len(x) // 7)]
    return routes, some, [engagement.motion(float(v), 3).derivatives() for v in some]


def compare(table, machine, engagement, x, exact, peak, condition, where):
    """Position to jerk at the angles x, by every route."""
    routes, some, numbers = strictly(values_at, engagement, x)
    place = [f"{where} at {v:.17g}" for v in x]
    for k, name in enumerate(NAMES):
        u, values = unit(peak[name]), [e[k] for e in exact]
        for route in routes:
            n = len(route[k])
            error = ulps(route[k], values[:n], u)
            table.add((machine, name), error, condition[k][:n], place[:n])
        at = np.searchsorted(x, some)
        one = ulps([n[k] for n in numbers], [values[i] for i in at], u)
        table.add((machine, name), one, condition[k][at], [place[i] for i in at])


def stationary(f, pick, places):
    """Roots of the slope between neighbouring places, by the Illinois method."""
    found = []
    slopes = [pick(f(x))[1] for x in places]
    for a, b, p, q in zip(places, places[1:], slopes, slopes[1:], strict=False):
        if p * q < 0:
            with mp.workdps(DIGITS):
                found.append(
                    mp.findroot(
                        lambda x: pick(f(x))[1],
                        (a, b),
                        solver="anderson",
                        tol=mp.mpf(10) ** -150,
                        verify=False,
                    )
                )
    return found, max(abs(s) for s in slopes)


class Found(NamedTuple):
    """A place that may be the greatest, and how its angle is conditioned (0: an end)."""

    size: object
    x: object
    shift: object = 0


def candidates(f, quantity, places, knots=()):
    """Ends and stationary points of a quantity, and knots, where its slope may jump."""
    pick = PICK[quantity]
    inner, steepest = stationary(f, pick, places)
    out = [Found(abs(pick(f(x))[0]), x) for x in (places[0], places[-1], *knots)]
    d = unit(steepest)
    for x in inner:
        value, _, bend = pick(f(x))
        # a double in the fifth derivative's place is not needed: jerk bends by p[5]
        out.append(Found(abs(value), x, d / abs(bend) if bend else mp.inf))
    return out


def greatest(found):
    """The best size, and the places that may be named: the first of equals, or nearly as great."""
    best = max(found, key=lambda c: c.size)
    near = [c for c in found if c.size >= best.size * (1 - mp.mpf(10) ** -12)]
    exact = mp.mpf(10) ** -30
    first = [c for c in near if not any(o.x < c.x and o.size >= c.size * (1 - exact) for o in near)]
    return best.size, first


def compare_peaks(table, machine, got, exact, half, where, more=None):
    """Sizes and angles; exact[quantity] = (size, places); ``more``: conditions of sizes."""
    for name in PEAKS:
        size, places = exact[name]
        p = getattr(got, name)
        row = f"peak {name}"
        error = ulps([p.max], [size], unit(size))
        table.add((machine, row), error, more[name] if more else 1.0, where)
        at = to_radians(p.at_deg)
        u = unit(half)
        nearest = min(places, key=lambda c: abs(c.x - at))
        error = ulps([0.0], [(at - nearest.x)], u)
        if at == 0 and abs(nearest.x) < 1e-12 * 2 * half:
            # the program takes a maximum so near to mid-motion, where two pieces of its search
            # meet, for that place: it says so in numerics/extremes.py
            error = np.zeros(1)
        table.add((machine, f"{row}, angle"), error, float(nearest.shift / u), where)

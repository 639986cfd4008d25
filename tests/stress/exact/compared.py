"""Motion of an engagement against that of a witness, by every route through the program."""

import math

import numpy as np

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


def angles(engagement):
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
        half += [end * (i + 0.37) / 5 for i in range(5)]
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

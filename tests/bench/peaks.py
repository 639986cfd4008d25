"""The peak acceleration of one design."""

import math
from functools import partial

import numpy as np
from witness import Geneva, mp

from bench.formulas import Proportions, acceleration, jerk
from bench.method import Method, Subject, Task
from geneva_cli.drives.crank import Crank
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.motion import registry
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import peak as program
from geneva_cli.motion.wheels import classic


def brentq(d, tolerance, scan=17):
    """Peak by SciPy's brentq on the slope between the points of a scan, or the value at the end."""
    from scipy.optimize import brentq as solve

    x = [d.half * i / (scan - 1) for i in range(scan)]
    slopes = [jerk(math, d, t) for t in x]
    best = abs(acceleration(math, d, d.half))
    for i in range(scan - 1):
        if slopes[i] * slopes[i + 1] < 0.0:
            root = solve(partial(jerk, math, d), x[i], x[i + 1], xtol=tolerance)
            best = max(best, abs(acceleration(math, d, root)))
    return best


def grid(d, n):
    """Greatest of n even points."""
    return float(np.abs(acceleration(np, d, np.linspace(0.0, d.half, n))).max())


def closed(d):
    """Peak for A = 0 outside, in the textbook form.

    cos a* = sqrt(q² + 2) - q, q = (1 + l²)/(4 l).
    """
    l = d.l
    q = (1.0 + l * l) / (4.0 * l)
    cosine = math.sqrt(q * q + 2.0) - q
    D = 1.0 - 2.0 * l * cosine + l * l
    return l * (1.0 - l * l) * math.sqrt(1.0 - cosine * cosine) / (D * D)


def peaks(quick):
    """Every method on a few designs."""
    designs = ((3, "external", 0.0), (6, "external", 0.6), (4, "internal", 0.95))
    tasks = [_task(*design, quick) for design in designs[: 2 if quick else None]]
    return Subject("Peak acceleration of one design", "relative error of the peak", tasks)


def _task(z, gearing, A, quick):
    wheel = registry.gearing(gearing)(z)
    d = Proportions.of(wheel.SIGN, z, A)
    methods = [
        Method("grid", 101, partial(grid, d, 101)),
        Method("scan of 17 + SciPy brentq", 1e-12, partial(brentq, d, 1e-12)),
    ]
    mechanism = build(Spec(wheel, SideCrank(A=A) if A else Crank()))
    engagement = mechanism.engagements[0]
    outside = wheel.SIGN > 0.0
    if not A and outside:
        l, gap = mechanism.ratio, classic.gap(wheel.SIGN, 1, z)
        methods += [
            Method("closed form of the textbook", None, partial(closed, d)),
            Method("ours", None, lambda: classic.acceleration_peak(l, gap)[0], True),
        ]
    ours = partial(program, engagement.motion, "acceleration")
    methods.append(Method("ours, as geneva peaks does", None, lambda: ours().max, True))
    name = f"{gearing}, z = {z}" + (f", A = {A:g}" if A else "")
    x, exact = 0.3 * d.half, Geneva(z, gearing, A).peak("acceleration")[0]
    return Task(
        name,
        "one evaluation of the formula in plain Python",
        lambda: acceleration(math, d, x),
        lambda peak: float(abs(mp.mpf(float(peak)) / exact - 1)),
        methods,
    )

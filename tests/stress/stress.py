"""Numerical stress against mpmath: `tests/stress/stress.py [--sample]`, part of `make stress`.

Every machine (the kinds of drive and the laws come from the program's registries) at the edge of
what a spec may hold. One row a machine and quantity, with the place where the program is worst:

- ``error``: in units in the last place of the quantity's own peak in that machine. For the angle
  of a peak, of the half motion angle; for the slot, of its farthest point from the wheel's axis.
- ``condition``: what one such unit of the problem itself moves there, in the same units: the
  largest of |dq/dx| ulp(x) for the input angle x, |dq/dp| ulp(p) for each value p of the drive
  (A, say) and, in the outer quarter of the motion, |dq/dx| ulp(entry angle). For a curved slot the
  entry angle counts everywhere: the law is laid over the motion from it. The angle of a peak moves
  by d(slope) / |second derivative| for d(slope) one unit of the slope's own peak, and by what one
  unit of p and of the engagement's mid-motion moves it. A slot also turns by one unit of the
  wheel's greatest angle.
- ``share``: error / max(1, condition), at most 16; else the exit status is 1.
- ``textbook``: the error there of the usual formulas in doubles, D = 1 - 2 l cos a + l² and so on
  with l = math.sin(math.pi / z), at its own worst place, and its share.

A curved slot's motion angle is a difference (alpha0_deg from the natural angle), and as
ill-conditioned as alpha0_deg is near its limit. It has a row of its own, in units of the larger of
the two; position to jerk are then compared for the motion angle that the program has.

Nothing may warn, raise a floating-point flag, hold a NaN or change NumPy's settings.
"""

import argparse
import bisect
import math
import random
import sys
import tempfile
import time
import warnings
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import machine_witness
import numpy as np
import spline_witness
from spline_witness import derivatives
from test_machines import CASES, ON_PATH
from witness import LAWS as LAW_WITNESSES
from witness import PolynomialLaw, SineLaw, krasniqi, mp
from words import LAWS, Motion, Spec, Wheel, law, load, points

from geneva_cli.analysis.peaks import peaks
from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine import spec as given
from geneva_cli.machine.drives.drive import Drive
from geneva_cli.machine.law_motion import MOTION_MIN
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.registry import DRIVES, GEARINGS
from geneva_cli.machine.wheels.classic_arrays import ClassicArrays
from geneva_cli.numerics.roots import TIE
from geneva_cli.parts.slot_profile import slot
from geneva_cli.parts.slot_sampling import nodes
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Size

LIMIT = 16.0
DIGITS = 120  # A within 1e-12 of 1 costs a fourth derivative four times 12 of them, and more
BESIDE = mp.mpf(10) ** -60  # of a knot: on one side of it, and at it by any digit asked for
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
SIGN = {"external": 1, "internal": -1}
NEAR_1 = [1.0 - t for t in (1e-3, 1e-6, 1e-9, 1e-12)]


def radians(deg):
    return mp.mpf(float(deg)) * mp.pi / 180


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


def chain(g, f):
    """Derivatives 0..5 of g(f(x)) (Faà di Bruno)."""
    g0, g1, g2, g3, g4, g5 = g
    _, a, b, c, d, e = f
    return (
        g0,
        g1 * a,
        g2 * a**2 + g1 * b,
        g3 * a**3 + 3 * g2 * a * b + g1 * c,
        g4 * a**4 + 6 * g3 * a**2 * b + g2 * (4 * a * c + 3 * b**2) + g1 * d,
        g5 * a**5
        + 10 * g4 * a**3 * b
        + g3 * (10 * a**2 * c + 15 * a * b**2)
        + g2 * (5 * a * d + 10 * b * c)
        + g1 * e,
    )


# Witnesses of drives: crank angle and derivatives 1..5 from the input angle, and the way back.


class Plain:
    """The crank itself."""

    values = ((),)
    few = ((),)

    @staticmethod
    def crank(_, phi):
        return (phi, mp.mpf(1), *[mp.mpf(0)] * 4)

    @staticmethod
    def input(_, f):
        return f

    @staticmethod
    def keys(_):
        return {}

    @staticmethod
    def textbook(_, phi):
        return phi, 1.0, 0.0, 0.0


class SideCrank:
    """f = arg(A + e^(i phi))."""

    few = ((0.6,), (1.0 - 1e-12,), (-1.0 + 1e-12,))
    values = tuple(
        (s * a,) for a in (1e-12, 0.1, 0.3, 0.6, 0.9, 0.97, *NEAR_1) for s in (1.0, -1.0)
    )

    @staticmethod
    def crank(values, phi):
        A, E = values[0], mp.expj(phi)
        f = phi + mp.arg(1 + A / E)
        return (f, *angle_rates((A + E, 1j * E, -E, -1j * E, E, 1j * E))[1:])

    @staticmethod
    def input(values, f):
        return f + mp.asin(values[0] * mp.sin(f))

    @staticmethod
    def keys(values):
        return {"A": values[0]}

    @staticmethod
    def textbook(values, phi):
        (A,), s, c = values, np.sin(phi), np.cos(phi)
        W = 1 + 2 * A * c + A * A
        up = A * (1 - A * A)
        third = up * ((1 + A * A) * c - 2 * A * c * c + 4 * A) / W**3
        # -: both are odd or even about mid-motion as the pin's own are
        return np.arctan2(s, A + c), (1 + A * c) / W, up * s / W**2, third


class Ellipses:
    """tan(f/2) = (1-e)/(1+e) tan(phi/2); a negative e is the quick phase."""

    few = ((0.5,), (1.0 - 1e-9,))
    values = tuple((s * a,) for a in (0.1, 0.6, 0.9, *NEAR_1[1:3]) for s in (1.0, -1.0))

    @staticmethod
    def crank(values, phi):
        e, s, c = values[0], mp.sin(phi / 2), mp.cos(phi / 2)
        rates = [((1 + e) * c, (1 - e) * s)]
        for _ in range(5):
            (x, y), h = rates[-1], mp.mpf(1) / 2
            rates.append((-h * y * (1 + e) / (1 - e), h * x * (1 - e) / (1 + e)))
        return tuple(2 * v for v in angle_rates([mp.mpc(x, y) for x, y in rates]))

    @staticmethod
    def input(values, f):
        e = values[0]
        return 2 * mp.arg(mp.mpc((1 - e) * mp.cos(f / 2), (1 + e) * mp.sin(f / 2)))

    @staticmethod
    def keys(values):
        return {"eccentricity": abs(values[0]), "phase": "slow" if values[0] >= 0 else "quick"}

    @staticmethod
    def textbook(values, phi):
        (e,), s, c = values, np.sin(phi), np.cos(phi)
        W = 1 + e * e + 2 * e * c
        up = 2 * e * (1 - e * e)
        third = up * ((1 + e * e) * c - 2 * e * c * c + 4 * e) / W**3
        f = 2 * np.arctan((1 - e) / (1 + e) * np.tan(phi / 2))
        return f, (1 - e * e) / W, up * s / W**2, third


class GearedSideCrank(SideCrank):
    """Noncircular gears with the side-crank's ratio."""

    few = ((0.6,),)
    values = ((0.3,), (-0.6,), (0.97,), (-1.0 + 1e-9,))


class Pair:
    """The first of two wheels carries the crank of the second: f = arg(1 - l e^(-i phi))."""

    few = ((3,), (4,))
    values = ((3,), (4,), (6,))

    @staticmethod
    def fits(values, gearing, z):
        """The second motion lies within one step of the first wheel."""
        return gearing == "external" and values[0] * (z - 2) <= 2 * z

    @staticmethod
    def crank(values, phi):
        C = mp.sin(mp.pi / values[0]) * mp.expj(-phi)
        return angle_rates((1 - C, *[-C * (-1j) ** k for k in range(1, 6)]))

    @staticmethod
    def input(values, f):
        return mp.asin(mp.sin(f) / mp.sin(mp.pi / values[0])).real - f

    @staticmethod
    def keys(values):
        return {"first_z": values[0]}

    @staticmethod
    def textbook(values, phi):
        return textbook_wheel(1, math.sin(math.pi / values[0]), phi)


class RatioFile:
    """Noncircular gears with a ratio from a file: the values are the ratio at its points."""

    kind, few = "noncircular-gears", ()

    def __init__(self, deg, ratio):
        self.deg, self.ratio = deg, ratio
        self.known = {}

    def pieces(self, values):
        """Knots, and of each piece the coefficients of the ratio and the crank's angle before."""
        if values not in self.known:
            if not self.known:
                x = [radians(v) for v in self.deg]
                self.spline = spline_witness.Spline(x, [*values, values[0]], True)
            out, whole = [], mp.mpf(0)
            for (a, b), c in zip(pairwise(self.spline.x), self.spline.pieces(values), strict=True):
                out.append((c, whole))
                whole = derivatives(c, b - a, whole)[0]
            scale = 2 * mp.pi / whole
            self.known[values] = [([v * scale for v in c], w * scale) for c, w in out]
        return self.spline.x, self.known[values]

    def crank(self, values, phi):
        x, pieces = self.pieces(values)
        turns = mp.floor(phi / (2 * mp.pi))
        at = phi - turns * 2 * mp.pi
        i = min(bisect.bisect_right(x, at), len(pieces)) - 1
        f, *rates = derivatives(pieces[i][0], at - x[i], pieces[i][1])
        return (f + turns * 2 * mp.pi, *rates)

    def input(self, values, f):
        phi = f
        for _ in range(60):
            at, rate = self.crank(values, phi)[:2]
            step = (at - f) / rate
            phi -= step
            if abs(step) < mp.mpf(10) ** (5 - DIGITS):
                break
        return phi

    def knots(self, values):
        """Input angles at which the ratio's pieces meet, of the turns around the first."""
        x = self.pieces(values)[0]
        return [v + turn * 2 * mp.pi for turn in (-1, 0, 1) for v in x]

    def keys(self, values):
        rows = zip(self.deg, (*values, values[0]), strict=True)
        return {"ratio": from_file(rows, registry.drive(self.kind), "ratio")}

    def textbook(self, _, phi):
        ratio = self.spline.by_scipy()
        whole = ratio.antiderivative()
        scale = 2 * math.pi / float(ratio.integrate(0.0, 2 * math.pi))
        turns = np.floor(phi / (2 * math.pi))
        at = phi - turns * 2 * math.pi
        f = (whole(at) - whole(0.0)) * scale + turns * 2 * math.pi
        return (f, *[scale * ratio.derivative(k)(at) for k in range(3)])


def ratio_case(deg, ratio):
    """Degrees and ratios, of a mean of 1 over the turn as the program wants it."""
    x, y = [radians(v) for v in deg], [mp.mpf(v) for v in ratio]
    spline = spline_witness.Spline(x, [*y, y[0]], True)
    whole = mp.mpf(0)
    for (a, b), c in zip(pairwise(x), spline.pieces(), strict=True):
        whole = derivatives(c, b - a, whole)[0]
    mean = float(whole / (2 * mp.pi))
    return deg, tuple(v / mean for v in ratio)


def ratio_cases(sample):
    """Even and uneven points of a smooth ratio, of a steep one, and of one rounded to 3 digits."""
    rng = random.Random(9)

    def steep(deg):
        return 0.2775 / (1.2225 + 0.95 * math.cos(math.radians(deg)))  # ellipses, slow, e = 0.475

    for n in (12,) if sample else (7, 24):
        even = [360.0 * k / n for k in range(n)]
        uneven = [0.0, *sorted(round(v + rng.uniform(-0.3, 0.3) * 360 / n, 3) for v in even[1:])]
        for deg in (even, uneven):
            smooth = [1.0 - 0.3 * math.cos(math.radians(v)) for v in deg]
            yield ratio_case([*deg, 360.0], smooth)
            if n > 12:
                yield ratio_case([*deg, 360.0], [steep(v) for v in deg])
                yield ratio_case([*deg, 360.0], [round(v, 3) for v in smooth])


def ratio_files(table, sample):
    """Straight slots behind a ratio from a file; the values moved are the points' ratios."""
    for deg, ratio in ratio_cases(sample):
        FRONTS["ratio file"] = RatioFile(deg, ratio)
        for gearing, z in (("external", 6), ("internal", 5), ("external", 3))[: 1 if sample else 3]:
            straight_one(table, z, gearing, "ratio file", ratio, 1)


FRONTS = {
    "crank": Plain,
    "side-crank": SideCrank,
    "elliptical-gears": Ellipses,
    "noncircular-gears": GearedSideCrank,
    "geneva-pair": Pair,
}

# Four-bars whose wheel's motion is short, or whose wheel is near: with places near which their
# wheel's entry and exit are.
FOUR_BAR = (
    "wheel.z = {}\ndrive = {{kind = 'four-bar', crank_mm = {}, ground_mm = {}, coupler_mm = {}, "
    "rocker_mm = {}, point_mm = {}, point_deg = {}}}"
)
NEAR_PLACES = {
    FOUR_BAR.format(12, 20, 100, 100, 60, 30, 100): (89.65, 252.03),
    **{CASES[name]: ON_PATH[name] for name in ON_PATH},
}
# The point moves 17 times slower than its links there: what rounds is larger than what is left,
# while a change of the links moves the wheel, too.
HARD = {FOUR_BAR.format(5, 35, 90, 80, 95, 120, 25): (295.13, 300.24)}

# What is no wheel of radial slots behind a front: specs, as text, for the witnesses of
# machine_witness.py. Of each line the sample takes the first.
SPHERE = "wheel = {{z = {}, gearing = 'spherical', axes_deg = {}}}"
PLANET = "wheel.z = {}\ndrive = {{kind = 'epicyclic', planet_ratio = {}, fixed = '{}'}}"
OTHERS = {
    "spherical": [
        SPHERE.format(z, axes)
        for z in (3, 10**6, 4, 6, 24, 1000)
        for axes in (
            3e-3,
            90.0,
            60.0,
            1e-2,
            1e-3,
            1e-6,
            1.0,
            30.0,
            89.999999999,
            90.000000001,
            120.0,
            179.0,
            179.999,
        )
    ],
    "spherical, side-crank": [
        SPHERE.format(z, 60.0) + f"\ndrive = {{kind = 'side-crank', A = {A!r}}}"
        for z in (3, 24)
        for A in (0.6, 1.0 - 1e-12, -1.0 + 1e-12, 0.999)
    ],
    # the offset's size is below 100 cos² b: 75 for six slots
    "offset": [
        f"wheel = {{z = {z}, offset_mm = {sign * share * 100.0 * math.cos(math.pi / z) ** 2!r}}}"
        for z in (5, 6, 3, 24, 10**6)
        for share in (0.9999, 0.5, 1e-9, 0.1, 0.99, 0.999999, *NEAR_1[2:], 1.0 - 1e-14)
        for sign in (1.0, -1.0)
    ],
    "offset, side-crank": [
        f"wheel = {{z = 6, offset_mm = {e}}}\ndrive = {{kind = 'side-crank', A = {A}}}"
        for e in (74.9999, -74.9999, 30.0)
        for A in (0.6, -0.3, 0.999)
    ],
    "steps": [
        "wheel = {z = 6, steps_deg = [70.0, 50.0]}",
        "wheel = {z = 4, steps_deg = [90.000000001, 89.999999999]}",
        "wheel = {z = 3, steps_deg = [100.0, 122.5, 137.5]}",
    ],
    "epicyclic": [
        PLANET.format(z, rp, fixed)
        for z in (4, 3, 6)
        for rp in ('"shockless"', 0.01, 1e-12, -0.01)
        for fixed in ("sun", "ring")
    ],
    # linkages, with places near which their wheel's entry and exit are, are that file's cases
    "four-bar": [text for text in NEAR_PLACES if "four-bar" in text],
    "slider-crank": [text for text in NEAR_PLACES if "slider-crank" in text],
    "cam": [
        f"wheel = {{z = {z}, gearing = '{g}'}}\ndrive.kind = 'cam'\n"
        f"motion = {{law = '{law}', alpha0_deg = {alpha}}}"
        for alpha in (0.0, 10.0, 59.999999)
        for law in LAWS
        for z, g in ((6, "external"), (8, "internal"))
    ],
}


def from_file(rows, cls, attribute):
    """Points as the reader hands them over, from a file of them."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        for row in rows:
            file.write("{!r},{!r}\n".format(*row))
        file.flush()
        return points(file.name, cls, attribute)


def exactly(values):
    """Doubles as they are; whole numbers, which have no last place, stay whole."""
    return tuple(v if isinstance(v, int) else mp.mpf(v) for v in values)


def variations(values, h):
    """The values with each of them in turn moved by h."""
    return [
        tuple(v + (h if k == i and not isinstance(v, int) else 0) for k, v in enumerate(values))
        for i in range(len(values))
    ]


def spec_of(z, gearing, kind, values, rollers=1, motion=None, L=100.0):
    front = FRONTS[kind]
    drive = registry.drive(getattr(front, "kind", kind))
    return Spec(
        Wheel(z, gearing),
        drive(rollers=rollers, **front.keys(values)),
        motion=motion,
        size=Size(center_distance_mm=L),
    )


class Straight:
    """Straight radial slots; ``at`` takes the input angle since the engagement's mid-motion."""

    def __init__(self, z, gearing, kind, values, behind=0):
        self.g, self.front = SIGN[gearing], FRONTS[kind]
        self.values = exactly(values)
        self.b, self.behind = mp.pi / z, behind
        self.known = {}
        self.l = mp.sin(self.b)
        self.half = mp.pi / 2 - self.g * self.b
        self.mid = self.front.input(self.values, behind)
        self.ends = tuple(self.from_crank(f) for f in (-self.half, self.half))

    def from_crank(self, f):
        return self.front.input(self.values, self.behind + f) - self.mid

    def at(self, x):
        if x not in self.known:
            self.known[x] = self._at(x)
        return self.known[x]

    def _at(self, x):
        f, *rates = self.front.crank(self.values, self.mid + x)
        C, turn = self.g * self.l * mp.expj(-self.g * (f - self.behind)), -1j * self.g
        Q = (1 - C, *[-C * turn**k for k in range(1, 6)])
        return chain(angle_rates(Q), (f, *rates))

    def varied(self, i, h):
        """The same with one of the drive's values moved by h."""
        other = object.__new__(Straight)
        other.__dict__.update(self.__dict__)
        other.values, other.known = variations(self.values, h)[i], {}
        other.mid = self.front.input(other.values, self.behind)
        return other

    def textbook(self, x):
        g, b = self.g, math.pi / float(mp.pi / self.b)
        l = math.sin(b)
        f, f1, f2, f3 = self.front.textbook(
            [float(v) for v in self.values], float(self.mid) + np.radians(x)
        )
        f = f - float(self.behind)
        psi, p1, p2, p3 = textbook_wheel(g, l, f)
        return psi, p1 * f1, p2 * f1**2 + p1 * f2, p3 * f1**3 + 3 * p2 * f1 * f2 + p1 * f3


def textbook_wheel(g, l, a):
    s, c = np.sin(a), np.cos(a)
    D = 1 - 2 * g * l * c + l * l
    third = l * (1 - l * l) * (4 * l - g * (1 + l * l) * c - 2 * l * c * c) * g**2 / D**3
    if g < 0:
        third = -l * (1 - l * l) * (4 * l + (1 + l * l) * c - 2 * l * c * c) / D**3
    return (
        np.arctan2(l * s, 1 - g * l * c),
        l * (c - l) / D if g > 0 else l * (c + l) / D,
        -l * (1 - l * l) * s / D**2,
        third,
    )


class Worst(NamedTuple):
    """The worst place of one row."""

    error: float = 0.0
    condition: float = 0.0
    share: float = -1.0
    where: str = ""


class Table:
    """Rows by (machine, quantity), the program's worst and the textbook's."""

    def __init__(self):
        self.ours, self.textbook, self.count = {}, {}, 0
        self.faults = []

    def add(self, row, error, condition, where, textbook=None):
        """``error`` (arrays or numbers) with its condition; where[i] or where says the place."""
        error, condition = np.atleast_1d(error), np.broadcast_to(condition, np.shape(error))
        condition = np.atleast_1d(condition)
        self.count += error.size
        for kept, e in ((self.ours, error), (self.textbook, textbook)):
            if e is None:
                continue
            e = np.atleast_1d(e)
            share = e / np.maximum(1.0, condition)
            if kept is self.textbook:
                share = np.where(np.isnan(share), -1.0, share)
            i = int(np.argmax(np.where(np.isnan(share), np.inf, share)))
            best = kept.setdefault(row, Worst())
            if not share[i] <= best.share:
                place = where if isinstance(where, str) else where[i]
                kept[row] = Worst(float(e[i]), float(condition[i]), float(share[i]), place)

    def fault(self, what):
        self.faults.append(what)

    def print(self):
        head = ("machine", "quantity", "error", "condition", "share", "textbook", "its share")
        lines = []
        for row, w in sorted(self.ours.items(), key=lambda item: item[0][0]):
            t = self.textbook.get(row)
            book = (f"{t.error:.3g}", f"{t.share:.3g}") if t else ("-", "-")
            cells = (*row, f"{w.error:.3g}", f"{w.condition:.3g}", f"{w.share:.3g}", *book)
            lines.append((*cells, w.where))
        widths = [max(len(x[i]) for x in [head, *lines]) for i in range(7)]
        for line in [(*head, "where"), *lines]:
            cells = [
                c.ljust(n) if i < 2 else c.rjust(n)
                for i, (c, n) in enumerate(zip(line, widths, strict=False))
            ]
            print("  ".join([*cells, line[7]]).rstrip())

    @property
    def over(self):
        return {row: w for row, w in self.ours.items() if not w.share <= LIMIT}


def ulps(got, exact, unit):
    """Sizes of got - exact, each in ``unit``; NaN stays NaN."""
    return np.array(
        [
            float(abs(mp.mpf(float(v)) - e) / unit) if math.isfinite(v) else math.nan
            for v, e in zip(got, exact, strict=True)
        ]
    )


def strictly(f, *arguments):
    """The program's own part of the work: every floating-point flag is an error there."""
    with np.errstate(all="raise"):
        return f(*arguments)


def unit(peak):
    return math.ulp(float(peak))


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


def compare(table, machine, engagement, x, exact, peak, condition, where, book=None):
    """Position to jerk at the angles x, by every route."""
    routes, some, numbers = strictly(values_at, engagement, x)
    place = [f"{where} at {v:.17g}" for v in x]
    for k, name in enumerate(NAMES):
        u, values = unit(peak[name]), [e[k] for e in exact]
        for i, route in enumerate(routes):
            n = len(route[k])
            error = ulps(route[k], values[:n], u)
            usual = ulps(book[k], values, u) if book is not None and not i else None
            table.add((machine, name), error, condition[k][:n], place[:n], usual)
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
        at = radians(p.at_deg)
        u = unit(half)
        nearest = min(places, key=lambda c: abs(c.x - at))
        error = ulps([0.0], [(at - nearest.x)], u)
        table.add((machine, f"{row}, angle"), error, float(nearest.shift / u), where)


def drive_cases():
    for kind in DRIVES:
        if kind in FRONTS:
            for values in FRONTS[kind].few:
                yield kind, values


def straight(table, sample, gearing, kind):
    """Straight slots behind a drive, one roller."""
    wheels = (3, 10**6) if sample else (3, 4, 5, 6, 7, 12, 24, 97, 1000, 4099, 999_983, 10**6)
    front = FRONTS[kind]
    fits = getattr(front, "fits", lambda *_: True)
    for values in front.few if sample else front.values:
        for z in [z for z in wheels if fits(values, gearing, z)]:
            straight_one(table, z, gearing, kind, values, 1)


def several(table, sample, kind):
    """Several rollers behind a drive."""
    for values in FRONTS[kind].few:
        for z, m in ((4, 3),) if sample else ((3, 2), (3, 5), (4, 3), (5, 3), (24, 2)):
            straight_one(table, z, "external", kind, values, m)


def straight_one(table, z, gearing, kind, values, m):
    machine = f"{gearing}, {kind}" + (", rollers" if m > 1 else "")
    where = f"z={z}" + "".join(f" {v!r}" for v in values[:9]) + (f" m={m}" if m > 1 else "")
    try:
        mechanism = strictly(build, spec_of(z, gearing, kind, values, m))
    except GenevaError as error:
        table.fault(f"{machine} {where}: refused: {error}")
        return
    for j, engagement in enumerate(mechanism.engagements):
        place = where + (f" engagement {j + 1}" if m > 1 else "")
        w = Straight(z, gearing, kind, values, 2 * mp.pi * j / m)
        x = angles(engagement)
        exact = [w.at(radians(v)) for v in x]
        # A tiny step of each value: 1e-40 is far above 120 digits and far below 1 - A.
        h = mp.mpf(10) ** -40
        others = [w.varied(i, h) for i in range(len(values))]
        moved = [[o.at(radians(v)) for v in x] for o in others]
        peak_of, more = {}, {}
        mid = math.ulp(engagement.mid_deg)
        crank = [w.half * (mp.mpf(i) / 24 - 1) for i in range(49)]
        # a ratio by points has no symmetry, and its pieces' ends are the ends of its slopes
        knots = getattr(w.front, "knots", lambda _: ())(w.values)
        mirrored = j == 0 and not knots
        if mirrored:
            crank = crank[:25]  # the second half mirrors the first
        # where a crank runs away, it does so beyond 90 degrees (inside) or evenly in the input
        crank += [s * (mp.pi / 2 + w.b * k / 9) for k in range(9) for s in (-1, 1) if w.g < 0]
        grid = {w.from_crank(f) for f in crank} | {w.ends[0] * k / 12 for k in range(12)}
        beside = [v - w.mid + side for v in knots for side in (-BESIDE, BESIDE)]
        beside = [x for x in beside if w.ends[0] < x < w.ends[1]]
        grid = sorted(x for x in {*grid, *beside} if x <= 0 or not mirrored)
        for name in PEAKS:
            found = candidates(w.at, name, grid, beside)
            # a power's extrema lie between those of velocity and acceleration
            grid = sorted({*grid, *[c.x for c in found]})
            found = [_with_values(w, name, c, values, h, mid) for c in found]
            peak_of[name] = greatest(found)
            more[name] = _size_condition(w, name, peak_of[name], values, h)
        size = {n: peak_of[n][0] for n in NAMES[1:]} | {"position": w.b}
        condition = []
        outer = np.abs(x) > 0.75 * np.where(x < 0.0, -engagement.entry_deg, engagement.exit_deg)
        entry = max(math.ulp(engagement.entry_deg), math.ulp(engagement.exit_deg))
        for k, name in enumerate(NAMES):
            u = unit(size[name])
            slope = np.array([abs(float(e[k + 1])) for e in exact])
            own = np.maximum(np.array([math.ulp(v) for v in x]), mid)
            step = np.maximum(own, np.where(outer, entry, 0.0))
            c = slope * np.radians(step) / u
            for i, v in enumerate(values):
                by = [abs(float((b[k] - a[k]) / h)) for a, b in zip(exact, moved[i], strict=True)]
                c = np.maximum(c, np.array(by) * math.ulp(v) / u)
            condition.append(c)
        book = w.textbook(x)
        compare(table, machine, engagement, x, exact, size, condition, place, book)
        got = strictly(peaks, engagement)
        farthest = max(abs(e) for e in w.ends)
        compare_peaks(table, machine, got, peak_of, farthest, place, more)


def _with_values(w, name, found, values, h, mid_deg):
    """A stationary point's shift, with one unit of the drive's values and of mid-motion."""
    if not found.shift:
        return found
    slope, bend = PICK[name](w.at(found.x))[1:]
    shift = max(found.shift, radians(mid_deg))
    for i, v in enumerate(values):
        by = (PICK[name](w.varied(i, h).at(found.x))[1] - slope) / h
        shift = max(shift, abs(by / bend) * math.ulp(v))
    return found._replace(shift=shift)


def _size_condition(w, name, peak, values, h):
    """What one unit of each of the drive's values does to a peak's size, at its place."""
    size, places = peak
    x, pick, out = places[0].x, PICK[name], 1.0
    for i, v in enumerate(values):
        other = w.varied(i, h)
        at = x
        for end, sign in zip(w.ends, (-1, 1), strict=True):
            if x == end:  # it moves with the value
                at = other.from_crank(sign * w.half)
        by = (pick(other.at(at))[0] - pick(w.at(x))[0]) / h
        out = max(out, abs(float(by)) * math.ulp(v) / unit(size))
    if x in w.ends:  # and is rounded, as is the place of mid-motion
        turned = max(unit(mp.degrees(v)) for v in (*w.ends, w.mid))
        out = max(out, abs(float(pick(w.at(x))[1])) * math.radians(turned) / unit(size))
    return out


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

    def textbook(self, u):
        """s(u) and three derivatives as the books write them, in doubles."""
        law = self.law
        if isinstance(law, PolynomialLaw):
            c = [float(x) for x in law.c]
            return [
                sum(math.perm(n, k) * a * u ** (n - k) for n, a in enumerate(c) if n >= k)
                for k in range(4)
            ]
        out = [np.zeros_like(u) for _ in range(4)]
        for i, (start, end, v, s, terms) in enumerate(law.pieces):
            w0, v0, s0 = float(start), float(v), float(s)
            here = (u > w0) & (u <= float(end)) if i else u <= float(end)
            t = u[here] - w0
            got = [s0 + v0 * t, v0 + 0 * t, 0 * t, 0 * t]
            for amplitude, rate, phase in terms:
                a, w, p = float(amplitude), float(rate), float(phase)
                if w:
                    y, q = w * u[here] + p, w * w0 + p
                    got[0] = got[0] + a / w * (math.cos(q) * t - (np.sin(y) - math.sin(q)) / w)
                    got[1] = got[1] + a / w * (math.cos(q) - np.cos(y))
                    got[2] = got[2] + a * np.sin(y)
                    got[3] = got[3] + a * w * np.cos(y)
                else:
                    got[0] = got[0] + a * math.sin(p) * t**2 / 2
                    got[1] = got[1] + a * math.sin(p) * t
                    got[2] = got[2] + a * math.sin(p)
            for o, g in zip(out, got, strict=True):
                o[here] = g / float(law.whole)
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

    def textbook(self, u):
        """SciPy's."""
        spline = self.spline.by_scipy()
        return [spline.derivative(k)(u) for k in range(4)]


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


def law_files(table, sample):
    """Curved slots of a law from a file."""
    for u, s in point_cases(sample):
        series = Points(u, s)
        read_points = from_file(zip(u, s, strict=True), registry.law("table"), "points")
        motion = given.Motion(law("table", read_points), alpha0_deg=-10.0)
        mechanism = strictly(build, spec_of(6, "external", "crank", (), 1, motion))
        where = f"{len(u)} points, the second {u[1]!r},{s[1]!r}"
        args = (series, series.peaks(), (), Plain, "external", 6, None, where)
        laid_out(table, "curved, table", mechanism, *args)


def law_cases(sample):
    for name in LAWS:
        yield name, 0.0
    eighth = [0.125, math.nextafter(0.125, 0), math.nextafter(0.125, 1), 0.1249, 0.1251]
    shapes = [0.125, 10.0] if sample else [*eighth, 0.05, 0.25, 1e-9, 1.0, 10.0]
    for shape in shapes:
        yield "sine-group", shape
        yield "sine-group", -shape


def curved(table, sample, rng, name, shape):
    """Curved slots of a law behind every drive, with alpha0 up to its limits."""
    series = Series(krasniqi(shape) if shape else LAW_WITNESSES[name])
    top = series.peaks()
    cases = [
        (z, gearing, kind, values)
        for gearing in SIGN
        for kind, values in drive_cases()
        if not hasattr(FRONTS[kind], "fits")
        for z in ((3, 24) if sample else (3, 6, 25, 10**6))
    ]
    for case in rng.sample(cases, 1) if sample else cases:
        curved_one(table, name, shape, series, top, *case, sample, rng)


def curved_one(table, name, shape, series, top, z, gearing, kind, values, sample, rng):
    machine, front = f"curved, {name}", FRONTS[kind]
    exact_values = exactly(values)
    half_crank = mp.pi / 2 - SIGN[gearing] * mp.pi / z
    natural = 2 * front.input(exact_values, half_crank) * 180 / mp.pi
    n = float(natural)
    alphas = [rng.uniform(n - 359.0, n - 1.0), n - 1e-9, n - 360.0 + 1e-9]
    if MOTION_MIN < n < 360.0 - MOTION_MIN:
        alphas = [0.0, *alphas]
    for alpha0 in rng.sample(alphas, 2) if sample else alphas:
        ratio = rng.choice([None, 1e-6, 0.3, 0.999999999])
        L = rng.choice([1e-6, 1e-3, 1.0, 100.0, 12345.678, 1e6])
        where = f"{gearing} z={z} {kind}" + "".join(f" {v!r}" for v in values)
        where += f" lambda={shape!r} alpha0={alpha0!r} ratio={ratio} L={L:g}"
        motion = Motion(law=name, lambda_=shape, alpha0_deg=alpha0, ratio=ratio)
        try:
            mechanism = strictly(build, spec_of(z, gearing, kind, values, 1, motion, L))
        except GenevaError as error:
            table.fault(f"{machine} {where}: refused: {error}")
            continue
        engagement = mechanism.engagements[0]
        motion_deg = natural - mp.mpf(alpha0)
        u = max(unit(natural), math.ulp(alpha0), unit(motion_deg))
        h = mp.mpf(10) ** -40
        here = front.input(exact_values, half_crank)
        by = [
            2.0 * abs(float((front.input(moved, half_crank) - here) / h)) * math.ulp(v)
            for moved, v in zip(variations(exact_values, h), values, strict=True)
        ]
        cond = max([0.0, *[math.degrees(b) / u for b in by]])
        table.add(
            (machine, "motion angle"), ulps([engagement.motion_deg], [motion_deg], u), cond, where
        )
        laid_out(
            table, machine, mechanism, series, top, exact_values, front, gearing, z, ratio, where
        )


def laid_out(table, machine, mechanism, series, top, values, front, gearing, z, ratio, where):
    """Motion, peaks and slot for the motion angle that the program has."""
    engagement = mechanism.engagements[0]
    whole, step = radians(engagement.motion_deg), 2 * mp.pi / z
    entry = radians(engagement.entry_deg)

    def at(x):
        s = series.at((x - entry) / whole)
        return [step * (s[0] - mp.mpf(1) / 2), *[step * s[k] / whole**k for k in range(1, 6)]]

    x = angles(engagement, 7)
    # At a joint of the law a jump is read off on one side; keep a little off.
    joints = [float(a) for a, _ in series.pieces[1:]]
    u = (x - engagement.entry_deg) / engagement.motion_deg
    for j in joints:
        x, u = x[np.abs(u - j) > 1e-12], u[np.abs(u - j) > 1e-12]
    exact = [at(radians(v)) for v in x]
    scale = {"position": step, "power": step**2 / whole**3}
    scale |= {n: step / whole**k for k, n in enumerate(NAMES) if k}
    size = {n: top[n][0] * scale[n] for n in (*NAMES, "power")}
    own = np.maximum(np.array([math.ulp(v) for v in x]), math.ulp(engagement.entry_deg))
    condition = []
    for k, name in enumerate(NAMES):
        slope = np.array([abs(float(e[k + 1])) for e in exact])
        condition.append(slope * np.radians(own) / unit(size[name]))
    if hasattr(series, "moves"):
        for k, by in enumerate(series.moves(u)):
            by = by * float(scale[NAMES[k]]) / unit(size[NAMES[k]])
            condition[k] = np.maximum(condition[k], by)
    b, w = math.pi / z, math.radians(engagement.motion_deg)
    s = series.textbook(u)
    book = [2 * b * (s[0] - 0.5), *[2 * b * s[k] / w**k for k in (1, 2, 3)]]
    compare(table, machine, engagement, x, exact, size, condition, where, book)
    found = {}
    for name in PEAKS:
        places = [Found(c.size, entry + c.x * whole, c.shift * whole) for c in top[name][1]]
        found[name] = (size[name], places)
    got = strictly(peaks, engagement)
    compare_peaks(table, machine, got, found, whole / 2, where)
    slot_points(table, machine, mechanism, x, exact, values, front, gearing, z, ratio, where)


def pitch_curve(values, front, gearing, l):
    """The pin in the wheel's frame and its rate, from the input angle and the wheel's angle."""
    g = SIGN[gearing]

    def at(x, psi, rate):
        f, f1 = front.crank(values, x)[:2]
        C = g * l * mp.expj(-g * f)
        turned = mp.expj(-psi)
        return (1 - C) * turned, (1j * g * C * f1 - 1j * rate * (1 - C)) * turned

    return at


def slot_points(table, machine, mechanism, x, exact, values, front, gearing, z, ratio, where):
    """The slot's pitch curve in millimetres."""
    l = mp.sin(mp.pi / z) if ratio is None else mp.mpf(ratio)
    wheel = max(abs(float(e[0])) for e in exact)
    curve = pitch_curve(values, front, gearing, l)
    L = mp.mpf(mechanism.center_distance_mm)
    points = [curve(radians(v), e[0], e[1]) for v, e in zip(x, exact, strict=True)]
    far = unit(L * max(abs(p) for p, _ in points))
    got = strictly(slot, mechanism, x)
    if not (np.isfinite(got.left).all() and np.isfinite(got.right).all()):
        table.fault(f"{machine} {where}: NaN or infinity in a flank")
    own = np.maximum(
        np.array([math.ulp(v) for v in x]), math.ulp(mechanism.engagements[0].entry_deg)
    )
    h = mp.mpf(10) ** -40
    place = [f"{where} at {v:.17g}" for v in x]
    near = []
    for (p, _), v, e, d in zip(points, x, exact, own, strict=True):
        steps = [s * radians(d) for s in (-1, 1)]
        near.append((p, [curve(radians(v) + s, e[0] + s * e[1], e[1])[0] for s in steps]))
    for i, part in enumerate(("real", "imag")):
        # the whole change: its first order can vanish where the second is large
        c = (
            np.array([max(abs(float(L * getattr(p - n, part))) for n in by) for p, by in near])
            / far
        )
        # a law of lambda = 10 turns the wheel several times round: a unit of that angle, too
        c = np.maximum(c, math.ulp(wheel) * float(L * max(abs(p) for p, _ in points)) / far)
        for moved, v in zip(variations(values, h), values, strict=True):
            other = pitch_curve(moved, front, gearing, l)
            by = [
                abs(float(L * getattr(other(radians(a), e[0], e[1])[0] - p, part) / h))
                for a, e, (p, _) in zip(x, exact, points, strict=True)
            ]
            c = np.maximum(c, np.array(by) * math.ulp(float(v)) / far)
        error = ulps(got.centre[:, i], [L * getattr(p, part) for p, _ in points], far)
        table.add((machine, f"slot {'xy'[i]}"), error, c, place)


def others(table, sample, name):
    """Everything else, read from a spec as a user would write it."""
    built = 0
    for text in OTHERS[name][:1] if sample else OTHERS[name]:
        mechanism = read(text)
        if mechanism is not None:
            built += 1
            other_one(table, name, text, mechanism, sample)
    if not built:
        table.fault(f"{name}: every spec was refused")


def read(text):
    """The mechanism, or None where the values do not go together."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(text)
        file.flush()
        try:
            return strictly(load, file.name)
        except GenevaError:
            return None


def varied_specs(spec):
    """The spec with each of its numbers that shape the motion one unit up, a number at a time."""
    common = {field.key for field in fields(Drive)}
    for part in ("wheel", "drive", "motion"):
        for key, v in spec.table(part).items():
            if isinstance(v, float) and v and key not in common:
                yield spec.with_(f"{part}.{key}", math.nextafter(v, math.inf))


def other_one(table, name, text, mechanism, sample):
    where = " ".join(text.split())
    specs = [mechanism.spec, *varied_specs(mechanism.spec)]
    near = {**NEAR_PLACES, **HARD}.get(text)
    witnesses = [
        [machine_witness.on_path(s, *near)] if near else machine_witness.motions(s) for s in specs
    ]
    for j, engagement in enumerate(mechanism.engagements):
        place = where if len(mechanism.engagements) == 1 else f"{where} engagement {j + 1}"
        w, *moved = [m[j] for m in witnesses]
        x = angles(engagement, 5)[:: 3 if sample else 1]
        if w.law is not None and hasattr(w.law, "pieces"):
            x = np.array([v for v in x if abs(v) > 1e-9 * engagement.exit_deg or v == 0.0])
        exact = [w.derivatives(v) for v in x]
        by = [[m.derivatives(v) for v in x] for m in moved]
        turned = max(
            math.ulp(v) for v in (engagement.entry_deg, engagement.exit_deg, engagement.mid_deg)
        )
        step = np.radians(np.maximum([math.ulp(v) for v in x], turned))
        found = strictly(peaks, engagement)
        peak = {"position": w.b}
        for quantity in PEAKS:
            p, pick = getattr(found, quantity), PICK[quantity]
            here = abs(pick((*w.derivatives(p.at_deg), 0))[0])
            # nowhere is it greater than what was found, and what was found is there, or where it
            # is greater by less than 1e-13: of tops so nearly equal the first place is told
            at, top = greatest_top(w, pick, x, exact, p.at_deg, here)
            peak[quantity] = max(top, *[abs(pick((*e, 0))[0]) for e in exact])
            u = unit(peak[quantity])
            c = [float(size_moves(w, moved, pick, v, turned) / u) for v in (at, p.at_deg)]
            table.add((name, f"peak {quantity}"), ulps([p.max], [peak[quantity]], u), c[0], place)
            less = max(0, top * (1 - 2 * mp.mpf(TIE)) - here)
            table.add((name, f"peak {quantity}, angle"), float(less / u), c[1], place)
        condition = []
        for k, quantity in enumerate(NAMES):
            u = unit(peak[quantity])
            c = np.array([abs(float(e[k + 1])) for e in exact]) * step / u
            for other in by:
                change = [abs(float(b[k] - a[k])) for a, b in zip(exact, other, strict=True)]
                c = np.maximum(c, np.array(change) / u)
            condition.append(c)
        compare(table, name, engagement, x, exact, peak, condition, place)


def size_moves(w, moved, pick, deg, turned):
    """What one unit of a place, of the engagement's own or of a key moves a size by there."""
    size, slope = pick((*w.derivatives(deg), 0))[:2]
    by_keys = [abs(abs(pick((*m.derivatives(deg), 0))[0]) - abs(size)) for m in moved]
    return max([abs(slope) * radians(max(math.ulp(deg), turned)), *by_keys])


def greatest_top(w, pick, x, exact, at_deg, told):
    """A peak's place and size, or those of another top between two of the places x."""
    here, known = (at_deg, told), [pick((*e, 0))[:2] for e in exact]
    for a, b, (p, s), (q, t) in zip(x, x[1:], known, known[1:], strict=False):
        # no cubic with these slopes has a higher top
        reach = max(abs(p), abs(q)) + radians(b - a) * max(abs(s), abs(t))
        if s * t < 0 < p * s and not a <= at_deg <= b and reach > told:
            top = mp.findroot(
                lambda v: pick((*w.derivatives(v), 0))[1],
                (a, b),
                solver="anderson",
                tol=1e-30,
                verify=False,
            )
            size = abs(pick((*w.derivatives(float(top)), 0))[0])
            here = max(here, (float(top), size), key=lambda found: found[1])
    return here


def arrays(table, sample):
    """The closed form as l nears 1, where the textbook's denominator is all rounding."""
    for k in range(1, 16):
        for gearing, g in SIGN.items():
            l = 1.0 - 10.0**-k
            rest = 1.0 - l  # exact (Sterbenz)
            scale = math.degrees(rest)
            x = [scale * t for t in (0.1, 0.3, 0.5, 1 / math.sqrt(3), 0.7, 1.0, 1.7, 3, 10, 100)]
            x = sorted(v for v in [*x, 1e-3, 0.1, 1.0, 10.0, 80.0] if v < 90.0)
            if g < 0:
                x = sorted({*x, *[180.0 - v for v in x]})
            x = np.array([*[-v for v in x[::-1]], 0.0, *x])
            C = [g * mp.mpf(l) * mp.expj(-g * radians(v)) for v in x]
            turn = -1j * g
            exact = [angle_rates((1 - c, *[-c * turn**n for n in range(1, 6)])) for c in C]
            got = strictly(ClassicArrays(float(g), l, rest).derivatives, x, (0, 1, 2, 3))
            book = textbook_wheel(g, l, np.radians(x))
            place = [f"l=1-1e-{k} at {v:.17g}" for v in x]
            for n, name in enumerate(NAMES):
                values = [e[n] for e in exact]
                u = unit(max(abs(v) for v in values))
                slope = np.array([abs(float(e[n + 1])) for e in exact])
                bend = np.array([abs(float(e[n + 2])) for e in exact])
                step = np.radians([math.ulp(v) for v in x])
                # at the line of centres the slope is 0, and the bend is what moves it
                c = np.maximum(slope, bend * step / 2.0) * step / u
                row = (f"classic arrays, {gearing}, l to 1", name)
                table.add(row, ulps(got[n], values, u), c, place, ulps(book[n], values, u))


def chords(table, sample, rng, name):
    """The slot's chords for a tolerance: really nearer than it, or refused in clear words."""
    for L in (1.0,) if sample else (1e-6, 1.0, 100.0, 1e6):
        for tolerance in (1.0, 1e-3) if sample else (1.0, 1e-3, 1e-6, 1e-9):
            # the finest tolerances on the largest wheels take minutes to be refused
            if L / tolerance <= 1e9:
                chord_case(table, name, L, tolerance, rng)


def chord_case(table, name, L, tolerance, rng):
    where = f"z=6 L={L:g} tolerance={tolerance:g}"
    mechanism = strictly(build, spec_of(6, "external", "crank", (), 1, Motion(law=name), L))
    try:
        x = strictly(nodes, mechanism, tolerance)
    except GenevaError as error:
        if "--tolerance" not in str(error):
            table.fault(f"chords {name} {where}: refused without naming --tolerance: {error}")
        return
    got = strictly(slot, mechanism, x).centre
    engagement, series = mechanism.engagements[0], Series(LAW_WITNESSES[name])
    curve = pitch_curve((), Plain, "external", mp.mpf(1) / 2)
    whole, entry = radians(engagement.motion_deg), radians(engagement.entry_deg)
    for i in rng.sample(range(len(x) - 1), min(len(x) - 1, 12)):
        a, b = (mp.mpc(*got[k].tolist()) for k in (i, i + 1))
        for t in (0.21, 0.44, 0.5, 0.57, 0.83):  # not the sixteenths that the program looks at
            at = radians(x[i]) + (radians(x[i + 1]) - radians(x[i])) * t
            s = series.at((at - entry) / whole)
            p = L * curve(at, 2 * mp.pi / 6 * (s[0] - mp.mpf(1) / 2), 0)[0]
            along = (p - a) * mp.conj(b - a) / abs(b - a) if b != a else 0
            share = min(max(along.real / abs(b - a), 0), 1) if b != a else 0
            off = float(abs(p - a - share * (b - a)))
            # in units of the tolerance, which 16 ulp of the slot's size may blur
            blur = 16 * math.ulp(L) / tolerance
            table.add(
                (f"chords, {name}", "tolerance"), LIMIT * (off / tolerance - blur), 0.0, where
            )


def missing():
    """What the registries hold and nobody has written a witness for."""
    # a gear sector is a straight slot and a straight line: test_gear_sector.py has its witness
    known = {*FRONTS, *OTHERS, *SIGN, "gear-sector"}
    out = [f'drive kind "{kind}"' for kind in DRIVES if kind not in known]
    out += [f'gearing "{g}"' for g in GEARINGS if g not in known]
    return out + [f'law "{name}"' for name in LAWS if name not in LAW_WITNESSES]


def parts(sample):
    """What the table is made of: each part's name, and a function that fills the table with it."""
    out = {}
    for kind in DRIVES:
        if kind in FRONTS:
            fits = getattr(FRONTS[kind], "fits", lambda *_: True)
            for gearing in [g for g in SIGN if any(fits(v, g, 3) for v in FRONTS[kind].few)]:
                out[f"{gearing}, {kind}"] = partial(straight, gearing=gearing, kind=kind)
            if FRONTS[kind].few != ((),) and not hasattr(FRONTS[kind], "fits"):
                out[f"external, {kind}, rollers"] = partial(several, kind=kind)
    for name, shape in law_cases(sample):
        which = f"curved, {name} {shape:g}"
        rng = random.Random(which)
        out[which] = partial(curved, rng=rng, name=name, shape=shape)
    for name in OTHERS:
        out[name] = partial(others, name=name)
    out["curved, table"] = law_files
    out["ratio file"] = ratio_files
    out["classic arrays"] = arrays
    for name in LAWS:
        out[f"chords, {name}"] = partial(chords, rng=random.Random(name), name=name)
    return out


def fill(table, part, sample):
    """One part, with every floating-point flag an error in the program's own share of the work."""
    before = np.geterr()
    with mp.workdps(DIGITS), warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("error")
        part(table, sample)
    if np.geterr() != before:
        table.fault(f"NumPy's settings changed: {before} to {np.geterr()}")


def run(sample):
    """The whole table; faults and missing witnesses are in it."""
    table = Table()
    for name, part in parts(sample).items():
        start = time.perf_counter()
        fill(table, part, sample)
        print(f"# {name}: {time.perf_counter() - start:.0f} s, {table.count} values so far",
              file=sys.stderr)  # fmt: skip
    for what in missing():
        table.fault(f"{what}: no witness; write one in tests/stress/stress.py")
    return table


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--sample", action="store_true", help="a few machines of every kind")
    table = run(parser.parse_args().sample)
    table.print()
    for what in table.faults:
        print(f"fault: {what}")
    for row, w in table.over.items():
        print(f"over {LIMIT:g}: {', '.join(row)}: {w}")
    sys.exit(bool(table.faults or table.over))


if __name__ == "__main__":
    main()

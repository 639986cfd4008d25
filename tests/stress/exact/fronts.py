"""Witnesses of drives in front of a crank: its angle and derivatives 1..5, and the way back."""

import bisect
import math
import random
import tempfile
from itertools import pairwise

import spline_witness
from spline_witness import derivatives
from witness import mp, to_radians
from words import Spec, Wheel, points

from exact.rates import DIGITS, NEAR_1, angle_rates
from geneva_cli.motion import registry
from geneva_cli.motion.registry import DRIVES
from geneva_cli.spec.tables import Size


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
                x = [to_radians(v) for v in self.deg]
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


def ratio_case(deg, ratio):
    """Degrees and ratios, of a mean of 1 over the turn as the program wants it."""
    x, y = [to_radians(v) for v in deg], [mp.mpf(v) for v in ratio]
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


FRONTS = {
    "crank": Plain,
    "side-crank": SideCrank,
    "elliptical-gears": Ellipses,
    "noncircular-gears": GearedSideCrank,
    "geneva-pair": Pair,
}


def from_file(rows, cls, attribute):
    """Points as the reader hands them over, from a file of them."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        for row in rows:
            file.write("{!r},{!r}\n".format(*row))
        file.flush()
        return points(file.name, cls, attribute)


def spec_of(z, gearing, kind, values, rollers=1, motion=None, L=100.0):
    front = FRONTS[kind]
    drive = registry.drive(getattr(front, "kind", kind))
    return Spec(
        Wheel(z, gearing),
        drive(rollers=rollers, **front.keys(values)),
        motion=motion,
        size=Size(center_distance_mm=L),
    )


def drive_cases():
    for kind in DRIVES:
        if kind in FRONTS:
            for values in FRONTS[kind].few:
                yield kind, values

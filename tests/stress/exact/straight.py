"""Straight radial slots behind a drive, and the closed form as l nears 1."""

import math
from functools import partial

import numpy as np
from witness import SIGN, chain, mp, to_radians

from exact.compared import NAMES, PEAKS, PICK, angles, candidates, compare, compare_peaks, greatest
from exact.fronts import FRONTS, RatioFile, ratio_cases, spec_of
from exact.rates import BESIDE, angle_rates, exactly, variations
from exact.table import strictly, ulps, unit
from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import peaks
from geneva_cli.motion.wheels import classic


def ratio_files(table, sample):
    """Straight slots behind a ratio from a file; the values moved are the points' ratios."""
    for deg, ratio in ratio_cases(sample):
        FRONTS["ratio file"] = RatioFile(deg, ratio)
        for gearing, z in (("external", 6), ("internal", 5), ("external", 3))[: 1 if sample else 3]:
            straight_one(table, z, gearing, "ratio file", ratio, 1)


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
        exact = [w.at(to_radians(v)) for v in x]
        # A tiny step of each value: 1e-40 is far above 120 digits and far below 1 - A.
        h = mp.mpf(10) ** -40
        others = [w.varied(i, h) for i in range(len(values))]
        moved = [[o.at(to_radians(v)) for v in x] for o in others]
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
            of_values = np.zeros(len(x))
            for i, v in enumerate(values):
                by = [abs(float((b[k] - a[k]) / h)) for a, b in zip(exact, moved[i], strict=True)]
                # points of a file act together, and solving for their spline in doubles moves
                # each by as much as its own rounding does
                one = np.array(by) * math.ulp(v) / u
                of_values = of_values + 2.0 * one if knots else np.maximum(of_values, one)
            condition.append(np.maximum(c, of_values))
        compare(table, machine, engagement, x, exact, size, condition, place)
        got = strictly(peaks, engagement)
        farthest = max(abs(e) for e in w.ends)
        compare_peaks(table, machine, got, peak_of, farthest, place, more)


def _with_values(w, name, found, values, h, mid_deg):
    """A stationary point's shift, with one unit of the drive's values and of mid-motion."""
    if not found.shift:
        return found
    slope, bend = PICK[name](w.at(found.x))[1:]
    shift = max(found.shift, to_radians(mid_deg))
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


def arrays(table, sample):
    """The closed form as l nears 1, where 1 - 2 l cos a + l² is all rounding."""
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
            C = [g * mp.mpf(l) * mp.expj(-g * to_radians(v)) for v in x]
            turn = -1j * g
            exact = [angle_rates((1 - c, *[-c * turn**n for n in range(1, 6)])) for c in C]
            got = strictly(partial(classic.derivatives, float(g), l, rest), x, (0, 1, 2, 3))
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
                table.add(row, ulps(got[n], values, u), c, place)

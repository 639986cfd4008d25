"""Reference motions of 50 digits for every machine, from its geometry.

The input is the tables of a spec. The pin is a place in the plane (on the sphere: a vector), and
its direction is the wheel's angle. Formulas are those of a textbook, differentiated by mpmath's
differences with digits to spare. The derivatives that theory derives by hand stand below and are
compared with those differences, so each of the two checks the other. Nothing in this file imports
the program; every key is the exact double that it is.
"""

from functools import cache, partial

from spline_witness import powers
from witness import LAWS, chain, krasniqi, mp, taylor, to_radians


class Front:
    """The crank's angle f behind a front drive, as a function of the input angle, and back."""

    def __init__(self, drive=None):
        self.kind = drive.NAME if drive else "crank"
        slow = self.kind in ("side-crank", "noncircular-gears")  # the same ratio
        self.A = mp.mpf(drive.A) if slow else mp.mpf(0)
        self.e = mp.mpf(0)
        if self.kind == "elliptical-gears":
            self.e = mp.mpf(drive.eccentricity) * (1 if drive.phase == "slow" else -1)

        # two wheels in series: the first wheel is the second's crank
        self.first = mp.pi / drive.first_z if self.kind == "geneva-pair" else None

    def crank(self, phi):
        """The coulisse points along A + E, the ellipse along (E + e)/(1 + e E), E = e^(i phi).

        E is taken out of both, so that no turn is lost: |A| and |e| are below 1.
        """
        E = mp.expj(phi)
        if self.first:
            return mp.arg(1 - mp.sin(self.first) / E)
        return phi - mp.arg(1 + self.A * E) - 2 * mp.arg(1 + self.e * E)

    def input(self, f):
        """Law of sines in the side-crank's triangle; the ellipse's map turned round."""
        if self.first:
            if abs(abs(f) - self.first) < mp.mpf(10) ** -40:  # asin's end, where it loses digits
                return mp.sign(f) * (mp.pi / 2 - self.first)
            return mp.asin(mp.sin(f) / mp.sin(self.first)) - f
        return f + mp.asin(self.A * mp.sin(f)) - 2 * mp.arg(1 - self.e * mp.expj(f))

    def closed(self, phi):
        """f1, f2, f3 as theory derives them by hand: sections 1.8 and 1.9."""
        if self.first:
            return offset_closed(mp.sin(self.first), mp.mpf(0), phi)
        A, e, c, s = self.A, self.e, mp.cos(phi), mp.sin(phi)
        if self.kind == "elliptical-gears":
            W, k = 1 + e * e + 2 * e * c, 1 - e * e
            third = 2 * e * k * ((1 + e * e) * c - 2 * e * c * c + 4 * e) / W**3
            return k / W, 2 * e * k * s / W**2, third
        W, k = 1 + 2 * A * c + A * A, A * (1 - A * A)
        third = k * ((1 + A * A) * c - 2 * A * c * c + 4 * A) / W**3
        return (1 + A * c) / W, k * s / W**2, third


class Motion:
    """One motion of one roller through one slot, about its own mid-motion; radians, L = 1.

    ``wheel`` and ``path`` are functions of the input angle; ``closed``, of the same, gives the
    first three derivatives of the wheel's angle by hand-derived formulas.
    """

    law = None
    offset = mp.mpf(0)  # of the straight slot's axis from the wheel's
    parallel = False  # True for the slots of a rack, which all run along the line of centres

    def __init__(self, mid, entry, exit_, half_step, wheel, path, closed=None, polar=None):
        self.mid, self.entry, self.exit, self.b = mid, entry, exit_, half_step
        self.wheel, self.path, self.closed, self.polar = wheel, path, closed, polar

    def derivatives(self, deg):
        """The wheel's angle and its derivatives 1..4, at a double in degrees taken as exact."""
        return taylor(self.wheel, to_radians(deg), 4)

    def axis(self, x):
        """Lever of the slot's normal at the pin, and the pin's speed along the slot.

        In the frame that turns with the wheel the pin moves along the slot only.
        """
        if self.polar:
            at, speed = taylor(self.polar, x, 1)
            return mp.sin(at), speed
        if self.parallel:  # the rack's pinion has the radius 1
            return mp.mpf(1), taylor(lambda t: self.path(t).real, x, 1)[1]
        place, speed = taylor(lambda t: self.path(t) * mp.expj(-self.wheel(t)), x, 1)
        along = mp.expj(mp.arg(speed)) * (1 if speed.real * place.real > 0 else -1)
        foot = (place * mp.conj(along)).real
        return abs(foot), (speed * mp.conj(along)).real


class LawMotion(Motion):
    """A motion that follows a law; at a joint of the law, from the left."""

    def __init__(self, law, motion, half_step, path_of, middle=None):
        """``middle`` is the share of the motion at which the input's angle is 0: or else half."""
        self.law, self.whole = law, motion
        before = -motion * (mp.mpf(1) / 2 if middle is None else middle)
        super().__init__(mp.mpf(0), before, before + motion, half_step, self._wheel, None)
        self.path = lambda x: path_of(x, self._wheel(x))

    def _wheel(self, x):
        u = (x - self.entry) / self.whole
        return 2 * self.b * (self.law(min(max(u, mp.mpf(0)), mp.mpf(1)), 2)[0] - mp.mpf(1) / 2)

    def derivatives(self, deg):
        """The law's own derivatives, scaled."""
        return self.rates(to_radians(deg))

    def rates(self, x):
        """The derivatives at an angle in radians, which rounding may put outside the motion."""
        u = (x - self.entry) / self.whole
        q = self.law(min(max(u, mp.mpf(0)), mp.mpf(1)), 4)
        q[0] -= mp.mpf(1) / 2
        return [2 * self.b * v / self.whole**k for k, v in enumerate(q)]


class LawBehind(Motion):
    """A law's motion by another shaft's angle: outside its ends a law has no Taylor series."""

    def __init__(self, own, turned, *places):
        super().__init__(*places)
        self.own, self.turned = own, turned

    def derivatives(self, deg):
        """Both series, one put into the other."""
        turned = taylor(self.turned, to_radians(deg), 4)
        return list(chain(self.own.rates(turned[0]), turned))


def motions(spec):
    """The motions of a machine in the order of its engagements."""
    if spec.drive_before:
        front, each = Front(spec.drive_before), motions(spec.replace(drive_before=None))
        count = spec.drive.rollers if spec.motion else 1  # rollers that are alike have one motion
        turns = [2 * mp.pi * k / count for k in range(count)]
        return [retimed(own, front, turn) for turn in turns for own in each]
    kind = spec.drive.NAME
    if kind == "epicyclic":
        return [epicyclic(spec)]
    if kind == "cam":
        return [cam(spec)]
    front = Front(spec.drive)
    if spec.motion is not None:
        return [curved(spec, front)]
    return [straight(spec, front, crank, b) for crank, b in rollers(spec)]


def retimed(own, front, late=0):
    """A motion whose input shaft a front drive turns."""
    own_mid = own.mid + late
    mid = front.input(own_mid)

    def turned(x):
        return front.crank(mid + x) - own_mid

    def closed(x):
        f1, f2, f3 = front.closed(mid + x)
        G1, G2, G3 = own.closed(turned(x))
        return G1 * f1, G2 * f1**2 + G1 * f2, G3 * f1**3 + 3 * G2 * f1 * f2 + G1 * f3

    behind = partial(LawBehind, own, turned) if isinstance(own, LawMotion) else Motion
    out = behind(
        mid,
        front.input(own_mid + own.entry) - mid,
        front.input(own_mid + own.exit) - mid,
        own.b,
        lambda x: own.wheel(turned(x)),
        lambda x: own.path(turned(x)),
        closed if own.closed else None,
        (lambda x: own.polar(turned(x))) if own.polar else None,
    )
    out.offset, out.parallel = own.offset, own.parallel
    return out


def rollers(spec):
    """Crank angle and half a step of every roller that moves the wheel in its own way."""
    wheel, drive = spec.wheel, spec.drive
    b = mp.pi / wheel.z
    if wheel.steps:
        halves = [to_radians(s) / 2 for s in wheel.steps]
        if drive.roller_angles_deg:
            return list(zip(map(to_radians, drive.roller_angles_deg), halves, strict=True))
        # equal dwells between motions of pi - 2 b
        dwell = (2 * mp.pi - sum(mp.pi - 2 * h for h in halves)) / len(halves)
        out, at = [], mp.mpf(0)
        for i, h in enumerate(halves):
            if i:
                at += mp.pi / 2 - halves[i - 1] + dwell + mp.pi / 2 - h
            out.append((at, h))
        return out
    if drive.roller_angles_deg:
        return [(to_radians(a), b) for a in drive.roller_angles_deg]
    alike = drive.NAME in ("crank", "carousel")  # on a plain crank all move the wheel alike
    count = 1 if alike else drive.rollers
    return [(2 * mp.pi * j / drive.rollers, b) for j in range(count)]


def straight(spec, front, crank, b):
    """A straight slot, and a roller on the crank's circle, ``crank`` behind the first."""
    gearing = spec.wheel.NAME
    e = mp.mpf(spec.wheel.as_dict().get("offset_mm", 0.0)) / mp.mpf(spec.given_distance_mm)
    polar = None
    if gearing == "spherical":
        S = to_radians(spec.wheel.axes_deg)
        th = mp.asin(mp.sin(S) * mp.sin(b))
        half = mp.acos(mp.tan(th) / mp.tan(S)) if spec.wheel.axes_deg != 90.0 else mp.pi / 2
        first, last = -half, half

        def place(a):
            x, y, _ = on_the_sphere(S, th, a)
            return mp.mpc(x, y)

        def wheel(a):
            return mp.arg(place(a))

        def polar_of(a):
            x, y, height = on_the_sphere(S, th, a)
            return mp.atan2(mp.hypot(x, y), height)

        def hand(a):
            return spherical_closed(S, th, a)

        polar = polar_of
    elif gearing == "linear":
        first, last = -mp.pi / 2, mp.pi / 2
        b = mp.mpf(1)

        def place(a):
            return 1 - mp.expj(-a)

        def wheel(a):
            return mp.sin(a)

        def hand(a):
            return mp.cos(a), -mp.sin(a), -mp.cos(a)

    else:
        g = -1 if gearing == "internal" else 1
        d = mp.asin(e / mp.cos(b))
        l = mp.sin(b) * mp.cos(d)
        first, last = -(mp.pi / 2 - g * b + d), mp.pi / 2 - g * b - d

        def place(a):
            return 1 - g * l * mp.expj(-g * a)

        def wheel(a):
            at = place(a)
            return mp.arg(at) + mp.asin(e / abs(at)) - d

        def hand(a):
            return offset_closed(l, e, a, g)

    mid = front.input(crank)

    def behind(f):
        return lambda x: f(front.crank(mid + x) - crank)

    def closed(x):
        f1, f2, f3 = front.closed(mid + x)
        G1, G2, G3 = hand(front.crank(mid + x) - crank)
        return G1 * f1, G2 * f1**2 + G1 * f2, G3 * f1**3 + 3 * G2 * f1 * f2 + G1 * f3

    out = Motion(
        mid,
        front.input(crank + first) - mid,
        front.input(crank + last) - mid,
        b,
        behind(wheel),
        behind(place),
        closed,
        behind(polar) if polar else None,
    )
    out.offset, out.parallel = e, gearing == "linear"
    return out


def on_the_sphere(S, th, a):
    """The pin on the unit sphere: wheel's axis up, the crank's at S from it in the xz plane.

    At a = 0 it leans from the crank's axis towards the wheel's.
    """
    out, up = mp.cos(th), mp.sin(th)
    x = out * mp.sin(S) - up * mp.cos(a) * mp.cos(S)
    height = out * mp.cos(S) + up * mp.cos(a) * mp.sin(S)
    return x, up * mp.sin(a), height


def epicyclic(spec):
    """The roller on a planet's arm: a trochoid about the crank's axis."""
    keys, z = spec.drive, spec.wheel.z
    b = mp.pi / z
    u = mp.mpf(2 * z) / (z - 2)
    c = 1 + u if keys.fixed == "sun" else 1 - u
    l = mp.sin(b)
    rp = l / (c * c - 1) if keys.planet_ratio == "shockless" else mp.mpf(keys.planet_ratio)
    R0 = l + rp
    half = mp.pi / 2 - b

    def pin(x):
        return 1 - R0 * mp.expj(-x) - rp * mp.expj(-c * x)

    def closed(x):
        way = [
            -(((-1j) ** k) * R0 * mp.expj(-x) + ((-1j * c) ** k) * rp * mp.expj(-c * x))
            for k in (1, 2, 3)
        ]
        return path_closed(pin(x), *way)

    return Motion(mp.mpf(0), -half, half, b, lambda x: mp.arg(pin(x)), pin, closed)


def cam(spec):
    """A straight slot and a law: the law of sines in the triangle of both axes and the roller."""
    g = -1 if spec.wheel.NAME == "internal" else 1
    b = mp.pi / spec.wheel.z
    motion = mp.pi - 2 * g * b - to_radians(spec.motion.alpha0_deg)

    def pin(x, psi):
        return mp.sin(x) / mp.sin(x + g * psi) * mp.expj(psi)

    law = law_of(spec.motion.law)
    half = mp.mpf(1) / 2  # of the time, and of the step but for a law of unlike halves
    if law(half, 1)[0] != half:
        half = mp.findroot(lambda u: law(u, 1)[0] - mp.mpf(1) / 2, half)
    return LawMotion(law, motion, b, pin, half)


def law_of(law):
    """The law that a spec names, with its keys: derivatives 0 to any order at a share of time."""
    if law.NAME == "table":
        return table(tuple(law.points.pairs))
    return krasniqi(law.lambda_) if law.NAME == "sine-group" else LAWS[law.NAME]


@cache
def table(pairs):
    """The quintic spline through points, at rest at both ends: one dense system for all powers."""
    x, y = zip(*((mp.mpf(a), mp.mpf(b)) for a, b in pairs), strict=True)
    inner = x[1:-1]
    rows = [powers(v, inner, 0) for v in x]
    rows += [powers(v, inner, k) for v in (x[0], x[-1]) for k in (1, 2)]
    c = mp.lu_solve(mp.matrix(rows), mp.matrix([*y, 0, 0, 0, 0]))

    def at(u, order):
        return [mp.fdot(powers(u, inner, k), c) for k in range(order + 1)]

    return at


def curved(spec, front):
    """A law and a roller on the crank's circle."""
    g = -1 if spec.wheel.NAME == "internal" else 1
    b, law = mp.pi / spec.wheel.z, law_of(spec.motion.law)
    motion = 2 * front.input(mp.pi / 2 - g * b) - to_radians(spec.motion.alpha0_deg)
    l = spec.motion.ratio
    if l is None:
        l = mp.sin(b)
    elif l == "matched":  # the slot crosses the line of centres as fast as the pin does
        v = law(mp.mpf(1) / 2, 1)[1] * 2 * b / motion / front.closed(mp.mpf(0))[0]
        l = v / (1 + g * v)
    l = mp.mpf(l)
    return LawMotion(law, motion, b, lambda x, _: 1 - g * l * mp.expj(-g * front.crank(x)))


def path_closed(Q, Q1, Q2, Q3):
    """Derivatives of arg Q by those of Q: theory 1.6."""
    return (
        (Q1 / Q).imag,
        (Q2 / Q - (Q1 / Q) ** 2).imag,
        (Q3 / Q - 3 * Q2 * Q1 / Q**2 + 2 * (Q1 / Q) ** 3).imag,
    )


def spherical_closed(S, th, a):
    """Theory 1.3, any angle S between the axes."""
    t, c, s = mp.tan(th), mp.cos(a), mp.sin(a)
    N, M = t * s, mp.sin(S) - t * mp.cos(S) * c
    Q = M * M + N * N
    Q1 = 2 * t * (M * mp.cos(S) * s + N * c)
    level = (t * mp.cos(S) * s) ** 2 + M * t * mp.cos(S) * c + (t * c) ** 2 - N * t * s
    A = t * mp.sin(S)  # of A(a) = A (cos a - tan th / tan S)
    psi1 = A * (c - t * mp.cos(S) / mp.sin(S)) / Q
    psi2 = (-A * s - psi1 * Q1) / Q
    return psi1, psi2, (-A * c - 2 * psi2 * Q1 - psi1 * 2 * level) / Q


def offset_closed(l, e, a, g=1):
    """Theory 1.4; with e = 0 the radial slot. An internal wheel is l -> -l and psi -> -psi."""
    l = g * l
    rho = mp.sqrt(1 - 2 * l * mp.cos(a) + l * l)
    s = mp.sqrt(rho * rho - e * e)
    psi = mp.atan2(l * mp.sin(a), 1 - l * mp.cos(a)) + mp.asin(e / rho)
    C, D = l * mp.cos(a + psi), l * mp.sin(a + psi)
    psi1, s1 = C / s, l * mp.sin(a) / s
    s2 = (l * mp.cos(a) - s1 * s1) / s
    psi2 = -(D * (1 + psi1) + psi1 * s1) / s
    psi3 = -(C * (1 + psi1) ** 2 + D * psi2 + 2 * psi2 * s1 + psi1 * s2) / s
    return g * psi1, g * psi2, g * psi3


def linkage(kind, keys):
    """The roller's path about the crank's axis in millimetres, by circles that meet."""
    a = mp.mpf(keys.crank_mm)
    arm = mp.mpf(keys.point_mm) * mp.expj(to_radians(keys.point_deg))

    def turn(x):  # mpmath's expj stops its own root finder
        return mp.mpc(mp.cos(x), mp.sin(x))

    def four_bar(phi):
        A = a * turn(phi)
        b, c = mp.mpf(keys.coupler_mm), mp.mpf(keys.rocker_mm)
        d = mp.mpf(keys.ground_mm) - A
        side = 1 if keys.branch == "+" else -1
        cosine = (b * b + abs(d) ** 2 - c * c) / (2 * b * abs(d))
        return A + arm * turn(mp.arg(d) + side * mp.acos(cosine))

    def slider(phi):
        A = a * turn(phi)
        return A + arm * turn(mp.asin((mp.mpf(keys.height_mm) - A.imag) / mp.mpf(keys.rod_mm)))

    return {"four-bar": four_bar, "slider-crank": slider}[kind]


def fitted(path, b, entry, exit_):
    """Entry, exit and centre of the wheel whose slots are tangent to the path at both.

    The two tangents meet equally far from both places, at the index angle.
    """

    def tangents(first, last):
        (p, v), (q, w) = taylor(path, first, 1), taylor(path, last, 1)
        return p, v, q, w, v / abs(v), w / abs(w)

    def off(first, last):
        p, _, q, _, t, u = tangents(first, last)
        chord = ((q - p) * mp.conj(t + u)).imag
        # -t and u point from the wheel's centre to the pin
        return chord, abs(mp.arg(-u / t)) - 2 * b

    def widest(first, last):
        """Where the index angle is stationary among pairs of equally far places."""
        (p, v, a), (q, w, c) = taylor(path, first, 2), taylor(path, last, 2)
        t, u = v / abs(v), w / abs(w)
        bend, turn = ((mp.conj(x) * 2 * y).imag / abs(x) ** 2 for x, y in ((v, a), (w, c)))
        chord, both = q - p, mp.conj(t + u)
        by_first = (chord * mp.conj(1j * bend * t) - v * both).imag
        by_last = (chord * mp.conj(1j * turn * u) + w * both).imag
        return (chord * both).imag, by_first * turn + by_last * bend

    first, last = mp.findroot(off, (entry, exit_), tol=mp.mpf(10) ** -80, verify=False)
    if abs(off(first, last)[1]) > mp.mpf(10) ** -30:  # a double root, or what is nearest to one
        first, last = mp.findroot(widest, (first, last), tol=mp.mpf(10) ** -80, verify=False)
    (p, v), (q, w) = taylor(path, first, 1), taylor(path, last, 1)
    rho = abs(q - p) / abs(v / abs(v) + w / abs(w))
    return first, last, p + rho * v / abs(v)


def on_path(spec, entry_deg, exit_deg):
    """A machine whose roller is a point of a linkage; the two angles are near the true ones."""
    if spec.drive_before:
        own = on_path(spec.replace(drive_before=None), entry_deg, exit_deg)
        return retimed(own, Front(spec.drive_before))
    b = mp.pi / spec.wheel.z
    path = linkage(spec.drive.NAME, spec.drive)
    entry, exit_, centre = fitted(path, b, to_radians(entry_deg), to_radians(exit_deg))
    middle = (entry + exit_) / 2  # the input's own middle
    L = abs(centre)
    ray = path(entry) - centre
    sense = 1 if mp.arg((path(exit_) - centre) / ray) > 0 else -1

    def turned(x):
        """The pin from the wheel's centre, the ray to it at entry being the x axis."""
        at = (path(middle + x) - centre) / ray * abs(ray) / L
        return at if sense > 0 else mp.conj(at)

    # the crank's axis lies at (1, 0)
    axis = -centre / ray * abs(ray) / L
    axis = axis if sense > 0 else mp.conj(axis)
    return Motion(
        mp.mpf(0),
        entry - middle,
        exit_ - middle,
        b,
        lambda x: mp.arg(turned(x) * mp.expj(-b)),
        lambda x: turned(x) / axis,
    )

"""A wheel for any roller path: where it must stand, and the engagement that it makes.

The roller's path P(phi) is closed. A wheel with straight radial slots takes it without shock where
the path enters along one slot and leaves along the next, equally far from the wheel's centre O:
with the unit tangents t1 and t2 there,

    O = P1 + rho t1 = P2 - rho t2 ,    the angle from -t1 to t2 = the index angle 2b.

So P2 - P1 is parallel to t1 + t2, which leaves a one-parameter family of pairs; the index angle
picks the pair. Where the path has inflections at both ends the index angle is stationary along the
family, the root is double, and the acceleration starts from zero.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from decimal import Decimal, localcontext
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.machine import path_and_slot, path_pairs
from geneva_cli.machine.engagement import Anchor, Engagement, Vector, cross
from geneva_cli.machine.path_and_slot import AnchoredPath, Followed
from geneva_cli.machine.path_pairs import Path, Way
from geneva_cli.machine.wheels.poses import Step
from geneva_cli.numerics import digits
from geneva_cli.numerics.angles import radians, scaled_sin_cos
from geneva_cli.numerics.arrays import library
from geneva_cli.numerics.jet import Coefficient, Jet, atan2, sin_cos, sine_versine

Exact: TypeAlias = tuple[Decimal, Decimal]  # a vector in the plane


GRID = 720  # places between entry and exit, and between exit and entry, that are checked
DOUBLE = 1e-12  # radians: a stationary index angle nearer than this to the wanted one is meant
BESIDE = 1e-4  # radians: entries nearer to each other lead to the same pair
NEWTON = 1e-12  # radians: steps of the search that are worth another one
ROUGH = 1e-9  # radians: index angle's excess that is left to the polishing
ANCHORS = 4  # on either side of the middle: near the wheel a path is all bends
DOUBLE_SLOPE = 1e-5  # of the index angle along the family: less is a double root
POLISHINGS = 6  # steps of Newton, each of which leaves some millionth of the error
POLISHED = 1e-20  # radians: the last of them


class Pair(NamedTuple):
    """Entry and exit on the family of pairs, with the index angle's excess and its slope."""

    entry: float
    exit: float
    excess: float
    slope: float


class Fit(NamedTuple):
    """A wheel that fits: input angles at entry and exit, its centre, and how fast it turns."""

    entry: Decimal
    exit: Decimal
    centre: Exact
    sense: float  # +1 where the wheel turns counterclockwise on the path's own axes
    peak: float  # of its velocity


class _Place(NamedTuple):
    """A point of the path: place, velocity, unit tangent and the rate at which that turns."""

    p: complex
    v: complex
    t: complex
    turn: float


def fits(path: Path, step: Step) -> list[Fit]:
    """All wheels of an index angle that the path can drive, the gentlest first."""
    tried: list[float] = []
    found: list[Fit] = []
    for entry, exit_ in _candidates(path, step.b):
        if any(abs(math.remainder(entry - other, math.tau)) < 1e-6 for other in tried):
            continue
        tried.append(entry)
        fit = _checked(path, step, entry, exit_)
        if fit:
            found.append(fit)
    return sorted(found, key=lambda f: f.peak)


def engagement(path: Path, fit: Fit, step: Step) -> tuple[Engagement, float]:
    """The engagement of a wheel that fits, and the centre distance; the crank's axis is the origin.

    Every place is worked out in 50 digits and rounded once.
    """
    with localcontext(digits.FIFTY):
        ox, oy = fit.centre
        L = (ox * ox + oy * oy).sqrt()
        middle = (fit.entry + fit.exit) / 2
        places = [
            _Turned.of(path, middle + (fit.exit - middle) * i / ANCHORS)
            for i in range(-ANCHORS, ANCHORS + 1)
        ]
        rays = [(p.p[0] - ox, p.p[1] - oy) for p in places]
        first, last = _unit(rays[0]), _unit(rays[-1])
        half_way = (first[0] + last[0], first[1] + last[1])
        inside = [fit.sense * _angle(half_way, ray) for ray in rays[1:-1]]
        ahead = fit.sense * _angle((-ox, -oy), rays[ANCHORS])
        anchors = tuple(
            Anchor(
                digits.to_degrees(p.phi - middle),
                wheel,
                float(_length(ray) / L),
                along_ray(
                    path.about(p.sine, p.cosine),
                    (float(ray[0]), float(ray[1])),
                    fit.sense,
                    float(L),
                    end,
                ),
            )
            for p, ray, wheel, end in zip(
                places,
                rays,
                (-step.b, *inside, step.b),
                (-1.0, *[0.0] * len(inside), 1.0),
                strict=True,
            )
        )
    anchored = AnchoredPath(anchors, ahead)
    motion = Followed(anchored, step.b, mirrored=False)
    body = Link(path, float(middle), fit.sense)
    ahead_x, ahead_y = float(-ox / L), float(-oy / L)
    joints = LinkJoints(path, float(middle), fit.sense, float(L), ahead_x, ahead_y)
    return path_and_slot.engagement(0.0, anchored, motion, -fit.sense, body, joints), float(L)


class Link(NamedTuple):
    """The link that carries the roller, from mid-motion on."""

    path: Path
    middle: float  # the crank's angle there
    sense: float

    def __call__(self, tau: Coefficient, order: int) -> Jet:
        """How fast it turns, positive with the wheel."""
        x, y = self.path.link(*sin_cos(Jet.variable(tau + self.middle, order + 1)))
        return atan2(y, x).derivative() * self.sense


class LinkJoints(NamedTuple):
    """The link cut free: the crank's pin A holds it, and a third body at B along a known line."""

    path: Path
    middle: float  # the crank's angle at mid-motion
    sense: float
    L: float  # millimetres
    x: float  # direction of the line of centres from the wheel's axis, on the path's axes
    y: float

    def __call__(self, input_deg: Coefficient, force: Vector, moment: Jet) -> tuple[Vector, Vector]:
        """Reactions of the crank's shaft, which are those at A, and of the third body."""
        tau = Jet.variable(radians(input_deg) + self.middle, moment.order)
        sine, cosine = sin_cos(tau)
        across = force[1] * self.sense
        F = (force[0] * self.x - across * self.y, force[0] * self.y + across * self.x)
        ex, ey = self.path.link(sine, cosine)
        px, py = self.path.place(sine, cosine)
        ax, ay = self.path.joint(sine, cosine)
        arm, h = self.path.hold(sine, cosine)
        # moments about A
        turning = cross((px - ax, py - ay), F) + moment * (self.sense * self.L)
        push = turning / (cross((ex * arm, ey * arm), h)) * -1.0
        third = h[0] * push, h[1] * push
        return (F[0] + third[0], F[1] + third[1]), third


class AlongRay(NamedTuple):
    """The pin's way along a ray (x, y) and across it, positive with the wheel."""

    way: Way
    x: float
    y: float
    scale: float
    sense: float

    def __call__(self, tau: Coefficient, order: int) -> tuple[Jet, Jet]:
        """``tau`` radians of the crank later."""
        x, y = self.way(*sine_versine(Jet.variable(tau, order)))
        along = (x * self.x + y * self.y) * self.scale
        across = (y * self.x - x * self.y) * (self.sense * self.scale)
        return along, across


def along_ray(way: Way, ray: tuple[float, float], sense: float, L: float, end: float) -> AlongRay:
    """The pin's way along and across a ray; at an end (-1, 1) the ray is the pin's own direction.

    There it is the velocity that ``way`` itself gives, so that nothing at all is left across it.
    """
    ux, uy = ray
    if end:
        x, y = way(*sine_versine(Jet.variable(0.0, 1)))
        ux, uy = end * x.c[1], end * y.c[1]
    return AlongRay(way, ux, uy, 1.0 / (library(ux).hypot(ux, uy) * L), sense)


class _Turned(NamedTuple):
    """A point of the path in 50 digits: crank's angle, place, velocity, and its unit vector."""

    phi: Decimal
    sine: Decimal
    cosine: Decimal
    p: Exact
    v: Exact
    t: Exact

    @staticmethod
    def of(path: Path, phi: Decimal) -> _Turned:
        """The point at a crank angle in radians."""
        s, c = digits.sin_cos(phi)
        x, y = path.place(Jet((s, c)), Jet((c, -s)), exact=True)
        v = (x.c[1], y.c[1])
        return _Turned(phi, s, c, (x.c[0], y.c[0]), v, _unit(v))


def _length(a: Exact) -> Decimal:
    return (a[0] * a[0] + a[1] * a[1]).sqrt()


def _unit(a: Exact) -> Exact:
    size = _length(a)
    return a[0] / size, a[1] / size


def _cross(a: Exact, b: Exact) -> Decimal:
    return a[0] * b[1] - a[1] * b[0]


def _angle(a: Exact, b: Exact) -> float:
    """The angle from a to b, rounded once."""
    return math.atan2(_cross(a, b), a[0] * b[0] + a[1] * b[1])


def _place(path: Path, phi: float) -> _Place:
    x, y = path.at(phi, 2)
    p, v, a = (complex(*z) for z in zip(x.derivatives(), y.derivatives(), strict=True))
    speed = abs(v)
    return _Place(p, v, v / speed, (v.conjugate() * a).imag / speed**2)


def _candidates(path: Path, b: float) -> Iterator[tuple[float, float]]:
    """Entry and exit of every pair with the right index angle, checked for nothing else."""
    with np.errstate(all="ignore"):
        found = path_pairs.pairs(path, path_pairs.on_grid(path, 1), np.array([[b]]))
    tried: list[float] = []
    for ends in found:
        for entry, exit_ in ends.phi.tolist():
            if any(abs(math.remainder(entry - other, math.tau)) < BESIDE for other in tried):
                continue
            tried.append(entry)
            pair = _on_family(path, b, entry, exit_)
            root = _refined(path, b, pair) if pair else None
            if root:
                yield root


def _on_family(path: Path, b: float, entry: float, exit_: float) -> Pair | None:
    """The exit near ``exit_`` that is as far from the meeting point as ``entry``: Newton."""
    one = _place(path, entry)
    for _ in range(40):
        two = _place(path, exit_)
        chord, both = two.p - one.p, one.t + two.t
        value = (chord * both.conjugate()).imag
        by_exit = (two.v * both.conjugate() + chord * (1j * two.turn * two.t).conjugate()).imag
        if by_exit == 0.0:
            return None
        move = max(-0.05, min(0.05, -value / by_exit))
        exit_ += move
        if abs(move) < NEWTON:
            break
    else:
        return None
    by_entry = (-one.v * both.conjugate() + chord * (1j * one.turn * one.t).conjugate()).imag
    angle = cmath.phase(-two.t * one.t.conjugate())
    slope = math.copysign(1.0, angle) * (-two.turn * by_entry / by_exit - one.turn)
    return Pair(entry, exit_, abs(angle) - 2.0 * b, slope)


def _refined(path: Path, b: float, pair: Pair) -> tuple[float, float] | None:
    """From a pair of the family to one with the index angle: a root, or a double root."""
    here, step = pair, math.tau / GRID
    for _ in range(60):
        if here.slope == 0.0:
            break
        move = max(-step, min(step, -here.excess / here.slope))
        after = _on_family(path, b, here.entry + move, here.exit - move)
        if after is None or abs(after.entry - pair.entry) > 12.0 * step:
            return None
        done = abs(after.excess) < 4e-16 or abs(move) < NEWTON
        here = after
        if done:
            break
    flat = _stationary(path, b, here)
    if flat and abs(flat.excess) < DOUBLE:
        here = flat
    return (here.entry, here.exit) if abs(here.excess) < ROUGH else None


def _stationary(path: Path, b: float, pair: Pair) -> Pair | None:
    """Where the index angle is stationary along the family: secant on its slope."""
    before, here = pair, _on_family(path, b, pair.entry + 1e-4, pair.exit - 1e-4)
    for _ in range(40):
        if here is None or here.slope == before.slope:
            return before if here is None else here
        move = -here.slope * (here.entry - before.entry) / (here.slope - before.slope)
        if abs(move) > 0.05:
            return None
        before, here = here, _on_family(path, b, here.entry + move, here.exit - move)
        if here is not None and abs(move) < 4e-16 * max(1.0, abs(here.entry)):
            return here
    return here


def _polished(
    path: Path, step: Step, entry: float, exit_: float, sense: float
) -> tuple[Decimal, Decimal] | None:
    """A pair in 50 digits: Newton on what is left of both conditions, its slopes in doubles.

    Where the root is double no slope is left, and only the equal distances are mended.
    None where there turns out to be no such pair.
    """
    first, last = Decimal(entry), Decimal(exit_)
    sin_2b, cos_2b = (Decimal(n) / Decimal(1 << 128) for n in scaled_sin_cos(2 * step.p, step.q))
    one, two = _place(path, entry), _place(path, exit_)
    chord, both = two.p - one.p, one.t + two.t
    by_exit = (two.v * both.conjugate() + chord * (1j * two.turn * two.t).conjugate()).imag
    by_entry = (-one.v * both.conjugate() + chord * (1j * one.turn * one.t).conjugate()).imag
    slope = -two.turn * by_entry - one.turn * by_exit  # of the index angle, times by_exit
    double = abs(slope) < DOUBLE_SLOPE * abs(by_exit)
    for _ in range(POLISHINGS):
        p, q = _Turned.of(path, first), _Turned.of(path, last)
        apart = (q.p[0] - p.p[0], q.p[1] - p.p[1])
        total = (p.t[0] + q.t[0], p.t[1] + q.t[1])
        away = float(_cross(total, apart))
        if double:
            move = away / by_exit
            last -= Decimal(move)
            continue
        # sine of the index angle's excess, the angle being that from -t1 to t2
        sine, cosine = -_cross(p.t, q.t), -(p.t[0] * q.t[0] + p.t[1] * q.t[1])
        excess = float(sine * cos_2b - Decimal(sense) * cosine * sin_2b)
        # by_entry de + by_exit dx = -away,  -turn1 de + turn2 dx = -excess
        det = by_entry * two.turn + by_exit * one.turn
        move = (away * two.turn - excess * by_exit) / det
        first -= Decimal(move)
        last -= Decimal((by_entry * excess + one.turn * away) / det)
    return (first, last) if abs(move) < POLISHED else None


def _checked(path: Path, step: Step, entry: float, exit_: float) -> Fit | None:
    """The wheel of a pair, if the roller stays in its slot and turns it one way only."""
    one, two = _place(path, entry), _place(path, exit_)
    rho = abs(two.p - one.p) / abs(one.t + two.t)
    centre = 0.5 * ((one.p + rho * one.t) + (two.p - rho * two.t))
    sense = math.copysign(1.0, cmath.phase(-two.t * one.t.conjugate()))
    inside = entry + (exit_ - entry) * np.arange(1, GRID) / GRID
    x, y = path.at(inside, 1)
    way = x.c[0] + 1j * y.c[0] - centre
    velocity = sense * ((x.c[1] + 1j * y.c[1]) / way).imag
    x, y = path.at(exit_ + (entry + math.tau - exit_) * np.arange(1, GRID) / GRID, 0)
    rest = np.abs(x.c[0] + 1j * y.c[0] - centre)
    if (velocity <= 0.0).any() or (np.abs(way) >= rho).any() or (rest <= rho).any():
        return None
    with localcontext(digits.FIFTY):
        pair = _polished(path, step, entry, exit_, sense)
        if pair is None:
            return None
        first, last = pair
        p, q = _Turned.of(path, first), _Turned.of(path, last)
        total = (p.t[0] + q.t[0], p.t[1] + q.t[1])
        far = _length((q.p[0] - p.p[0], q.p[1] - p.p[1])) / _length(total)
        place = (p.p[0] + far * p.t[0], p.p[1] + far * p.t[1])
    return Fit(first, last, place, sense, float(velocity.max()))

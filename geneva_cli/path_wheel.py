"""A wheel for any roller path: where it must stand, and the station that it makes.

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
from collections.abc import Callable, Iterator
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli import gearing
from geneva_cli.jet import Coefficient, Jet
from geneva_cli.station import Anchor, SlotDriven

Path: TypeAlias = Callable[[Coefficient, int], tuple[Jet, Jet]]
# input angle in radians, order -> x, y with their derivatives

GRID = 720  # places on the path that are tried for entry and for exit
SMALL = 0.05  # radians by which the index angle may be off, for a double root to be looked for
DOUBLE = 1e-12  # radians: a stationary index angle nearer than this to the wanted one is meant


class Pair(NamedTuple):
    """Entry and exit on the family of pairs, with the index angle's excess and its slope."""

    entry: float
    exit: float
    excess: float
    slope: float


class Fit(NamedTuple):
    """A wheel that fits: input angles at entry and exit, its centre, and how fast it turns."""

    entry: float
    exit: float
    centre: complex
    sense: float  # +1 where the wheel turns counterclockwise on the path's own axes
    peak: float  # of its velocity


class _Place(NamedTuple):
    """A point of the path: place, velocity, unit tangent and the rate at which that turns."""

    p: complex
    v: complex
    t: complex
    turn: float


def fits(path: Path, b: float) -> list[Fit]:
    """All wheels of half index angle b that the path can drive, the gentlest first."""
    found: list[Fit] = []
    for entry, exit_ in _candidates(path, b):
        fit = _checked(path, entry, exit_)
        if fit and not any(
            abs(math.remainder(fit.entry - f.entry, math.tau)) < 1e-6 for f in found
        ):
            found.append(fit)
    return sorted(found, key=lambda f: f.peak)


def station(path: Path, fit: Fit, step: gearing.Step, crank: complex) -> tuple[SlotDriven, float]:
    """The station of a wheel that fits, and the centre distance; ``crank`` is the crank's axis."""
    line = crank - fit.centre
    L = abs(line)
    middle = 0.5 * (fit.entry + fit.exit)
    rays = [_place(path, phi).p - fit.centre for phi in (fit.entry, middle, fit.exit)]
    first, last = (fit.sense * cmath.phase(rays[i] / line) for i in (0, 2))
    half_way = first + 0.5 * ((last - first) % math.tau)
    ahead = math.remainder(fit.sense * cmath.phase(rays[1] / line), math.tau)
    wheel = math.remainder(ahead - half_way, math.tau)
    anchors = (
        _anchor(path, fit, fit.entry - middle, fit.entry, -step.b, rays[0], L),
        _anchor(path, fit, 0.0, middle, wheel, rays[1], L),
        _anchor(path, fit, fit.exit - middle, fit.exit, step.b, rays[2], L),
    )
    out = SlotDriven(0.0, step.b, anchors, ahead=ahead, mirrored=False)
    out.crank_sense = -fit.sense
    return out, L


def _anchor(
    path: Path, fit: Fit, from_mid: float, phi: float, wheel: float, ray: complex, L: float
) -> Anchor:
    start = fit.centre + ray
    unit = ray / abs(ray)
    at_end = from_mid != 0.0

    def displacement(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
        x, y = path(tau + phi, order)
        x, y = x - start.real, y - start.imag
        along = (x * unit.real + y * unit.imag) / L
        across = (y * unit.real - x * unit.imag) * (fit.sense / L)
        if not at_end:
            return along, across
        # Entry and exit lie on their slot, and the path along it: what is left there is rounding.
        here = tau == 0.0
        value, slope = (np.where(here, 0.0, c) for c in across.c[:2]) if order else (0.0, 0.0)
        if isinstance(tau, float) and order:
            value, slope = float(value), float(slope)
        return along, Jet((value, slope, *across.c[2:])) if order else across

    return Anchor(math.degrees(from_mid), wheel, abs(ray) / L, displacement)


def _place(path: Path, phi: float) -> _Place:
    x, y = path(phi, 2)
    p, v, a = (complex(*z) for z in zip(x.derivatives(), y.derivatives(), strict=True))
    speed = abs(v)
    return _Place(p, v, v / speed, (v.conjugate() * a).imag / speed**2)


def _candidates(path: Path, b: float) -> Iterator[tuple[float, float]]:
    """Entry and exit of every pair with the right index angle, checked for nothing else."""
    phi = np.arange(GRID) * (math.tau / GRID)
    x, y = path(phi, 1)
    p, v = x.c[0] + 1j * y.c[0], x.c[1] + 1j * y.c[1]
    speed = np.abs(v)
    t = np.divide(v, speed, out=np.zeros_like(v), where=speed > 0.0)  # none where the point rests
    # Rows are entries; column j is an exit j + 1 grid steps later.
    later = (np.arange(GRID)[:, None] + np.arange(1, GRID)[None, :]) % GRID
    chord, both = p[later] - p[:, None], t[later] + t[:, None]
    product = chord * both.conj()
    crossing = (np.sign(product.imag[:, 1:]) != np.sign(product.imag[:, :-1])) & (
        (product.real[:, 1:] > 0.0) & (product.real[:, :-1] > 0.0)
    )
    excess = np.abs(np.angle(-t[later] * t[:, None].conj())) - 2.0 * b
    for i, j in np.argwhere(crossing & (np.abs(excess[:, 1:]) < 4.0 * SMALL)):
        entry = float(phi[i])
        pair = _on_family(path, b, entry, entry + (int(j) + 1.5) * math.tau / GRID)
        if pair is None:
            continue
        root = _refined(path, b, pair)
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
        if abs(move) < 4e-16 * max(1.0, abs(exit_)):
            break
    else:
        if abs(move) > 1e-12:
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
        done = abs(after.excess) < 4e-16 or abs(move) < 4e-16
        here = after
        if done:
            break
    flat = _stationary(path, b, here)
    if flat and abs(flat.excess) < DOUBLE:
        here = flat
    return (here.entry, here.exit) if abs(here.excess) < DOUBLE else None


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


def _checked(path: Path, entry: float, exit_: float) -> Fit | None:
    """The wheel of a pair, if the roller stays in its slot and turns it one way only."""
    one, two = _place(path, entry), _place(path, exit_)
    rho = abs(two.p - one.p) / abs(one.t + two.t)
    centre = 0.5 * ((one.p + rho * one.t) + (two.p - rho * two.t))
    sense = math.copysign(1.0, cmath.phase(-two.t * one.t.conjugate()))
    inside = entry + (exit_ - entry) * np.arange(1, GRID) / GRID
    x, y = path(inside, 1)
    way = x.c[0] + 1j * y.c[0] - centre
    velocity = sense * ((x.c[1] + 1j * y.c[1]) / way).imag
    x, y = path(exit_ + (entry + math.tau - exit_) * np.arange(1, GRID) / GRID, 0)
    rest = np.abs(x.c[0] + 1j * y.c[0] - centre)
    if (velocity <= 0.0).any() or (np.abs(way) >= rho).any() or (rest <= rho).any():
        return None
    return Fit(entry, exit_, centre, sense, float(velocity.max()))

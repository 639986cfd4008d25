"""Wheels for the paths of many designs at once: the search of ``wheel_for_path``, in doubles.

All pairs of places on a path are looked at on a grid; Newton takes those near a wheel's index angle
to entry and exit, all designs' together. Where a root is double or nearly so, doubles know it to
half their digits only, and the design is left to be solved alone, in 50 digits.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.machine import path_and_slot
from geneva_cli.machine.engagement import Anchor, Engagement
from geneva_cli.machine.path_and_slot import AnchoredPath, Followed
from geneva_cli.machine.path_pairs import (
    LONG_PI,
    Ends,
    Path,
    ends_at,
    on_grid,
    pairs,
    residual,
    rounded,
    taken,
)
from geneva_cli.machine.wheel_for_path import ANCHORS, DOUBLE_SLOPE, Link, LinkJoints, along_ray
from geneva_cli.machine.wheels.poses import Step
from geneva_cli.numerics.jet import Jet

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

FINE = 180  # places between entry and exit, and between exit and entry, that are checked
SAME = 1e-6  # radians: entries nearer to each other are one
BLOCK = 64  # wheels that are checked together
POLISHINGS = 3  # steps of Newton: each leaves some millionth of the error
GROUP = 2048  # designs at a time


class Fits(NamedTuple):
    """One wheel a design, of n designs: the angles are radians, (n, 1); NaN where none fits.

    ``alone`` are the numbers of designs that are to be solved one by one.
    """

    entry: Any
    exit: Any
    sense: Any  # +1 where the wheel turns counterclockwise on the path's own axes
    alone: Any


def engagement_many(path: Path, found: Fits, step: Step) -> tuple[Engagement, float]:
    """The engagements of the wheels that fit, and their centre distances, (n, 1).

    Every place is worked out in long doubles, where the computer has them, and rounded once.
    """
    b, sense = step.b, found.sense
    with np.errstate(all="ignore"):
        entry, exit_ = _polished(path, found, step)
    middle = (entry + exit_) / 2
    phi = [middle + (exit_ - middle) * i / ANCHORS for i in range(-ANCHORS, ANCHORS + 1)]
    places = [_place(path, x) for x in phi]
    (p, t), (q, u) = places[0], places[-1]
    rho = np.abs(q - p) / np.abs(t + u)
    centre = ((p + rho * t) + (q - rho * u)) / 2
    rays: list[Any] = [place - centre for place, _ in places]
    L: Any = np.abs(centre)
    half_way = rays[0] / np.abs(rays[0]) + rays[-1] / np.abs(rays[-1])
    inside = [sense * rounded(np.angle(ray * half_way.conj())) for ray in rays[1:-1]]
    ends = (-1.0, *[0.0] * len(inside), 1.0)
    distance = rounded(L)
    anchors = tuple(
        Anchor(
            rounded((x - middle) * (180 / LONG_PI)),
            wheel,
            rounded(np.abs(ray) / L),
            along_ray(
                path.about(np.sin(x), np.cos(x)),
                (rounded(ray.real), rounded(ray.imag)),
                sense,
                distance,
                end,
            ),
        )
        for x, ray, wheel, end in zip(phi, rays, (-b, *inside, b), ends, strict=True)
    )
    ahead = sense * rounded(np.angle(-rays[ANCHORS] * centre.conj()))
    anchored = AnchoredPath(anchors, ahead)
    motion = Followed(anchored, b, mirrored=False)
    mid = rounded(middle)
    line = rounded(-centre.real / L), rounded(-centre.imag / L)
    joints = LinkJoints(path, mid, sense, distance, *line)
    body = Link(path, mid, sense)
    return path_and_slot.engagement(0.0, anchored, motion, -sense, body, joints), distance


def _place(path: Path, phi: Any) -> tuple[Any, Any]:
    """Place and unit tangent at an angle in long doubles, as complex numbers."""
    s, c = np.sin(phi), np.cos(phi)
    x, y = path.place(Jet((s, c)), Jet((c, -s)), exact=True)
    v = x.c[1] + 1j * y.c[1]
    return x.c[0] + 1j * y.c[0], v / np.abs(v)


def _polished(path: Path, found: Fits, step: Step) -> tuple[Any, Any]:
    """Entry and exit in long doubles, as ``wheel_for_path`` polishes: its slopes in doubles."""
    every = np.arange(len(found.entry))
    ends = ends_at(path, every, np.hstack((found.entry, found.exit)))
    rest = residual(ends, np.broadcast_to(step.b, found.entry.shape))
    by_entry, by_exit = rest.by_entry[:, None], rest.by_exit[:, None]
    turn, turn_out = ends.turn[:, :1], ends.turn[:, 1:]
    det = rest.det[:, None]
    double = np.abs(det) < DOUBLE_SLOPE * np.abs(by_exit)
    wanted = 2 * LONG_PI * step.p / step.q
    entry, exit_ = (np.asarray(x, dtype=np.longdouble) for x in found[:2])
    for _ in range(POLISHINGS):
        (p, t), (q, u) = _place(path, entry), _place(path, exit_)
        away = ((q - p) * (t + u).conj()).imag
        index = -u * t.conj()
        excess = index.imag * np.cos(wanted) - found.sense * index.real * np.sin(wanted)
        entry = entry - np.where(double, 0.0, (away * turn_out - excess * by_exit) / det)
        both = np.where(double, away / by_exit, (by_entry * excess + turn * away) / det)
        exit_ = exit_ - both
    return entry, exit_


def fits_many(path: Path, b: Any, wanted: float | None) -> Fits:
    """The gentlest wheel of each path, or the one entered nearest to ``wanted`` (radians).

    ``path``, half the index angle b and ``wanted`` hold numbers (n, 1), or one for all.
    """
    numbers = (*path.rough, b, 0.0 if wanted is None else wanted)
    count = np.broadcast_shapes(*(np.shape(x) for x in numbers))[0]
    out = np.full((3, count), np.nan)
    alone = []
    half = np.broadcast_to(np.asarray(b, dtype=float), (count, 1))
    goal = None if wanted is None else np.broadcast_to(np.asarray(wanted, dtype=float), (count, 1))
    with np.errstate(all="ignore"):
        for start in range(0, count, GROUP):
            part = np.arange(start, min(start + GROUP, count))
            ends, sense, peak, doubtful = _block(path.of(part), half[part])
            entry, exit_ = ends.phi.T
            worse = peak
            if goal is not None:
                off = entry - goal[part][ends.which, 0]
                worse = np.abs(off - math.tau * np.round(off / math.tau))
            order = np.lexsort((-worse, ends.which))  # the best is written last
            which = ends.which[order]
            out[:, part[which]] = entry[order], exit_[order], sense[order]
            alone.append(part[doubtful])
    entry, exit_, sense = out[:, :, None]
    return Fits(entry, exit_, sense, np.concatenate(alone))


def _block(path: Path, b: Array) -> tuple[Ends, Array, Array, Any]:
    """All wheels of some designs, with their peak velocities; and designs that are in doubt."""
    grid = on_grid(path, len(b))
    ends, doubtful = pairs(path, grid, b)
    rest = residual(ends, b)
    steep = np.abs(rest.det) >= DOUBLE_SLOPE * np.abs(rest.by_exit)
    alone = np.unique(np.concatenate((doubtful.which, ends.which[~steep])))
    chord, both = ends.p[:, 1] - ends.p[:, 0], ends.t.sum(axis=1)
    rho = np.abs(chord) / np.abs(both)
    centre = 0.5 * (ends.p.sum(axis=1) + rho * (ends.t[:, 0] - ends.t[:, 1]))
    # What the grid's own places show needs no closer look.
    entry, exit_ = ends.phi.T
    since = grid.phi - entry[:, None]
    since -= math.tau * np.floor(since / math.tau)
    inside = since < (exit_ - entry)[:, None]
    way = grid.p[ends.which] - centre[:, None]
    far = np.abs(way) >= rho[:, None]
    turns = rest.sense[:, None] * (grid.v[ends.which] * way.conj()).imag > 0.0
    good = np.where(inside, turns & ~far, far).all(axis=1)
    good &= _first_of_same(ends.which, entry, good)
    ends, sense, rho, centre = taken(ends, good), rest.sense[good], rho[good], centre[good]
    peak = np.empty(len(sense))
    for start in range(0, len(sense), BLOCK):
        i = slice(start, start + BLOCK)
        peak[i] = _checked(path.of(ends.which[i]), ends.phi[i], sense[i], rho[i], centre[i])
    good = ~np.isnan(peak)
    return taken(ends, good), sense[good], peak[good], alone


def _first_of_same(which: Any, entry: Array, good: Any) -> Any:
    """Of good pairs that are one, the first."""
    place = entry - math.tau * np.floor(entry / math.tau)
    order = np.lexsort((place, which))
    order = order[good[order]]
    same = (np.diff(which[order]) == 0) & (np.diff(place[order]) < SAME)
    first = np.zeros(len(which), dtype=bool)
    first[order] = True
    first[order[1:][same]] = False
    return first


def _checked(path: Path, phi: Array, sense: Array, rho: Array, centre: Any) -> Array:
    """The peak velocity, if the roller stays in its slot and turns the wheel one way only."""
    share = np.arange(1, FINE) / FINE
    entry, exit_ = phi[:, :1], phi[:, 1:]
    x, y = path.at(entry + (exit_ - entry) * share, 1)
    way = x.c[0] + 1j * y.c[0] - centre[:, None]
    velocity = sense[:, None] * ((x.c[1] + 1j * y.c[1]) / way).imag
    x, y = path.at(exit_ + (entry + math.tau - exit_) * share, 0)
    rest = np.abs(x.c[0] + 1j * y.c[0] - centre[:, None])
    bar = rho[:, None]
    wrong = (velocity <= 0.0).any(axis=1) | (np.abs(way) >= bar).any(axis=1)
    wrong |= (rest <= bar).any(axis=1)
    return np.where(wrong, np.nan, velocity.max(axis=1, initial=0.0))

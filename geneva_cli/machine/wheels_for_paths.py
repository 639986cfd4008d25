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
from geneva_cli.machine.path_pairs import Ends, Path, on_grid, pairs, residual, taken
from geneva_cli.machine.wheel_for_path import ANCHORS, DOUBLE_SLOPE, Link, LinkJoints, along_ray
from geneva_cli.numerics.jet import Jet

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

FINE = 180  # places between entry and exit, and between exit and entry, that are checked
SAME = 1e-6  # radians: entries nearer to each other are one
BLOCK = 64  # wheels that are checked together
GROUP = 2048  # designs at a time


class Fits(NamedTuple):
    """One wheel a design, of n designs: the angles are radians, (n, 1); NaN where none fits.

    ``alone`` are the numbers of designs that are to be solved one by one.
    """

    entry: Any
    exit: Any
    sense: Any  # +1 where the wheel turns counterclockwise on the path's own axes
    alone: Any


def engagement_many(path: Path, found: Fits, b: Any) -> tuple[Engagement, float]:
    """The engagements of the wheels that fit, and their centre distances, (n, 1)."""
    entry, exit_, sense = found[:3]
    middle = 0.5 * (entry + exit_)
    phi = [middle + (exit_ - middle) * (i / ANCHORS) for i in range(-ANCHORS, ANCHORS + 1)]
    turned = [(np.sin(x), np.cos(x)) for x in phi]
    places = [path.place(Jet((s, c)), Jet((c, -s))) for s, c in turned]
    p, v = ([x.c[k] + 1j * y.c[k] for x, y in places] for k in (0, 1))
    t, u = v[0] / np.abs(v[0]), v[-1] / np.abs(v[-1])
    rho = np.abs(p[-1] - p[0]) / np.abs(t + u)
    centre = 0.5 * ((p[0] + rho * t) + (p[-1] - rho * u))
    rays: list[Any] = [place - centre for place in p]
    L: Any = np.abs(centre)
    half_way = rays[0] / np.abs(rays[0]) + rays[-1] / np.abs(rays[-1])
    inside = [sense * np.angle(ray * half_way.conj()) for ray in rays[1:-1]]
    ends = (-1.0, *[0.0] * len(inside), 1.0)
    anchors = tuple(
        Anchor(
            np.degrees(x - middle),
            wheel,
            np.abs(ray) / L,
            along_ray(path.about(*sin_cos), (ray.real, ray.imag), sense, L, end),
        )
        for x, sin_cos, ray, wheel, end in zip(
            phi, turned, rays, (-b, *inside, b), ends, strict=True
        )
    )
    anchored = AnchoredPath(anchors, sense * np.angle(-rays[ANCHORS] * centre.conj()))
    motion = Followed(anchored, b, mirrored=False)
    body = Link(path, middle, sense)
    joints = LinkJoints(path, middle, sense, L, -centre.real / L, -centre.imag / L)
    return path_and_slot.engagement(0.0, anchored, motion, -sense, body, joints), L


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

"""Four-bars whose coupler carries the roller: the least peak acceleration over their proportions.

The crank turns all round (Grashof), and no joint goes farther from its axis than the wish allows.
For every four-bar and every crank angle at entry ``coupler`` knows the point that makes the motion;
so what is searched are the proportions, the angle and, in a range, the motion: first at places
spread evenly, which are the same in every run, then nearer and nearer about the best.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.machine.compatible import refuse_clashes
from geneva_cli.machine.drives.four_bar import FourBar
from geneva_cli.machine.path_pairs import ends_at, newton, residual
from geneva_cli.machine.path_wheels import followed
from geneva_cli.machine.spec import Spec
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.study.synthesis.families.coupler import Drive, Links, driving, judged
from geneva_cli.study.synthesis.families.family import (
    BARE,
    Family,
    closed_span,
    machine,
    natural_deg,
    only,
    wanted,
)
from geneva_cli.study.synthesis.spans import Span
from geneva_cli.study.synthesis.wish import Wish

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array

SAMPLES = 6000  # four-bars that are looked at for all wheels of a wish together
FEWEST, MOST = 256, 2048  # and for one wheel
PROPORTIONS = 4.0  # coupler and rocker over the ground link, at most, and at least its inverse
CRANK = (0.05, 0.97)  # shares of the longest crank that turns all round
LOOKS, FEW, MANY = 300, 14, 60  # nearer looks for all wheels together, and for one
PARENTS, CHILDREN = 4, 12  # the best, and places about each, of a nearer look
WIDEST, NARROWEST = 0.3, 3e-3  # the first look, of a side of the cube, and the last one over it
COARSE, FINE = 16, 96  # places of a motion, and of the way back, that are looked at
LINKS = ("crank_mm", "ground_mm", "coupler_mm", "rocker_mm")
EXACT = 2e-13  # share of a motion by which it may differ from the one wished for
TRIED = 4  # times that rounding is mended
OTHERS = 6  # that are offered where the wish has bounds
FINEST = PARENTS + OTHERS
DIMENSIONS = 5  # of what is searched: two proportions, crank, angle, and the motion of a range


class _Pool(NamedTuple):
    """Places in the unit cube, and what becomes of them."""

    unit: Array  # (n, DIMENSIONS)
    links: Links
    drive: Drive
    peak: Array  # infinite where there is no machine
    distance: Array

    def best(self, count: int) -> _Pool:
        """The gentlest."""
        order = np.argsort(self.peak, kind="stable")[:count]
        order = order[np.isfinite(self.peak[order])]
        return self.taken(order)

    def taken(self, which: Any) -> _Pool:
        """Some of them."""
        return _Pool(*(_taken(part, which) for part in self))


def four_bars(wish: Wish, wheel: Gearing) -> Iterator[Family]:
    """The gentlest four-bar of a wheel; where the wish has bounds, some others as well."""
    free = closed_span(wanted(wish, 1, natural_deg(wheel)), 1)
    if free is None or wish.rollers not in (None, 1):
        return
    try:
        refuse_clashes(_machine(wish, wheel, FourBar(**_EXAMPLE), free.low))
    except GenevaError:  # a wheel that it does not drive
        return
    found = _searched(wish, wheel, free)
    left = 1 + (OTHERS if wish.bounds else 0)
    for i in range(len(found.peak)):
        spec = _spec(wish, wheel, found, i)
        if spec is not None:
            yield only(spec)
            left -= 1
            if not left:
                return


_EXAMPLE: Any = FourBar.EXAMPLE.tables["drive"]


def _searched(wish: Wish, wheel: Gearing, motion: Span) -> _Pool:
    """The gentlest, the best first."""
    count = min(max(SAMPLES // len(wish.z), FEWEST), MOST)
    looks = min(max(LOOKS // len(wish.z), FEW), MANY)
    with np.errstate(all="ignore"):
        unit, sense = np.repeat(_spread(count), 2, axis=0), np.resize([1.0, -1.0], 2 * count)
        first = _pool(wish, wheel, motion, unit, sense, COARSE)
        found, width = first.best(PARENTS), WIDEST
        for look in range(looks):
            offset = (_spread(CHILDREN, look) - 0.5) * width
            unit = (found.unit[:, None] + offset).reshape(-1, DIMENSIONS)
            sense = np.repeat(found.drive.sense[:, 0], CHILDREN)
            near = _pool(wish, wheel, motion, _inside(unit), sense, COARSE)
            found = _joined(found, near).best(PARENTS)
            width *= NARROWEST ** (1.0 / looks)
        # those that what lies between the places spares
        every = _joined(found, first.best(OTHERS))
        return _pool(wish, wheel, motion, every.unit, every.drive.sense[:, 0], FINE).best(FINEST)


def _spread(count: int, start: int = 0) -> Array:
    """Points of the unit cube, spread evenly (Roberts' sequence: multiples of the powers of g,
    g^6 = g + 1).
    """
    g = 1.1347241384015194
    powers = g ** -np.arange(1.0, 6.0)
    points: Array = (
        0.5 + np.arange(1 + start * count, 1 + (start + 1) * count)[:, None] * powers
    ) % 1
    return points


def _inside(unit: Array) -> Array:
    """The angle goes round; what is beyond the other sides is at them."""
    inside = np.clip(unit, 0.0, 1.0)
    inside[:, 3] = unit[:, 3] % 1.0
    return inside


def _pool(
    wish: Wish, wheel: Gearing, motion: Span, unit: Array, sense: Array, places: int
) -> _Pool:
    """What becomes of places of the cube, with wheels of some sense."""
    u = unit.T[:, :, None]
    g = np.ones(u[0].shape)
    b, c = (PROPORTIONS ** (2.0 * x - 1.0) for x in u[:2])
    longest = np.minimum(
        np.minimum(np.minimum(g, b), c), g + b + c - 2.0 * np.maximum(np.maximum(g, b), c)
    )
    links = Links(longest * (CRANK[0] + (CRANK[1] - CRANK[0]) * u[2]), g, b, c)
    # the gentlest is often at an end of a range: a sixth of all places is at either
    share = np.clip(1.5 * u[4] - 0.25, 0.0, 1.0)
    wide = np.radians(motion.low + (motion.high - motion.low) * share)
    half = wheel.step.b
    drive = driving(links, math.tau * u[3], wide, half, sense[:, None])
    told = judged(links, drive, half, places, places)
    good = told.drives & (longest[:, 0] > 0.0) & (told.reach <= wish.space * told.distance)
    return _Pool(unit, links, drive, np.where(good, told.peak, np.inf), told.distance)


def _joined(one: _Pool, two: _Pool) -> _Pool:
    def both(a: Any, b: Any) -> Any:
        if isinstance(a, tuple):
            return type(a)(*map(both, a, b))
        return np.concatenate((a, b))

    joined: _Pool = both(one, two)
    return joined


def _taken(part: Any, which: Any) -> Any:
    if isinstance(part, tuple):
        return type(part)(*(_taken(x, which) for x in part))
    return part[which]


def _spec(wish: Wish, wheel: Gearing, found: _Pool, i: int) -> Spec | None:
    """The machine, as large as the frame has it.

    None where links are too unlike each other, or the roller leaves its slot after all.
    """
    one = found.taken(np.array([i]))
    links, (entry, motion, sense, _) = one.links, one.drive
    b, wanted_, wide = wheel.step.b, float(motion[0, 0]), motion
    own = _machine(wish, wheel, FourBar(**_EXAMPLE), math.degrees(wanted_))
    scale = (wish.frame or BARE).given_distance_mm / float(one.distance[0])
    for _ in range(TRIED):
        w = complex(driving(links, entry, wide, b, sense).w[0, 0]) * scale
        lengths: Any = {k: float(x[0, 0]) * scale for k, x in zip(LINKS, links, strict=True)}
        try:
            keys = FourBar(
                **lengths,
                point_mm=abs(w),
                point_deg=math.degrees(cmath.phase(w)),
                entry_deg=math.degrees(math.remainder(float(entry[0, 0]), math.tau)),
                n_rpm=own.drive.n_rpm,
            )
        except GenevaError:
            return None
        path, half = keys.roller_path, np.array([[b]])
        ends = ends_at(path, np.array([0]), np.hstack((entry, entry + wide)))
        step = newton(ends, residual(ends, half))
        reached = float(np.diff(ends.at.phi + step)[0, 0])
        if abs(reached - wanted_) <= EXACT * wanted_:
            break
        wide = wide + (wanted_ - reached)  # what rounding took
    else:
        return None
    wheel_ = followed(path, ends.at.phi + step, sense[0])
    return own.but(drive=keys) if len(wheel_.which) else None


def _machine(wish: Wish, wheel: Gearing, drive: FourBar, motion_deg: float) -> Spec:
    """A machine of the wish's frame; its centre distance follows from the links."""
    held = wheel.but(held_by="detent")  # there is no locking disc
    spec = machine(wish, held, lambda n: drive.but(n_rpm=n), 1, motion_deg)
    return spec.but(size=spec.size.but(center_distance_mm=None))

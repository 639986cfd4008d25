"""The paths of the rollers' centres, and the slots' mouths, in the wheel and about the crank."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.shapes import Line, Point
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import scalar
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.slot_ends import tip

TURN_SAMPLES = 720  # input angles at which a path is sampled


class RollerPaths(NamedTuple):
    """Least distances of the rollers' centres from the axes, mm, whatever the rollers' radius."""

    # least distance of each kind of slot from the wheel's axis; greatest for internal wheels
    ends: tuple[float, ...]
    arm: float  # least distance of the rollers, and of the adjacent slots, from the crank's axis


def roller_paths(assembly: Assembly) -> RollerPaths:
    """Return the paths of a machine's rollers."""
    L, ends, near = assembly.L, [], []
    for kind in (s.through for s in assembly.kinds):
        x, y = kind.slot(np.linspace(kind.entry_deg, kind.exit_deg, TURN_SAMPLES + 1), 0)
        points = L * np.column_stack((x.c[0], y.c[0] + 0.0 * x.c[0]))
        reach = np.hypot(*points.T)
        ends.append(float(reach.min() if assembly.sign > 0.0 else reach.max()))
        # adjacent slots while the wheel rests
        near += [np.hypot(*(points - rest(assembly, kind, end)).T).min() for end in (-1.0, 1.0)]
        if kind.built is not None:  # their mouths may be nearer
            near += [math.dist(_mouth(assembly, kind, e), rest(assembly, kind, e)) for e in (-1, 1)]
    turn = np.linspace(0.0, assembly.turn_deg, TURN_SAMPLES, endpoint=False)
    leaders = {engagement: i for i, (engagement, _) in reversed([*enumerate(assembly.rollers)])}
    for i in leaders.values():  # others follow their leaders
        near.append(np.hypot(*(assembly.pin(i, turn) - (L, 0.0)).T).min())
    return RollerPaths(tuple(ends), float(min(near)))


def mouth(assembly: Assembly, engagement: Engagement, r: float) -> float:
    """Return the rim's radius, where a roller of radius r enters and leaves a slot.

    There the roller touches the wall that faces the crank's axis, at the foot of the perpendicular
    from that axis. If it enters and leaves at two radii, no wall may stand in its way at either.
    """
    if not engagement.slot.offset:
        nearest = min if assembly.sign > 0.0 else max
        if engagement.built is not None:
            return math.hypot(*_mouth(assembly, engagement, 1.0), r)
        ends = engagement.entry_deg, engagement.exit_deg
        reaches = (scalar(engagement.reach(at_deg)) for at_deg in ends)
        return math.hypot(assembly.L * nearest(reaches), r)
    return max(math.hypot(*corner(assembly, engagement, end, r)) for end in (-1.0, 1.0))


def corner(assembly: Assembly, engagement: Engagement, end: float, r: float) -> tuple[float, float]:
    """Return the mouth's corner on the crank axis' side at entry (-1) or exit (1), mm."""
    px, py = _mouth(assembly, engagement, end)
    cx, cy = rest(assembly, engagement, end)
    ratio = r / math.dist((px, py), (cx, cy))
    return px + ratio * (cx - px), py + ratio * (cy - py)


def _mouth(assembly: Assembly, engagement: Engagement, end: float) -> Point:
    """Return the roller's centre at entry (-1) or exit (1), in the wheel's frame, mm.

    For a crank as built it is where a crank of the right R/L would have it: at the foot of the
    perpendicular from the crank's axis to the slot's.
    """
    x, y = engagement.slot(engagement.end_deg(end), 0)
    px, py = assembly.L * scalar(x.c[0]), assembly.L * scalar(y.c[0])
    if engagement.built is None:
        return px, py
    x, y = engagement.slot(0.0, 0)
    ux, uy = px - assembly.L * scalar(x.c[0]), py - assembly.L * scalar(y.c[0])
    cx, cy = rest(assembly, engagement, end)
    further = ((cx - px) * ux + (cy - py) * uy) / (ux * ux + uy * uy)
    return px + further * ux, py + further * uy


def least_mouth(L: float, recess: float, rim: float) -> float:
    """Return the radius to which lower mouths are extended, mm."""
    reach = L - recess
    return reach + 0.2 * (rim - reach)


def mouth_corners(
    assembly: Assembly, r: float, recess: float, rim: float
) -> dict[Engagement, tuple[float, float]]:
    """Return the radii of each mouth's corners where the roller comes and goes, mm."""
    widest = {kind: mouth(assembly, kind, r) for kind in assembly.kinds}
    shift = rim - max(widest.values())
    least = least_mouth(assembly.L, recess, rim) if assembly.sign > 0.0 else 0.0
    out = {}
    for kind, own in widest.items():
        entry, exit_ = own, own
        if kind.slot.offset:
            entry, exit_ = (math.hypot(*corner(assembly, kind, end, r)) for end in (-1.0, 1.0))
        out[kind] = max(entry + shift, least), max(exit_ + shift, least)
    return out


class HornSizes(NamedTuple):
    """Sizes of mouths and horns, mm."""

    roller: float
    half_width: float
    recess: float
    rim: float
    tip: float  # width of the flats of thin horns


def horn_corners(assembly: Assembly, own: HornSizes) -> dict[Engagement, tuple[float, float]]:
    """Return the distances from the axis of each slot's horns, mm, before and after a motion."""
    mouths = mouth_corners(assembly, own.roller, own.recess, own.rim)
    if not (own.tip and own.recess):
        return mouths
    return {
        kind: (_cut(assembly, own, kind, -1.0, entry), _cut(assembly, own, kind, 1.0, exit_))
        for kind, (entry, exit_) in mouths.items()
    }


def _cut(assembly: Assembly, own: HornSizes, kind: Engagement, end: float, mouth: float) -> float:
    """Return the distance of one horn's corner at its recess, with ``mouth`` that of its mouth."""
    x, y = kind.slot(kind.end_deg(end), 0)
    u, v = kind.slot(0.0, 0)
    L, centre = assembly.L, rest(assembly, kind, end)
    start = L * scalar(u.c[0]), L * scalar(v.c[0])
    out = L * scalar(x.c[0]) - start[0], L * scalar(y.c[0]) - start[1]
    long = math.hypot(*out)
    ux, uy = out[0] / long, out[1] / long
    side = math.copysign(own.half_width, (centre[1] - start[1]) * ux - (centre[0] - start[0]) * uy)
    x0, y0 = start[0] - side * uy, start[1] + side * ux
    level = math.sqrt(max(mouth * mouth - (y0 * ux - x0 * uy) ** 2, 0.0))
    along = assembly.sign * level - (x0 * ux + y0 * uy)
    cut = tip(Line((x0, y0), (x0 + along * ux, y0 + along * uy)), centre, own.recess, own.tip)
    return math.hypot(*cut.recess) if cut else mouth


def rest(assembly: Assembly, engagement: Engagement, end: float) -> tuple[float, float]:
    """Return the crank's axis in the wheel's frame before (-1) and after (1) a motion."""
    b = -end * engagement.half_step
    return assembly.L * math.cos(b), assembly.L * math.sin(b)


@lru_cache(maxsize=16)  # the sizes under a load try many bores of one machine
def roller_centres(assembly: Assembly) -> tuple[Point, ...]:
    """Return the centres of the rollers on the first crank, each at its mid-motion."""
    centres = []
    on_first = slice(1) if len(assembly.full.crank_places) > 1 else slice(None)
    for number, (_, behind) in enumerate(assembly.rollers[on_first]):
        at = np.array([behind])
        x, y = (assembly.pin(number, at) - (assembly.L, 0.0))[0]
        angle = math.atan2(y, x) - float(assembly.crank(at)[0])
        reach = math.hypot(x, y)
        centres.append((reach * math.cos(angle), reach * math.sin(angle)))
    return tuple(centres)


def roller_reaches(assembly: Assembly) -> list[float]:
    """Return the distances of the rollers from the crank's axis, at mid-motion, each once."""
    leaders = {engagement: i for i, (engagement, _) in enumerate(assembly.rollers)}
    at = [(i, np.array([assembly.rollers[i][1]])) for i in leaders.values()]
    return [math.hypot(*(assembly.pin(i, mid) - (assembly.L, 0.0))[0]) for i, mid in at]

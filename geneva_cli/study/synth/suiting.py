"""The roller that suits each machine of a batch, or the obstacle to its parts.

A curved slot needs a roller between two limits. Where its entry and exit paths differ, a small
roller leaves an island of the wheel between them, which falls out. A large roller undercuts the
outer walls. Adjacent slots and the locking disc limit the roller too. Places are sampled, and
collisions in a whole turn are left to ``synth_table``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.undercut import outer_walls
from geneva_cli.numerics.arrays import Array, Mask, Whole, parameter
from geneva_cli.numerics.tolerances import to_digits
from geneva_cli.parts.slots.groove import sampled_extremes
from geneva_cli.spec.defaults import wall_min
from geneva_cli.verdict.checks.motion_checks import GROOVE_MAX_DEG
from geneva_cli.verdict.motion_warnings import SHOWN_UNDERCUT

USUAL = (5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)  # % of L
SPARE = 1.001  # times the least roller, for what lies between the samples
SAMPLES = 120  # of a motion, and of a turn of the crank
UNDERCUT_SAMPLES, UNDERCUT_STEP = 96, 4  # of half a motion; the walls are tested at every fourth
# Obstacles, the first that applies; "" for none.
LOCK, SIZES = "lock", "sizes"
OBSTACLES = ("", "rollers", LOCK, SIZES, "walls", LOCK, "groove_pressure_deg", "undercut", "island")
UNDERCUT, ISLAND = 7, 8


class SlotPaths(NamedTuple):
    """What limits the rollers of n machines whatever their radius; lengths in mm, (n,) each."""

    end: Array  # least distance from the wheel's axis; the greatest for internal wheels
    mouth: Array  # distance of the slots' mouths from there
    arm: Array  # least distance of rollers and adjacent slots from the crank's axis
    between: Array  # of the pitch curves of adjacent slots
    least: Array  # the radius of the smallest roller that leaves no island in its slot
    steep_deg: Array  # the greatest pressure angle in a cam's groove
    radius: Array  # of the crank


def slot_paths(machine: Mechanism) -> SlotPaths:
    """The paths of the rollers of a machine, or of a batch, whose motions are alike."""
    engagement, n = machine.engagements[0], np.size(machine.design)
    entry, wide = (np.atleast_2d(x) for x in (engagement.entry_deg, engagement.motion_deg))
    at = entry + wide * (np.arange(SAMPLES + 1) / SAMPLES)
    x, y = (np.broadcast_to(c.c[0], (n, SAMPLES + 1)) for c in engagement.slot(at, 0))
    reach = np.hypot(x, y)
    nearest, farthest = (np.min, np.max) if machine.spec.wheel.SIGN > 0.0 else (np.max, np.min)
    ends = reach[:, [0, -1]]
    is_offset = np.ravel(engagement.slot.offset) != 0.0
    mouth = np.where(is_offset, farthest(ends, axis=1), nearest(ends, axis=1))
    steep = np.zeros(n)
    if engagement.groove:
        arm, steep = sampled_extremes(engagement.groove, at)
    else:
        turn = 360.0 * machine.spec.turns * (np.arange(SAMPLES) / SAMPLES - 0.5)
        px, py = (c.c[0] for c in engagement.path(np.atleast_2d(turn), 0))
        arm = np.hypot(px - 1.0, py).min(axis=1)
    half = np.reshape(engagement.half_step, (-1, 1))
    for side in (-1.0, 1.0):  # the slots next to the crank's axis while the wheel rests
        away = np.hypot(x - np.cos(half), y - side * np.sin(half))
        arm = np.minimum(arm, away.min(axis=1))
    least = np.zeros(n)
    if engagement.slot.curved:
        least = 0.5 * np.hypot(x - x[:, ::-1], y - y[:, ::-1]).max(axis=1)
    # every third sample suffices where places of two slots are compared
    place = x[:, ::3] + 1j * y[:, ::3]
    turned = np.exp(1j * np.reshape(math.tau / np.asarray(machine.spec.wheel.z), (-1, 1))) * place
    gap = place[:, :, None] - turned[:, None]
    between = np.sqrt((gap.real**2 + gap.imag**2).min(axis=(1, 2)))
    L, end, ratio = np.ravel(machine.center_distance_mm), nearest(reach, axis=1), machine.ratio
    rows = (L * end, L * mouth, L * arm, L * between, L * least, steep, L * np.ravel(ratio))
    return SlotPaths(*np.broadcast_arrays(*rows))


def suiting(machine: Mechanism, rollers: Array, largest: bool = True) -> tuple[Array, list[str]]:
    """For n machines the radii in mm of the rollers that suit them, and the obstacles to parts.

    ``rollers`` (n,) are their numbers on the crank. The roller is the largest usual one up to L/20
    without an obstacle, or the least that leaves no island; without ``largest`` any one. It is NaN
    for the spec's own, for the default, and for a machine whose obstacle no roller avoids.
    """
    n, size, paths = machine.designs, machine.spec.size, slot_paths(machine)
    L = np.broadcast_to(np.ravel(machine.center_distance_mm), (n,))
    given, least = size.roller_radius_mm, SPARE * paths.least
    if given is None:
        digits = np.array([to_digits(x, 2, math.ceil) for x in (least / L).tolist()])
        radii = 0.01 * np.array(USUAL)[:, None] * L
        radii = np.vstack((radii, np.maximum(digits * L, radii[-1])))
    else:
        radii, least = np.full((1, n), given), paths.least
    walls = [np.array(wall[1:6]) for wall in outer_walls(machine, UNDERCUT_SAMPLES) or ()]
    code = _obstacles(machine.spec, paths, bool(walls), L, radii, rollers)

    def fitting(some: Whole, numbers: Whole | int) -> Whole:
        """Those machines whose slot is not undercut by the roller of this number."""
        w = radii[numbers, some] + size.allowances.slot_clearance_mm
        return some[~_is_undercut([wall[:, some] for wall in walls], w, L[some])]

    radius, is_island = np.full(n, math.nan), radii < least
    why = np.where(code[-1] == 0, UNDERCUT, code[-1])
    for obstacle, able in ((0, ~is_island), (ISLAND, is_island))[: 1 + largest]:
        able &= (code == 0) & np.isnan(radius)
        smallest = len(radii) - 1 - able[::-1].argmax(axis=0)  # it is undercut least
        left = np.flatnonzero(able.any(axis=0))
        left = fitting(left, smallest[left])
        why[left] = obstacle
        for number, own in enumerate(radii if largest else ()):
            found = fitting(left[able[number, left]], number)
            radius[found] = own[found]
            left = np.setdiff1d(left, found)
    radius[radius == radii[0]] = math.nan  # the spec's own, or the default
    return radius, [OBSTACLES[i] for i in why]


def _obstacles(
    spec: Spec, at: SlotPaths, is_curved: bool, L: Array, r: Array, rollers: Array
) -> Whole:
    """The numbers in ``OBSTACLES`` of the first obstacles to k rollers of radius r, mm (k, n).

    Whether the walls are undercut, the slowest test, comes later.
    """
    size, allowed = spec.size, spec.size.allowances
    w, wall = r + allowed.slot_clearance_mm, np.asarray(wall_min(size, parameter(L)))
    rim = np.hypot(at.mouth, r) if size.wheel_radius_mm is None else size.wheel_radius_mm
    bottom = 0.0 if is_curved else np.maximum(allowed.slot_clearance_mm, 0.05 * r)
    # the lock reaches past the rim, and leaves a horn next to the slot
    limit, reach = at.arm - w - allowed.lock_clearance_mm, np.maximum(L - rim, 0.0)
    usual = np.maximum(limit - np.minimum(r, 0.2 * limit), 0.5 * (limit + reach))
    lock = usual if size.lock_radius_mm is None else size.lock_radius_mm
    chord = at.radius * 2.0 * np.sin(math.pi / np.maximum(rollers, 2))
    each = (
        (rollers > 1) & (chord <= r),
        spec.has_lock & (limit <= reach),
        (spec.wheel.SIGN > 0.0) & (at.end - bottom - w <= 0.0),
        at.between - 2.0 * w < wall,
        spec.has_lock & (limit - lock < wall),
        at.steep_deg > GROOVE_MAX_DEG * (1.0 + 1e-9),
    )
    first: Whole = np.select([np.broadcast_to(one, r.shape) for one in each], range(1, 7), 0)
    return first


def _is_undercut(walls: Sequence[Array], w: Array, L: Array) -> Mask:
    """Mask (n,) of the machines in which a slot of half the width w, mm, is undercut.

    ``walls`` (5, n, k) are the outer walls: pitch curve, normal and curvature over L.
    """
    R, out = w / L, np.zeros(len(L), dtype=bool)
    for x, y, normal_x, normal_y, bend in walls:
        design, place = np.nonzero(bend[:, ::UNDERCUT_STEP] * R[:, None] > 1.0)
        place, own = place * UNDERCUT_STEP, R[design]
        across = x[design, place] + own * normal_x[design, place]
        up = y[design, place] + own * normal_y[design, place]
        square = (across[:, None] - x[design]) ** 2 + (up[:, None] - y[design]) ** 2
        depth = own - np.sqrt(square.min(axis=1, initial=math.inf))
        out[design[depth * L[design] > SHOWN_UNDERCUT]] = True
    return out


def with_roller(spec: Spec, radius_mm: float) -> Spec:
    """The spec with another roller, without the rounding of its radius; unchanged for NaN."""
    if math.isnan(radius_mm):
        return spec
    return spec.replace(size=spec.size.replace(roller_radius_mm=float(f"{radius_mm:.12g}")))

"""The roller that suits each machine of a batch, or the obstacle to its parts.

A curved slot needs a roller between two limits. Where its entry and exit paths differ, a small
roller leaves an island of the wheel between them, which falls out. A large roller undercuts the
outer walls. Adjacent slots and the locking disc limit the roller too. Places are sampled, and
collisions in a whole turn are left to ``built``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.drives.crank import Crank
from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.records import thing
from geneva_cli.motion.undercut import outer_walls
from geneva_cli.numerics.arrays import Array, Whole, parameter
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.parts.slots.groove import sampled_extremes
from geneva_cli.spec.defaults import wall_min
from geneva_cli.study.batches import batch_machines
from geneva_cli.study.target import USUAL_RPM
from geneva_cli.verdict.checks.motion_checks import GROOVE_MAX_DEG
from geneva_cli.verdict.motion_warnings import SHOWN_UNDERCUT

USUAL = (5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)  # % of L
SPARE = 1.001  # times the least roller, for what lies between the samples
SAMPLES = 120  # of a motion, and of a turn of the crank
UNDERCUT_SAMPLES, UNDERCUT_STEP = 96, 4  # of half a motion; the walls are tested at every fourth

# Entries of the table for parts that pass a full turn, and for parts that were not turned.
YES = "yes"
MAYBE = "maybe"
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
        groove = sampled_extremes(engagement.groove, at)
        arm, steep = groove.nearest, groove.pressure_deg
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
    u, v = x[:, ::3, None], y[:, ::3, None]
    step = np.reshape(math.tau / np.asarray(machine.spec.wheel.z), (-1, 1, 1))
    c, s = np.cos(step), np.sin(step)
    over, up = np.swapaxes(c * u - s * v, 1, 2), np.swapaxes(s * u + c * v, 1, 2)
    between = np.sqrt(((u - over) ** 2 + (v - up) ** 2).min(axis=(1, 2)))
    L, end, ratio = np.ravel(machine.center_distance_mm), nearest(reach, axis=1), machine.ratio
    rows = (L * end, L * mouth, L * arm, L * between, L * least, steep, L * np.ravel(ratio))
    return SlotPaths(*np.broadcast_arrays(*rows))


def suiting(machine: Mechanism, rollers: Array) -> tuple[Array, list[str]]:
    """For n machines the radii in mm of the rollers that suit them, and the obstacles to parts.

    ``rollers`` (n,) are their numbers on the crank. The roller is the largest usual one up to L/20
    without an obstacle, or the least that leaves no island. It is NaN for the spec's own, for the
    default, and for a machine whose obstacle no roller avoids.
    """
    paths, own = slot_paths(machine), machine.spec.size.roller_radius_mm
    n, walls = len(paths.end), outer_walls(machine, UNDERCUT_SAMPLES) or ()
    branches = np.array([(one.x, one.y, one.normal_x, one.normal_y, one.bend) for one in walls])
    L = np.broadcast_to(np.ravel(machine.center_distance_mm), (n,))
    code, radius = np.full(n, ISLAND), np.full(n, math.nan)

    def obstacles(which: Whole, r: Array) -> Whole:
        some, curves = SlotPaths(*(part[which] for part in paths)), branches
        if len(walls):
            curves = branches[:, :, which]
        return _obstacles(machine.spec, some, curves, L[which], r, rollers[which])

    if own is not None:
        code = obstacles(np.arange(n), np.full(n, own))
        code[(code == 0) & (own < paths.least)] = ISLAND
        return radius, [OBSTACLES[i] for i in code]
    least, usual = SPARE * paths.least, [0.01 * percent * L for percent in USUAL]
    digits = [to_digits(x, 2, math.ceil) for x in (least / L).tolist()]
    for r in (*usual, np.maximum(np.array(digits) * L, usual[-1])):
        left = np.flatnonzero(np.isnan(radius) & (r >= least))
        if len(left):
            code[left] = obstacles(left, r[left])
            fits = left[code[left] == 0]
            radius[fits] = r[fits]
    for r in usual:  # where the island is the only obstacle to some roller
        left = np.flatnonzero(np.isnan(radius) & (r < least))
        if len(left):
            fits = left[obstacles(left, r[left]) == 0]
            code[fits], radius[fits] = ISLAND, r[fits]
    radius[radius == usual[0]] = math.nan  # the default
    return radius, [OBSTACLES[i] for i in code]


def _obstacles(
    spec: Spec, at: SlotPaths, curves: Array, L: Array, r: Array, rollers: Array
) -> Whole:
    """The numbers in ``OBSTACLES`` of the first obstacles to rollers of radius r, mm (n,).

    ``curves`` are those of the outer walls (2, 5, n, k): pitch curve, normal and curvature over L;
    empty for straight slots.
    """
    size, allowed = spec.size, spec.size.allowances
    w, wall = r + allowed.slot_clearance_mm, np.asarray(wall_min(size, parameter(L)))
    rim = np.hypot(at.mouth, r) if size.wheel_radius_mm is None else size.wheel_radius_mm
    bottom = 0.0 if len(curves) else np.maximum(allowed.slot_clearance_mm, 0.05 * r)
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
    for own in curves:  # the slowest test comes last
        left = np.flatnonzero((first == 0) & (own[4].max(axis=1) * w > L))
        R, (x, y, *_) = (w / L)[left, None], own[:, left]
        px, py, nx, ny, bend = own[:, left, ::UNDERCUT_STEP]
        px, py = px + R * nx, py + R * ny
        away = np.hypot(px[:, :, None] - x[:, None], py[:, :, None] - y[:, None])
        depth = np.where(bend * R > 1.0, R - away.min(axis=2), 0.0).max(axis=1)
        first[left[depth * L[left] > SHOWN_UNDERCUT]] = UNDERCUT
    return first


def with_rollers(specs: Sequence[Spec]) -> list[tuple[Spec, str | None]]:
    """Each spec with the roller that suits it, and the table's entry for parts before a turn.

    The entry is None for a wheel whose parts are not drawn. A spec that makes no machine is left as
    it is.
    """
    alike: dict[Spec, tuple[Spec, int]] = {}  # with the same slots and rollers' paths
    for spec in specs:
        if spec.is_flat:
            is_plain = spec.motion is None and spec.drive.crank  # whatever turns the crank
            one = spec.replace(drive=Crank(n_rpm=USUAL_RPM)) if is_plain else with_one_roller(spec)
            alike[spec] = one, spec.drive.rollers
    several = [*dict.fromkeys(alike.values())]
    found: dict[tuple[Spec, int], tuple[float, str]] = {}
    for members, machine in batch_machines([one for one, _ in several]):
        own = [several[i] for i in members.tolist()]
        radii, obstacles = suiting(machine, np.array([m for _, m in own]))
        found.update(zip(own, zip(radii.tolist(), obstacles, strict=True), strict=True))
    out: list[tuple[Spec, str | None]] = []
    for spec in specs:
        r, why = math.nan, ""
        if spec in alike:
            r, why = found.get(alike[spec], (r, why))
        elif spec.is_turned and (suits := thing(spec.wheel.NAME, "roller")):
            try:
                r, why = suits(build(spec))
            except GenevaError as error:
                why = str(error)
        entry = f"no: {why}" if why else MAYBE if spec.is_turned else None
        out.append((with_roller(spec, r), entry))
    return out


def with_roller(spec: Spec, radius_mm: float) -> Spec:
    """The spec with another roller, without the rounding of its radius; unchanged for NaN."""
    if math.isnan(radius_mm):
        return spec
    return spec.replace(size=spec.size.replace(roller_radius_mm=float(f"{radius_mm:.12g}")))


def with_one_roller(spec: Spec) -> Spec:
    """The machine at the usual speed with one of its equal rollers: its peaks are the same."""
    return spec.replace(drive=spec.drive.replace(n_rpm=USUAL_RPM, rollers=1))

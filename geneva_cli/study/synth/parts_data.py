"""Data of a machine's parts that do not depend on the roller's size, for batches of machines.

A drive in front of a crank changes when its parts reach a position, and equal rollers run through
the same slots. Machines that differ in these only share the data.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from geneva_cli.drives.crank import Crank
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.undercut import OuterWall, outer_walls
from geneva_cli.numerics.arrays import Array, Number, array
from geneva_cli.parts.slots.groove import sampled_extremes
from geneva_cli.parts.slots.roller_paths import RollerPaths
from geneva_cli.study.batches import batch_machines
from geneva_cli.study.target import USUAL_RPM

SLOT_SAMPLES = 720  # also of a whole turn of the crank
UNDERCUT_SAMPLES = 120  # of half a motion
CACHE = 4096  # entries


class PartsData(NamedTuple):
    """Data of the parts that do not depend on the roller; lengths in mm."""

    spec: Spec  # represents all specs with the same data
    paths: RollerPaths
    between: float  # between the pitch curves of adjacent slots
    least: float  # the radius of the smallest roller that leaves no island of the wheel in its slot
    pressure_deg: float  # the greatest in a cam's groove
    walls: tuple[OuterWall, OuterWall] | None  # of curved slots
    # of a wheel without a lock, the roller's places at rest: along the nearest slot, and across
    back: tuple[Array, Array] | None


def distances_at_rest(along: Array, across: Array, rim: Number, half_width: Number) -> Array:
    """Distances of places along the nearest slot and across it from a wheel with straight slots.

    Next to a slot the rim is nearest; in front of it, a corner of its mouth is.
    """
    level = np.sqrt(np.maximum(rim * rim - half_width * half_width, 0.0))
    corner = np.where(
        along >= level, np.hypot(along - level, half_width - across), half_width - across
    )
    before = across * level < half_width * along
    return np.where(before, corner, np.hypot(along, across) - rim)


_kept: dict[Spec, PartsData] = {}


def parts_data(spec: Spec) -> PartsData:
    """The data of a machine with flat parts. Raises GenevaError if it cannot be built."""
    own = _alike(spec)
    if own not in _kept:
        compute_parts_data([spec])
    data = _kept.get(own)  # none of a machine that no batch builds; another thread may clear it
    return data or _computed([own], build(own))[0]


def compute_parts_data(specs: Iterable[Spec]) -> None:
    """Compute the data of many machines at once, for later calls of ``parts_data``."""
    new = dict.fromkeys(
        own for spec in specs if spec.is_flat and (own := _alike(spec)) not in _kept
    )
    if len(_kept) + len(new) > CACHE:
        _kept.clear()
    several = [*new]
    for members, machine in batch_machines(several):
        of = [several[i] for i in members]
        _kept.update(zip(of, _computed(of, machine), strict=True))


@lru_cache(maxsize=CACHE)
def _alike(spec: Spec) -> Spec:
    """The machine that represents all with the same slots and rollers' paths."""
    if spec.motion is None and spec.drive.crank:
        return spec.replace(drive=Crank(n_rpm=USUAL_RPM))
    return with_one_roller(spec)


def with_one_roller(spec: Spec) -> Spec:
    """The machine at the usual speed with one of its equal rollers: its peaks are the same."""
    drive = spec.drive
    if drive.n_rpm == USUAL_RPM and drive.rollers == 1:
        return spec
    return spec.replace(drive=drive.replace(n_rpm=USUAL_RPM, rollers=1))


def _computed(specs: Sequence[Spec], machine: Mechanism) -> list[PartsData]:
    engagement, *others = machine.engagements
    assert not others, "synth finds only machines whose rollers move alike"
    L = np.atleast_2d(array(machine.center_distance_mm))
    entry, wide = (np.atleast_2d(x) for x in (engagement.entry_deg, engagement.motion_deg))
    moving = entry + wide * (np.arange(SLOT_SAMPLES + 1) / SLOT_SAMPLES)
    groove = sampled_extremes(engagement.groove, moving) if engagement.groove else None
    x, y = (c.c[0] for c in engagement.slot(moving, 0))
    shape = (len(specs), SLOT_SAMPLES + 1)
    x, y = L * np.broadcast_to(x, shape), L * np.broadcast_to(y, shape)
    reach = np.hypot(x, y)
    ends = reach.min(axis=1) if machine.spec.wheel.SIGN > 0.0 else reach.max(axis=1)
    arm = groove.nearest * L[:, 0] if groove else _arm(machine)
    half = np.atleast_2d(array(engagement.half_step))
    for side in (-1.0, 1.0):  # the slots next to the crank's axis while the wheel rests
        away = np.hypot(x - L * np.cos(half), y - side * L * np.sin(half))
        arm = np.minimum(arm, away.min(axis=1))
    # every third sample suffices where places of a slot are compared, and every sixth below
    fx, fy = x[:, ::3], y[:, ::3]
    least = 0.5 * np.hypot(fx - fx[:, ::-1], fy - fy[:, ::-1]).max(axis=1)
    least = least if engagement.slot.curved else np.zeros(len(specs))
    z = np.broadcast_to(machine.spec.wheel.z, (len(specs), 1))[:, 0]
    between = np.empty(len(specs))
    for i, (u, v) in enumerate(zip(fx[:, ::2], fy[:, ::2], strict=True)):
        b = math.tau / z[i]
        c, s = math.cos(b), math.sin(b)
        dx, dy = u[:, None] - (c * u - s * v), v[:, None] - (s * u + c * v)
        between[i] = math.sqrt(float((dx * dx + dy * dy).min()))
    pressure = groove.pressure_deg if groove else np.zeros(len(specs))
    walls = outer_walls(machine, UNDERCUT_SAMPLES)
    back = None if machine.spec.drive.LOCKS else _places_at_rest(machine)
    columns = np.broadcast_arrays(ends, arm, between, least, pressure)
    out = []
    for i, (spec, row) in enumerate(zip(specs, np.column_stack(columns).tolist(), strict=True)):
        end, near, apart, radius, steep = row
        own = walls and (walls[0].of(i), walls[1].of(i))
        away = back and (back[0][i], back[1][i])
        out.append(PartsData(spec, RollerPaths((end,), near), apart, radius, steep, own, away))
    return out


def _places_at_rest(machine: Mechanism) -> tuple[Array, Array]:
    """The roller's places at rest of the wheel, mm along the nearest slot and across, (n, m)."""
    (engagement,) = machine.engagements
    entry, wide = (np.atleast_2d(x) for x in (engagement.entry_deg, engagement.motion_deg))
    rest = 360.0 * machine.spec.turns - wide
    at = entry + wide + rest * (np.arange(SLOT_SAMPLES) / SLOT_SAMPLES)
    x, y = (c.c[0] for c in engagement.path(at, 0))
    away, b = machine.center_distance_mm * np.hypot(x, y), np.atleast_2d(engagement.half_step)
    angle = np.arctan2(y, x)
    angle = np.abs((angle - angle[:, :1] + b) % (2.0 * b) - b)  # the roller leaves along its slot
    return away * np.cos(angle), away * np.sin(angle)


def _arm(machine: Mechanism) -> Array:
    """Least distance of the roller from the crank's axis over its turn, mm, (n,) or (1,)."""
    (engagement,) = machine.engagements
    turn = 360.0 * machine.spec.turns
    at = turn * (np.arange(SLOT_SAMPLES) / SLOT_SAMPLES - 0.5)
    x, y = (c.c[0] for c in engagement.path(np.atleast_2d(at), 0))
    away = np.hypot(x - 1.0, y)
    return np.ravel(machine.center_distance_mm * away.min(axis=1, keepdims=True))

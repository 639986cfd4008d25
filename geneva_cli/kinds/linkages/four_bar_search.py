"""The search of four-bars whose coupler carries the roller: for every wheel the best proportions.

The crank turns fully (Grashof), no joint is farther from its axis than allowed, and a roller of
usual size passes the wheel on its way back. Searched are proportions, the crank's angle at entry
and, in a range, the motion. With the crank's pin A and the coupler's unit vector e, the roller is
at P = A + w e. Between entry and exit of slots of a wheel of sense s, the tangent V has turned by
pi - 2b relative to the wheel, and the chord is half-way between both tangents:

    Im(V2 V1* exp(i s (pi - 2b))) = 0 ,    Im((P2 - P1) V1* exp(i s (pi - 2b)/2)) = 0 .

In the plane of w both are circles. At one intersection the roller rests at entry; the other one is
the solution.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.kinds.linkages.four_bar import CouplerPath, FourBar
from geneva_cli.kinds.linkages.path_wheels import centre_of
from geneva_cli.kinds.linkages.tangent_pairs import Pairs, points_at
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Array, Complex, Mask, Whole, parameter, within_half_turn
from geneva_cli.study.synth.families.family import Family, is_compatible, natural_deg
from geneva_cli.study.synth.family_search import Costs, Places, Zoom, sampled, zoom
from geneva_cli.study.target import AllowedSpan, Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

SAMPLES = (256, 2048)  # least and most four-bars that are sampled for one wheel
SAMPLINGS = (13, 40)  # least and most closer samplings for one wheel
COARSE, FINE = 16, 96  # sampled places of a motion, and half of those of the way back
OTHERS = 6  # further results if a bound or the goal is not computed here
_SIDES: Any = {"crank_mm": 40.0, "ground_mm": 90.0, "coupler_mm": 100.0, "rocker_mm": 100.0}
_EXAMPLE = FourBar(**_SIDES, point_mm=161.5, point_deg=-36.1, entry_deg=123.3)  # any one


class Task(NamedTuple):
    """The search for one wheel: a machine, motions, and the least roller as a fraction of L."""

    spec: Spec
    motion: AllowedSpan
    roller: float


def four_bars(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """The best four-bar of each wheel, and some others."""
    if target.rollers not in (None, 1):
        return
    tasks = [task for wheel in wheels if (task := _task(target, wheel))]
    every, n = tasks, len(tasks)
    if target.any_motion and not target.sort:  # that of a plain crank, if it keeps the bounds
        natural = [natural_deg(task.spec.wheel) for task in tasks]
        plain = [t._replace(motion=AllowedSpan(x, x)) for t, x in zip(tasks, natural, strict=True)]
        every = [*plain, *tasks]
    count = 1 if in_batch(target.names) else 1 + OTHERS
    found = _search(target, every) if tasks else []
    for i, task in enumerate(tasks):
        own = min(found[i::n], key=lambda places: places.violation.min(initial=math.inf))
        own = own.take(slice(count))
        columns, _ = keys_at(target, every, own.of, own.at)
        for row in zip(*(column.tolist() for column in columns.values()), strict=True):
            yield Family(task.spec.with_keys(dict(zip(columns, row, strict=True))))


def _task(target: Target, wheel: Gearing) -> Task | None:
    """The search for a wheel; None for a wheel that no four-bar drives."""
    free, size = target.free_motions(1, natural_deg(wheel)), target.own.size
    if free is None:
        return None
    unlocked = wheel.replace(held_by="detent")  # there is no locking disc
    spec = target.machine(unlocked, _EXAMPLE)
    # the coupler passes below the wheel's axis, where a shaft without a hub ends in the wheel
    hub = 0.0 if size.wheel_hub_mm is None else size.wheel_hub_mm
    spec = spec.replace(size=spec.size.replace(center_distance_mm=None, wheel_hub_mm=hub))
    if not is_compatible(spec):
        return None
    if size.roller_radius_mm is not None:
        return Task(spec, free, size.roller_radius_mm / target.own.given_distance_mm)
    # half the usual roller, and at most a third of sin b, which is the crank of a plain wheel
    return Task(spec, free, min(0.025, (1.0 / 3.0) * wheel.step.sin_cos[0]))


def _search(target: Target, tasks: Sequence[Task]) -> list[Places]:
    """For each task the places of four-bars, the best first.

    A place is a point of the unit cube: two proportions, the crank, its angle, the motion in a
    range, and the wheel's sense.
    """
    slots, costs = len(target.z), Costs([task.spec for task in tasks], target)
    # all wheels of a requirement together have about 6000 samples, and 300 closer samplings
    count = min(max(6000 // slots, SAMPLES[0]), SAMPLES[1])
    samplings = min(max(300 // slots, SAMPLINGS[0]), SAMPLINGS[1])
    parents, children = 4, 12  # the best places of a task, and the closer samples near each

    def evaluate(of: Whole, at: Array, samples: int = COARSE) -> tuple[Array, Array]:
        keys, motion_deg = keys_at(target, tasks, of, at, samples)
        batches = [*costs.groups.machines(of, keys)]
        violation, cost = costs.of(batches, len(of))
        for members, machine in batches:
            # where the roller does not pass this wheel, the path may drive another one
            off = np.ravel(machine.engagements[0].motion_deg) - motion_deg[members]
            violation[members[np.abs(off) > 1e-6]] = math.inf
        return violation, cost

    def offsets(number: int) -> Array:
        return np.column_stack((_spread(children, number) - 0.5, np.zeros(children)))

    points = np.repeat(_spread(count), 2, axis=0)
    at = np.column_stack((points, np.resize([1.0, 0.0], 2 * count)))
    of = np.repeat(np.arange(len(tasks)), len(at))
    first = sampled(evaluate, of, np.tile(at, (len(tasks), 1))).best(OTHERS)
    first = first.take(np.isfinite(first.violation))
    near = Zoom(offsets, 0.3, 3e-3 ** (1.0 / samplings), samplings, around=(3,))
    several = zoom(evaluate, first.best(parents), near, keep=parents).joined(first)
    # fine samples remove those that fail between the coarse ones
    kept = sampled(partial(evaluate, samples=FINE), several.of, several.at)
    kept = kept.take(np.isfinite(kept.violation)).best(parents + OTHERS)
    return [kept.take(kept.of == i) for i in range(len(tasks))]


def _spread(count: int, start: int = 0) -> Array:
    """Points spread evenly in the unit cube: Roberts' sequence, multiples of the powers of g."""
    g = 1.1347241384015194
    powers = g ** -np.arange(1.0, 6.0)
    numbers = np.arange(1 + start * count, 1 + (start + 1) * count)
    points: Array = (0.5 + numbers[:, None] * powers) % 1
    return points


def keys_at(
    target: Target, tasks: Sequence[Task], of: Whole, at: Array, places: int = FINE
) -> tuple[dict[str, Array], Array]:
    """Keys and motions, degrees, of machines at places of the cube, for tasks by their numbers.

    All are (n,). Lengths are infinite where there is no machine.
    """
    rows = [(task.spec.wheel.step.b, *task.motion, task.roller) for task in tasks]
    (b, low, high, roller), u = np.array(rows).T[:, of], at.T
    # coupler and rocker are 1/4 to 4 times as long as the ground link
    sides = np.stack((np.ones(len(of)), *(4.0 ** (2.0 * x - 1.0) for x in u[:2])))
    longest = np.minimum(sides.min(axis=0), sides.sum(axis=0) - 2.0 * sides.max(axis=0))
    # the crank is 0.05 to 0.97 times as long as the longest that turns fully
    lengths = (longest * (0.05 + (0.97 - 0.05) * u[2]), *sides)
    path = CouplerPath(*map(parameter, lengths), reach_mm=0.0, angle_deg=0.0)
    # the gentlest is often at an end of a range: a sixth of all places is at either
    motion_deg = low + (high - low) * np.clip(1.5 * u[4] - 0.25, 0.0, 1.0)
    entry = math.tau * u[3]
    ends = np.stack((entry, entry + np.radians(motion_deg)))
    pair = Pairs(of, ends, np.where(u[5] > 0.5, 1.0, -1.0))
    with np.errstate(all="ignore"):
        w = coupler_point(path, pair, b)
        path = path.having((*path.numbers[:4], parameter(w.real), parameter(w.imag)))
        # coarse samples miss the nearest places, which a larger roller makes up for
        roller = roller * (1.15 if places < FINE else 1.0)
        passes, distance = _passing(path, pair, b, roller, target.space, places)
        passes &= longest > 0.0
        scale = np.where(passes, target.own.given_distance_mm / distance, math.inf)
        names = map("drive.{}".format, FourBar.LENGTHS.values())
        keys = dict(zip(names, (x * scale for x in (*lengths, np.abs(w))), strict=True))
    keys["drive.point_deg"] = np.degrees(np.angle(w))
    keys["drive.entry_deg"] = np.degrees(within_half_turn(entry))
    return keys, motion_deg


def coupler_point(path: CouplerPath, pair: Pairs, b: Array) -> Complex:
    """The roller's place w on the coupler that makes a motion, (n,).

    NaN if there is none, or if the chord does not run from entry to exit.
    """
    crank = np.exp(1j * pair.phi)
    (x, y), (px, py), (*_, rate, _) = path.turn(crank, 1)
    along, pin = x + 1j * y, px + 1j * py
    (p, p_end), (v, v_end) = pin, 1j * pin
    (e, e_end), (u, u_end) = along, 1j * rate * along
    turn = np.exp(1j * pair.sense * (0.5 * math.pi - b))
    circles = []
    for q, f, k in (v_end, u_end, turn * turn), (p_end - p, e_end - e, turn):
        # Im((q + w f)(v + w u)* k) = A |w|² + Im(d w) + C
        d = f * v.conj() * k - (q * u.conj() * k).conj()
        circles.append(((f * u.conj() * k).imag, d, (q * v.conj() * k).imag))
    (A, d, C), (A2, d2, C2) = circles
    # The line through both points: Im(D w) + E = 0
    D, E = A2 * d - A * d2, A2 * C - A * C2
    direction, foot = D.conj() / np.abs(D), -1j * E / D
    at_rest = ((-v / u - foot) * direction.conj()).real
    total = -(2.0 * A * (foot * direction.conj()).real + (d * direction).imag) / A
    w = foot + (total - at_rest) * direction
    chord, speed = p_end + w * e_end - (p + w * e), v + w * u
    ahead = (chord * (speed / np.abs(speed)).conj() * turn).real > 0.0
    return np.where(ahead, w, np.nan)


def _passing(
    path: CouplerPath, pair: Pairs, b: Array, roller: Array, space: float, places: int
) -> tuple[Mask, Array]:
    """A mask of the wheels that roller and links pass, at samples; their centre distances.

    Over these, ``roller`` is its radius, and ``space`` the greatest distance of joints and roller
    from the crank's axis.
    """
    entry, exit_ = pair.phi
    # the way back has twice the motion's samples
    back = np.linspace(exit_, entry + math.tau, 2 * places + 1)[1:-1]
    turn = np.concatenate((np.linspace(entry, exit_, places + 1), back))
    _, *moving = path.joints(np.exp(1j * turn))
    centre, rho = centre_of(points_at(path, pair.phi))
    L, rays = np.abs(centre), moving[-1] - centre
    near, returns = np.abs(rays[: places + 1]), rays[places + 1 :]
    half_wall = 1.0 / 400.0  # of the least wall between two slots, over the centre distance
    passes = near.min(axis=0) * np.sin(b) >= (roller + half_wall) * L
    passes &= (near[1:-1] < rho).all(axis=0)
    reach = np.abs(moving).max(axis=(0, 1))
    passes &= np.maximum(path.numbers[1], reach) <= space * L
    # Lengths over the distance of the slots' mouths from the wheel's axis; a slot points along the
    # real axis. The wheel ends at hypot(1, r), where slots as wide as the roller leave corners.
    r, place = roller * L / rho, returns / rays[0]
    d, angle = np.abs(place), np.abs((np.angle(place) + b) % (2.0 * b) - b)
    ahead, across = d * np.cos(angle), d * np.sin(angle)
    corner = np.where(ahead >= 1.0, np.hypot(ahead - 1.0, r - across), r - across)
    # in front of a slot its mouth's corner is nearest, else the rim
    gap = np.where(across < r * ahead, corner, d - np.hypot(1.0, r)) - r
    touch = 1e-6  # a roller that leaves its slot is this near to it
    passes &= ((gap >= -touch) & (d > 1.0)).all(axis=0)
    return passes, L

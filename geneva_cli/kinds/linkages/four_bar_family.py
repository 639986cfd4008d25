"""Four-bars whose coupler carries the roller: for every wheel the one of the best proportions.

The crank turns fully (Grashof), no joint is farther from its axis than allowed, and a roller of
usual size passes the wheel on its way back. For every four-bar and crank angle at entry,
``coupler`` gives the point that makes the motion; ``four_bar_search`` does the rest.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.linkages.coupler import coupler_drive
from geneva_cli.kinds.linkages.coupler_costs import Costs, is_known
from geneva_cli.kinds.linkages.four_bar import FourBar
from geneva_cli.kinds.linkages.four_bar_search import (
    OTHERS,
    Goal,
    WheelGoal,
    four_bars_at,
    search_four_bars,
)
from geneva_cli.kinds.linkages.path_wheels import driven
from geneva_cli.kinds.linkages.tangent_pairs import Pairs, newton, points, residual, sampled
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synth.families.family import (
    BARE,
    Family,
    allowed_motions,
    closed_span,
    is_compatible,
    machine,
    natural_deg,
)
from geneva_cli.study.synth.optimiser import Places
from geneva_cli.study.target import AllowedSpan, Target


def four_bars(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """The best four-bar of each wheel, and some others.

    Others are added if the search cannot compute the goal or a bound.
    """
    if target.rollers not in (None, 1):
        return
    tasks = [task for wheel in wheels if (task := _task(target, wheel))]
    names = [target.sort.name if target.sort else target.peak, *(b.name for b in target.bounds)]
    count = 1 if all(map(is_known, names)) else 1 + OTHERS
    for found in _searched(target, tasks):
        made = (_spec(target, found, i) for i in range(len(found.places.of))) if found else ()
        yield from (Family(spec) for spec in islice(filter(None, made), count))


class _Found(NamedTuple):
    """The search that found four-bars of a wheel, the best first."""

    goal: Goal
    places: Places


def _task(target: Target, wheel: Gearing) -> WheelGoal | None:
    """The goal of the search for a wheel; None for a wheel that no four-bar drives."""
    free = closed_span(allowed_motions(target, 1, natural_deg(wheel)), 1)
    if free is None:
        return None
    if not is_compatible(_machine(target, wheel, FourBar(**_EXAMPLE), free.low)):
        return None
    frame = target.frame or BARE
    radius_mm = frame.size.roller_radius_mm
    # half the usual roller, and at most a third of sin b, which is the crank of a plain wheel
    roller = min(0.025, (1.0 / 3.0) * math.sin(wheel.step.b))
    return WheelGoal(
        wheel, free, roller if radius_mm is None else radius_mm / frame.given_distance_mm
    )


def _searched(target: Target, tasks: Sequence[WheelGoal]) -> Sequence[_Found | None]:
    """The best four-bars, if any, of each wheel."""
    bounds = tuple(b for b in target.bounds if is_known(b.name))
    goal = Goal(target, (), bounds, target.peak)
    if target.sort and is_known(target.sort.name):
        goal = goal._replace(least=target.sort.name, sign=target.sort.sign)
    every = dict(enumerate(tasks))
    same = {
        i: plain for i, plain in enumerate(map(_as_plain, tasks)) if _in_time(target, plain, bounds)
    }
    by_wheel: dict[int, _Found] = {}
    for tried in (same, every) if target.any_motion and not target.sort else (every,):
        left = {i: task for i, task in tried.items() if i not in by_wheel}
        own = goal._replace(wheels=tuple(left.values()))
        for i, found in zip(left, search_four_bars(own) if left else [], strict=True):
            if len(found.of):
                by_wheel[i] = _Found(own, found)
    return [by_wheel.get(i) for i in every]


def _as_plain(task: WheelGoal) -> WheelGoal:
    """The goal with the plain crank's motion."""
    natural = natural_deg(task.wheel)
    return task._replace(motion=AllowedSpan(natural, natural))


def _in_time(target: Target, task: WheelGoal, bounds: Sequence[Constraint]) -> bool:
    """Return True if a motion keeps the bounds that depend on it only."""
    step, motion = np.array([360.0 / task.wheel.z]), np.array([task.motion.low])
    of_time = tuple(b for b in bounds if b.name.startswith("timing."))
    return not Costs(target, step, [], motion).broken(of_time).any()


_EXAMPLE: Any = FourBar.EXAMPLE.tables["drive"]


def _spec(target: Target, found: _Found, number: int) -> Spec | None:
    """The machine of a number in a search, scaled to the frame's size."""
    one = found.places.take(slice(number, number + 1))
    with np.errstate(all="ignore"):
        machine = four_bars_at(found.goal, one.of, one.at)
    links, (entry, motion, sense, _) = machine.links, machine.drive
    wheel = found.goal.wheels[one.of[0]].wheel
    b, required, wide = wheel.step.b, float(motion[0, 0]), motion
    own = _machine(target, wheel, FourBar(**_EXAMPLE), math.degrees(required))
    scale = (target.frame or BARE).given_distance_mm / float(machine.distance[0])
    for _ in range(4):  # until the motion has its digits
        w = complex(coupler_drive(links, entry, wide, b, sense).w[0, 0]) * scale
        crank, ground, coupler, rocker = (float(np.ravel(x)[0]) * scale for x in links.numbers[:4])
        try:
            keys = FourBar(
                crank_mm=crank,
                ground_mm=ground,
                coupler_mm=coupler,
                rocker_mm=rocker,
                point_mm=abs(w),
                point_deg=math.degrees(cmath.phase(w)),
                entry_deg=math.degrees(math.remainder(float(entry[0, 0]), math.tau)),
                n_rpm=own.drive.n_rpm,
            )
        except GenevaError:
            return None
        path, phi = keys.roller_path, np.hstack((entry, entry + wide))
        at = points(path, phi)
        phi = phi + newton(at, residual(at, np.array([b]), sense[0]))
        reached = float(np.diff(phi)[0, 0])
        if abs(reached - required) <= 2e-13 * required:  # rounding
            break
        wide = wide + (required - reached)  # the part lost to rounding
    else:
        return None
    pair = Pairs(np.zeros(1, dtype=int), phi, sense[0])
    wheels = driven(path, [(samples, pair) for samples in sampled(path, 1)])
    return own.replace(drive=keys) if len(wheels.which) else None


def _machine(target: Target, wheel: Gearing, drive: FourBar, motion_deg: float) -> Spec:
    """A machine with the requirement's frame; its centre distance follows from the links."""
    unlocked = wheel.replace(held_by="detent")  # there is no locking disc
    spec = machine(target, unlocked, lambda n: drive.replace(n_rpm=n), 1, motion_deg)
    # the coupler passes below the wheel's axis, where a shaft without a hub ends in the wheel
    hub = 0.0 if spec.size.wheel_hub_mm is None else spec.size.wheel_hub_mm
    return spec.replace(size=spec.size.replace(center_distance_mm=None, wheel_hub_mm=hub))

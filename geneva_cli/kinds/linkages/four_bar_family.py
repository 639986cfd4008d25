"""Four-bars whose coupler carries the roller: for every wheel the one of the best proportions.

The crank turns fully (Grashof), no joint is farther from its axis than allowed, and a roller of
usual size passes the wheel on its way back.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.linkages import four_bar_search as search
from geneva_cli.kinds.linkages.four_bar import FourBar
from geneva_cli.kinds.linkages.path_wheels import driven, passed
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.study.synth.families.family import Family, is_compatible, natural_deg
from geneva_cli.study.synth.family_search import Places
from geneva_cli.study.target import AllowedSpan, Target

_SIDES: Any = {"crank_mm": 40.0, "ground_mm": 90.0, "coupler_mm": 100.0, "rocker_mm": 100.0}
_EXAMPLE = FourBar(**_SIDES, point_mm=161.5, point_deg=-36.1, entry_deg=123.3)


def four_bars(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """The best four-bar of each wheel, and some others."""
    if target.rollers not in (None, 1):
        return
    tasks = [task for wheel in wheels if (task := _task(target, wheel))]
    names = [target.sort.name if target.sort else target.peak, *(b.name for b in target.bounds)]
    count = 1 if all(map(search.is_known, names)) else 1 + search.OTHERS
    for goal, places in _searched(target, tasks):
        made = (_spec(target, goal, places, i) for i in range(len(places.of)))
        yield from (Family(spec) for spec in islice(filter(None, made), count))


def _task(target: Target, wheel: Gearing) -> search.WheelGoal | None:
    """The goal of the search for a wheel; None for a wheel that no four-bar drives."""
    free = target.free_motions(1, natural_deg(wheel))
    if free is None:
        return None
    if not is_compatible(_machine(target, wheel, _EXAMPLE, free.low)):
        return None
    frame = target.own
    radius_mm = frame.size.roller_radius_mm
    # half the usual roller, and at most a third of sin b, which is the crank of a plain wheel
    roller = min(0.025, (1.0 / 3.0) * math.sin(wheel.step.b))
    return search.WheelGoal(
        wheel, free, roller if radius_mm is None else radius_mm / frame.given_distance_mm
    )


def _searched(target: Target, tasks: list[search.WheelGoal]) -> list[tuple[search.Goal, Places]]:
    """The search of each wheel that found four-bars, and its places, in the order of the wheels."""
    bounds = tuple(b for b in target.bounds if search.is_known(b.name))
    goal = search.Goal(target, (), bounds, target.peak)
    if target.sort and search.is_known(target.sort.name):
        goal = goal._replace(least=target.sort.name, sign=target.sort.sign)
    rounds = [tasks]
    if target.any_motion and not target.sort:  # that of a plain crank, if it keeps the bounds
        plain = []
        for task in tasks:
            natural = natural_deg(task.wheel)
            plain.append(task._replace(motion=AllowedSpan(natural, natural)))
        rounds.insert(0, plain)
    by_wheel: dict[int, tuple[search.Goal, Places]] = {}
    for tried in rounds:
        left = {i: task for i, task in enumerate(tried) if i not in by_wheel}
        own = goal._replace(wheels=tuple(left.values()))
        for i, found in zip(left, search.search_four_bars(own) if left else [], strict=True):
            if len(found.of):
                by_wheel[i] = own, found
    return [by_wheel[i] for i in sorted(by_wheel)]


def _spec(target: Target, goal: search.Goal, places: Places, number: int) -> Spec | None:
    """The machine of a number in a search, scaled to the frame's size."""
    one = places.take(slice(number, number + 1))
    with np.errstate(all="ignore"):
        machine = search.four_bars_at(goal, one.of, one.at)
    scale, pair = target.own.given_distance_mm / machine.distance, machine.pair
    *lengths, x, y = (np.array(machine.path.numbers) * scale)[:, 0].tolist()
    sides: Any = dict(zip(_SIDES, lengths, strict=True))
    entry, exit_ = pair.phi[:, 0].tolist()
    try:
        drive = FourBar(
            **sides,
            point_mm=math.hypot(x, y),
            point_deg=math.degrees(math.atan2(y, x)),
            entry_deg=math.degrees(math.remainder(entry, math.tau)),
        )
    except GenevaError:
        return None
    path, wheel = drive.roller_path, goal.wheels[one.of[0]].wheel
    wheels, _ = driven(path, pair._replace(which=np.arange(1)))
    drives = len(passed(path, wheels).which)
    return _machine(target, wheel, drive, math.degrees(exit_ - entry)) if drives else None


def _machine(target: Target, wheel: Gearing, drive: FourBar, motion_deg: float) -> Spec:
    """A machine with the requirement's frame; its centre distance follows from the links."""
    unlocked = wheel.replace(held_by="detent")  # there is no locking disc
    spec = target.machine(unlocked, drive, motion_deg)
    # the coupler passes below the wheel's axis, where a shaft without a hub ends in the wheel
    hub = 0.0 if spec.size.wheel_hub_mm is None else spec.size.wheel_hub_mm
    return spec.replace(size=spec.size.replace(center_distance_mm=None, wheel_hub_mm=hub))

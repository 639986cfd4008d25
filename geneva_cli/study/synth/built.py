"""Sizes with which the parts of a chosen machine pass every check in a full turn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.study.synth.fast_parts import SPARE, USUAL, exact, parts, with_roller
from geneva_cli.study.synth.parts_data import parts_data
from geneva_cli.study.synth.turns import HAND_OVER_PLAY, Turn, failing_of, is_lost
from geneva_cli.verdict.both_directions import worst_checks
from geneva_cli.verdict.checks.all_checks import LIMITS, MOTION, applicable
from geneva_cli.verdict.checks.check import Check

# keys that conflict with a crank's bore
SHAFT = {"crank_shaft_mm", "crank_hub_mm", "crank_bore_wall_mm"}
UNDERCUT = "undercut_mm"
UNSIZED = {*MOTION, *LIMITS} - {UNDERCUT}  # checks that no other roller can mend


class Built(NamedTuple):
    """A spec, and the checks that fail in its parts, empty if none does."""

    spec: Spec
    trouble: str


def passes(spec: Spec) -> bool:
    """Return True if the parts pass every check with the sizes of the spec."""
    machine = build(spec)
    return not (_of_motion(machine) or Turn(machine).first_failing)


def built(spec: Spec, fixed: frozenset[str] = frozenset()) -> Built:
    """The spec with the first of some sizes with which its parts pass every check in a full turn.

    ``fixed`` are keys of its [size] that must not change. If no sizes pass, the spec is unchanged.
    """
    machine = build(spec)
    motion, turn = _of_motion(machine), Turn(machine)
    if {one.name for one in motion} & UNSIZED:  # no need to turn them
        return Built(spec, _names(motion))
    failing = known = [*motion, *turn.first_failing]
    if not failing:
        return Built(spec, "")
    if {one.name for one in failing} <= SHAFT:  # test whether other checks fail too
        failing = known = turn.failing
    for other in _others(spec, {one.name for one in failing}, fixed):
        if any(map(is_lost, failing)):
            break
        failing = _other_failing(other, known)
        if not failing:
            return Built(other, "")
        known = [*{(one.name, one.at_deg): one for one in (*failing, *known)}.values()]
    return Built(spec, _names([*motion, *turn.failing]))


def _names(failing: Sequence[Check]) -> str:
    return ", ".join(one.name for one in failing)


def _others(spec: Spec, trouble: set[str], fixed: frozenset[str]) -> Iterator[Spec]:
    """The machine with other sizes: smaller rollers, the nearest first, then larger ones."""
    overhung = "crank_bore_mm" not in fixed and trouble & SHAFT
    if overhung:
        spec = spec.with_("size.crank_bore_mm", 0.0)
        yield spec
    if trouble <= SHAFT or trouble & UNSIZED or "roller_radius_mm" in fixed:
        return
    L = build(spec).center_distance_mm
    r = spec.roller_radius_mm(L)
    least = island = SPARE * parts_data(spec).least if spec.is_flat else 0.0
    if spec.drive.LOCKS and spec.size.lock_radius_mm is None:
        least = max(least, wall_min(spec.size, L))  # a horn is no thicker than its roller's radius
    for other in [exact(0.01 * percent * L) for percent in USUAL]:
        if least <= other < r * (1.0 - 1e-9):
            yield with_roller(spec, other)
    if trouble <= {HAND_OVER_PLAY} and island:
        larger = [with_roller(spec, exact(0.01 * percent * L)) for percent in (8.0, 10.0)]
        yield from (one for one in larger if not parts(build(one)).why)


def _other_failing(spec: Spec, known: Sequence[Check]) -> list[Check]:
    """Some of the checks that fail with other sizes, after those ``known`` to fail before."""
    machine = build(spec)
    named = dict(LIMITS)
    if UNDERCUT in {one.name for one in known}:
        named[UNDERCUT] = MOTION[UNDERCUT]
    return (
        failing_of(applicable(named, machine))
        or Turn(machine).some_failing(known)
        or _of_motion(machine)
    )


def _of_motion(machine: Mechanism) -> list[Check]:
    return failing_of(worst_checks(machine, parts=False))

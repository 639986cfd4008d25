"""Sizes with which the parts of a chosen machine pass every check in a full turn."""

from __future__ import annotations

from itertools import chain

import numpy as np

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.defaults import wall_min
from geneva_cli.study.synth.suiting import SPARE, USUAL, slot_paths, with_roller
from geneva_cli.verdict.checks import LIMITS, MOTION, all_pass, applicable, checks, every_check

# keys that conflict with a crank's bore
SHAFT = {"crank_shaft_mm", "crank_hub_mm", "crank_bore_wall_mm"}
UNSIZED = {*MOTION, *LIMITS} - {"undercut_mm"}  # checks that no other roller can mend


def built(spec: Spec, fixed: frozenset[str] = frozenset()) -> tuple[Spec, str]:
    """The spec with sizes with which its parts pass every check in a full turn, and what fails.

    The largest of the usual rollers that passes is taken: smaller ones fail less. ``fixed`` are
    keys of its [size] that must not change. If no sizes pass, the spec is unchanged.
    """
    machine = build(spec)
    quick = chain(applicable(MOTION, machine), applicable(LIMITS, machine))
    failing = [check.name for check in quick if check.passes is False]
    if not {*failing} & UNSIZED:
        failing = [check.name for check in checks(machine) if check.passes is False]
    trouble = {*failing}
    if not trouble or trouble & UNSIZED:
        return spec, ", ".join(failing)
    own = spec
    if "crank_bore_mm" not in fixed and trouble & SHAFT:
        own = spec.with_("size.crank_bore_mm", 0.0)  # the shaft ends in the arm
        if all_pass(every_check(build(own), quick=True)):
            return own, ""
    if trouble <= SHAFT or "roller_radius_mm" in fixed:
        return spec, ", ".join(failing)
    L = machine.center_distance_mm
    least = SPARE * float(slot_paths(machine).least[0]) if spec.is_flat else 0.0
    if spec.drive.LOCKS and spec.size.lock_radius_mm is None:
        least = max(least, wall_min(spec.size, L))  # a horn is no thicker than its roller's radius
    most = machine.roller_radius_mm * (1.0 - 1e-9)
    radii = [r for r in 0.01 * L * np.array(USUAL) if least <= r < most]
    best = None
    low, high = 0, len(radii)  # those from ``high`` on pass
    while low < high:
        middle = (low + high) // 2
        other = with_roller(own, radii[middle])
        if all_pass(every_check(build(other), quick=True)):
            best, high = other, middle
        else:
            low = middle + 1
    return (best, "") if best else (spec, ", ".join(failing))

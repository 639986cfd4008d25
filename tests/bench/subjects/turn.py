"""The outlines of a machine's parts, and the collision check of a full turn: walls, gaps and play.

Times are in units of one sine and cosine of a million numbers, about 15 ms.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from bench.method import Method, Subject, Task
from geneva_cli.drives.crank import Crank
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.wheels.external import External
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.full_turn import full_turn
from geneva_cli.parts.turn.turn_certificate import certificate, tolerance_mm
from geneva_cli.spec.tables import Size


def subject(quick: bool) -> Subject:
    """One task for each machine, all without clearance."""
    size = Size(center_distance_mm=100.0, roller_radius_mm=5.0)
    specs = {
        "6 straight slots": Spec(External(6), size=size),
        "6 curved slots": Spec(External(6), motion=Motion(ModifiedSine()), size=size),
        "24 straight slots": Spec(External(24), size=size.replace(roller_radius_mm=2.0)),
        "4 slots, 3 rollers": Spec(External(4), Crank(rollers=3), size=size),
    }
    count = 10_000 if quick else 1_000_000
    return Subject(
        "Outlines and full turn of a machine",
        "gap between roller and slot, over the centre distance: without clearance it is 0",
        [_task(name, build(spec), count) for name, spec in specs.items()],
        floor=2e-6,  # accuracy of curved walls
    )


def _task(name: str, machine: Mechanism, count: int) -> Task:
    angles = np.linspace(0.0, 1.0, count)
    return Task(
        name,
        f"one np.sin + np.cos over {count} numbers",
        lambda: (np.sin(angles), np.cos(angles)),
        lambda gap: abs(gap) / machine.center_distance_mm,
        [
            Method("outlines and full turn", None, partial(_turned, machine), True),
            Method("the same, and the certificate", None, partial(_proved, machine), True),
        ],
    )


def _turned(machine: Mechanism) -> float:
    return full_turn(parts_of(machine)).driving.mm


def _proved(machine: Mechanism) -> float:
    parts = parts_of(machine)
    turn = full_turn(parts)
    found = certificate(parts, turn.smallest.mm, tolerance_mm(parts))
    assert found.proved
    return turn.driving.mm

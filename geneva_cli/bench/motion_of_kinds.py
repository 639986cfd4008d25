"""Velocity and acceleration of one design of every machine, at very many angles."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.bench.kinds import KINDS, VariedMachine, values_of
from geneva_cli.bench.method import Method, Task
from geneva_cli.machine.mechanism import build

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from geneva_cli.kinematics.engagement import WheelMotion
    from geneva_cli.numerics.jet import Array

ORDERS = (1, 2)


def tasks(count: int) -> list[Task]:
    """A task for each machine, over ``count`` angles from entry to exit."""
    return [_task(kind, count) for kind in KINDS]


def _task(kind: VariedMachine, count: int) -> Task:
    value = values_of(kind, 1)[0].item()
    motion = build(kind.spec.with_(kind.key, value)).engagements[0].motion
    angles = np.linspace(motion.entry_deg, motion.exit_deg, count)
    angles[1] = 0.5 * (angles[0] + angles[1])  # not its own mirror image: no half is copied
    radians, formula = np.radians(angles), kind.formula and partial(kind.formula, value)
    methods = [
        *(
            [Method("a handbook's formulas, in blocks", count, partial(_blocks, formula, radians))]
            if formula
            else []
        ),
        Method("jets, whole arrays", count, lambda: _jets(motion, angles)),
        Method("ours", count, lambda: motion.derivatives(angles, ORDERS), True),
    ]
    what = f"{kind.name}: velocity and acceleration"
    return angle_task(what, angles, lambda results: _error(motion, angles, results), methods)


def angle_task(
    what: str, angles: Array, error: Callable[[Any], float], methods: Sequence[Method]
) -> Task:
    """A task over angles in degrees, whose baseline is their sine and cosine."""
    radians = np.radians(angles)
    return Task(
        f"{what} at {len(angles)} angles",
        f"one np.sin + np.cos over {len(angles)} angles",
        lambda: (np.sin(radians), np.cos(radians)),
        error,
        methods,
    )


def _blocks(formula: Callable[[Array], Any], x: Array, size: int = 8192) -> Array:
    """Velocity and acceleration by a formula in blocks of angles that stay in the cache."""
    out = np.empty((len(ORDERS), len(x)))
    for i in range(0, len(x), size):
        out[:, i : i + size] = formula(x[i : i + size])
    return out


def _jets(motion: WheelMotion, angles: Array) -> list[Any]:
    """The derivatives from one jet; of a copy, as a motion keeps its latest jet."""
    return list(motion(angles.copy(), ORDERS[-1]).derivatives()[1:])


def _error(motion: WheelMotion, angles: Array, results: Sequence[Any]) -> float:
    """Greatest difference from the values of single angles, by ``math`` instead of NumPy."""
    # the error is measured at 50 angles
    some = np.linspace(0, len(angles) - 1, 50).astype(int)
    exact = np.array([motion(x, ORDERS[-1]).scalars()[1:] for x in angles[some].tolist()]).T
    errors = [
        np.abs(values[some] - own).max() / np.abs(values).max()
        for values, own in zip(results, exact, strict=True)
    ]
    return float(max(errors))

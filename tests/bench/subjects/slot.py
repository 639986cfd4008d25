"""A curved slot's profile: pieces and time against chord error."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from bench.method import Method, Subject, Task
from geneva_cli.motion.laws.standard import Cycloidal
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.wheels.external import External
from geneva_cli.numerics.jet import Array
from geneva_cli.parts.slots.slot_profile import slot
from geneva_cli.parts.slots.slot_sampling import chord_errors, nodes
from geneva_cli.spec.tables import Size


def even(mechanism: Mechanism, tolerance: float) -> Array:
    """Even input angles, as many as needed: the number follows the square root of the error."""
    engagement, count = mechanism.engagements[0], 16
    while True:
        angles = np.linspace(engagement.entry_deg, engagement.exit_deg, count + 1)
        worst = chord_errors(mechanism, angles).max()
        if worst <= tolerance:
            return angles
        count = 2 * int(np.ceil(0.5 * max(count * 1.001, count * np.sqrt(worst / tolerance))))


def bisection(mechanism: Mechanism, tolerance: float) -> Array:
    """Input angles from halving chords until each is within the tolerance."""
    engagement = mechanism.engagements[0]
    angles = np.array([engagement.entry_deg, 0.0, engagement.exit_deg])
    while len(long := np.flatnonzero(chord_errors(mechanism, angles) > tolerance)):
        angles = np.insert(angles, long + 1, 0.5 * (angles[long] + angles[long + 1]))
    return angles


def greedy(mechanism: Mechanism, tolerance: float) -> Array:
    """Input angles of the longest chords within the tolerance, one by one: the fewest possible."""
    engagement = mechanism.engagements[0]
    angles = [engagement.entry_deg]
    guess = engagement.motion_deg / 17
    while (a := angles[-1]) < engagement.exit_deg:
        far = 0.0 if a < 0.0 else engagement.exit_deg

        def good(b: float, a: float = a) -> bool:
            return bool(chord_errors(mechanism, np.array([a, b]))[0] <= tolerance)

        low, high = a, min(a + 2.0 * guess, far)
        while high < far and good(high):
            low, high = high, min(a + 2.0 * (high - a), far)
        if high == far and good(far):
            low = far
        else:
            for _ in range(20):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if good(middle) else (low, middle)
        guess = low - a
        angles.append(low)
    return np.array(angles)


class ChainMethod(NamedTuple):
    """A method that writes a slot as a chain of chords, by the input angles at their ends."""

    name: str
    run: Callable[[Mechanism, float], Array]
    ours: bool = False
    finest: float = 0.0  # mm; at finer tolerances the method would take minutes


def chord_error(mechanism: Mechanism, angles: Array) -> float:
    """Greatest distance of 63 points per chord from it, over pitch curve and flanks, mm.

    The points are complex numbers rotated into each chord's direction, unlike the program's method.
    """
    ends = slot(mechanism, angles)
    inner = np.linspace(0.0, 1.0, 65)[1:-1]
    worst = 0.0
    for start in range(0, len(angles) - 1, 2048):
        a, b = angles[start : start + 2049][:-1], angles[start : start + 2049][1:]
        points = slot(mechanism, (a[:, None] + (b - a)[:, None] * inner).ravel())
        for name in ("centre", "left", "right"):
            p = (getattr(points, name) @ [1.0, 1j]).reshape(len(a), -1)
            q = (getattr(ends, name) @ [1.0, 1j])[start : start + len(a) + 1]
            turned = (p - q[:-1, None]) * np.exp(-1j * np.angle(np.diff(q)))[:, None]
            worst = max(worst, float(np.abs(turned.imag).max()))
    return worst


def chain_methods() -> list[ChainMethod]:
    """All methods, one line each."""
    return [
        ChainMethod("even input angles", even),
        ChainMethod("recursive bisection", bisection),
        ChainMethod("greedy longest chords", greedy, finest=1e-4),
        ChainMethod("ours: polyline", nodes, True),
    ]


def subject(quick: bool) -> Subject:
    """Every method at every tolerance, for a wheel of 8 slots and the cycloidal law."""
    size = Size(center_distance_mm=200.0, roller_radius_mm=9.0, slot_clearance_mm=0.25)
    mechanism = build(Spec(External(8), motion=Motion(Cycloidal(), ratio="matched"), size=size))
    engagement = mechanism.engagements[0]
    angles = np.linspace(engagement.entry_deg, engagement.exit_deg, 1000)
    task = Task(
        "slot of z = 8, cycloidal, matched R/L, L = 200 mm",
        "pitch curve and flanks at 1000 angles",
        lambda: slot(mechanism, angles),
        partial(chord_error, mechanism),
        _methods(mechanism, quick),
    )
    return Subject(
        "A curved slot in pieces", "greatest distance from the curve, mm", [task], floor=0.0
    )


def _methods(mechanism: Mechanism, quick: bool) -> list[Method]:
    tolerances = (1e-2, 1e-3) if quick else (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)  # mm
    return [
        Method(
            method.name,
            tolerance,
            partial(method.run, mechanism, tolerance),
            method.ours,
            pieces=lambda angles: len(angles) - 1,
        )
        for method in chain_methods()
        for tolerance in tolerances
        if tolerance >= method.finest and not (quick and method.run is greedy)
    ]

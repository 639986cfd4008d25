"""Does the design work? Each check with its value, its limit and a change that would pass."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from geneva_cli import loads
from geneva_cli.cautions import SHOWN_UNDERCUT, turns_back
from geneva_cli.drives import GEARED
from geneva_cli.errors import GenevaError
from geneva_cli.keys import Z_USUAL, Spec
from geneva_cli.kinds import is_flat
from geneva_cli.mechanism import Mechanism, build, matched_ratio_of
from geneva_cli.peaks import Peaks, worst
from geneva_cli.pitch import retraces
from geneva_cli.station import LawDriven, LawMotion
from geneva_cli.table import Table, rows_table

STEPS = 60  # tried on the way to a motion of a whole turn
NAMES = ("spec", "check", "value", "at_deg", "must_be", "limit", "passes", "nearest")


class Check(NamedTuple):
    """One check; ``nearest`` names the smallest change found that passes, where it fails.

    ``at_deg`` is the input angle at which the value occurs, where it is of one place.
    """

    name: str
    value: float
    must_be: str
    limit: float
    passes: bool
    nearest: str = ""
    at_deg: float | None = None


def checks(mechanism: Mechanism, parts: bool = True) -> list[Check]:
    """Every check of one design: its motion, its parts unless left out, its own ``[limits]``."""
    shown = _parts(mechanism) if parts else []
    return [*_motion(mechanism), *shown, *_limits(mechanism)]


def checks_table(mechanisms: list[Mechanism]) -> Table:
    """One row a check, spec after spec."""
    rows = [
        (m.spec.path, c.name, c.value, c.at_deg, *c[2:6]) for m in mechanisms for c in checks(m)
    ]
    return rows_table(NAMES, rows)


def _motion(mechanism: Mechanism) -> list[Check]:
    dwell = min(mechanism.dwell_deg(i) for i in range(len(mechanism.stations)))
    out = [Check("dwell_deg", dwell, "at least", 0.0, dwell >= 0.0)]
    if mechanism.spec.drive.kind in GEARED:
        from geneva_cli.gears import convexity

        for gear, least in convexity(mechanism)._asdict().items():
            out.append(Check(f"{gear}_gear_convexity", least, "above", 0.0, least > 0.0))
    station = mechanism.stations[0]
    if not isinstance(station, LawMotion):
        return out
    back = turns_back(station)
    nearest = "lambda = " + f"{math.copysign(0.125, mechanism.spec.motion.lambda_):g}"
    out.append(
        Check(
            "velocity_min",
            back[0] if back else 0.0,
            "at least",
            0.0,
            back is None,
            "" if back is None else nearest if mechanism.spec.motion.law == "sine-group" else "",
        )
    )
    if not isinstance(station, LawDriven):
        return out
    if mechanism.spec.limits.pressure_angle_max_deg is None:
        pressure = loads.greatest(mechanism, "pressure_deg").max
        out.append(_pressure(mechanism, pressure, 90.0))
    out.append(_undercut(mechanism))
    return out


def _parts(mechanism: Mechanism) -> list[Check]:
    """Walls, shafts and the full turn, where the machine has flat parts."""
    if not is_flat(mechanism.spec):
        return []
    from geneva_cli.clearances import clearances
    from geneva_cli.full_turn import full_turn
    from geneva_cli.outline import outlines

    try:
        found = outlines(mechanism)
    except GenevaError as error:
        return [Check("parts", 0.0, "at least", 1.0, False, str(error))]
    return [
        Check(
            c.name,
            c.value,
            "at least" if c.at_least else "at most",
            c.limit,
            c.passes,
            c.nearest,
            c.at_deg,
        )
        for c in clearances(found, full_turn(found))
    ]


def _pressure(mechanism: Mechanism, value: float, limit: float) -> Check:
    name = "pressure_angle_deg"
    if retraces(mechanism.stations[0]):
        passes = value <= limit
        nearest = "" if passes else _slower_wheel(mechanism, _pressure_below(limit))
        return Check(name, value, "at most", limit, passes, nearest)
    matched = matched_ratio_of(mechanism)
    nearest = f'ratio = "matched" ({matched:.6g})' if matched is not None else ""
    return Check(name, value, "at most", limit, False, nearest)


def _pressure_below(limit: float) -> Callable[[Mechanism], bool]:
    return lambda m: loads.greatest(m, "pressure_deg").max <= limit


def _undercut(mechanism: Mechanism) -> Check:
    from geneva_cli.undercut import undercut

    def depth(spec: Spec) -> float:
        found = undercut(mechanism._replace(spec=spec))
        return found.depth_mm if found else 0.0

    def sized(radius: float) -> Spec:
        size = mechanism.spec.size._replace(roller_radius_mm=radius)
        return mechanism.spec._replace(size=size)

    value = depth(mechanism.spec)
    name = "undercut_mm"
    if value <= SHOWN_UNDERCUT:
        return Check(name, value, "at most", SHOWN_UNDERCUT, True)
    r = _passing(lambda r: depth(sized(r)) <= SHOWN_UNDERCUT, mechanism.spec.roller_radius_mm, 0.0)
    nearest = f"roller_radius_mm = {r:.4g}" if r else ""
    return Check(name, value, "at most", SHOWN_UNDERCUT, False, nearest)


def _limits(mechanism: Mechanism) -> list[Check]:
    limits = mechanism.spec.limits
    if not any(v is not None for v in limits):
        return []
    peaks = worst(mechanism)
    out = []
    for key, limit in limits._asdict().items():
        if limit is None:
            continue
        name = key
        if key in _INVARIANTS:
            pick = _INVARIANTS[key]
            value = pick(peaks)
            nearest = "" if value <= limit else _slower_wheel(mechanism, _below(pick, limit))
            out.append(Check(name, value, "at most", limit, value <= limit, nearest))
        elif key == "pressure_angle_max_deg":
            out.append(_pressure(mechanism, _load(mechanism, key), limit))
        else:
            value = _load(mechanism, key)
            passes = value <= limit
            nearest = "" if passes else _eased(mechanism, key)
            out.append(Check(name, value, "at most", limit, passes, nearest))
    return out


_INVARIANTS: dict[str, Callable[[Peaks], float]] = {
    "velocity_max": lambda p: p.velocity.max,
    "acceleration_max": lambda p: p.acceleration.max,
    "acceleration_entry_max": lambda p: p.ends.acceleration_entry,
    "jerk_max": lambda p: p.jerk.max,
}
_LOADS = {
    "pin_force_max_N": "pin_force_N",
    "input_torque_max_Nm": "input_torque_Nm",
    "pressure_angle_max_deg": "pressure_deg",
    "contact_stress_max_MPa": "contact_stress_MPa",
}


def _below(pick: Callable[[Peaks], float], limit: float) -> Callable[[Mechanism], bool]:
    return lambda m: pick(worst(m)) <= limit


def _load(mechanism: Mechanism, key: str) -> float:
    return loads.greatest(mechanism, _LOADS[key]).max


def _slower_wheel(mechanism: Mechanism, passes: Callable[[Mechanism], bool]) -> str:
    """More slots, or, where the motion is given, less extra dwell."""
    spec = mechanism.spec
    if mechanism.law is None:
        for z in range(spec.wheel.z + 1, Z_USUAL + 1):
            changed = _built(spec._replace(wheel=spec.wheel._replace(z=z)))
            if changed and passes(changed):
                return f"z = {z}"
        return ""

    def with_dwell(alpha0: float) -> Mechanism | None:
        return _built(spec._replace(motion=spec.motion._replace(alpha0_deg=alpha0)))

    def works(alpha0: float) -> bool:
        changed = with_dwell(alpha0)
        return changed is not None and passes(changed)

    # Outwards from the alpha_0 that fails, on both sides, to the nearest that passes.
    now, motion = spec.motion.alpha0_deg, mechanism.stations[0].motion_deg
    span = 360.0 / spec.drive.rollers
    for i in range(1, STEPS):
        for side in (-1.0, 1.0):
            far = now + side * span * i / STEPS
            if 0.0 < motion - side * span * i / STEPS < span and works(far):
                found = _passing(works, now + side * span * (i - 1) / STEPS, far)
                return f"alpha0_deg = {found:.9g}"
    return ""


def _eased(mechanism: Mechanism, key: str) -> str:
    """A slower input shaft, or, where the resisting torque alone is too much, a larger machine."""
    spec = mechanism.spec
    limit: float = getattr(spec.limits, key)

    def slower(n_rpm: float) -> bool:
        changed = mechanism._replace(spec=spec._replace(drive=spec.drive._replace(n_rpm=n_rpm)))
        return _load(changed, key) <= limit

    n = _passing(slower, spec.drive.n_rpm, spec.drive.n_rpm * 1e-6)
    if n is not None:
        return f"n_rpm = {n:.4g}"
    if key == "input_torque_max_Nm":
        return ""

    def larger(L: float) -> bool:
        size = spec.size._replace(
            center_distance_mm=L, roller_radius_mm=spec.roller_radius_mm * L / start
        )
        return _load(mechanism._replace(spec=spec._replace(size=size)), key) <= limit

    start = spec.size.center_distance_mm
    L = _passing(larger, start, 100.0 * start)
    return f"center_distance_mm = {L:.4g} and the roller with it" if L is not None else ""


def _built(spec: Spec) -> Mechanism | None:
    try:
        return build(spec)
    except GenevaError:
        return None


def _passing(passes: Callable[[float], bool], fails_at: float, far: float) -> float | None:
    """The value nearest to ``fails_at`` that passes, towards ``far``; None if far fails too."""
    if not passes(far):
        return None
    good, bad = far, fails_at
    for _ in range(40):
        middle = 0.5 * (good + bad)
        if passes(middle):
            good = middle
        else:
            bad = middle
        if abs(good - bad) <= 1e-5 * abs(good):
            break
    # Four digits are shown: round to the side that passes.
    for digits in range(4, 9):
        shown = float(f"{good:.{digits}g}")
        step = abs(good) * 10.0 ** (1 - digits)
        for value in (shown, shown + math.copysign(step, good - bad)):
            if passes(value):
                return value
    return good

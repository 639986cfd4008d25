"""Timing and peaks of each engagement; when each of several wheels or cranks moves."""

from __future__ import annotations

import math

from geneva_cli.loads import highest_speed
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import Peaks, placed_peaks
from geneva_cli.motion.timing import timings
from geneva_cli.numerics.angles import omega
from geneva_cli.parts.parts import Parts
from geneva_cli.table import rows_table
from geneva_cli.verdict.quantities.batch_designs import Numbers, Values
from geneva_cli.verdict.quantities.motion_quantities import peak_values


def shortest_motion(parts: Parts) -> Values:
    """The time of the fastest motion, if it is equal in all engagements."""
    each = [engagement.motion_deg for engagement in parts.mechanism.engagements]
    # Rounding makes a motion differ between engagements by up to 1e-12 of it.
    if not math.isclose(min(each), max(each), rel_tol=1e-12):
        return {}
    return {"shortest_motion_s": _shortest_s(parts.mechanism, each[0])}


def _shortest_s(mechanism: Mechanism, motion_deg: float) -> float | None:
    """The time of a motion at the highest speed that the limits on loads allow.

    Krasniqi's (15) and (16). Without limits it is that at n; None if no speed keeps them.
    """
    fastest = highest_speed.fastest_rpm(mechanism)
    if fastest is not None and math.isinf(fastest):
        fastest = mechanism.spec.drive.n_rpm
    return motion_deg / (6.0 * fastest) if fastest else None


def stations(parts: Parts) -> Values:
    """A row for each engagement, if they differ."""
    mechanism = parts.mechanism
    if len(mechanism.engagements) == 1:
        return {"stations": None}
    each = [
        {f"timing.{name}": value for name, value in _timing(mechanism, i).items()}
        | _peaks(mechanism, placed_peaks(mechanism, s))
        for i, s in enumerate(mechanism.engagements)
    ]
    return {"stations": rows_table(tuple(each[0]), [tuple(e.values()) for e in each])}


def _timing(mechanism: Mechanism, i: int) -> Numbers:
    timing = timings(mechanism)[i]
    values: Numbers = timing._asdict()
    motion = timing.motion_deg
    values["shortest_motion_s"] = _shortest_s(mechanism, motion)
    values["k_r"] = motion / (360.0 - motion) if motion < 360.0 else None
    return values


def _peaks(mechanism: Mechanism, peaks: Peaks) -> Numbers:
    w, ends, output = omega(mechanism.spec.drive.n_rpm), peaks.ends, mechanism.output
    return {
        **peak_values("velocity", output, w, peaks.velocity, ()),
        **peak_values("acceleration", output, w, peaks.acceleration, ends[:2]),
        **peak_values("jerk", output, w, peaks.jerk, ends[2:]),
        **peak_values("power", output, w, peaks.power, ()),
    }


def wheels(parts: Parts) -> Values:
    """A row for each of several wheels: where it stands, and when it moves.

    Angles are those of the carrier from the middle of the first wheel's motion.
    """
    mechanism = parts.mechanism
    places = mechanism.wheel_places
    if len(places) < 2:
        return {"wheels": None}
    (one,) = mechanism.engagements  # one finger, which all wheels meet alike
    names = ("wheel", "behind_deg", "entry_deg", "exit_deg", "entry_s")
    rows = []
    for place in places:
        behind = place.behind_deg
        after_s = behind / (6.0 * mechanism.spec.drive.n_rpm)  # n rpm is 6 n degrees a second
        rows.append((place.number, behind, behind + one.entry_deg, behind + one.exit_deg, after_s))
    return {"wheels": rows_table(names, rows)}


def cranks(parts: Parts) -> Values:
    """A row for each of several cranks; None for a single one.

    Input angles are from the middle of the first crank's motion. Slots count counterclockwise from
    that which the first crank then enters. In step n a crank enters slot k - n from place k.
    """
    mechanism = parts.mechanism
    places = mechanism.crank_places
    if len(places) < 2:
        return {"cranks": None}
    spec = mechanism.spec
    each = mechanism.engagements  # one of each crank, if they differ
    every = math.gcd(len(places), spec.wheel.z)
    names = ("crank", "place_deg", "behind_deg", "entry_deg", "exit_deg", "entry_s", "slot")
    rows = []
    for k, (place, step) in enumerate(zip(places, spec.drive.cranks, strict=True)):
        number, i = divmod(k, len(each))
        one = each[i]
        behind = number * mechanism.period_deg + one.mid_deg - each[0].mid_deg
        ends = behind + one.entry_deg, behind + one.exit_deg
        # n rpm is 6 n degrees a second
        after_s = (ends[0] - each[0].entry_deg) / (6.0 * spec.drive.n_rpm)
        slot = (int(step) - place.number + 1) % every
        place_deg = 360.0 * step / spec.wheel.z
        rows.append((place.number, place_deg, behind, *ends, after_s, slot, every))
    return {"cranks": rows_table((*names, "slot_every"), rows)}

"""The table of wheels: timing and peaks for each number of slots."""

from typing import TypeAlias

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.timing import CamFactors, Timing, cam_factors, timing
from geneva_cli.motion.wheels import classic
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.spec.rules import SPEED, Z_MAX, range_text
from geneva_cli.table import Reading, Table, rows_table

TIMES = Timing._fields[:-1]  # no rack is among them
PEAKS = ("velocity_max", *(f"acceleration_{x}" for x in ("max", "max_deg", "entry")), "jerk_entry")
NAMES = ("z", "gearing", "rollers", *TIMES, *PEAKS, "rollers_max", *CamFactors._fields)
SIGNS = {"external": 1.0, "internal": -1.0}  # the gearings with closed forms
ROWS_MAX = 10_000
# Timing, peaks of velocity to jerk and of power, and the most rollers.
Moves: TypeAlias = tuple[Timing, tuple[float, ...], int]


def survey(z: str, gearing: str, n_rpm: float, rollers: int, A: float) -> Table:
    """One row for each z in a text like ``6``, ``3..12`` or ``3,4,6``."""
    if n_rpm not in SPEED:
        raise GenevaError(f"--n {n_rpm:g}: the speed must be {SPEED}")
    if not -1.0 < A < 1.0:
        raise GenevaError(f"--A {A:g}: the side-crank's offset must be above -1 and below 1")
    if rollers < 1:
        raise GenevaError(f"--rollers {cut(rollers)}: a crank carries at least 1")
    if rollers > 1 and A:
        text = "--rollers with --A: the engagements differ, so one row cannot describe them; write "
        raise GenevaError(text + 'a spec with kind = "side-crank" and use `geneva report`')
    rows, wheels = [], parse_z(z)
    for slots in wheels:
        try:
            if A or gearing not in SIGNS:
                own = _general(slots, gearing, n_rpm, rollers, A)
            else:
                own = _classic(slots, SIGNS[gearing], n_rpm, rollers)
        except GenevaError as error:
            raise GenevaError(f"--z {slots}: {error}") from None
        times, (*peaks, power), most = own
        factors = cam_factors(peaks[0], peaks[1], power, times.motion_deg, 360.0 / slots)
        rows.append((slots, gearing, rollers, *times[:-1], *peaks, most, *factors))
    # the columns in order of importance, for a window too narrow for all
    first = "z motion_deg dwell_deg acceleration_max velocity_max motion_s dwell_s index_deg "
    first += "acceleration_max_deg rollers_max acceleration_entry jerk_entry"
    drive = f"side-crank A = {A:g}" if A else "one roller" if rollers == 1 else f"{rollers} rollers"
    indexes = "one index" if rollers == 1 else f"{rollers} indexes"
    cycle = f"cycle {60.0 / n_rpm / rollers:.5g} s"
    title = f"{gearing.capitalize()} wheels, {drive}, {n_rpm:g} rpm: {indexes} a turn, {cycle}."
    reading = Reading(tuple(first.split()), title, ("gearing", "rollers", "cycle_s"))
    return rows_table(NAMES, rows).replaced(reading=reading)


def _classic(z: int, sign: float, n_rpm: float, rollers: int) -> Moves:
    """Those from closed forms, without building a machine."""
    motion = 2.0 * classic.half_motion_deg(sign, 1, z)
    classic.refuse_jam(rollers, motion)
    l, cos_b = sin_cos_pi(1, z)
    gap = classic.gap(sign, 1, z)
    entry = l / cos_b  # the jump at entry is tan b, the jerk after it 3 tan² b
    most, at_deg = (entry, 0.5 * motion) if sign < 0.0 else classic.acceleration_peak(l, gap)
    # of two equal places the earlier one
    peaks = l / gap, most, -at_deg, entry, 3.0 * entry * entry, classic.power_peak(l, gap)[0]
    times = timing(motion, 360.0 / rollers - motion, 360.0 / z, n_rpm)
    return times, peaks, classic.rollers_max(motion)


def _general(z: int, gearing: str, n_rpm: float, rollers: int, A: float) -> Moves:
    """Those from a built machine, without closed forms."""
    from geneva_cli.design import Design
    from geneva_cli.drives.crank import Crank
    from geneva_cli.drives.side_crank import SideCrank
    from geneva_cli.motion import registry

    drive = SideCrank(A=A, n_rpm=n_rpm) if A else Crank(n_rpm=n_rpm, rollers=rollers)
    design = Design(registry.gearing(gearing)(z), drive)
    velocity, most, _, power, ends = design.peaks
    own = velocity.max, most.max, most.at_deg, ends.acceleration_entry, ends.jerk_entry, power.max
    return design.timing, own, design.mechanism.rollers_max


def parse_z(text: str) -> list[int]:
    """Return the numbers of slots in ``6``, ``3..12``, ``4..12:2``, ``3,4,6`` or a mixture."""
    out: list[int] = []
    option = f"--z {cut(text)}"
    for part in text.split(","):
        least, most, by = range_text(part, option) or (part, part, "")
        numbers = [number.strip() for number in (least, most, by or "1")]
        if not all(x.isascii() and x.isdigit() and len(x) < 12 for x in numbers):
            raise GenevaError(f"{option}: it must be whole numbers, as 6, 3..12 or 3,4,6")
        low, high, step = map(int, numbers)
        if not (3 <= low <= high <= Z_MAX and step):
            raise GenevaError(f"{option}: it must be at least 3, at most {Z_MAX}, the lesser first")
        if len(out) + (high - low) // step >= ROWS_MAX:
            raise GenevaError(f"{option}: that is more than {ROWS_MAX} rows; give fewer")
        out.extend(range(low, high + 1, step))
    return out
